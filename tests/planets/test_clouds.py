"""Tables ``[[clouds]]``: read, overridden, refused where they would be ignored."""

import pytest

from airlight.cli.planet_options import PlanetOptions
from airlight.errors import ConflictError, ParameterError
from airlight.planets import Medium, load_planet, replace
from airlight.planets.clouds import CLOUDS, Cirrus, CloudFile, CumulusHumilis
from airlight.planets.reading.declared_keys import spelled_out
from airlight.planets.reading.overrides import parsed
from airlight.viewer.parameters.parameter_list import parameters_of

EARTH = "earth-atmosphere-plus"


def _clouds(*tables, **overrides):
    return load_planet(EARTH, {"clouds": list(tables), **overrides}).clouds


def test_kinds_have_defaults_of_their_own_and_files_need_no_kind(tmp_path):
    cumulus, cirrus, file = _clouds(
        {"kind": "cumulus", "cover": 0.4, "base": "1.2 km"},
        {"kind": "cirrus", "name": "high"},
        {"file": str(tmp_path / "les.nc")},
    )
    assert cumulus == CumulusHumilis(cover=0.4, base=1200.0)
    assert cirrus == Cirrus(name="high")
    assert cirrus.particles == "ice"
    assert file == CloudFile(file=str(tmp_path / "les.nc"))
    assert [one.title for one in (cumulus, cirrus, file)] == ["cumulus", "high", "file"]


def test_a_planet_without_clouds_is_unchanged():
    planet = load_planet(EARTH)
    assert planet.clouds == ()
    assert planet.without_clouds is planet
    clouded = replace(planet, clouds=(Cirrus(),))
    fingerprints = [
        Medium.from_planet(one, [550.0]).fingerprint() for one in (planet, clouded.without_clouds)
    ]
    assert fingerprints[0] == fingerprints[1]


def test_a_path_names_the_only_clouds_or_some_by_name_or_kind():
    (one,) = _clouds({"kind": "cumulus"}, **{"clouds.cover": 0.7})
    assert one.cover == 0.7
    low, high = _clouds(
        {"kind": "cumulus"},
        {"kind": "cirrus", "name": "high.thin"},
        **{"clouds.cumulus.cover": 0.1, "clouds.high.thin.cover": 0.2, "clouds[1].depth": "1 km"},
    )
    assert (low.cover, high.cover, high.depth) == (0.1, 0.2, 1000.0)
    with pytest.raises(ParameterError, match=r"clouds\.cumulus\.cover or clouds\.cirrus\.cover"):
        _clouds({"kind": "cumulus"}, {"kind": "cirrus"}, **{"clouds.cover": 0.7})


def test_solvers_do_not_ignore_clouds():
    planet = load_planet(EARTH, {"clouds": [{"kind": "stratus"}]})
    with pytest.raises(ConflictError, match="clouds cannot be used by this computation"):
        Medium.from_planet(planet, [550.0])


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"kind": "cumulos"}, "did you mean 'cumulus'"),
        ({"kind": "cumulus", "cover": 1.1}, r"clouds\[0\].cover is 1.1; allowed: 0 to 1"),
        ({"kind": "cumulus", "base": 3}, "base"),
        ({"kind": "cumulus", "bas": "1 km"}, "did you mean 'base'"),
        ({"kind": "file"}, "file"),
        ({"cover": 0.4}, "kind"),
        ({"kind": "cirrus", "particles": "snow"}, "water, ice"),
    ],
)
def test_invalid_tables_get_one_line(table, message):
    with pytest.raises(ParameterError, match=message):
        _clouds(table)


def test_names_are_unique_and_few():
    with pytest.raises(ParameterError, match="unique"):
        _clouds({"kind": "cirrus"}, {"kind": "cirrus"})
    with pytest.raises(ParameterError, match="at most 8"):
        _clouds(*({"kind": "cirrus", "name": f"{k}"} for k in range(9)))


def test_the_option_replaces_the_clouds_of_the_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    given = {"kind": "cumulus"}, "cumulus", {"file": str(tmp_path / "les.nc")}, "les.nc"
    for table, text in (given[:2], given[2:]):
        (change,) = PlanetOptions(planet=EARTH, clouds=text).overrides
        assert parsed(change) == ("clouds", [table])
    planet = PlanetOptions(planet=EARTH, clouds="cirrus", set_=["clouds.cover=0.3"]).load()
    assert planet.clouds == (Cirrus(cover=0.3),)
    assert PlanetOptions(planet=EARTH, clouds="none").load().clouds == ()
    with pytest.raises(ParameterError, match="did you mean 'cirrus'"):
        PlanetOptions(planet=EARTH, clouds="cirus").load()


def test_editors_show_every_key_of_clouds():
    names = {one.name for one in CLOUDS.declared({"kind": "cumulus"})}
    shown = [one.path for one in parameters_of({"clouds": [{"kind": "cumulus"}]})]
    own = {path.removeprefix("clouds[0].") for path in shown if "clouds[0]" in path}
    assert own == names - {"name", "latitude", "longitude"}  # which have no default value
    assert {path for path in shown if "clouds" in path and "clouds[0]" not in path} == {
        "clouds[1].kind"  # adds another
    }
    two = parameters_of({"clouds": [{"kind": "cumulus"}, {"kind": "cirrus", "name": "high"}]})
    covers = [(one.group, one.label) for one in two if one.path.endswith("cover")]
    assert covers == [("3-D clouds", "cumulus: cover"), ("3-D clouds", "high: cover")]
    assert parameters_of({"clouds": []}) == parameters_of({})


def test_paths_of_clouds_are_made_absolute_for_editors(tmp_path):
    tables = {"clouds": [{"file": "les.nc"}]}
    assert spelled_out(tables, tmp_path)["clouds"][0]["file"] == str(tmp_path / "les.nc")

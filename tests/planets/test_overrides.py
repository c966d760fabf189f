"""Changes of single keys of a planet file before it is read."""

from __future__ import annotations

import tomllib
from importlib import resources

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError, ParameterErrors
from airlight.planets import Medium, load_planet, planet_names
from airlight.planets.matter.profiles import PROFILES
from airlight.planets.reading.overrides import overridden, parsed
from airlight.planets.reading.reader import read_planet

FILE = """
name = "Test"
shell = { bottom_radius = "6360 km", top_radius = "6460 km" }
star = { irradiance = "1 W/m^2/nm", angular_radius = "0.25 deg" }

[ground]
wavelengths = "680, 550, 440 nm"
albedo = [0.1, 0.2, 0.3]

[[constituents]]
name = "air v1.2"
profile = { kind = "exponential", scale_height = "8 km" }
scattering = { rayleigh = "air", temperature = "288.15 K", pressure = "101325 Pa" }

[[constituents]]
name = "ground"
profile = { kind = "uniform" }
absorption = "1e-6 /m"
"""


def read(path, value):
    return read_planet(FILE, "test.toml", overrides={path: value})


def test_an_override_equals_the_same_key_edited_in_the_file():
    # the definition: the file with another text for that key
    edited = FILE.replace('"8 km"', '"9 km"').replace("0.2, 0.3", "0.25, 0.3")
    changed = read_planet(
        FILE,
        "test.toml",
        overrides={"air v1.2.profile.scale_height": "9 km", "ground.albedo[1]": 0.25},
    )
    assert changed == read_planet(edited, "test.toml")
    assert changed != read_planet(FILE, "test.toml")


def test_twice_the_dust_is_twice_its_optical_depth():
    # the optical depth is set: dust of Mars at 550 nm, the rest unchanged
    nm = [680.0, 550.0, 440.0]
    before = Medium.from_planet(load_planet("mars"), nm).vertical_optical_depth
    path = "dust.particles.optical_depth"
    factor = 2.0
    if "particles" not in _tables("mars")["constituents"][1]:
        path, given = "dust.optical_depth", _tables("mars")["constituents"][1]["optical_depth"]
        doubled = [factor * value for value in given]
    else:
        doubled = factor * _tables("mars")["constituents"][1]["particles"]["optical_depth"]
    after = Medium.from_planet(load_planet("mars", {path: doubled}), nm).vertical_optical_depth
    assert_allclose(after[1], factor * before[1], rtol=1e-12)
    assert_allclose(after[0], before[0], rtol=0, atol=0)


def _tables(name):
    file = resources.files("airlight.planets") / "presets" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def test_a_name_with_dots_and_a_name_that_is_a_table_are_both_found():
    # "air v1.2" is one name; "ground" is the table, and the constituent only by its index
    assert read("air v1.2.scattering.pressure", "2 bar").constituents[0].scattering.pressure == 2e5
    assert read("ground.albedo", 0.5).ground.albedo == 0.5
    assert read("constituents[1].absorption", "2e-6 /m").constituents[1].absorption == 2e-6


def test_none_takes_a_key_away_and_makes_room_for_another():
    # a star has an irradiance or a temperature: one must be removed before the other is set
    with pytest.raises(ParameterError, match="one of spectrum, irradiance, temperature"):
        read("star.spectrum", "astm-g173")
    sun = read_planet(
        FILE, "t", overrides={"star.irradiance": None, "star.spectrum": "astm-g173"}
    ).star
    assert sun.irradiance is None
    assert sun.spectrum == "astm-g173"


def test_arrays_and_tables_of_python_stand_for_those_of_the_file():
    values = {
        "ground.albedo": np.array([0.4, 0.5, 0.6]),
        "constituents[1].wavelengths": ("500 nm",),
    }
    changed = read_planet(FILE, "t", overrides=values)
    assert_allclose(changed.ground.albedos([680.0, 550.0, 440.0]), [0.4, 0.5, 0.6], rtol=1e-15)
    profile = {"kind": "tent", "center": "25 km", "half_width": "15 km"}
    assert read("constituents[1].profile", profile).constituents[1].profile.half_width == 15e3


def test_the_file_given_is_not_changed():
    file = {"ground": {"albedo": [0.1]}}
    assert overridden(file, {"ground.albedo[0]": 0.9}) == {"ground": {"albedo": [0.9]}}
    assert file == {"ground": {"albedo": [0.1]}}


@pytest.mark.parametrize("name", planet_names())
def test_no_override_is_no_change(name):
    assert load_planet(name, {}) == load_planet(name)


@pytest.mark.parametrize(
    ("path", "meant"),
    [
        ("grond.albedo", "ground.albedo"),
        ("air.scattering.pressure", "air v1.2.scattering.pressure"),
        ("air v1.2.scatering.pressure", "air v1.2.scattering.pressure"),
        ("scale_height", "air v1.2.profile.scale_height"),
        ("ground.albedo[3]", "ground.albedo"),
        ("ground.albedo[0].x", "ground.albedo"),
        ("ground..albedo", "ground.albedo"),
        ("ground.albdo", "albedo"),
    ],
)
def test_a_path_that_leads_nowhere_is_one_line_with_the_nearest(path, meant):
    with pytest.raises(ParameterError) as caught:
        read(path, 0.3)
    message = str(caught.value)
    assert message.startswith("test.toml: ")
    assert f"did you mean '{meant}" in message
    assert "\n" not in message


@pytest.mark.parametrize("path", ["", " ", "constituents[9].name", "ground.", "[0]", 3, "a\nb.c"])
def test_what_is_no_path_is_refused(path):
    with pytest.raises(ParameterError, match="override"):
        read(path, 0.3)


def test_an_impossible_value_is_refused_by_the_field_s_own_range():
    with pytest.raises(ParameterError, match=r"ground.albedo is 1.5; allowed: 0 to 1"):
        read("ground.albedo", 1.5)
    with pytest.raises(ParameterError, match=r"overrides is 'ground.albedo=1'"):
        load_planet("earth", "ground.albedo=1")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ground.albedo=0.3", ("ground.albedo", 0.3)),
        ("star.distance = 1.5 au", ("star.distance", "1.5 au")),
        ("name='a = b'", ("name", "a = b")),
        ("name=a = b", ("name", "a = b")),
        ("a.b=[1, 2]", ("a.b", [1, 2])),
        ("a.b={ kind = 'tent' }", ("a.b", {"kind": "tent"})),
        ("a.b=", ("a.b", None)),
        ("a=1\nb=2", ("a", "1\nb=2")),
    ],
)
def test_the_command_line_s_text_is_toml_or_itself(text, expected):
    assert parsed(text) == expected


@pytest.mark.parametrize("text", ["ground.albedo", "=0.3", ""])
def test_text_without_path_or_sign_is_refused(text):
    with pytest.raises(ParameterError, match="PATH=VALUE"):
        parsed(text)


def test_of_two_names_that_fit_the_longer_is_meant():
    # "haze.fine" is a constituent, and not the key "fine" of "haze"
    file = {"constituents": [{"name": "haze"}, {"name": "haze.fine", "at": 1}]}
    changed = overridden(file, {"haze.fine.at": 2})
    assert changed["constituents"] == [{"name": "haze"}, {"name": "haze.fine", "at": 2}]


#: One profile of each kind.
KINDS = {
    "exponential": 'kind = "exponential", scale_height = "8 km"',
    "tent": 'kind = "tent", center = "95 km", half_width = "15 km"',
    "layered": 'kind = "layered", layers = [{ width = "10 km", constant_term = 1 }, '
    "{ constant_term = 0.5 }]",
    "tabulated": 'kind = "tabulated", altitudes = "0, 50, 100 km", densities = [1, 0.5, 0.2]',
    "layers": 'kind = "layers", altitudes = "0, 11 km", temperature = "288 K", '
    'lapse_rates = "6.5, 0 K/km", molar_mass = "29 g/mol", gravity = "9.8 m/s^2", '
    'gravity_radius = "6360 km"',
    "sounding": 'kind = "sounding", temperatures = "288, 217 K", altitudes = "0, 11 km", '
    'molar_mass = "29 g/mol", gravity = "9.8 m/s^2"',
    "uniform": 'kind = "uniform"',
}


def test_every_kind_of_profile_is_tried():
    # the list above is complete
    assert set(KINDS) == {one.keyword for one in PROFILES.classes}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("radius", ["500 km", "6400 km", "1e5 km"])
def test_the_air_keeps_its_thickness_when_the_ground_moves(kind, radius):
    # by definition: densities over altitude, and so the columns, do not know the radius
    text = FILE.replace('kind = "uniform"', KINDS[kind])
    before = read_planet(text, "test.toml")
    after = read_planet(text, "test.toml", overrides={"shell.bottom_radius": radius})
    assert_allclose(after.thickness, 100e3, rtol=1e-9)
    media = [Medium.from_planet(one, [550.0]) for one in (before, after)]
    assert_allclose(media[1].columns, media[0].columns, rtol=1e-9)


def test_a_top_that_is_given_stays():
    # by definition, in either order
    for paths in (("bottom", "top"), ("top", "bottom")):
        ends = {"bottom": "6300 km", "top": "6500 km"}
        radii = {f"shell.{one}_radius": ends[one] for one in paths}
        planet = read_planet(FILE, "test.toml", overrides=radii)
        assert (planet.bottom_radius, planet.top_radius) == (6300e3, 6500e3)


@pytest.mark.parametrize("radius", ["5 km", "2e9 km", "0 km", "-7 km", "7 s", "wide", 1e4])
def test_a_ground_that_does_not_fit_is_the_radius_s_own_error(radius):
    # the key that was typed is named, and not the one that moves along
    with pytest.raises(ParameterError, match=r"shell\.bottom_radius is") as caught:
        read("shell.bottom_radius", radius)
    assert "top_radius" not in str(caught.value)


def test_light_that_would_follow_the_larger_ground_is_the_radius_s_error():
    # around 1e5 km air of 8 km scale height bends light by more than the ground is bent
    with pytest.raises(ParameterError, match=r"shell\.bottom_radius is '1e5 km'; allowed: a sm"):
        load_planet("earth", {"shell.bottom_radius": "1e5 km"})


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("star.irradiance", "1 W/m^2/nm"),
        ("star.temperature", "5800 K"),
        ("aerosol.extinction", "1e-5 /m"),
        ("air.absorption", 3),
        ("ozone.scattering", 5),
        ("shell.thickness", 5),
        ("rings", 3),
    ],
)
def test_no_key_is_guessed_for_one_that_files_may_have_or_that_resembles_none(path, value):
    # the first five are declared keys that the file has not; "rings" and "thickness" are like none
    with pytest.raises(ParameterError) as caught:
        load_planet("earth", {path: value})
    assert "did you mean" not in str(caught.value)


def test_all_offending_keys_of_a_file_are_in_one_line():
    # five keys in four tables, two of them unknown, one of another unit, two out of range
    with pytest.raises(ParameterErrors) as caught:
        load_planet(
            "earth",
            {
                "ground.albdo": 0.3,
                "ground.brightness": -1,
                "star.distance": "3 kg",
                "ozone.absorption.ozone": 0.3,
                "air.colour": "blue",
            },
        )
    line = str(caught.value)
    assert line.startswith("earth.toml: ")
    assert "\n" not in line
    for part in (
        "'albdo'", "ground.brightness is -1", "star.distance is '3 kg'",
        "constituents[2].absorption.ozone is 0.3", "'colour'",
    ):  # fmt: skip
        assert part in line
    assert len(caught.value.errors) == 5


def test_all_paths_that_lead_nowhere_are_in_one_line():
    with pytest.raises(ParameterErrors, match=r"ground\.albedo.*air\.profile") as caught:
        load_planet("earth", {"grond.albedo": 0.3, "air.profil.kind": "uniform", "name": "x"})
    assert [one.value for one in caught.value.errors] == ["grond.albedo", "air.profil.kind"]


def test_a_line_of_many_errors_has_an_end():
    with pytest.raises(ParameterErrors) as caught:
        load_planet("earth", {f"ground.key{k}": k for k in range(200)})
    assert len(str(caught.value)) < 1000
    assert str(caught.value).endswith(" more")
    assert len(caught.value.errors) == 200


@pytest.mark.parametrize(
    ("text", "molecules"),
    [
        ("300 DU", 300.0),
        ("0.3 atm-cm", 300.0),
        ("0.3 atm cm", 300.0),
        ("300 matm-cm", 300.0),
        ("0.133845 mol/m^2", 300.0),
        ("13.3845 mmol m^-2", 30.0),
    ],
)
def test_columns_of_ozone_by_thickness_and_by_moles(text, molecules):
    # a Dobson unit is 10 µm of gas at 0 °C and 1 atm, 0.44615 mmol/m² (the ideal gas law with the
    # constants of 2019: 1e-5 m × 101325 Pa / (8.314462618 J/mol/K × 273.15 K))
    dobson = 1e-5 * 101325.0 / (8.314462618 * 273.15) * 6.02214076e23
    absorption = load_planet("earth", {"ozone.absorption.ozone": text}).constituents[2].absorption
    assert_allclose(absorption.column, molecules * dobson, rtol=4e-6)  # half the last digit


def test_a_column_without_a_unit_is_told_of_dobson_units():
    with pytest.raises(ParameterError, match=r"ozone is 0\.3; .*'DU', 'atm-cm', 'mol/m\^2'"):
        load_planet("earth", {"ozone.absorption.ozone": 0.3})

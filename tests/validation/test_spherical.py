"""The spherical suite: its metrics by hand, its worst case in the table, and damaged files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import FileError
from airlight.validation.spherical.data import ReferenceScene, read_bruneton, read_scenes
from airlight.validation.spherical.radiances import compare, spherical
from airlight.validation.suite import SuiteRun

HEADER = (
    "scene,ground_albedo,altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg,radiance_680nm,"
    "radiance_550nm,radiance_440nm,standard_error_680nm,standard_error_550nm,standard_error_440nm"
)


def scene(radiance: list[list[float]], deviation: list[list[float]]) -> ReferenceScene:
    n = len(radiance)
    where = {name: np.zeros(n) for name in ("altitude", "sun_zenith", "view_zenith", "azimuth")}
    return ReferenceScene("rayleigh-only", 0.0, where, np.array(radiance), np.array(deviation))


def test_errors_are_counted_where_the_referee_is_sure() -> None:
    # By hand: values of 1 % noise or more, and darker than 1e-6, are left out; of the others
    # +1 % at 0.2 % noise lies beyond three standard errors, -0.5 % at 0.2 % does not.
    known = scene([[1.0, 1.0, 1.0], [1e-7, 1.0, 1.0]], [[2e-3, 2e-3, 0.5], [1e-10, 1e-3, 1e-3]])
    got = np.array([[1.01, 0.995, 9.0], [5e-7, 1.0, 1.0]])
    found = compare(known, got)
    assert_array_equal(found.sure, [[True, True, False], [False, True, True]])
    assert_allclose(found.error, [[0.01, -0.005, 0.0], [0.0, 0.0, 0.0]], atol=1e-12)
    assert_allclose(found.beyond, [[0.01, 0.0, 0.0], [0.0, 0.0, 0.0]], atol=1e-12)
    assert (found.summary.count, found.summary.median) == (4, pytest.approx(0.0025))
    assert_allclose(found.largest_beyond(3.0), 0.01)
    assert_allclose(found.largest_beyond(6.0), 0.0, atol=0)


def write(folder: Path, rows: list[str], header: str = HEADER) -> None:
    (folder / "spherical-monte-carlo.csv").write_text("\n".join([header, *rows]) + "\n")


def test_a_wrong_reference_misses_the_bar_and_is_the_worst_case_in_the_table(
    tmp_path: Path,
) -> None:
    # Rayleigh sky of the shared file's first planet: two radiances as a solver of this kind gives
    # them, one 20 % too high. It must fail the suite, and stand first among the worst.
    pytest.importorskip("matplotlib")
    from airlight.solver import solve
    from airlight.validation.reference_earth import reference_earth

    planet = reference_earth(albedo=0.0, aerosol=None, ozone=False)
    where = {"altitude": 0.0, "sun_zenith": [30.0, 60.0, 85.0], "view_zenith": [0.0, 45.0, 80.0]}
    truth = (
        solve(planet, quality="default", polarisation=False, cache=False).radiance(**where).values
    )
    truth[2, 1] *= 1.2
    rows = [
        f"rayleigh-only,0.0,0,{where['sun_zenith'][k]},{where['view_zenith'][k]},0,"
        + ",".join(f"{x:.9e}" for x in truth[k])
        + ",1e-9,1e-9,1e-9"
        for k in range(3)
    ]
    write(tmp_path, rows)
    suite = spherical(SuiteRun(data=tmp_path), qualities=("default",))
    assert not suite.passed
    worst = next(part for part in suite.parts if part.title.startswith("The ten worst"))
    assert worst.rows[0][:7] == ("rayleigh-only", "0", "0", "85.000", "80.000", "0", "550")
    assert worst.rows[0][10] == "-16.67"  # 1/1.2 - 1
    assert [part.title for part in suite.parts if "over sun zenith" in part.title]


def test_bars_hold_without_a_wrong_number(reference_data: Path) -> None:
    # The real file of Bruneton's radiances alone, whose errors its header states.
    table, known = read_bruneton(reference_data)
    assert table.shape == known.shape
    assert len(read_scenes(reference_data)) == 7


def test_shared_scenes_are_the_planets_they_say(reference_data: Path) -> None:
    # From the names: gas alone, with ozone, with aerosol.
    names = {
        one.name: [c.name for c in one.planet.constituents] for one in read_scenes(reference_data)
    }
    assert names == {
        "full-cornette-shanks": ["air", "aerosol", "ozone"],
        "full-henyey-greenstein": ["air", "aerosol", "ozone"],
        "rayleigh-only": ["air"],
        "rayleigh-ozone": ["air", "ozone"],
    }


@pytest.mark.parametrize(
    ("header", "row", "part"),
    [
        (HEADER.replace("azimuth_deg", "azimuth"), "rayleigh-only" + ",1" * 11, "azimuth_deg"),
        (HEADER, "rayleigh-only" + ",1" * 10 + ",much", "not a number"),
        (HEADER, "rayleigh-only,0.0,1", "not a number"),
        (HEADER, "", "no rows"),
    ],
)
def test_damaged_files_are_named_with_the_reason(
    tmp_path: Path, header: str, row: str, part: str
) -> None:
    write(tmp_path, [row] if row else [], header)
    with pytest.raises(FileError, match=part) as error:
        read_scenes(tmp_path)
    assert "spherical-monte-carlo.csv" in str(error.value)


def test_an_unknown_scene_is_refused(tmp_path: Path) -> None:
    write(tmp_path, ["martian" + ",1" * 11])
    with pytest.raises(FileError, match="martian"):
        _ = read_scenes(tmp_path)[0].planet


@pytest.mark.parametrize("text", ["# x\na,b\n1,2\n", "# x\na\n1,2,3,4,5,six\n"])
def test_a_damaged_table_of_brunetons_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "bruneton2017-radiances.csv").write_text(text)
    with pytest.raises(FileError, match=r"bruneton2017-radiances\.csv"):
        read_bruneton(tmp_path)


def test_an_empty_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="neither"):
        spherical(SuiteRun(data=tmp_path))

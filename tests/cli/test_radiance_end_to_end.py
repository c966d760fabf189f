"""``airlight radiance`` with the real solver: one observer, a file of them, and Python agree."""

from __future__ import annotations

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal

import airlight
from airlight.cli import main
from airlight.studies.sweep.case_dataset import case_dataset
from airlight.studies.sweep.cases import Cases

solvers = pytest.importorskip("airlight.solver")
pytestmark = pytest.mark.skipif(not hasattr(solvers, "solve"), reason="there is no solver yet")

PLANET = "earth-atmosphere-plus"
QUICK = ["--quality", "preview"]
HEADER = ["site", "altitude_m", "sun_zenith_deg", "view_zenith_deg", "azimuth_deg"]
ROWS = [
    ["ground", "0", "60", "30", "90"],
    ["aloft", "10000.0", "85", "95", "0"],
    ["orbit", "5e5", "30", "180", "0"],
    ["missing the air", "5e5", "30", "0", "0"],
    ["twilight", "0", "94", "80", "-45"],
]


@pytest.fixture(scope="module")
def cases(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("cases") / "cases.csv"
    with path.open("w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([HEADER, *ROWS])
    return path


@pytest.fixture(scope="module")
def answers(cases: Path) -> Path:
    out = cases.with_name("out.csv")
    assert main(["radiance", PLANET, "--input", str(cases), "--output", str(out), *QUICK]) == 0
    return out


def read(path: Path) -> list[list[str]]:
    with path.open(newline="") as stream:
        return list(csv.reader(stream))


def test_bulk_keeps_the_input_and_appends_the_planet_s_own_wavelengths(answers: Path) -> None:
    table = read(answers)
    assert table[0] == [*HEADER, "radiance_680nm", "radiance_550nm", "radiance_440nm"]
    assert [row[:5] for row in table[1:]] == ROWS
    assert sorted(path.name for path in answers.parent.iterdir()) == ["cases.csv", "out.csv"]


def test_bulk_radiances_are_finite_and_empty_space_is_black(answers: Path) -> None:
    values = np.array([[float(cell) for cell in row[5:]] for row in read(answers)[1:]])
    assert np.isfinite(values).all()
    assert (values >= 0.0).all()
    assert_array_equal(values[3], 0.0)  # upwards from above the air, 30° off the sun
    assert (values[[0, 1, 2, 4]] > 0.0).all()


def test_bulk_and_python_agree_to_the_digits_written(answers: Path) -> None:
    # second method: the same solver, asked from Python
    import airlight

    planet = airlight.load_planet(PLANET)
    solution = airlight.solve(planet, wavelengths=planet.wavelengths, quality="preview")
    table = read(answers)[1:]
    altitude, sun, view, azimuth = np.array([[float(c) for c in row[1:5]] for row in table]).T
    expected = solution.radiance(
        altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth
    )
    written = np.array([[float(cell) for cell in row[5:]] for row in table])
    assert_allclose(written, np.asarray(expected), rtol=5.1e-9)  # half the ninth digit


@pytest.mark.parametrize("row", ROWS)
def test_one_observer_and_a_file_of_them_agree(
    row: list[str], answers: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    altitude, sun, view, azimuth = row[1:]
    words = ["--altitude", altitude + "m", "--sun-zenith", sun + "deg", "--view-zenith", view]
    assert main(["radiance", PLANET, *words, "--azimuth", azimuth, *QUICK]) == 0
    lines = capsys.readouterr().out.splitlines()
    bulk = read(answers)[1 + ROWS.index(row)][5:]
    assert [line.split()[0] for line in lines] == ["680", "550", "440"]
    single = [float(line.split()[2]) for line in lines]
    # the last of nine digits may fall to either side
    assert_allclose(single, [float(cell) for cell in bulk], rtol=2e-8)
    assert all(line.endswith("W m⁻² sr⁻¹ nm⁻¹") for line in lines)


def test_wavelengths_are_the_ones_asked_for_in_that_order(
    cases: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--input", str(cases), "--wavelengths", "500, 640.5", *QUICK]
    assert main(["radiance", PLANET, *words]) == 0
    header = capsys.readouterr().out.splitlines()[0]
    assert header == ",".join([*HEADER, "radiance_500nm", "radiance_640.5nm"])


def test_a_wavelength_where_the_planet_is_not_known_is_one_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    words = ["--sun-zenith", "60", "--view-zenith", "0", "--wavelengths", "550,2500"]
    assert main(["radiance", PLANET, *words, *QUICK]) == 2
    captured = capsys.readouterr()
    assert "2500" in captured.err
    assert captured.err.count("\n") == 1


def test_pipes_work(cases: Path, answers: Path) -> None:
    command = Path(sys.executable).with_name("airlight")
    done = subprocess.run(
        [command, "radiance", PLANET, "--input", "-", *QUICK],
        input=cases.read_text(),
        capture_output=True,
        text=True,
        check=True,
        timeout=600,
    )
    assert done.stdout == answers.read_text()
    note = "airlight: 1 of 5 lines of sight miss the atmosphere: radiance 0\n"
    assert done.stderr == note


def test_the_suffix_names_the_format(
    cases: Path, answers: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # the same numbers as the table in text, to its nine digits
    out = cases.with_name("out.nc")
    assert main(["radiance", PLANET, "--input", str(cases), "-o", str(out), *QUICK]) == 0
    assert capsys.readouterr().out.startswith(f"{out}  ")
    with xarray.open_dataset(out) as data:
        data.load()
    text = np.array([[float(cell) for cell in row[5:]] for row in read(answers)[1:]])
    assert_allclose(data.radiance.transpose("case", "wavelength"), text, rtol=1e-8)
    assert_allclose(data.wavelength, [680.0, 550.0, 440.0])
    assert data.site.values.tolist() == [row[0] for row in ROWS]
    assert_allclose(data.altitude, [float(row[1]) for row in ROWS])
    assert (data.radiance.units, data.altitude.units) == ("W m-2 sr-1 nm-1", "m")
    assert data.Conventions.startswith("CF-")
    assert data.version == airlight.__version__
    assert data.planet.startswith("Earth")
    assert "degree=" in data.settings


@pytest.mark.parametrize("name", ["b.json", "b.parquet", "b.tsv", "b"])
def test_a_format_that_is_not_written_is_refused(
    cases: Path, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["radiance", PLANET, "--input", str(cases), "-o", str(tmp_path / name)]) == 2
    assert "the name of a table ends in .csv or .nc" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_columns_named_as_results_stay_apart(cases: Path) -> None:
    # a column of the input is written as it was read, whatever its name
    nm, found = [550.0], np.array([[1.0], [2.0]])
    table = Cases(comments=["# a site"], header=["radiance", "", *HEADER[1:]],
                  rows=[["x", "5", *ROWS[0][1:]], ["y", "6", *ROWS[1][1:]]],
                  values=np.zeros((2, 4)))  # fmt: skip
    data = case_dataset(table, nm, found)
    assert data.input_radiance.values.tolist() == ["x", "y"]
    assert data.input_.values.tolist() == [5.0, 6.0]
    assert_allclose(data.radiance, found)
    assert data.comment == "a site"


def test_observers_of_one_basin_are_a_table_and_those_of_several_are_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # the definition: each row is that of one observer alone, at the altitude that was given
    words = ["radiance", "earth", "--quality", "preview", "--wavelengths", "550"]
    words += ["--view-zenith", "30", "--sun-zenith"]
    assert main([*words, "30,60", "--altitude=-400m"]) == 0
    header, *rows = capsys.readouterr().out.splitlines()
    assert header.startswith("altitude_m,")
    assert main([*words, "60", "--altitude=-400m"]) == 0
    alone = capsys.readouterr().out.split()[2]
    assert rows[1] == f"-400,60,30,0,{alone}"
    assert main([*words, "60", "--altitude=-400m,0m"]) == 2
    assert "allowed: a single altitude if below 0" in capsys.readouterr().err

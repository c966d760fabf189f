"""``airlight irradiance``: a table, files, series, and one line for what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose

from airlight.cli import main

EARTH = ("irradiance", "earth", "--quality", "preview", "--wavelengths", "400:700:50")
PLACE = ("--at", "40N,3.7W")


def test_a_place_and_time_are_a_table_with_its_range(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*EARTH, *PLACE, "--time", "2026-06-21T12:00Z", "--tilt", "30"]) == 0
    out, err = capsys.readouterr()
    for name in ("ghi", "dni", "dhi", "poa_sky", "[lx]", "[umol m-2 s-1]", "2026-06-21T12:00:00Z"):
        assert name in out
    assert "irradiances are from 400 to 700 nm" in err


def test_a_series_is_written_as_cf_netcdf_csv_and_json(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [tmp_path / f"day.{kind}" for kind in ("nc", "csv", "json")]
    day = ("--start", "2026-06-21T06:00Z", "--end", "2026-06-21T18:00Z", "--step", "3h")
    assert main([*EARTH, *PLACE, *day, *(part for f in files for part in ("-o", str(f)))]) == 0
    capsys.readouterr()
    with xarray.open_dataset(files[0], engine="scipy") as data:
        assert data.attrs["Conventions"].startswith("CF-")
        hours = (data.time.values - data.time.values[0]) / np.timedelta64(1, "h")
        ghi, units = data.ghi.values, data.ghi.attrs["units"]
    assert_allclose(hours, [0.0, 3.0, 6.0, 9.0, 12.0])
    assert units == "W m-2"
    assert ghi.argmax() == 2  # noon, 12:15 UTC at 3.7° W
    lines = [one for one in files[1].read_text("utf-8").splitlines() if one[0] != "#"]
    column = lines[0].split(",").index("ghi")
    assert_allclose([float(one.split(",")[column]) for one in lines[1:]], ghi, rtol=1e-7)
    read = json.loads(files[2].read_text("utf-8"))
    assert_allclose([row["ghi"] for row in read["rows"]], ghi)
    assert read["rows"][0]["uv_index"] is None
    assert read["units"]["illuminance"] == "lx"


def test_spectra_have_a_row_for_each_wavelength(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*EARTH, "--sun-zenith", "60", "--spectral"]) == 0
    rows = capsys.readouterr().out.splitlines()[2:]
    assert [row.split()[0] for row in rows] == [str(nm) for nm in range(400, 701, 50)]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--azimuth", "S"), "--azimuth requires --tilt"),
        (("--tilt", "200"), "--tilt is 200.0; allowed: 0 to 180 deg"),
        (("--start", "2026-06-21T06:00Z"), "--start requires --at and --end"),
        ((*PLACE, "--start", "noon", "--end", "noon", "--step", "-1h"), "--step is '-1h'"),
        ((*PLACE, "--start", "soon", "--end", "noon"), "--start is 'soon'"),
        ((*PLACE, "--time", "noon", "--step", "1h"), "--time cannot be combined with --start"),
        (("--sun-zenith", "60", "-o", "x.txt"), ".csv, .nc, .json"),
    ],
)
def test_what_cannot_be_is_refused_on_one_line(
    arguments: tuple[str, ...], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*EARTH, *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line


def test_bands_have_the_lines_of_gases(capsys: pytest.CaptureFixture[str]) -> None:
    # 762 nm lies in the A band of oxygen, of which 10 nm transmit 0.6 of the direct light at 48°;
    # at single wavelengths the planet has none.
    command = ("irradiance", "earth", "--quality", "preview", "--sun-zenith", "48.2", "--spectral")
    dni = []
    for width in ((), ("--bandwidth", "10nm")):
        assert main([*command, "--wavelengths", "748,762", *width]) == 0
        rows = capsys.readouterr().out.splitlines()
        names = rows[0].split()
        dni.append([float(one.split()[names.index("dni")]) for one in rows[2:]])
    ratio = np.array(dni[1]) / np.array(dni[0])
    assert 0.95 < ratio[0] < 1.03  # the sun's lines within 10 nm
    assert 0.5 < ratio[1] < 0.75
    assert main([*command, "--wavelengths", "762", "--bandwidth", "0"]) != 0
    assert "--bandwidth is 0.0; allowed: more than 0" in capsys.readouterr().err

"""CSV files of radiances: both forms, units, and every fault in one line."""

from __future__ import annotations

from pathlib import Path

import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import AirlightError
from airlight.studies.fit.measurements import turned
from airlight.studies.fit.radiance_file import read_radiance_file

HEADER = "wavelength_nm,sun_zenith_deg,view_zenith_deg,azimuth_deg,radiance"


def written(folder: Path, *lines: str) -> Path:
    file = folder / "sky.csv"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def test_units_of_the_header_are_those_of_the_numbers(tmp_path: Path) -> None:
    # 0.55 µm is 550 nm, 45 mW is 0.045 W, 0.5 rad is 28.6479°.
    file = written(
        tmp_path, "# a comment",
        "wavelength [um],sun_zenith [rad],view_zenith_deg,azimuth_deg,radiance [mW m⁻² sr⁻¹ nm⁻¹],"
        "uncertainty [mW/m^2/sr/nm],altitude [km],scan,note",
        "0.55,0.5,10,-20,45,2,1.5,morning,x", "0.44,0.5,10,-20,90,3,1.5,noon,y",
    )  # fmt: skip
    got = read_radiance_file(file)
    assert_allclose(got.wavelength, [550.0, 440.0])
    assert_allclose(got.sun_zenith, 28.6478898, rtol=1e-8)
    assert_allclose(got.radiance, [0.045, 0.09])
    assert got.uncertainty is not None
    assert_allclose(got.uncertainty, [0.002, 0.003])
    assert_allclose(got.altitude, 1500.0)
    assert got.scans == ("morning", "noon")
    assert got.line is not None
    assert got.line.tolist() == [3, 4]


def test_wide_form_is_the_long_one(tmp_path: Path) -> None:
    # As airlight radiance writes it: a column a wavelength.
    file = written(
        tmp_path,
        "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg,radiance_680nm,radiance_440.5nm,"
        "standard_error_680nm,standard_error_440.5nm",
        "0,60,30,90,1e-2,2e-2,1e-4,2e-4", "0,70,30,90,3e-2,4e-2,3e-4,4e-4",
    )  # fmt: skip
    got = read_radiance_file(file)
    assert_allclose(got.wavelength, [680.0, 440.5, 680.0, 440.5])
    assert_allclose(got.radiance, [0.01, 0.02, 0.03, 0.04])
    assert got.uncertainty is not None
    assert_allclose(got.uncertainty, [1e-4, 2e-4, 3e-4, 4e-4])
    assert_array_equal(got.scan, [0, 0, 1, 1])  # one sun, one scan


def test_bands_dates_and_sunlight_are_read(tmp_path: Path) -> None:
    # One width and one date a line, irradiances by wavelength; a time of day is no date.
    columns = "bandwidth [nm],time,solar_irradiance_550nm [mW/m^2/nm],radiance_550nm"
    head = HEADER.removeprefix("wavelength_nm,").removesuffix("radiance") + columns
    file = written(tmp_path, head, "60,30,90,3,2013-05-27T09:30,1800,0.1")
    got = read_radiance_file(file)
    assert got.bandwidth is not None
    assert got.solar_irradiance is not None
    assert_allclose([got.bandwidth[0], got.solar_irradiance[0]], [3.0, 1.8])
    assert str(got.date) == "['2013-05-27']"
    plain = read_radiance_file(written(tmp_path, HEADER + ",time", "550,60,30,90,0.1,09:30"))
    assert (plain.date, plain.bandwidth, plain.solar_irradiance) == (None, None, None)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (["wavelength_nm,sun_zenith_deg,azimuth_deg,radiance", "550,1,1,1"],
         "has no column view_zenith_deg in its header"),
        ([HEADER.replace("azimuth_deg", "azimut_deg"), "550,1,1,1,1"],
         "has no column azimuth_deg in its header (did you mean 'azimut_deg'?)"),
        ([HEADER, "550,60,30,90,nan"], "line 2, radiance is 'nan'; allowed: 0 to 1e+12"),
        ([HEADER, "550,60,30,90,0.1", "550,60,230,90,0.1"],
         "line 3, view_zenith is '230'; allowed: 0 to 180 deg"),
        ([HEADER, "550,60,30,90"], "line 2 is '4 cells'; allowed: 5, as in the header"),
        ([HEADER + ",uncertainty", "550,60,30,90,0.1,0"], "line 2, uncertainty is '0'"),
        ([HEADER + " [lux]", "550,60,30,90,0.1"], "unit of radiance is 'lux'"),
        ([HEADER + ",radiance", "550,60,30,90,0.1,0.1"], "has the column radiance more than once"),
        ([HEADER], "contains no radiance"),
        ([HEADER + ",bandwidth", "550,60,30,90,0.1,0"], "bandwidth is '0'; allowed: more than 0"),
        ([HEADER + ",date", "550,60,30,90,0.1,27.5."], "line 2, date is '27.5.'; allowed: a date"),
    ],
)  # fmt: skip
def test_faults_are_said_in_one_line(tmp_path: Path, lines: list[str], said: str) -> None:
    # File, line, column, value, and what is allowed.
    file = written(tmp_path, *lines)
    with pytest.raises(AirlightError) as caught:
        read_radiance_file(file)
    assert said in str(caught.value)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_turn_past_the_zenith_comes_down_on_the_other_side() -> None:
    # Geometry: 3° back from 1° is 2° at the opposite azimuth.
    assert_allclose(turned(1.0, 30.0, -3.0, 0.0), [2.0, -150.0])  # type: ignore[arg-type]

"""Stars whose spectrum is a file: units, distance, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import AirlightError, ParameterError, Planet, load_planet

PLANET = """
name = "planet of a measured star"
[shell]
bottom_radius = "6000 km"
top_radius = "6100 km"
[ground]
albedo = 0.3
[star]
irradiance = "star.csv"
{star}
[[constituents]]
name = "gas"
profile = {{ kind = "exponential", scale_height = "8 km" }}
scattering = "1e-5 /m"
phase_function = {{ kind = "rayleigh" }}
"""
ROWS = "wavelength,irradiance\n400,1.0\n700,2.5\n"


def planet(folder: Path, unit: str, star: str, distance: str = "", rows: str = ROWS) -> Planet:
    header = f"# unit: {unit}\n# source: a test\n" + (distance and f"# distance: {distance}\n")
    (folder / "star.csv").write_text(header + rows, encoding="utf-8")
    (folder / "planet.toml").write_text(PLANET.format(star=star), encoding="utf-8")
    return load_planet(folder / "planet.toml")


def test_a_spectrum_without_distance_is_that_at_the_planet(tmp_path: Path) -> None:
    # A power law between the rows: half-way in the logarithm, the geometric mean.
    made = planet(tmp_path, "W m-2 nm-1", 'angular_radius = "0.2 deg"')
    half = (400.0 * 700.0) ** 0.5
    assert_allclose(made.star.irradiances([400.0, half, 700.0]), [1.0, 2.5**0.5, 2.5])
    assert made.star.limits == (390.0, 710.0)


@pytest.mark.parametrize(
    ("unit", "factor"),
    [("W/m^2/um", 1e-3), ("erg s-1 cm-2 angstrom-1", 1e-2), ("mW m-2 nm-1", 1e-3)],
)
def test_units_are_converted(unit: str, factor: float, tmp_path: Path) -> None:
    # 1 erg s⁻¹ cm⁻² Å⁻¹ = 1e-7 W / 1e-4 m² / 0.1 nm
    made = planet(tmp_path, unit, 'angular_radius = "0.2 deg"')
    assert_allclose(made.star.irradiances([400.0]), factor)


def test_a_spectrum_at_a_distance_goes_with_the_inverse_square(tmp_path: Path) -> None:
    star = 'radius = "100000 km"\ndistance = "0.1 au"'
    made = planet(tmp_path, "W m-2 nm-1", star, distance="1 au")
    assert_allclose(made.star.irradiances([400.0]), 100.0)
    assert made.star.angular_radius_degrees == pytest.approx(
        np.degrees(np.arcsin(1e8 / 14_959_787_070.0))
    )


@pytest.mark.parametrize(
    ("unit", "star", "distance", "rows", "words"),
    [
        ("W m-2 nm-1", 'angular_radius = "0.2 deg"', "1 au", ROWS, "star.distance is missing"),
        ("W m-2", 'angular_radius = "0.2 deg"', "", ROWS, "unit of star.csv"),
        ("furlong", 'angular_radius = "0.2 deg"', "", ROWS, "unit of star.csv"),
        ("W m-2 nm-1", 'angular_radius = "0.2 deg"', "", "wavelength,a,b\n400,1,2\n", "one column"),
        ("W m-2 nm-1", 'angular_radius = "0.2 deg"', "", "wavelength,a\n400,-1\n", "irradiance"),
        ("W m-2 nm-1", "", "", ROWS, "angular_radius is missing"),
    ],
)
def test_what_cannot_be_a_spectrum_is_refused_on_one_line(
    unit: str, star: str, distance: str, rows: str, words: str, tmp_path: Path
) -> None:
    with pytest.raises(AirlightError) as caught:
        planet(tmp_path, unit, star, distance, rows)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_spectrum_that_is_not_there_is_named(tmp_path: Path) -> None:
    (tmp_path / "planet.toml").write_text(PLANET.format(star=""), encoding="utf-8")
    with pytest.raises(AirlightError, match=r"star\.csv"):
        load_planet(tmp_path / "planet.toml")


def test_wavelengths_that_the_spectrum_does_not_reach_are_refused(tmp_path: Path) -> None:
    from airlight import solve

    made = planet(tmp_path, "W m-2 nm-1", 'angular_radius = "0.2 deg"')
    with pytest.raises(ParameterError, match="390 to 710 nm"):
        solve(made, [800.0], "preview")

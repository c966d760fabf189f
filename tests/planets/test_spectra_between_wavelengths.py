"""Spectra of a planet file between their wavelengths: positive ones by Ångström's law."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Medium, load_planet
from airlight.errors import ParameterError
from airlight.planets import replace
from airlight.studies.distribution.fingerprint import digest

NM = np.array([440.0, 500.0, 550.0, 600.0, 675.0])
FILE = """
name = "Bands"
[shell]
bottom_radius = "6360 km"
top_radius = "6420 km"
[ground]
albedo = 0.1
[star]
wavelengths = "440, 675 nm"
irradiance = ["2 W/m^2/nm", "1 W/m^2/nm"]
angular_radius = "0.27 deg"
[[constituents]]
name = "haze"
profile = { kind = "exponential", scale_height = "2 km" }
wavelengths = "440, 675 nm"
COEFFICIENTS
phase_function = { kind = "henyey-greenstein", asymmetry = [0.7, 0.6] }
"""


def angstrom(first: float, last: float) -> np.ndarray:
    """Ångström's law through values at 440 and 675 nm."""
    exponent = np.log(first / last) / np.log(675.0 / 440.0)
    return first * (NM / 440.0) ** -exponent


def straight(first: float, last: float) -> np.ndarray:
    return first + (last - first) * (NM - 440.0) / 235.0


def medium(folder: Path, coefficients: str) -> Medium:
    file = folder / "bands.toml"
    file.write_text(FILE.replace("COEFFICIENTS", coefficients), encoding="utf-8")
    return Medium.from_planet(load_planet(file), NM)


@pytest.mark.parametrize("albedo", [(0.95, 0.9), (1.0, 0.9), (0.9, 0.0)])
def test_optical_depth_follows_angstrom_whatever_the_albedo(tmp_path: Path, albedo) -> None:
    # The law for the depth, a straight line for the albedo; scattering and absorption add up.
    found = medium(
        tmp_path, f"optical_depth = [0.31, 0.19]\nsingle_scattering_albedo = {list(albedo)}"
    )
    depth = angstrom(0.31, 0.19)
    assert_allclose(found.vertical_optical_depth[0], depth, rtol=1e-12)
    assert_allclose(found.single_scattering_albedo[0], straight(*albedo), rtol=1e-12)


@pytest.mark.parametrize(
    ("coefficients", "scattering", "absorption"),
    [
        ('scattering = "3e-5, 1e-5 /m"', angstrom(3e-5, 1e-5), 0.0 * NM),
        (
            'scattering = "3e-5, 1e-5 /m"\nabsorption = "1e-6, 0 /m"',
            angstrom(3e-5, 1e-5),
            straight(1e-6, 0.0),
        ),
        (
            'extinction = "4e-5, 3e-5 /m"\nscattering = "4e-5, 1e-5 /m"',
            angstrom(4e-5, 1e-5),
            angstrom(4e-5, 3e-5) - angstrom(4e-5, 1e-5),
        ),
        (
            'extinction = "4e-5, 3e-5 /m"\nsingle_scattering_albedo = 0.75',
            0.75 * angstrom(4e-5, 3e-5),
            0.25 * angstrom(4e-5, 3e-5),
        ),
        (
            'scattering = "3e-5, 1e-5 /m"\nsingle_scattering_albedo = [0.9, 0.5]',
            angstrom(3e-5, 1e-5),
            angstrom(3e-5, 1e-5) * (1.0 / straight(0.9, 0.5) - 1.0),
        ),
    ],
)
def test_every_form_of_coefficients_follows_the_law(
    tmp_path: Path, coefficients: str, scattering: np.ndarray, absorption: np.ndarray
) -> None:
    # Both given spectra are power laws, straight lines next to 0; the third follows from them.
    found = medium(tmp_path, coefficients)
    assert_allclose(found.scattering[0], scattering, rtol=1e-12)
    assert_allclose(found.absorption[0], absorption, rtol=1e-9, atol=1e-20)


def test_light_and_cross_sections_follow_the_law_and_asymmetries_a_line(tmp_path: Path) -> None:
    # Irradiance and cross-section are positive spectra; an asymmetry may be negative.
    found = medium(
        tmp_path,
        'scattering = "1e-5 /m"\n'
        'absorption = { cross_section = "4e-25, 1e-25 cm^2", number_density = "1e24 /m^3" }',
    )
    assert_allclose(found.absorption[0], 1e24 * 1e-4 * angstrom(4e-25, 1e-25), rtol=1e-12)
    assert_allclose(found.solar_irradiance, angstrom(2.0, 1.0), rtol=1e-12)
    assert_allclose(found.phase_moments(1)[0, :, 1], straight(0.7, 0.6), rtol=1e-6)


def test_derived_coefficients_travel_and_refuse_other_values(tmp_path: Path) -> None:
    # A round trip by pickle, as to other processes; values without their formula would be ignored.
    file = tmp_path / "bands.toml"
    given = "optical_depth = [0.31, 0.19]\nsingle_scattering_albedo = 0.9"
    file.write_text(FILE.replace("COEFFICIENTS", given), encoding="utf-8")
    planet = load_planet(file)
    again = pickle.loads(pickle.dumps(planet))
    assert again.constituents == planet.constituents
    assert digest(again.constituents) == digest(planet.constituents)
    with pytest.raises(ParameterError, match="values is"):
        replace(planet.constituents[0].scattering, values=(1e-5, 1e-5))

"""Black bodies against the laws of Wien and of Stefan and Boltzmann."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS, SOLAR_TEMPERATURE
from airlight.physics.spectra.blackbody import planck_radiance, star_irradiance
from airlight.physics.spectra.sun import solar_irradiance

STEFAN_BOLTZMANN = 5.670374419e-8  # W m⁻² K⁻⁴, CODATA 2018
WIEN = 2.897771955e6  # nm K, CODATA 2018


def test_radiance_integrates_to_the_stefan_boltzmann_law():
    # π ∫ B dλ = σ T⁴; in ln λ the trapezoid converges beyond every power of the step.
    logarithm = np.linspace(np.log(50.0), np.log(5e7), 4001)
    wavelengths = np.exp(logarithm)
    for temperature in (300.0, 5772.0, 30000.0):
        scaled = wavelengths * 5772.0 / temperature
        total = np.trapezoid(planck_radiance(scaled, temperature) * scaled, logarithm)
        assert_allclose(np.pi * total, STEFAN_BOLTZMANN * temperature**4, rtol=1e-8)


@pytest.mark.parametrize("temperature", [2566.0, 5772.0, 10000.0])
def test_radiance_peaks_where_wien_says(temperature):
    peak = WIEN / temperature
    at = planck_radiance(peak * np.array([0.999, 1.0, 1.001]), temperature)
    assert at[1] > at[0]
    assert at[1] > at[2]


def test_rayleigh_and_jeans_at_long_waves():
    # 2 c k T / λ⁴; the next term is -hc/(2 λ k T) = -1.2e-6.
    classic = 2.0 * 299792458.0 * 1.380649e-23 * 5772.0 / 1.0**4 * 1e-9
    assert_allclose(planck_radiance(1e9, 5772.0), classic, rtol=3e-6)


def test_the_nominal_sun_gives_the_solar_constant():
    # IAU 2015 B3: 1361 W m⁻² within the nominal radius and temperature.
    wavelengths = np.exp(np.linspace(np.log(50.0), np.log(1e6), 4001))
    flux = star_irradiance(wavelengths, SOLAR_TEMPERATURE, SOLAR_RADIUS, ASTRONOMICAL_UNIT)
    assert_allclose(np.trapezoid(flux * wavelengths, np.log(wavelengths)), 1361.0, rtol=1e-3)


def test_the_nominal_sun_is_near_the_measured_one():
    # Lines and opacity make the sun differ from a black body by up to 14 % from 450 to 1000 nm.
    at = np.arange(450.0, 981.0, 10.0)
    measured = np.array([solar_irradiance(nm + np.arange(-10.0, 11.0)).mean() for nm in at])
    body = star_irradiance(at, SOLAR_TEMPERATURE, SOLAR_RADIUS, ASTRONOMICAL_UNIT)
    assert_allclose(body / measured, 1.0, atol=0.14)


def test_a_cold_body_is_dark_without_a_warning():
    assert float(planck_radiance(500.0, 1.0)) == 0.0


@pytest.mark.parametrize(
    ("field", "arguments"),
    [
        ("temperature", (550.0, -1.0, 7e8, 1.5e11)),
        ("temperature", (550.0, float("nan"), 7e8, 1.5e11)),
        ("wavelengths", (0.0, 5772.0, 7e8, 1.5e11)),
        ("radius", (550.0, 5772.0, 0.0, 1.5e11)),
        ("distance", (550.0, 5772.0, 7e8, 6e8)),
        ("distance", (550.0, 5772.0, 7e8, float("inf"))),
    ],
)
def test_impossible_stars_are_refused(field, arguments):
    with pytest.raises(ParameterError, match=f"^{field} is"):
        star_irradiance(*arguments)

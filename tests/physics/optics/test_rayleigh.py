"""Scattering coefficients of gases against the tables they come from."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.constants import GAS_CONSTANT
from airlight.physics.optics import king_factor, rayleigh, refractive_index

NM = np.array([680.0, 550.0, 440.0])


def test_air_refractivity_matches_peck_reeder_table_3():
    # Peck & Reeder 1972, Table III, in 1e-8, half the last printed digit
    found = 1e8 * refractive_index.air_refractivity_peck1972(644.02492)
    assert_allclose(found, 27638.092, rtol=0, atol=5e-4)


def test_co2_refractivity_matches_the_openspace_table():
    # OS Table 1 from Bideau-Mehu 1973, with 440 nm put right: half the last printed digit
    found = refractive_index.co2_refractivity_bideau_mehu1973(NM)
    assert_allclose(found, [0.00044661, 0.00045019, 0.00045588], rtol=0, atol=5e-9)


@pytest.mark.parametrize(
    "refractivity",
    [refractive_index.air_refractivity_peck1972, refractive_index.co2_refractivity_bideau_mehu1973],
)
@pytest.mark.parametrize("nm", [100.0, 2501.0, np.nan])
def test_wavelengths_outside_the_fits_are_refused(refractivity, nm):
    with pytest.raises(ParameterError, match="wavelengths"):
        refractivity([550.0, nm])


def test_reference_earth_scatters_as_the_golden_table_says():
    # 15 °C, Peck-Reeder, Bates: half the last printed digit
    density = rayleigh.number_density(288.15, 101_325.0)
    sigma = rayleigh.cross_section(
        NM,
        refractive_index.air_refractivity_peck1972(NM),
        density,
        king_factor.king_factor_air_bates1984(NM),
    )
    assert_allclose(1e6 * density * sigma, [4.848, 11.487, 28.710], rtol=0, atol=5e-4)


def edlen1953(nm):
    s2 = (1e3 / nm) ** 2
    return 1e-8 * (6432.8 + 2_949_810.0 / (146.0 - s2) + 25_540.0 / (41.0 - s2))


def test_openspace_standard_set_follows_from_its_inputs():
    # OS Eq 11 (the limit n → 1) with Edlén 1953 as Penndorf 1957 has it, from 15 °C
    # (2.54743e25 per m³) to 0 °C (2.68731e25), δ = 0.035: the golden table's last digit.
    # Lorentz-Lorenz and its limit differ by 1 + 2(n²-1)/3, which the comparison divides out.
    refractivity = edlen1953(NM) * 2.68731 / 2.54743
    factor = rayleigh.king_factor_from_depolarisation(0.035)
    sigma = rayleigh.cross_section(NM, refractivity, 2.68731e25, factor)
    square = (1.0 + refractivity) ** 2
    limit = sigma * ((square + 2.0) / 3.0) ** 2
    assert_allclose(1e6 * 2.68731e25 * limit, [5.1771, 12.2590, 30.5967], rtol=0, atol=5e-5)


def test_first_atmosphere_plus_set_needs_the_swapped_digits():
    # n = 1.0003: with 2.545e25 the three printed values follow to half their last digit
    nm = np.array([650.0, 510.0, 475.0])
    found = 1e6 * 2.545e25 * rayleigh.cross_section(nm, 3e-4, 2.545e25)
    half_digits = np.array([5e-3, 5e-2, 5e-2])
    assert np.all(np.abs(found - [6.55, 17.3, 23.0]) <= half_digits)
    misprint = 1e6 * 2.454e25 * rayleigh.cross_section(nm, 3e-4, 2.454e25)
    assert np.all(np.abs(misprint - [6.55, 17.3, 23.0]) > half_digits)


@pytest.mark.parametrize(
    ("density", "golden", "density_digits"),
    [(2.8e23, [0.1397, 0.3317, 0.8304], 0.0), (2.05e23, [0.1023, 0.2429, 0.6081], 0.0025)],
)
def test_mars_sets_follow_from_depolarisation_0_09(density, golden, density_digits):
    # OS Table 1 gives δ = 0.09; half the last digit, of the density too where it is rounded
    loschmidt = rayleigh.number_density(273.15, 101_325.0)
    sigma = rayleigh.cross_section(
        NM,
        refractive_index.co2_refractivity_bideau_mehu1973(NM),
        loschmidt,
        rayleigh.king_factor_from_depolarisation(0.09),
    )
    tolerance = 5e-5 + density_digits * np.array(golden)
    assert np.all(np.abs(1e6 * density * sigma - golden) <= tolerance)


def test_co2_king_factor_is_what_depolarisation_0_09_rounds_away():
    # Alms 1975 at 550 nm is 1.145, δ = 0.09 means 1.168: the golden Mars sets are 2 % higher
    assert_allclose(king_factor.king_factor_co2_alms1975(550.0), 1.1364 + 25.3e-12 / 550e-7**2)
    assert_allclose(rayleigh.king_factor_from_depolarisation(0.09), 6.27 / 5.37, rtol=1e-12)


def test_bucholtz_cross_section_is_met_within_its_rounding_and_ours():
    # Bucholtz 1995, Table 1 at 0.55 µm: 4.513e-27 cm²; Bodhaine 1999 puts the sources of
    # refractivity and King factor within 0.3 % of each other
    sigma = rayleigh.cross_section(
        550.0,
        refractive_index.air_refractivity_peck1972(550.0),
        rayleigh.number_density(288.15, 101_325.0),
        king_factor.king_factor_air_bates1984(550.0),
    )
    assert_allclose(sigma, 4.513e-31, rtol=3e-3)


def test_column_of_scattering_is_fixed_by_pressure_and_gravity():
    # β·H = σ N H with N = p/(kT), H = RT/(Mg): the temperature cancels exactly
    depths = []
    for temperature in (180.0, 240.0, 300.0):
        density = rayleigh.number_density(temperature, 101_325.0)
        height = rayleigh.scale_height(temperature, 28.9644e-3, 9.80665)
        sigma = rayleigh.cross_section(550.0, 2.7782e-4, 2.5469e25, 1.0488)
        depths.append(density * sigma * height)
    assert_allclose(depths, depths[0], rtol=1e-13)


def test_number_densities_from_pressure_and_from_mass_agree():
    # the ideal gas: ρ = p M/(R T)
    mass_density = 101_325.0 * 28.9644e-3 / (GAS_CONSTANT * 288.15)
    assert_allclose(
        rayleigh.number_density_from_mass(mass_density, 28.9644e-3),
        rayleigh.number_density(288.15, 101_325.0),
        rtol=1e-12,
    )


def test_depolarisation_and_king_factor_undo_each_other():
    delta = np.linspace(0.0, 0.5, 11)
    there = rayleigh.king_factor_from_depolarisation(delta)
    assert_allclose(rayleigh.depolarisation_from_king_factor(there), delta, rtol=0, atol=1e-15)


def test_thin_gas_keeps_its_digits():
    # σ must not depend on the state it is derived at; n - 1 of 1e-9 is rounding if n is formed
    thick = rayleigh.cross_section(550.0, 2.8e-4, 2.5e25)
    thin = rayleigh.cross_section(550.0, 2.8e-10, 2.5e19)
    assert_allclose(thin, thick, rtol=4e-4)  # Lorentz-Lorenz itself: (n²-1)/(n²+2) is not n-1

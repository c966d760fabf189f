"""The ozone table against the normative values, the measurement and a second measurement."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.physics.constants import DOBSON_UNIT
from airlight.physics.spectra.ozone import ozone_cross_section

RGB = [680.0, 550.0, 440.0]


def test_cross_sections_are_the_reference_values():
    # Golden numbers: 1.368e-21, 3.314e-21, 1.360e-22 cm², half the last printed digit.
    printed = [1.368e-25, 3.314e-25, 1.360e-26]
    assert_allclose(ozone_cross_section(RGB), printed, rtol=0, atol=5e-30)


def test_vertical_optical_depth_of_345_dobson_units():
    # Column times cross-section, printed to four decimals: (0.0127, 0.0307, 0.0013).
    depth = 345.0 * DOBSON_UNIT * ozone_cross_section(RGB)
    assert_allclose(depth, [0.0127, 0.0307, 0.0013], rtol=0, atol=5e-5)


def test_scaling_stays_within_the_measurement_s_uncertainty():
    # The 1 nm means of doi:10.5281/zenodo.5793207 at 293 K, whose accuracy is 3 per cent.
    assert_allclose(ozone_cross_section(RGB), [1.3604e-25, 3.2872e-25, 1.3537e-26], rtol=9e-3)


def test_chappuis_band_agrees_with_an_independent_measurement():
    # Brion et al. (1998), J. Atmos. Chem. 30, 291, at 295 K, as 1 nm means. Both claim a few per
    # cent; in the band's structured blue end and its red wing they differ by 5.
    brion = {
        500.0: 1.202e-25,
        532.0: 2.818e-25,
        550.0: 3.373e-25,
        575.0: 4.822e-25,
        602.0: 5.212e-25,
        630.0: 3.557e-25,
        650.0: 2.506e-25,
        680.0: 1.371e-25,
        700.0: 8.661e-26,
        750.0: 4.297e-26,
    }
    assert_allclose(ozone_cross_section(list(brion)), list(brion.values()), rtol=0.05)


def test_peak_of_the_chappuis_band_is_near_602_nanometres():
    at = np.arange(450.0, 751.0)
    assert 598.0 <= at[ozone_cross_section(at).argmax()] <= 606.0


def test_warm_ozone_is_near_the_cold_ozone_of_bruneton_s_table():
    # Bruneton (2017), demo.cc: means over 10 nm from 500 to 650 nm of the same laboratory's data
    # at 233 K; temperature changes these by less than 4 per cent.
    nanometres = np.arange(500.0, 650.0) + 0.5
    means = ozone_cross_section(nanometres).reshape(-1, 10).mean(axis=1)
    cold = [1.48e-25, 1.602e-25, 2.139e-25, 2.755e-25, 3.091e-25, 3.5e-25, 4.266e-25, 4.672e-25]
    cold += [4.398e-25, 4.701e-25, 5.019e-25, 4.305e-25, 3.74e-25, 3.215e-25, 2.662e-25]
    assert_allclose(means, cold, rtol=0.04)


def test_cold_ozone_has_the_dobson_absorption_coefficients():
    # A, C and D pairs of Komhyr et al. (1993), J. Geophys. Res. 98, 20451, at -46.3 °C, to base 10
    # [atm⁻¹ cm⁻¹]; triangular slits of 1 nm at the short and 3 nm at the long wavelength. At
    # 293 K they would be 15 % larger.
    pairs = {(305.5, 325.0): 1.806, (311.5, 332.4): 0.833, (317.5, 339.9): 0.374}
    wavelengths = np.arange(300.0, 345.0, 0.05)
    sections = ozone_cross_section(wavelengths, 226.85)

    def mean(centre: float, width: float) -> float:
        weights = np.maximum(1.0 - np.abs(wavelengths - centre) / width, 0.0)
        return float(np.average(sections, weights=weights))

    per_column = 1e3 * DOBSON_UNIT / np.log(10.0)
    found = [per_column * (mean(short, 1.0) - mean(long, 3.0)) for short, long in pairs]
    assert_allclose(found, list(pairs.values()), rtol=0.05)


def test_temperature_acts_as_measured():
    # 1 nm means of the same table at 223 K over 293 K, and at the cold end of the fit.
    measured = [0.8464, 0.8303, 1.0101, 0.9642]
    at = [310.0, 320.0, 600.0, 680.0]
    ratio = ozone_cross_section(at, 223.0) / ozone_cross_section(at, 293.0)
    assert_allclose(ratio, measured, rtol=0.02)
    cold = ozone_cross_section([310.0, 320.0], 193.0) / ozone_cross_section([310.0, 320.0])
    assert_allclose(cold, [0.8057, 0.8038], rtol=0.02)

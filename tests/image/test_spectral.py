"""Spectral colour against the golden numbers, Bruneton's program and full integration."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.image.spectral import (
    LEGACY_SUN_COLOR,
    default_wavelengths,
    rgb_weights,
    sky_factors,
    sun_color,
)
from airlight.image.xyz import XYZ_TO_RGB, luminance, rgb_to_xyz
from airlight.physics.constants import DOBSON_UNIT, LUMINOUS_EFFICACY
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.ozone import ozone_cross_section
from airlight.physics.spectra.sun import solar_irradiance

EYE = np.arange(360.0, 831.0)


def integrated(ratio):
    """Linear sRGB by the trapezoid at 1 nm of the whole spectrum: no interpolation."""
    radiance = ratio * solar_irradiance(EYE)
    return XYZ_TO_RGB @ np.trapezoid(radiance[:, None] * cie_1931().values, EYE, axis=0)


def skies():
    """Radiance over irradiance of typical skies at 1 nm, by Beer's law and single scattering."""
    rayleigh = 0.0972 * (550.0 / EYE) ** 4.09
    ozone = 345.0 * DOBSON_UNIT * ozone_cross_section(EYE)
    haze = 0.1 * (550.0 / EYE) ** 1.3
    blue = (550.0 / EYE) ** 4.09
    horizon = (1.0 - np.exp(-38.0 * (rayleigh + haze))) / (rayleigh + haze) * rayleigh
    return {
        "rayleigh": blue,
        "zenith": (1.0 - np.exp(-rayleigh)) * np.exp(-2.0 * ozone),
        "horizon": horizon * np.exp(-3.0 * ozone),
        "low sun": np.exp(-10.0 * (rayleigh + ozone + haze)),
        "sunset": np.exp(-38.0 * rayleigh - 12.0 * ozone - 10.0 * haze),
        "red sunset": np.exp(-60.0 * rayleigh - 20.0 * ozone - 40.0 * haze),
        "blue hour": blue * np.exp(-5.0 * rayleigh - 25.0 * ozone),
        "late dusk": blue * np.exp(-20.0 * rayleigh - 40.0 * ozone),
        "limb": blue * np.exp(-10.0 * ozone),
        "neutral ground": np.ones_like(EYE),
        "mars": 0.1 + 1.0 / (1.0 + np.exp(-(EYE - 560.0) / 40.0)),
    }


def colour_difference(rgb, reference):
    """ΔE of CIE 2000 by colour-science, the reference at half the luminance of white."""
    with np.printoptions():  # colour-science changes how NumPy prints, for everyone
        colour = pytest.importorskip("colour")
    scale = 0.5 / luminance(reference)
    lab = [colour.XYZ_to_Lab(rgb_to_xyz(scale * value)) for value in (rgb, reference)]
    return float(colour.delta_E(*lab, method="CIE 2000"))


def errors(wavelengths):
    weights = rgb_weights(wavelengths)
    found = {}
    for name, ratio in skies().items():
        radiance = np.interp(wavelengths, EYE, ratio) * solar_irradiance(wavelengths)
        found[name] = colour_difference(radiance @ weights, integrated(ratio))
    return found


def test_sun_has_the_golden_tristimulus_values():
    # Golden numbers: trapezoid at 1 nm, 360 to 830 nm, printed to eight decimals.
    golden = [189.43918012, 194.87614689, 201.49465290]
    assert_allclose(rgb_to_xyz(sun_color()), golden, rtol=1e-9)


def test_sun_has_the_golden_colour():
    golden = [213.86594734, 190.34611166, 183.80648353]
    assert_allclose(sun_color(), golden, rtol=1e-9)
    assert_allclose(integrated(np.ones_like(EYE)), golden, rtol=1e-9)


def test_sun_colour_in_float32_is_the_printed_one_bit_for_bit():
    # Atmosphere Plus notes 2, section 1.1.4, prints the float32 of it.
    printed = np.array([213.865952, 190.346115, 183.806488], dtype=np.float32)
    assert_array_equal(sun_color().astype(np.float32), printed)


def test_legacy_sun_colour_is_sun_times_constant_of_the_first_notes():
    # Their section 1.10: (0.1526, 0.191, 0.208) * (133.3209, 88.51855, 112.7552), in float32.
    product = np.array([0.1526, 0.191, 0.208]) * np.array([133.3209, 88.51855, 112.7552])
    assert_allclose(LEGACY_SUN_COLOR, product, rtol=1e-6)


def test_sunlight_outside_the_air_is_133_100_lux():
    # Golden numbers: printed to four digits.
    assert_allclose(LUMINOUS_EFFICACY * luminance(sun_color()), 133_100.0, rtol=5e-5)


def test_three_wavelength_factors_are_bruneton_s():
    # Bruneton (2017) prints in W m⁻² (248.1, 193.2, 182.8) for 680, 550, 440 nm: his sun holds
    # means over 10 nm at each interval's beginning. Made so, ours meets them to his matrix's
    # four decimals; made from the 1 nm sun it differs by up to 1.4 %.
    printed = [248.1, 193.2, 182.8]
    fine = solar_irradiance(np.arange(360.0, 850.0))
    coarse = np.interp(EYE, np.arange(360.0, 850.0, 10.0), fine.reshape(-1, 10).mean(axis=1))
    assert_allclose(sky_factors([680.0, 550.0, 440.0], coarse), printed, atol=0.12)
    assert_allclose(sky_factors([680.0, 550.0, 440.0]), printed, rtol=0.014)


def test_three_wavelengths_give_one_channel_each_whatever_their_order():
    weights = rgb_weights([550.0, 680.0, 440.0])
    sun = solar_irradiance([550.0, 680.0, 440.0])
    expected = np.zeros((3, 3))
    expected[[1, 0, 2], [0, 1, 2]] = sky_factors([440.0, 550.0, 680.0])
    assert_allclose(weights * sun[:, None], expected)


def test_three_wavelengths_are_exact_for_a_sky_that_falls_with_the_cube():
    # The factors are made so: ∫ (λ/λ_c)⁻³ … cancels λ_c⁻³.
    at = np.array([680.0, 550.0, 440.0])
    radiance = (at / 500.0) ** -3.0 * solar_irradiance(at)
    assert_allclose(radiance @ rgb_weights(at), integrated((EYE / 500.0) ** -3.0), rtol=1e-12)


@pytest.mark.parametrize("count", [1, 2, 4, 5, 8, 16, 40])
def test_a_neutral_ground_has_the_sun_s_colour_with_any_number_of_wavelengths(count):
    # A constant is interpolated without error, so the sun's lines cannot tint it.
    at = default_wavelengths(count)
    assert_allclose(0.3 * solar_irradiance(at) @ rgb_weights(at), 0.3 * sun_color(), rtol=1e-12)


def test_weights_integrate_a_cubic_ratio_exactly():
    # A not-a-knot cubic spline through cubic data is that cubic; ends at 360 and 830 nm.
    at = np.linspace(360.0, 830.0, 7)

    def ratio(wavelengths):
        x = (wavelengths - 600.0) / 200.0
        return 1.0 + 0.3 * x - 0.2 * x**2 + 0.1 * x**3

    radiance = ratio(at) * solar_irradiance(at)
    assert_allclose(radiance @ rgb_weights(at), integrated(ratio(EYE)), rtol=1e-10)


@pytest.mark.filterwarnings("ignore::Warning")  # of colour-science, about its own extras
@pytest.mark.parametrize(("count", "largest"), [(8, 3.0), (12, 1.3), (16, 0.35), (24, 0.15)])
def test_default_wavelengths_show_every_sky_in_its_colour(count, largest):
    # ΔE 1 is just noticed. The reference integrates the whole spectrum at 1 nm.
    found = errors(default_wavelengths(count))
    assert max(found.values()) < largest, found


@pytest.mark.filterwarnings("ignore::Warning")
def test_three_wavelengths_show_a_clear_sky_and_no_sunset():
    # What the documentation says of the three-wavelength mode.
    found = errors(default_wavelengths(3))
    assert found["rayleigh"] < 1.0
    assert found["zenith"] < 1.0
    assert found["sunset"] > 10.0


def test_order_of_the_wavelengths_does_not_matter():
    at = default_wavelengths()
    shuffled = np.random.default_rng(1).permutation(at.size)
    assert_array_equal(rgb_weights(at[shuffled]), rgb_weights(at)[shuffled])


def test_irradiance_as_function_array_or_none_is_the_same_sun():
    at = default_wavelengths()
    assert_array_equal(rgb_weights(at, solar_irradiance), rgb_weights(at))
    assert_allclose(rgb_weights(at, solar_irradiance(EYE)), rgb_weights(at), rtol=1e-14)


def test_under_a_flat_star_the_weights_are_the_eye_s():
    # E = 1: the colour of equal energy, ΣXYZ trapezoid at 1 nm, straight from the table.
    at = default_wavelengths()
    flat = XYZ_TO_RGB @ np.trapezoid(cie_1931().values, EYE, axis=0)
    assert_allclose(np.ones(at.size) @ rgb_weights(at, lambda nm: np.ones_like(nm)), flat)
    assert_allclose(sun_color(np.ones(471)), flat)


@pytest.mark.parametrize(
    "wavelengths", [[], [550.0, 550.0], [550.0, np.nan], [200.0, 550.0], [[550.0]]]
)
def test_wavelengths_that_cannot_be_weighted_are_refused(wavelengths):
    with pytest.raises(ParameterError, match=r"^wavelengths is"):
        rgb_weights(wavelengths)


def test_a_star_without_light_at_a_wavelength_is_refused():
    with pytest.raises(ParameterError, match=r"^irradiance is"):
        rgb_weights([450.0, 550.0], lambda nm: np.where(nm < 500.0, 0.0, 1.0))
    with pytest.raises(ParameterError, match=r"^irradiance is"):
        sun_color(np.full(471, np.nan))


def test_default_wavelengths_stay_within_the_limits():
    assert_allclose(default_wavelengths(16, 430.0, 690.0), np.linspace(430.0, 690.0, 16))
    assert_allclose(default_wavelengths(16, 430.0, 1000.0)[[0, -1]], [430.0, 695.0])
    assert_array_equal(default_wavelengths(3), [680.0, 550.0, 440.0])
    assert_allclose(default_wavelengths(3, 450.0, 700.0), [450.0, 572.5, 695.0])
    assert_allclose(default_wavelengths(1), [552.5])


@pytest.mark.parametrize(
    "arguments", [(0,), (-1,), (2.5,), (True,), (16, 700.0, 900.0), (16, float("nan"), 700.0)]
)
def test_impossible_wavelength_choices_are_refused(arguments):
    with pytest.raises(ParameterError):
        default_wavelengths(*arguments)

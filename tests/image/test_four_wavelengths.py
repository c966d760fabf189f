"""Colour of few wavelengths against integration of the whole spectrum."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.image.four_wavelengths import (
    CHOSEN,
    _seen_differences,
    few_wavelengths,
    fitted_weights,
    four_wavelengths,
    typical_light,
)
from airlight.image.spectral import default_wavelengths, rgb_weights, sun_color
from airlight.image.xyz import XYZ_TO_RGB, luminance, rgb_to_xyz
from airlight.physics.constants import DOBSON_UNIT
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.ozone import ozone_cross_section
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets import load_planet
from airlight.validation.reference_files import packaged_table

EYE = np.arange(360.0, 831.0)


def red_dwarf(wavelengths):
    """The star of TRAPPIST-1 e, 2566 K."""
    return load_planet("exoplanet").star.irradiances(wavelengths)


STARS = {"sun": solar_irradiance, "red dwarf": red_dwarf, "flat": np.ones_like}


def integrated(ratio, star=solar_irradiance):
    """Linear sRGB by the trapezoid at 1 nm of the whole spectrum."""
    radiance = ratio * star(EYE)
    return XYZ_TO_RGB @ np.trapezoid(radiance[:, None] * cie_1931().values, EYE, axis=0)


def unseen():
    """Light that the fit was not made for: Beer's law with other powers, columns and mixtures."""
    rayleigh = 0.0972 * (550.0 / EYE) ** 4.09
    ozone = 345.0 * DOBSON_UNIT * ozone_cross_section(EYE)
    haze = 0.1 * (550.0 / EYE) ** 0.9
    blue = (550.0 / EYE) ** 4.09
    horizon = (1.0 - np.exp(-38.0 * (rayleigh + haze))) / (rayleigh + haze) * rayleigh
    leaf = 0.05 + 0.08 * np.exp(-(((EYE - 550.0) / 35.0) ** 2)) + 0.4 * (EYE > 700.0)
    return {
        "zenith": (1.0 - np.exp(-rayleigh)) * np.exp(-2.0 * ozone),
        "horizon": horizon * np.exp(-3.0 * ozone),
        "low sun": np.exp(-10.0 * (rayleigh + ozone + haze)),
        "sunset": np.exp(-30.0 * rayleigh - 12.0 * ozone - 5.0 * haze),
        "blue hour": blue * np.exp(-5.0 * rayleigh - 25.0 * ozone),
        "limb": blue * np.exp(-10.0 * ozone),
        "mars": 0.1 + 1.0 / (1.0 + np.exp(-(EYE - 560.0) / 40.0)),
        "sky and grey ground": 0.3 * np.exp(-rayleigh) + 0.05 * blue,
        "leaves": leaf,
    }


def colour_difference(rgb, reference):
    """ΔE of CIE 2000 by colour-science, the reference at half the luminance of white."""
    with np.printoptions():  # colour-science changes how NumPy prints, for everyone
        colour = pytest.importorskip("colour")
    scale = 0.5 / luminance(reference)
    lab = [colour.XYZ_to_Lab(rgb_to_xyz(scale * value)) for value in (rgb, reference)]
    return float(colour.delta_E(*lab, method="CIE 2000"))


def errors(wavelengths, weights, star):
    found = {}
    for name, ratio in unseen().items():
        radiance = np.interp(wavelengths, EYE, ratio) * star(wavelengths)
        found[name] = colour_difference(radiance @ weights, integrated(ratio, star))
    return found


@pytest.mark.parametrize("star", STARS)
@pytest.mark.parametrize("count", [2, 3, 4, 5, 8])
def test_the_star_s_own_light_keeps_its_colour_exactly(star, count):
    # It is the fit's condition; rounding of the matrix is all that is left.
    at = np.linspace(430.0, 650.0, count)
    rgb = STARS[star](at) @ fitted_weights(at, STARS[star])
    assert_allclose(rgb, sun_color(STARS[star]), rtol=1e-10)


def test_light_of_as_many_spectra_as_wavelengths_could_not_be_fitted_better():
    # A law of least squares: any other matrix with the condition errs more on the same light.
    at, weights = four_wavelengths()
    light = typical_light()
    true = integrated_all(light)
    exposure = 0.5 / luminance(true)[:, None]
    samples = np.array([np.interp(at, EYE, one) for one in light]) * solar_irradiance(at)

    def error(candidate):
        lab = [lab_of(exposure * (samples @ candidate)), lab_of(exposure * true)]
        return np.sum(cie94(*lab) ** 2)

    random = np.random.default_rng(8)
    least = error(weights)
    for _ in range(40):
        change = random.normal(size=(4, 3))
        change -= change.mean(axis=0)  # of the ratios: the star keeps its colour
        change *= 0.05 * sun_color() / solar_irradiance(at)[:, None]
        assert error(weights + change) > least


def integrated_all(light):
    return np.trapezoid(
        (light * solar_irradiance(EYE))[:, :, None] * (cie_1931().values @ XYZ_TO_RGB.T),
        EYE,
        axis=1,
    )


def lab_of(rgb):
    """CIE 1976 L*a*b* as CIE 15 writes it; white is D65."""
    ratio = rgb_to_xyz(rgb) / np.array([0.95047, 1.0, 1.08883])
    f = np.where(ratio > (6 / 29) ** 3, np.cbrt(ratio), ratio / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack(
        [116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=-1
    )


def cie94(lab, reference):
    """CIE94 with the reference's chroma, from its definition."""
    chroma = np.hypot(*reference[:, 1:].T)
    by_chroma = np.hypot(*lab[:, 1:].T) - chroma
    by_all = np.hypot(*(lab - reference)[:, 1:].T)
    by_hue = np.sqrt(np.maximum(by_all**2 - by_chroma**2, 0.0))
    return np.sqrt(
        (lab - reference)[:, 0] ** 2
        + (by_chroma / (1 + 0.045 * chroma)) ** 2
        + (by_hue / (1 + 0.015 * chroma)) ** 2
    )


@pytest.mark.filterwarnings("ignore::Warning")  # of colour-science, about its own extras
@pytest.mark.parametrize("star", STARS)
def test_four_wavelengths_show_light_that_they_were_not_fitted_to(star, tell):
    # ΔE 1 is just noticed. The reference integrates the whole spectrum at 1 nm. Leaves rise beyond
    # the last sample, at 700 nm, where a red dwarf shines most: the method's limit.
    at, weights = four_wavelengths(STARS[star])
    found = errors(at, weights, STARS[star])
    tell(f"four wavelengths, {star}: " + ", ".join(f"{k} {v:.2f}" for k, v in found.items()))
    assert found.pop("leaves") < (8.0 if star == "red dwarf" else 1.5)
    assert max(found.values()) < 2.0, found
    assert np.median(list(found.values())) < 0.7, found


@pytest.mark.parametrize("planet", [1, 2, 3, 4])
def test_wavelengths_beside_methane_show_the_giant_planets(planet):
    # Karkoschka (1998), means over 10 nm, in sunlight; the reference integrates them. ΔE 1 is just
    # noticed; half of one more. At the other four wavelengths Neptune errs by 21, Jupiter by 3.
    table = packaged_table("data/full-disc-albedos.csv")
    nm, seen = table[:, 0], table[:, planet]
    true = integrated_all(np.interp(EYE, nm, seen)[None, :])
    at = few_wavelengths(4, methane=True)
    found = (np.interp(at, nm, seen) * solar_irradiance(at)) @ fitted_weights(at)
    exposure = 0.5 / luminance(true)[0]
    assert cie94(lab_of(exposure * found[None, :]), lab_of(exposure * true))[0] < 1.5


@pytest.mark.filterwarnings("ignore::Warning")
def test_fitted_wavelengths_show_a_sunset_that_interpolated_ones_do_not():
    # The reason why they are there: three channels, or four samples joined by a spline, miss it.
    for count, better in ((3, 2.0), (4, 3.0)):
        at = few_wavelengths(count)
        fitted = errors(at, fitted_weights(at), solar_irradiance)
        usual = default_wavelengths(count)
        interpolated = errors(usual, rgb_weights(usual), solar_irradiance)
        for name in ("sunset", "low sun", "blue hour"):
            assert better * fitted[name] < interpolated[name], name


def test_what_is_minimised_is_cie94_near_the_true_colours():
    # Its definition by small differences; at 1e-5 of the light the second order is below 1e-3.
    true = integrated_all(typical_light())
    exposure = 0.5 / luminance(true)[:, None]
    change = 1e-5 * np.random.default_rng(2).normal(size=true.shape) / exposure
    seen = np.einsum("kij,kj->ki", _seen_differences(true), change)
    exact = cie94(lab_of(exposure * (true + change)), lab_of(exposure * true))
    assert_allclose(np.hypot(np.hypot(*seen.T[:2]), seen[:, 2]), exact, rtol=1e-3)


@pytest.mark.parametrize(("count", "step"), [(4, 20.0), (3, 10.0)])
def test_no_wavelengths_near_by_fit_typical_light_better(count, step):
    # What the docstring says of the choice, tried again among the neighbours.
    light, true = typical_light(), integrated_all(typical_light())
    exposure = 0.5 / luminance(true)[:, None]
    reference = lab_of(exposure * true)

    def error(tried):
        at = np.array(tried)
        samples = np.array([np.interp(at, EYE, one) for one in light]) * solar_irradiance(at)
        rgb = exposure * (samples @ fitted_weights(at))
        return np.mean(cie94(lab_of(rgb), reference) ** 4) ** 0.25

    chosen = np.array(CHOSEN[count])
    steps = np.array(list(product((-step, 0.0, step), repeat=count)))
    tried = [tuple(at) for at in chosen + steps if min(np.diff(at)) >= 30.0]
    assert min(tried, key=error) == CHOSEN[count]


def test_order_of_the_wavelengths_does_not_matter():
    at = few_wavelengths(4)
    assert_allclose(fitted_weights(at[::-1]), fitted_weights(at)[::-1], rtol=1e-9, atol=1e-9)


def test_irradiance_as_function_array_or_none_is_the_same_sun():
    at = few_wavelengths(4)
    assert_array_equal(fitted_weights(at, solar_irradiance), fitted_weights(at))
    assert_allclose(fitted_weights(at, solar_irradiance(EYE)), fitted_weights(at), rtol=1e-12)


def test_a_brighter_star_has_the_same_weights():
    # The colour per radiance does not depend on how much light there is.
    at = few_wavelengths(4)
    brighter = fitted_weights(at, lambda nm: 7.0 * solar_irradiance(nm))
    assert_allclose(brighter, fitted_weights(at), rtol=1e-9)


def test_wavelengths_stay_within_the_limits():
    assert_array_equal(few_wavelengths(4), [440.0, 500.0, 560.0, 620.0])
    assert_array_equal(few_wavelengths(3, 440.0, 620.0), [450.0, 550.0, 620.0])
    assert_allclose(few_wavelengths(4, 470.0, 900.0), [470.0, 520.0, 570.0, 620.0])
    at, weights = four_wavelengths(None, (300.0, 590.0))
    assert_allclose(at, [440.0, 490.0, 540.0, 590.0])
    assert weights.shape == (4, 3)


@pytest.mark.parametrize(
    ("arguments", "field"),
    [((2,), "count"), ((5,), "count"), ((4, 700.0, 900.0), "low"), ((3, float("nan"), 1.0), "low")],
)
def test_impossible_choices_are_refused(arguments, field):
    with pytest.raises(ParameterError, match=rf"^{field}"):
        few_wavelengths(*arguments)


@pytest.mark.parametrize(
    "wavelengths",
    [[550.0], [550.0, 550.0], [330.0, 550.0], [550.0, 850.0], np.arange(400.0, 409.0)],
)
def test_wavelengths_that_cannot_be_fitted_are_refused(wavelengths):
    with pytest.raises(ParameterError, match=r"^wavelengths is"):
        fitted_weights(wavelengths)


def test_a_star_without_light_is_refused():
    with pytest.raises(ParameterError, match=r"^irradiance is"):
        four_wavelengths(lambda nm: np.where(nm < 500.0, 0.0, 1.0))

"""White balance: black bodies, grey in sunlight and under other stars, Bradford's matrix."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet
from airlight.errors import ParameterError
from airlight.image.color_temperature import correlated_color_temperature
from airlight.image.display import exposed_light, to_display
from airlight.image.display_settings import DisplaySettings
from airlight.image.spectral import default_wavelengths, rgb_weights
from airlight.image.white_balance import (
    NIGHT_X,
    NIGHT_Y,
    WHITE_BALANCES,
    adapt,
    black_body_x,
    black_body_y,
    mccamy_temperature,
    star_white,
    white_gains,
)
from airlight.image.xyz import RGB_TO_XYZ, chromaticity, rgb_to_xyz, xyz_to_rgb
from airlight.physics.spectra.blackbody import planck_radiance
from airlight.physics.spectra.color_matching import cie_1931

D65 = chromaticity(RGB_TO_XYZ.sum(axis=1))
SUN = star_white(None)


def gains(
    name: str, star: tuple[float, float], kelvin: float = 5500.0, exposure: float = -4.0
) -> Any:
    return white_gains(WHITE_BALANCES.index(name), kelvin, *star, 0.0, 0.0, 2.0**exposure)


def uv(xyz: np.ndarray) -> np.ndarray:
    """CIE 1976 u', v'."""
    total = xyz @ [1.0, 15.0, 3.0]
    return np.stack([4.0 * xyz[..., 0] / total, 9.0 * xyz[..., 1] / total], axis=-1)


def black_body(kelvin: float) -> tuple[float, float]:
    seen = cie_1931()
    x, y = chromaticity(planck_radiance(seen.wavelengths, kelvin) @ seen.values).tolist()
    return x, y


@pytest.mark.parametrize("kelvin", [2000.0, 2600.0, 4000.0, 5500.0, 8000.0, 25000.0])
def test_black_bodies_have_the_chromaticity_of_planck_s_law(kelvin: float) -> None:
    # the integral is the second method; the cubics are within 6e-4
    assert_allclose((black_body_x(kelvin), black_body_y(kelvin)), black_body(kelvin), atol=6e-4)


def test_mccamy_s_temperature_is_that_of_the_nearest_black_body() -> None:
    # McCamy gives an error of at most 2 K from 2856 to 6500 K; the search is the second method
    for x, y in ((0.44757, 0.40745), (0.3457, 0.3585), (0.31272, 0.32903)):
        xyz = np.array([x / y, 1.0, (1.0 - x - y) / y])
        assert_allclose(mccamy_temperature(x, y), correlated_color_temperature(xyz), atol=8.0)


def test_adaptation_is_the_published_matrix() -> None:
    # Lindbloom, "Chromatic Adaptation": Bradford from D50 to D65
    published = [
        [0.9555766, -0.0230393, 0.0631636],
        [-0.0282895, 1.0099416, 0.0210077],
        [0.0122982, -0.0204830, 1.3299098],
    ]
    x, y, z = 0.96422, 1.0, 0.82521
    white = x / (x + y + z), y / (x + y + z)
    found = rgb_to_xyz(adapt(xyz_to_rgb(np.eye(3)), gains("star", white)))
    assert_allclose(found.T, published, atol=3e-5)


def test_the_adopted_white_is_shown_white_and_as_bright() -> None:
    for name, star in (("star", SUN), ("star", black_body(3000.0)), ("daylight", SUN)):
        x, y = star if name == "star" else (black_body_x(5500.0), black_body_y(5500.0))
        light = xyz_to_rgb([x / y, 1.0, (1.0 - x - y) / y])
        assert_allclose(adapt(light, gains(name, star)), 1.0, rtol=2e-5)


def test_auto_is_daylight_under_a_sun_and_the_star_under_others() -> None:
    cool = black_body(3000.0)
    assert_allclose(gains("auto", SUN), gains("daylight", SUN), rtol=1e-12)
    assert_allclose(gains("auto", cool), gains("star", cool), rtol=1e-12)
    # of the dusk's blue sky light nothing is taken away, by night moon and lamps are as the sun is
    assert_allclose(gains("auto", SUN, exposure=2.0), 1.0, atol=1e-3)
    assert_allclose(gains("auto", SUN, exposure=12.0), gains("daylight", SUN), rtol=1e-12)
    # and airglow and lamps are shown in a warm white's balance, under a moon not
    white = (NIGHT_X, NIGHT_Y)
    assert_allclose(gains("auto", SUN, exposure=15.0), gains("star", white), rtol=1e-12)
    # which is a black body of 3600 K within 100 K, greener by 0.01 at most
    assert abs(mccamy_temperature(*white) - 3600.0) < 100.0
    assert 0.0 < NIGHT_Y - black_body_y(3600.0) < 0.02
    fading = [gains("auto", SUN, exposure=one)[2] for one in np.linspace(-4.0, 2.0, 25)]
    assert np.all(np.diff(fading) <= 0.0)
    assert gains("auto", (0.0, 0.0)) == gains("d65", SUN) == (1.0, 1.0, 1.0)
    assert_allclose(gains("kelvin", cool, 5500.0), gains("daylight", SUN), rtol=1e-12)
    assert abs(gains("star", SUN)[2] - gains("daylight", SUN)[2]) > 0.01


@pytest.mark.parametrize("elevation", [30.0, 40.0, 60.0])
def test_a_grey_card_in_sunlight_is_neutral(elevation: float, solved: Callable[..., Any]) -> None:
    # A horizontal card under sun and sky, at elevations from 30° to 60° as by day: photographic
    # daylight is defined by such light (ISO 7589).
    nm = tuple(default_wavelengths(16).tolist())
    solution = solved(load_planet("earth"), nm, "preview")
    light = solution.irradiance(altitude=0.0, sun_zenith=90.0 - elevation)
    total = np.asarray(light["direct"] + light["diffuse"]).ravel()
    card = total @ rgb_weights(nm, solution.lights[0].spectrum)
    white = star_white(solution.lights[0].spectrum)
    neutral = uv(RGB_TO_XYZ.sum(axis=1))
    shown = uv(rgb_to_xyz(adapt(card, gains("daylight", white))))
    assert np.hypot(*(shown - neutral)) < 0.005
    assert np.hypot(*(uv(rgb_to_xyz(card)) - neutral)) > 0.008  # as it was with the white D65


def test_scene_makes_a_tinted_world_grey_but_keeps_dusk_blue() -> None:
    world = np.random.default_rng(1).uniform(0.05, 1.0, (40, 40, 1)) * np.ones(3)
    for kelvin, nearly in ((5000.0, True), (15000.0, False)):
        x, y = black_body(kelvin)
        tinted = world * xyz_to_rgb([x / y, 1.0, (1.0 - x - y) / y])
        shown = to_display(tinted, 0.0, "exponential", white_balance="scene", dither=False)
        spread = np.ptp(shown.astype(float), axis=-1).max()
        assert (spread <= 2.0) == nearly


def test_night_stays_blue_whatever_the_white_is() -> None:
    # what rods see has no colour to adapt: below 0.01 cd m⁻², and in exposures no longer than what
    # the eye sees, pictures are the same
    dark = np.array([[[2e-5, 1e-5, 0.5e-5]]])
    shown = [
        to_display(dark, 8.0, eye=True, dither=False, white_balance=one)
        for one in (3000.0, 5500.0, "d65")
    ]
    assert shown[2].max() > 0
    assert_array_equal(shown[0], shown[2])
    assert_array_equal(shown[1], shown[2])


def test_a_displayed_picture_gives_its_light_back() -> None:
    light = np.random.default_rng(2).uniform(0.02, 0.4, (8, 8, 3))
    settings = DisplaySettings(white_balance=4000.0, encoding="gamma", bits=16, dither=False)
    shown = to_display(light, 0.0, settings=settings) / 65535.0
    found = exposed_light(shown, settings, settings.display(0.0)[-3:])
    within = np.ptp(light, axis=-1) < 0.2
    assert_allclose(found[within], light[within], rtol=2e-3, atol=2e-4)


def test_infinite_light_is_white_and_wrong_whites_are_refused() -> None:
    assert_array_equal(to_display(np.full((1, 1, 3), np.inf), 0.0, white_balance=3000.0), 255)
    for wrong in ("tungsten", 100.0, float("nan")):
        with pytest.raises(ParameterError, match=r"^white_(balance|temperature) is"):
            DisplaySettings(white_balance=wrong)

"""What the display chain makes of rendered frames: hues, ends of the scale, contours, exposure."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet, render
from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.image.encoding import srgb_decode
from airlight.image.four_wavelengths import typical_light
from airlight.image.natural import STYLES, natural
from airlight.image.oklab import rgb_to_oklab
from airlight.image.spectral import EYE, rgb_weights
from airlight.image.xyz import luminance
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.scene.metering import scene_exposure

CAMERA = Camera(width=320, height=180, field_of_view=70.0, look_zenith=78.0)
SCENES = {
    "noon": Scene(altitude=2.0, sun_zenith=30.0, camera=dataclasses.replace(CAMERA)),
    "sunset": Scene(altitude=2.0, sun_zenith=89.0, camera=dataclasses.replace(CAMERA)),
    "twilight": Scene(altitude=2.0, sun_zenith=94.0, camera=dataclasses.replace(CAMERA)),
}


@pytest.fixture(scope="module")
def solution(solved: Callable[..., Any]) -> Any:
    earth = load_planet("earth")
    nm = tuple(float(one) for one in picture_wavelengths(earth, 8))
    return solved(earth, nm, "preview")


@pytest.fixture(scope="module")
def seen(solution: Any) -> dict[str, tuple[np.ndarray, float]]:
    """Linear frame and exposure [EV] of each scene."""
    radius = solution.lights[0].angular_radius
    frames = {name: render(solution, scene).rgb for name, scene in SCENES.items()}
    return {name: (rgb, scene_exposure(rgb, SCENES[name], radius)) for name, rgb in frames.items()}


def hue_errors(shown: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Angles between the hues of colours that have chroma. [deg]"""
    a, b = rgb_to_oklab(shown), rgb_to_oklab(light)
    colored = np.hypot(a[..., 1], a[..., 2]) > 0.02
    angle = np.arctan2(a[..., 2], a[..., 1]) - np.arctan2(b[..., 2], b[..., 1])
    return np.abs(np.degrees((angle[colored] + np.pi) % (2.0 * np.pi) - np.pi))


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("style", STYLES)
def test_hues_are_those_of_the_light(name, style, seen):
    rgb, exposure = seen[name]
    settings = DisplaySettings(eye=False, bits=16, dither=False, style=style)
    shown = srgb_decode(to_display(rgb, exposure, settings=settings) / 65535.0)
    errors = hue_errors(shown, rgb)
    assert errors.size > 0.05 * rgb.shape[0] * rgb.shape[1]
    assert errors.max() < 8.0


@pytest.mark.parametrize("contrast", STYLES.values())
def test_hues_and_brightness_of_typical_light(contrast):
    # of skies, dusk, dust and tholins, from dim to far beyond white
    light = typical_light() @ rgb_weights(EYE, solar_irradiance(EYE))
    light /= luminance(light)[:, None]
    steps = np.geomspace(0.01, 30.0, 60)
    shown = natural(steps[:, None, None] * light, contrast)
    assert hue_errors(shown, np.broadcast_to(light, shown.shape)).max() < 8.0
    lightness = rgb_to_oklab(shown)[..., 0]
    assert np.all(np.diff(lightness[steps < 8.0], axis=0) > 0.0)
    assert np.all(np.diff(lightness, axis=0) > -1e-9)


@pytest.mark.parametrize("name", ["noon", "sunset"])
def test_no_channel_is_clipped(name, seen):
    rgb, exposure = seen[name]
    plain = to_display(rgb, exposure, eye=True, dither=False)
    assert (plain == 0).mean(axis=(0, 1)).max() < 0.005
    assert (plain == 255).mean(axis=(0, 1)).max() < 0.005
    # dither takes a sea of one step of light to 0 in places, but no sky
    picture = to_display(rgb, exposure, eye=True)
    assert (picture[:120] == 0).mean(axis=(0, 1)).max() < 0.005
    assert (picture == 255).mean(axis=(0, 1)).max() < 0.005


@pytest.mark.parametrize("name", SCENES)
def test_skies_have_no_contours(name, seen):
    rgb, exposure = seen[name]
    sky = to_display(rgb, exposure, eye=True)[:90]
    same = np.all(sky[:, 1:] == sky[:, :-1], axis=-1)
    runs = np.zeros(same.shape[0], int)
    longest = 0
    for column in range(same.shape[1]):
        runs = np.where(same[:, column], runs + 1, 0)
        longest = max(longest, int(runs.max()) + 1)
    assert longest <= 24


def test_size_and_field_of_view_hardly_change_the_exposure(solution, seen):
    radius = solution.lights[0].angular_radius
    for name in ("noon", "sunset"):
        scene, (_, exposure) = SCENES[name], seen[name]
        camera = dataclasses.replace(scene.camera, width=960, height=540)
        larger = dataclasses.replace(scene, camera=camera)
        found = scene_exposure(render(solution, larger).rgb, larger, radius)
        assert_allclose(found, exposure, atol=0.1)
    scene, (_, exposure) = SCENES["noon"], seen["noon"]
    narrow = dataclasses.replace(
        scene, camera=dataclasses.replace(scene.camera, field_of_view=40.0)
    )
    assert_allclose(
        scene_exposure(render(solution, narrow).rgb, narrow, radius), exposure, atol=0.3
    )


def test_the_sun_that_enters_the_picture_hardly_changes_it(solution):
    # half the field of view is 35°: the disc passes the edge, with its glow
    radius = solution.lights[0].angular_radius
    exposures = []
    for azimuth in (33.0, 34.5, 36.0, 37.5):
        camera = dataclasses.replace(CAMERA, look_zenith=70.0, look_azimuth=azimuth)
        scene = Scene(altitude=2.0, sun_zenith=70.0, camera=camera)
        exposures.append(scene_exposure(render(solution, scene).rgb, scene, radius))
    assert np.abs(np.diff(exposures)).max() < 0.3

"""Every observer, every sun, every projection: finite light, none of it below zero."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from marched_pictures import centres
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet, planet_names
from airlight.image.xyz import rgb_to_xyz
from airlight.render import render
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]

ALTITUDES = [0.0, 2.0, 1.2e4, 6e4, 99_999.99, 100_000.01, 4e5, 3.6e7, 1e8]
SUNS = [0.0, 30.0, 89.9, 90.0, 91.0, 96.0, 102.0, 110.0]
CAMERAS = [
    Camera(width=16, height=9, look_zenith=95.0),
    Camera(projection="fisheye", width=16, height=16, field_of_view=360.0),
    Camera(projection="equirectangular", width=24, height=12),
    Camera(projection="cubemap", width=36, height=6),
]
#: Planets that take longest and are of a kind with another: Earth with more haze, Saturn.
LATER = ("earth-volcanic", "jupiter", "uranus", "neptune")


def assert_sound(rgb: np.ndarray, what: str) -> None:
    """Check that values are finite and X, Y, Z not below 0; sRGB may be, outside the gamut."""
    assert np.isfinite(rgb).all(), what
    xyz = rgb_to_xyz(rgb.astype(np.float64))
    # X, Y, Z of channels rounded to float32 may miss 0 by a few 1e-7 of the largest
    allowed = 1e-6 * np.abs(rgb).max(axis=-1, keepdims=True)
    assert (xyz >= -allowed).all(), f"{what}: {xyz.min()}"


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda camera: camera.projection)
def test_earth_is_finite_and_not_negative_from_the_ground_to_far_away(
    camera: Camera, lit: Lit
) -> None:
    for altitude in ALTITUDES:
        for sun in SUNS:
            scene = Scene(camera=camera, altitude=altitude, sun_zenith=sun)
            rgb = render(lit(), scene).rgb
            assert_sound(rgb, f"{altitude:g} m, sun {sun:g}")


@pytest.mark.parametrize(
    "planet",
    [
        pytest.param(name, marks=[pytest.mark.validation] * (name in LATER))
        for name in planet_names()
    ],
)
def test_every_planet_is_finite_and_not_negative(planet: str, lit: Lit) -> None:
    solution = lit(planet, load_planet(planet).wavelengths)
    for altitude in (0.0, 3e4, 4e5, 1e8):
        for sun in (0.0, 90.0, 97.0, 110.0):
            scene = Scene(camera=CAMERAS[2], altitude=altitude, sun_zenith=sun)
            assert_sound(render(solution, scene).rgb, f"{altitude:g} m, sun {sun:g}")


@pytest.mark.filterwarnings("ignore::airlight.AirlightWarning")  # of bands beyond 700 nm
@pytest.mark.parametrize("planet", ["earth", pytest.param("mars", marks=pytest.mark.slow)])
def test_sixteen_wavelengths_give_colours_of_real_light(planet: str, lit: Lit) -> None:
    # the spectrum is interpolated between the wavelengths, which must not give values below 0
    solution = lit(planet, tuple(np.linspace(380.0, 780.0, 16)))
    for altitude in (0.0, 3e4, 4e5):
        for sun in (0.0, 85.0, 93.0, 97.0, 104.0, 110.0):
            scene = Scene(camera=CAMERAS[2], altitude=altitude, sun_zenith=sun)
            assert_sound(render(solution, scene).rgb, f"{altitude:g} m, sun {sun:g}")


@pytest.mark.parametrize("altitude", [100_001.0, 4e5, 1e8])
def test_lines_of_sight_that_miss_the_air_are_black(altitude: float, lit: Lit) -> None:
    # law: no air scatters; the shell's edge is seen at asin(top/r)
    camera = CAMERAS[2]
    scene = Scene(camera=camera, altitude=altitude, sun_zenith=140.0)
    rgb = centres(lit(), scene)
    z = camera.directions()[..., 2]
    r, top = 6360e3 + altitude, 6460e3
    misses = z > -np.sqrt((r - top) * (r + top)) / r
    away = camera.directions() @ scene.sun_direction < 0.9  # the star's own disc is light
    assert_array_equal(rgb[misses & away], 0.0)
    assert (misses & away).any()


def test_an_observer_turned_away_from_the_planet_sees_nothing(lit: Lit) -> None:
    camera = Camera(width=16, height=9, look_zenith=20.0, look_azimuth=180.0)
    assert_array_equal(render(lit(), Scene(camera=camera, altitude=4e5)).rgb, 0.0)


def test_outside_the_fisheye_s_circle_is_black_and_inside_is_not(lit: Lit) -> None:
    camera = Camera(projection="fisheye", width=50, height=32)
    rgb = render(lit(), Scene(camera=camera, sun_zenith=40.0)).rgb
    x, y = np.meshgrid(np.arange(50) + 0.5 - 25.0, np.arange(32) + 0.5 - 16.0)
    outside = np.hypot(x, y) > 16.0
    assert_array_equal(rgb[outside], 0.0)
    assert (rgb[~outside] > 0.0).all()


def test_air_and_ground_know_no_left_and_right(lit: Lit) -> None:
    # law: the planet without a map is symmetric about the plane of zenith and sun
    camera = Camera(projection="equirectangular", width=48, height=24)
    rgb = render(lit(), Scene(camera=camera, altitude=1e4, sun_zenith=85.0)).rgb
    assert_allclose(rgb[:, ::-1], rgb, rtol=1e-4, atol=1e-5 * float(rgb.max()))

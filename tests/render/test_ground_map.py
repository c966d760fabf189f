"""Map of the ground in a picture: correctly oriented, complete, without a seam."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Ground, Medium, Planet, Scene, load_planet, replace
from airlight.image.encoding import srgb_decode
from airlight.physics.optics.water import mean_specular
from airlight.render import render
from airlight.scene.surface_map import surface_map
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]
Mapped = Callable[[np.ndarray], MomentsSolution]

ALBEDO = float(srgb_decode(128 / 255.0))


@pytest.fixture
def mapped(lit: Lit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Mapped:
    """Earth with the pixels of a map, solved once: the solver's albedo is the same for all."""
    monkeypatch.chdir(tmp_path)  # the path of a map is at most 100 letters
    planet = load_planet("earth-atmosphere-plus")
    plain = lit(replace(planet, ground=Ground(albedo=ALBEDO)))
    count = 0
    surface_map.cache_clear()  # the tests' maps have the same names

    def make(pixels: np.ndarray) -> MomentsSolution:
        nonlocal count
        count += 1
        name = f"./map-{count}.png"
        Image.fromarray(pixels.astype(np.uint8)).save(name)
        painted: Planet = replace(planet, ground=Ground(albedo=ALBEDO, map=name))
        medium = Medium.from_planet(painted, plain.wavelengths)
        solution = MomentsSolution(medium, plain.settings, plain.moments, 0.0)
        solution.planet = painted
        return solution

    return make


def halves() -> np.ndarray:
    """Map that is red west of Greenwich, blue east of it."""
    pixels = np.zeros((64, 128, 3))
    pixels[:, :64, 0] = 255
    pixels[:, 64:, 2] = 255
    return pixels


@pytest.mark.parametrize("sun_azimuth", [0.0, 90.0, 200.0])
def test_east_is_on_the_right_when_looking_north(sun_azimuth: float, mapped: Mapped) -> None:
    camera = Camera(width=32, height=18, look_zenith=150.0, look_azimuth=-sun_azimuth)
    solution = mapped(halves())
    for longitude, east_is_blue in ((0.0, True), (180.0, False)):
        scene = Scene(
            camera=camera, altitude=400e3, sun_zenith=20.0, sun_azimuth=sun_azimuth,
            longitude=longitude,
        )  # fmt: skip
        rgb = render(solution, scene).rgb
        left, right = rgb[9:, 2:12], rgb[9:, 20:30]
        red_left = float(left[..., 0].mean() / right[..., 0].mean())
        assert red_left > 2.0 if east_is_blue else red_left < 0.5


def test_north_is_up_when_looking_north_down(mapped: Mapped) -> None:
    pixels = np.zeros((64, 128, 3))
    pixels[:32, :, 0] = 255  # the northern half is red
    camera = Camera(width=16, height=16, look_zenith=180.0, look_azimuth=-90.0)
    scene = Scene(camera=camera, altitude=400e3, sun_zenith=20.0, sun_azimuth=90.0)
    rgb = render(mapped(pixels), scene).rgb
    assert rgb[:6, :, 0].mean() > 2.0 * rgb[-6:, :, 0].mean()


def test_a_grey_map_is_the_ground_of_that_albedo(mapped: Mapped, lit: Lit) -> None:
    # second path: the albedo without a map; white is the same reflectance at every wavelength
    camera = Camera(projection="equirectangular", width=32, height=16)
    scene = Scene(camera=camera, altitude=400e3, sun_zenith=50.0)
    planet = load_planet("earth-atmosphere-plus")
    plain = render(lit(replace(planet, ground=Ground(albedo=ALBEDO))), scene).rgb
    assert_allclose(render(mapped(np.full((16, 32, 3), 128)), scene).rgb, plain, rtol=1e-4)


def test_the_map_has_no_seam_at_the_date_line(mapped: Mapped) -> None:
    # law: a planet turned by half a turn under an observer who moves along looks the same
    pixels = np.random.default_rng(3).integers(0, 256, (16, 32, 3))
    camera = Camera(width=48, height=32, field_of_view=80.0, look_zenith=180.0)
    here, there = (
        render(
            mapped(one),
            Scene(camera=camera, altitude=2e6, sun_zenith=20.0, longitude=longitude),
        ).rgb
        for one, longitude in ((pixels, 180.0), (np.roll(pixels, 16, axis=1), 0.0))
    )
    assert_allclose(there, here, rtol=1e-4, atol=1e-6 * float(here.max()))


@pytest.mark.parametrize("latitude", [90.0, -90.0])
def test_the_map_has_no_mark_at_the_poles(latitude: float, mapped: Mapped) -> None:
    # law: a map of rings around a pole, lit from straight above it, looks the same when turned
    rings = np.zeros((64, 128, 3)) + 40.0 + 3.0 * np.arange(64)[:, None, None]
    camera = Camera(width=33, height=33, field_of_view=40.0, look_zenith=180.0)
    scene = Scene(camera=camera, altitude=2e6, sun_zenith=0.0, latitude=latitude)
    rgb = render(mapped(rings), scene).rgb
    assert_allclose(np.rot90(rgb), rgb, rtol=2e-4)
    column = rgb[:, 16, 1]
    step = np.abs(np.diff(column))
    assert step[14:18].max() <= 1.5 * step[8:24].mean()  # the middle is no dot


def test_the_earth_s_map_keeps_the_solver_s_mean(lit: Lit) -> None:
    # the solver's albedo of the ground is approximately the mean over the pixels and what their
    # water mirrors: the map has three colours, the albedo a spectrum
    solution, earth = lit("earth"), surface_map("earth")
    mean = earth.mean_rgb + earth.mean_water * mean_specular(solution.medium.reflection.wind)
    assert_allclose(solution.medium.ground_albedo, mean, rtol=0.25)

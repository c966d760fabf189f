"""Clouds in pictures of a device, and the mean ground below them in its solver."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Scene, load_planet, solve
from airlight.image.display import to_display
from airlight.image.exposure import automatic_exposure
from airlight.planets.cloud_cover import mean_cover
from airlight.planets.medium import Medium
from airlight.render import render
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.render.gpu.solver.solver import solve_on
from airlight.scene.ground_overlay import ground_overlay
from airlight.solver.moments.settings import settings_for

NM = (440.0, 500.0, 560.0, 620.0)


@pytest.fixture
def clouds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Name of a picture of clouds with noise in every pixel."""
    monkeypatch.chdir(tmp_path)
    ground_overlay.cache_clear()
    mean_cover.cache_clear()
    cover = np.random.default_rng(4).integers(0, 256, (180, 360), np.uint8)
    Image.fromarray(cover).save("clouds.png")
    return "./clouds.png"


def test_clouds_of_a_device_are_those_of_the_cpu(device: Device, clouds: str) -> None:
    # The same functions in double precision, over land, sea and lights of towns; above the layer
    # and below it, by day and at dusk; also for the clear Earth after the cloudy one, whose shaders
    # and textures are others.
    pictures = GpuRenderer(device, (128, 64))
    for changes in ({"ground.clouds": clouds, "ground.cloud_altitude": "10 km"}, {}):
        solution = solve(load_planet("earth", changes), NM, "preview", cache=False)
        pictures.set_solution(solution)
        for altitude, zenith, sun in (
            (4e5, 150.0, 40.0), (4e5, 130.0, 93.0), (12e3, 100.0, 80.0), (2e3, 110.0, 70.0),
        ):  # fmt: skip
            camera = Camera(width=48, height=27, look_zenith=zenith, look_azimuth=20.0)
            scene = Scene(camera=camera, altitude=altitude, sun_zenith=sun, latitude=40.0,
                          longitude=10.0)  # fmt: skip
            wanted, seen = render(solution, scene), pictures.render(scene)
            exposure = automatic_exposure(wanted.rgb)
            shown = [to_display(one.rgb, exposure) for one in (wanted, seen)]
            off = np.abs(shown[0].astype(float) - shown[1].astype(float))
            assert off.max() <= 2.0
            assert np.median(np.abs(seen.rgb - wanted.rgb)) < 1e-4 * wanted.rgb.max()


def test_a_device_solves_for_the_mean_ground(device: Device, clouds: str) -> None:
    # The tolerance of any preview on a device.
    medium = Medium.from_planet(load_planet("earth-atmosphere-plus", {"ground.clouds": clouds}), NM)
    wanted, seen = (
        solution.irradiance(altitude=0.0, sun_zenith=60.0)["diffuse"].values
        for solution in (
            solve(load_planet("earth-atmosphere-plus", {"ground.clouds": clouds}), NM, "preview",
                  cache=False),
            solve_on(device, medium, settings_for("preview")),
        )
    )  # fmt: skip
    assert_allclose(seen, wanted, rtol=2e-3)

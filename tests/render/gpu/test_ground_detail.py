"""Detail of the ground on a device, in single precision."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet, render
from airlight.geometry.gradient_noise import PERIOD, smooth_noise
from airlight.geometry.vectors import Vec3
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.scene.ground_detail import WHOLE_PERIOD, finest_cell, ground_detail
from airlight.solver.moments.solution import MomentsSolution

CELL = np.float32(finest_cell(6371e3, 2700))


def test_noise_is_that_of_the_cpu(on_gpu: Callable[..., Any]) -> None:
    # Places of up to 256 cells are accurate to 2e-5 in single precision, at a slope of 4 at most.
    places = np.random.default_rng(1).uniform(-3.0, PERIOD, (3, 500)).astype(np.float32)
    wanted = [smooth_noise(*map(float, place)) for place in places.T]
    assert_allclose(on_gpu(smooth_noise, *places), wanted, atol=2e-4)


def test_detail_near_the_observer_is_that_of_the_cpu(on_gpu: Callable[..., Any]) -> None:
    # Up to a thousand of the finest cells away, where pixels are as large as they are.
    random = np.random.default_rng(2)
    away = 10.0 ** random.uniform(-1.0, 2.0, 500)
    steps = (random.normal(size=(3, 500)) * away).astype(np.float32)
    footprint = (1e-3 * away).astype(np.float32)
    wholes = np.floor(random.uniform(0.0, WHOLE_PERIOD, (3, 500))).astype(np.float32)
    parts = random.uniform(0.0, 1.0, (3, 500)).astype(np.float32)
    cell = np.full(500, CELL)
    given = Vec3(*steps), footprint, cell, Vec3(*wholes), Vec3(*parts)
    wanted = [
        ground_detail(Vec3(*step), float(size), float(CELL), Vec3(*whole), Vec3(*part))
        for step, size, whole, part in zip(
            *(one.T.tolist() for one in (steps, footprint, wholes, parts)), strict=True
        )
    ]
    assert_allclose(np.stack(on_gpu(ground_detail, *given), -1), wanted, atol=2e-3)


@pytest.mark.parametrize(
    ("altitude", "latitude", "longitude"),
    [(2.0, 25.0, 30.0), (1.7, 48.0, 11.0), (50.0, 25.0, 30.0)],
)
def test_the_ground_before_a_low_observer_is_that_of_the_cpu(
    device: Device,
    solved: Callable[..., MomentsSolution],
    altitude: float,
    latitude: float,
    longitude: float,
) -> None:
    # The cpu in double precision is the second method. A radius has half a metre in single
    # precision, so that the device's ground was displaced by up to a quarter of its distance, and
    # its detail differed by 22 %. At the edge of a stone or tuft a pixel in a thousand may see what
    # is behind it.
    solution = solved(load_planet("earth"), (680.0, 550.0, 440.0), "preview")
    camera = Camera(width=320, height=180, look_zenith=90.0, look_azimuth=-75.0)
    scene = Scene(
        camera=camera, altitude=altitude, sun_zenith=93.0, latitude=latitude, longitude=longitude,
        sun_azimuth=105.0, ground="detailed",
    )  # fmt: skip
    pictures = GpuRenderer(device)
    pictures.set_solution(solution)
    wanted, got = render(solution, scene).rgb, pictures.render(scene).rgb
    assert np.ptp(wanted[140]) > 0.1 * wanted[140].mean()  # the ground has detail
    assert np.quantile(np.abs(got - wanted) / wanted, 0.999) < 2e-3


def test_decorated_ground_from_orbit_is_that_of_the_cpu(
    device: Device, solved: Callable[..., MomentsSolution]
) -> None:
    # The cpu in double precision is the second method: clouds, slopes and shadows of the Himalaya
    # under a low sun, coasts and noise between texels, without most of the haze. Places of the map
    # are accurate to a metre in single precision: a pixel of a coast may change, not one of a
    # hundred.
    solution = solved(load_planet("earth"), (680.0, 550.0, 440.0), "preview")
    pictures = GpuRenderer(device)
    pictures.set_solution(solution)
    camera = Camera(width=96, height=54, look_zenith=150.0, field_of_view=60.0, dehaze=0.9)
    for latitude, longitude, zenith in ((29.0, 86.0, 76.0), (43.5, 13.0, 50.0)):
        scene = Scene(
            camera=camera, altitude=4e5, sun_zenith=zenith, latitude=latitude,
            longitude=longitude, sun_azimuth=135.0, ground="detailed",
        )  # fmt: skip
        wanted, got = render(solution, scene).rgb, pictures.render(scene).rgb
        off = np.abs(got - wanted) / wanted
        assert np.quantile(off, 0.99) < 2e-3
        assert np.median(off) < 2e-4


def test_craters_are_those_of_the_cpu(
    device: Device, solved: Callable[..., MomentsSolution]
) -> None:
    # The cpu in double precision is the second method, over the Moon from 30 km. At the rim of a
    # crater, whose slope is turned round there, a pixel in fifty may differ.
    solution = solved(load_planet("moon"), (680.0, 550.0, 440.0), "preview")
    pictures = GpuRenderer(device)
    pictures.set_solution(solution)
    camera = Camera(width=96, height=54, look_zenith=130.0, field_of_view=60.0)
    scene = Scene(
        camera=camera, altitude=3e4, sun_zenith=70.0, latitude=-20.0, longitude=-10.0,
        ground="detailed",
    )  # fmt: skip
    wanted, got = render(solution, scene).rgb, pictures.render(scene).rgb
    assert np.std(wanted[30]) > 0.05 * wanted[30].mean()
    off = np.abs(got - wanted) / wanted
    assert np.quantile(off, 0.98) < 1e-2
    assert np.median(off) < 2e-4

"""The sea of a GPU: resolved waves and what they mirror."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from airlight import Camera, Scene, load_planet, solve
from airlight.geometry.vectors import Vec3
from airlight.render import render
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.scene.ground_detail import finest_cell, lattice_origin
from airlight.scene.sea_waves import sea_slopes

NM = (680.0, 550.0, 440.0)


def test_waves_near_the_observer_are_those_of_the_cpu(on_gpu: Callable[..., Any]) -> None:
    # The same formula in single precision: phases to 1e-3 of a turn.
    up = np.array([0.36, -0.48, 0.8])
    cell, count = float(np.float32(finest_cell(6.36e6, 2700.0))), 64
    whole, part = np.array([lattice_origin(float(one), 6.36e6, cell) for one in up]).T
    part = part.astype(np.float32).astype(float)
    east = np.array([0.8, 0.6, 0.0])
    north = np.cross(up, east)
    random = np.random.default_rng(2)
    spread = random.uniform(-40.0, 40.0, (count, 2)).astype(np.float32)
    places = (spread @ np.array([east, north])).astype(np.float32).astype(float)
    footprint = random.uniform(0.01, 1.0, count).astype(np.float32).astype(float)
    same = np.ones(count)

    def vector(one: NDArray[np.float64]) -> Vec3:
        return Vec3(*(part * same for part in one))

    wanted = np.array([
        sea_slopes(Vec3(*place), Vec3(*east), Vec3(*north), foot, 6.0, cell, Vec3(*whole),
                   Vec3(*part))
        for place, foot in zip(places, footprint, strict=True)
    ])  # fmt: skip
    seen = on_gpu(
        sea_slopes, Vec3(*places.T), vector(east), vector(north), footprint, 6.0 * same,
        cell * same, vector(whole), vector(part),
    )  # fmt: skip
    assert_allclose(np.stack(seen, axis=-1), wanted, atol=5e-3)


def test_the_sea_of_a_device_is_that_of_the_cpu(device: Device) -> None:
    # Two compilers for the same pixels; single precision moves a wave by a thousandth of a turn.
    sea = {"ground.law": "water", "ground.wind": "6 m/s", "ground.albedo": 0.02}
    solution = solve(load_planet("earth-atmosphere-plus", sea), NM, "preview")
    camera = Camera(width=64, height=36, field_of_view=40.0, look_zenith=110.0)
    pictures = GpuRenderer(device, (64, 64))
    pictures.set_solution(solution)
    for altitude, sun in ((40.0, 60.0), (400e3, 50.0)):
        scene = Scene(altitude=altitude, sun_zenith=sun, camera=camera)
        seen, wanted = pictures.render(scene).rgb, render(solution, scene, exact=True).rgb
        assert np.quantile(np.abs(seen - wanted) / wanted.max(axis=(0, 1)), 0.99) < 0.02

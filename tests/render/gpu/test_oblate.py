"""Oblate planets on the GPU against the CPU, which marches with the same functions."""

from __future__ import annotations

import numpy as np

import airlight
from airlight import Camera, Scene, load_planet, replace
from airlight.planets.rings import Ring
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer

NM = (440.0, 500.0, 560.0, 620.0)


def test_an_oblate_planet_with_rings_is_that_of_the_cpu(device: Device) -> None:
    # Single precision, and other points of the march, as in test_rings
    ring = Ring(inner_radius=8.2e6, outer_radius=13e6, optical_depth=0.6)
    planet = replace(load_planet("earth-atmosphere-plus"), rings=(ring,), flattening=0.098)
    solution = airlight.solve(planet, NM, quality="preview")
    camera = Camera(width=48, height=32, field_of_view=28.0, look_zenith=180.0)
    scene = Scene(
        altitude=6e7, latitude=25.0, sun_zenith=60.0, sun_azimuth=120.0, camera=camera
    ).north_up()
    reference = CpuRenderer(solution, scene, edges=False)
    reference._view = reference._view._replace(shines=0)
    wanted = np.zeros((32, 48, 3), np.float32)
    reference.render_rows(0, 32, wanted)
    renderer = GpuRenderer(device)
    renderer.set_solution(solution)
    rgb = renderer.render(scene).rgb
    error = np.abs(rgb - wanted).max(axis=2) / np.quantile(wanted, 0.99)
    assert np.isfinite(rgb).all()
    assert np.quantile(error, 0.9) < 0.01
    assert (error > 0.05).mean() < 0.03
    assert (wanted.max(axis=2) > 0.0).mean() > 0.3

"""A cloud deck's map on the GPU against the CPU."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import airlight
from airlight import Camera, Scene, load_planet, replace
from airlight.planets import Ground
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer

NM = (440.0, 500.0, 560.0, 620.0)


def test_a_deck_is_that_of_the_cpu(device: Device, tmp_path: Path) -> None:
    # Single precision, and other points of the march: 1 %, as of pictures without a deck. Stripes
    # and colours of the map change the light by factors.
    stripes = np.full((32, 64, 3), 60, np.uint8)
    stripes[::4, :, 0], stripes[:, ::8, 2] = 200, 230
    Image.fromarray(stripes).save(tmp_path / "stripes.png")
    planet = load_planet("earth-atmosphere-plus")
    ground = Ground(albedo=0.3, deck=str(tmp_path / "stripes.png"))
    solution = airlight.solve(replace(planet, ground=ground), NM, quality="preview")
    camera = Camera(width=48, height=32, field_of_view=30.0, look_zenith=180.0)
    scene = Scene(
        altitude=2e7, latitude=25.0, sun_zenith=40.0, sun_azimuth=120.0, camera=camera
    ).north_up()
    wanted = np.zeros((32, 48, 3), np.float32)
    CpuRenderer(solution, scene, edges=False).render_rows(0, 32, wanted)
    renderer = GpuRenderer(device)
    renderer.set_solution(solution)
    rgb = renderer.render(scene).rgb
    error = np.abs(rgb - wanted).max(axis=2) / np.quantile(wanted, 0.99)
    assert np.isfinite(rgb).all()
    assert np.quantile(error, 0.95) < 0.01
    assert np.quantile(wanted[12:20, 18:30, 2], 0.9) > 1.5 * wanted[12:20, 18:30, 2].min()

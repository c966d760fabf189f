"""Layered air that bends light, drawn by a device: the points of its marches, and their loops."""

from __future__ import annotations

import numpy as np
import pytest
from marched_pictures import marched

from airlight import Camera, Scene, load_planet, solve
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import read_texture
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
from airlight.render.gpu.picture.uniforms import LAYERS
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 500.0, 560.0, 620.0)
CAMERA = Camera(width=64, height=36, look_zenith=95.0, look_azimuth=-20.0)


@pytest.fixture(scope="module")
def solution() -> MomentsSolution:
    """Standard atmosphere at the quality whose shaders have the longest loops that are usual."""
    solved = solve(load_planet("earth"), NM, "default", cache=False)
    assert isinstance(solved, MomentsSolution)
    return solved


@pytest.mark.parametrize(
    ("altitude", "sun"),
    [(35e3, 80.0), pytest.param(200.0, 90.0, marks=pytest.mark.validation)],
)
def test_a_marched_picture_has_the_cpu_s_radiance(
    altitude: float, sun: float, solution: MomentsSolution, device: Device
) -> None:
    # 1 % as for the presets, pictures without the disc's rim: single precision and other points.
    # From 35 km lines at the horizon have most panels: with 20 points in each Mesa ended their
    # loops at 65 535 turns, and they were half as bright.
    scene = Scene(altitude=altitude, sun_zenith=sun, camera=CAMERA)
    pictures = GpuRenderer(device, (64, 64))
    pictures.set_solution(solution)
    wanted = marched(solution, scene, device)
    rgb = pictures.render(scene, exact=True).rgb
    bright = wanted.max(axis=2) + 1e-4 * np.quantile(wanted, 0.99)
    error = np.abs(rgb - wanted).max(axis=2) / bright
    near = np.arccos(np.clip(CAMERA.directions() @ scene.sun_direction, -1.0, 1.0)) < 0.04
    assert error[~near].max() < 0.01


@pytest.mark.validation
def test_the_shader_fills_the_table_as_the_cpu_does(
    solution: MomentsSolution, device: Device
) -> None:
    # Two marches of the same light with other points, one in single precision: as of one
    # exponential, 99 of 100 fourth roots agree to a quarter of 1 %.
    layers = []
    for by_cpu in (True, False):
        pictures = GpuRenderer(device, (64, 32), sky_view_on_cpu=by_cpu)
        pictures.set_solution(solution)
        pictures.render(Scene(altitude=200.0, sun_zenith=66.0, camera=CAMERA))
        sky = pictures._sky_views[0].layers
        layers.append([read_texture(device, sky[name]) for name in LAYERS[:4]])
    for cpu, shader in zip(*layers, strict=True):
        scale = cpu.max()
        error = np.abs(shader - cpu) / np.maximum(cpu, 1e-3 * scale)
        assert scale > 0.0
        assert np.quantile(error, 0.99) < 0.0025

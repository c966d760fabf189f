"""One frame from a solution that is there already.

Bar: 1280 x 720 of Earth from 400 km, 16 wavelengths, default quality, within 3 s on two cores.

Run with ``pytest benchmarks/bench_frame.py``; ``AIRLIGHT_THREADS=1`` gives the work of one core.
"""

from __future__ import annotations

from typing import Any

import pytest

from airlight import Camera, Scene, load_planet, render, solve
from airlight.color.spectral import default_wavelengths

SIZES = {
    "640x360": Camera(width=640, height=360, look_zenith=110.0, look_azimuth=-75.0),
    "1280x720": Camera(width=1280, height=720, look_zenith=110.0, look_azimuth=-75.0),
    "fisheye": Camera(projection="fisheye", width=1024, height=1024, look_zenith=180.0),
    "equirectangular": Camera(projection="equirectangular", width=1024, height=512),
    "cubemap": Camera(projection="cubemap", width=6 * 256, height=256),
}


@pytest.fixture(scope="module")
def solution() -> Any:
    planet = load_planet("earth")
    return solve(planet, default_wavelengths(16, *planet.wavelength_limits))


@pytest.mark.parametrize("name", SIZES)
@pytest.mark.parametrize("altitude", [2.0, 400e3])
def test_frame(benchmark: Any, solution: Any, name: str, altitude: float) -> None:
    scene = Scene(camera=SIZES[name], altitude=altitude, sun_zenith=60.0)
    render(solution, Scene(camera=Camera(width=8, height=8)))  # compiles
    benchmark.pedantic(render, (solution, scene), rounds=3)

"""One frame from a solution that is there already, by size and by projection.

Bar: 1280 x 720 of Earth from 400 km, 16 wavelengths, default quality, within 0.4 s on two quiet
cores, the sky-view LUT included; marched exactly within 3 s.

Run with ``pytest benchmarks/bench_frame.py``; ``AIRLIGHT_THREADS=1`` gives the work of one core.
"""

from __future__ import annotations

from typing import Any

import pytest

from airlight import Camera, Scene, render, solve
from airlight.image.spectral import default_wavelengths

LOOK: dict[str, Any] = {"look_zenith": 110.0, "look_azimuth": -75.0}
SIZES = [(320, 180), (640, 360), (1280, 720)]
#: All of half a million pixels or nearly so.
PROJECTIONS = {
    "perspective": Camera(width=960, height=540, **LOOK),
    "fisheye": Camera(projection="fisheye", width=720, height=720, look_zenith=180.0),
    "equirectangular": Camera(projection="equirectangular", width=1024, height=512),
    "cubemap": Camera(projection="cubemap", width=6 * 296, height=296),
}


@pytest.fixture(scope="module")
def solution(earth: Any) -> Any:
    done = solve(earth, default_wavelengths(16, *earth.wavelength_limits), cache=False)
    for exact in (False, True):
        render(done, Scene(camera=Camera(width=320, height=180)), exact=exact)  # compiles
    return done


@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
@pytest.mark.parametrize("altitude", [2.0, 400e3])
@pytest.mark.benchmark(group="frame by size, 16 wavelengths")
def test_size(benchmark: Any, solution: Any, size: tuple[int, int], altitude: float) -> None:
    camera = Camera(width=size[0], height=size[1], **LOOK)
    scene = Scene(camera=camera, altitude=altitude, sun_zenith=60.0)
    benchmark.pedantic(render, (solution, scene), rounds=3)


@pytest.mark.benchmark(group="frame by size, 16 wavelengths")
def test_exact(benchmark: Any, solution: Any) -> None:
    camera = Camera(width=1280, height=720, **LOOK)
    scene = Scene(camera=camera, altitude=400e3, sun_zenith=60.0)
    benchmark.pedantic(render, (solution, scene), {"exact": True}, rounds=3)


@pytest.mark.parametrize("name", PROJECTIONS)
@pytest.mark.parametrize("altitude", [2.0, 400e3])
@pytest.mark.benchmark(group="frame by projection, 16 wavelengths")
def test_projection(benchmark: Any, solution: Any, name: str, altitude: float) -> None:
    scene = Scene(camera=PROJECTIONS[name], altitude=altitude, sun_zenith=60.0)
    benchmark.pedantic(render, (solution, scene), rounds=3)


@pytest.mark.benchmark(group="frame, three wavelengths")
def test_three_wavelengths(benchmark: Any, rgb_solution: Any) -> None:
    camera = Camera(width=1280, height=720, **LOOK)
    scene = Scene(camera=camera, altitude=400e3, sun_zenith=60.0)
    render(rgb_solution, scene)  # compiles
    benchmark.pedantic(render, (rgb_solution, scene), rounds=3)

"""The moments solver on the GPU: whole edits, the host's part, and each pass.

An edit is a new coefficient: the medium is there, its light is wanted. What the host does of it
(grid, rays, tables) and what the device does (the passes) are told apart in the section
"measured"; each pass is timed by the device's own clock.

Run with ``pytest benchmarks/bench_gpu_solve.py``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from airlight import load_planet
from airlight.planets.medium import Medium
from airlight.render.gpu.device.device import NoDevice, open_device
from airlight.render.gpu.device.pass_times import PassTimes
from airlight.render.gpu.solver.gpu_iteration import pooled_iteration
from airlight.render.gpu.solver.passes import MIX, ONCE, PACK, SWEEP
from airlight.render.gpu.solver.planning import plan_for
from airlight.render.gpu.solver.solver import solve_on
from airlight.solver.moments.settings import settings_for
from airlight.solver.refracted_geometry import RefractedGeometry

NM = (450.0, 530.0, 600.0, 680.0)
CASES = [("earth", "preview"), ("earth", "default")]


@pytest.fixture(scope="module")
def device() -> Any:
    try:
        return open_device()
    except NoDevice as reason:
        pytest.skip(str(reason))


@pytest.mark.parametrize(("planet", "quality"), CASES)
@pytest.mark.benchmark(group="solve on the GPU")
def test_edit(benchmark: Any, device: Any, planet: str, quality: str) -> None:
    medium = Medium.from_planet(load_planet(planet), NM)
    settings = settings_for(quality)
    solve_on(device, medium, settings)  # compiles
    benchmark.pedantic(solve_on, (device, medium, settings), rounds=3)


@pytest.mark.parametrize(("planet", "quality"), CASES)
@pytest.mark.benchmark(group="the host's part of a solve on the GPU")
def test_host(benchmark: Any, planet: str, quality: str) -> None:
    geometry = RefractedGeometry.of(Medium.from_planet(load_planet(planet), NM))
    settings = settings_for(quality)
    plan_for(geometry, settings)  # compiles, and keeps the columns of these profiles
    benchmark.pedantic(plan_for, (geometry, settings), rounds=5)


@pytest.mark.parametrize(("planet", "quality"), CASES)
@pytest.mark.benchmark(group="one order on the GPU")
def test_passes(
    benchmark: Any, device: Any, tell: Callable[[str], None], planet: str, quality: str
) -> None:
    geometry = RefractedGeometry.of(Medium.from_planet(load_planet(planet), NM))
    seconds: dict[str, float] = {}
    with pooled_iteration(device) as sweeper:
        sweeper.load(plan_for(geometry, settings_for(quality)))
        sweeper.begin()
        benchmark.pedantic(lambda: (sweeper.sweep(), sweeper.reduce()), rounds=3, warmup_rounds=1)
        if not device.measures_time:
            pytest.skip(f"{device} has no clocks for passes")
        times = PassTimes(device)
        for passes in (ONCE, PACK, SWEEP, MIX):
            sweeper.run(passes, times=times)
            seconds |= {f"{name} {1e3 * one:.1f}": one for name, one in times.read().items()}
    whole = 1e3 * sum(seconds.values())
    tell(f"{planet}, {quality}, on {device}: {whole:.1f} ms by its clocks: {', '.join(seconds)}")

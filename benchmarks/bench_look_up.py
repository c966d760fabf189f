"""Look-ups in baked tables, and lines of sight through a solution, each second.

Run with ``pytest benchmarks/bench_look_up.py``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from airlight.engines.baking.bake import bake

COUNT = 1 << 19
LINES = 1 << 16


def tell_rate(benchmark: Any, tell: Callable[[str], None], what: str, count: int) -> None:
    if benchmark.stats is None:  # --benchmark-disable
        return
    rate = count / benchmark.stats.stats.median
    benchmark.extra_info["per second"] = rate
    tell(f"{what}: {rate / 1e6:.3g} million/s")


@pytest.fixture(scope="module")
def tables(rgb_solution: Any) -> Any:
    # the usual mu, mu_s and nu; fewer radii, so that it is baked in seconds
    return bake(rgb_solution, size=(8, 64, 32, 8), points=64).tables


@pytest.mark.parametrize("name", ["scattering", "transmittance", "irradiance"])
@pytest.mark.benchmark(group="Table.look_up")
def test_table(benchmark: Any, tables: Any, name: str, tell: Callable[[str], None]) -> None:
    table = tables[name]
    shell = table.layout
    rng = np.random.default_rng(3)
    r = shell.bottom_radius + (shell.top_radius - shell.bottom_radius) * rng.random(COUNT) ** 2
    mu, mu_s = rng.uniform(-1.0, 1.0, COUNT), rng.uniform(-0.2, 1.0, COUNT)
    around = np.cos(rng.uniform(0.0, np.pi, COUNT))
    nu = np.clip(mu * mu_s + np.sqrt((1 - mu**2) * (1 - mu_s**2)) * around, -1.0, 1.0)
    table.look_up(r[:9], mu[:9], mu_s[:9], nu[:9])  # compiles
    benchmark.pedantic(table.look_up, (r, mu, mu_s, nu), rounds=5)
    shape = " x ".join(str(n) for n in table.layout.shape)
    tell_rate(benchmark, tell, f"look-ups, {name}, {shape}, 3 channels", COUNT)


@pytest.mark.parametrize("altitude", [0.0, 10e3, 400e3])
@pytest.mark.benchmark(group="Solution.radiance, moments")
def test_lines_of_sight(
    benchmark: Any, rgb_solution: Any, altitude: float, tell: Callable[[str], None]
) -> None:
    rng = np.random.default_rng(4)
    lowest = 90.0 if altitude < 1.0 else 180.0
    view = rng.uniform(110.0 if altitude > 1e5 else 0.0, lowest, LINES)
    around = rng.uniform(0.0, 180.0, LINES)
    given = {"altitude": altitude, "sun_zenith": 60.0, "view_zenith": view, "azimuth": around}
    rgb_solution.radiance(**{**given, "view_zenith": view[:9], "azimuth": around[:9]})  # compiles
    benchmark.pedantic(rgb_solution.radiance, (), given, rounds=3)
    tell_rate(benchmark, tell, f"lines of sight, 3 wavelengths, from {altitude:g} m", LINES)

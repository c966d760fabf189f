"""Solving Earth's air, compiled code at hand, nothing from the cache.

Bar, on two cores: three wavelengths at default quality within 0.5 s, at preview within 0.1 s;
16 wavelengths at default quality within 3 s. Fine has no bar.

Run with ``pytest benchmarks/bench_solve.py``.
"""

from __future__ import annotations

from typing import Any

import pytest

from airlight import load_planet, solve
from airlight.color.spectral import default_wavelengths

RGB = (680.0, 550.0, 440.0)


@pytest.mark.parametrize("quality", ["preview", "default", "fine"])
def test_three_wavelengths(benchmark: Any, quality: str) -> None:
    planet = load_planet("earth")
    solve(planet, RGB, "preview", cache=False)  # compiles
    benchmark.pedantic(solve, (planet, RGB, quality), {"cache": False}, rounds=3)


def test_sixteen_wavelengths(benchmark: Any) -> None:
    planet = load_planet("earth")
    nm = default_wavelengths(16, *planet.wavelength_limits)
    solve(planet, RGB, "preview", cache=False)  # compiles
    benchmark.pedantic(solve, (planet, nm), {"cache": False}, rounds=3)

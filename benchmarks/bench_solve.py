"""Solving, compiled code at hand, nothing from the cache.

Target, on two cores: three wavelengths at default quality within 0.5 s, at preview within 0.1 s;
16 wavelengths at default quality within 3 s. Fine has no bar.

Run with ``pytest benchmarks/bench_solve.py``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from airlight import solve
from airlight.image.spectral import default_wavelengths
from airlight.planets import Constituent
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential, Tent
from airlight.solver.montecarlo.settings import MonteCarloSettings as MonteCarloSettings

RGB = (680.0, 550.0, 440.0)

#: Two more than Earth has: an absorber in a layer and coarse dust.
MORE = (
    Constituent(
        name="layer", profile=Tent(center=30e3, half_width=10e3), absorption=2e-7
    ),
    Constituent(
        name="dust", profile=Exponential(scale_height=3000.0), scattering=2e-6, absorption=2e-7,
        phase_function=HenyeyGreenstein(asymmetry=0.7),
    ),
)  # fmt: skip


@pytest.mark.parametrize(
    "quality", ["preview", "default", pytest.param("fine", marks=pytest.mark.slow)]
)
@pytest.mark.benchmark(group="solve by quality")
def test_quality(benchmark: Any, earth: Any, quality: str) -> None:
    solve(earth, RGB, "preview", cache=False)  # compiles
    rounds = 1 if quality == "fine" else 5
    benchmark.pedantic(solve, (earth, RGB, quality), {"cache": False}, rounds=rounds)


@pytest.mark.parametrize("count", [1, 3, 8, 16, 40])
@pytest.mark.benchmark(group="solve by number of wavelengths")
def test_wavelengths(benchmark: Any, earth: Any, count: int) -> None:
    nm = default_wavelengths(count, *earth.wavelength_limits) if count > 1 else (550.0,)
    solve(earth, RGB, "preview", cache=False)  # compiles
    benchmark.pedantic(solve, (earth, nm), {"cache": False}, rounds=3)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5])
@pytest.mark.benchmark(group="solve by number of constituents")
def test_constituents(benchmark: Any, earth: Any, count: int) -> None:
    # air; and aerosol; and ozone; and a layer of absorber; and dust
    planet = replace(earth, constituents=(*earth.constituents, *MORE)[:count])
    solve(planet, RGB, "preview", cache=False)  # compiles
    benchmark.pedantic(solve, (planet, RGB), {"cache": False}, rounds=3)


@pytest.mark.parametrize("quality", ["preview", pytest.param("default", marks=pytest.mark.slow)])
@pytest.mark.benchmark(group="direct solver")
def test_direct(benchmark: Any, earth: Any, quality: str) -> None:
    solve(earth, RGB, "preview", solver="direct", cache=False)  # compiles
    rounds = 1 if quality == "default" else 3
    benchmark.pedantic(
        solve, (earth, RGB, quality), {"solver": "direct", "cache": False}, rounds=rounds
    )


@pytest.mark.parametrize("sun", [30.0, 92.0])
@pytest.mark.benchmark(group="Monte Carlo")
def test_monte_carlo(benchmark: Any, earth: Any, sun: float, tell: Callable[[str], None]) -> None:
    settings = MonteCarloSettings(relative_error=0.005, most_histories=200_000)
    solution = solve(earth, RGB, settings, solver="montecarlo")
    sight, _ = solution.lines_of_sight(
        altitude=0.0, sun_zenith=sun, view_zenith=[0.0, 60.0], azimuth=90.0
    )
    solution.trace(sight)  # compiles
    benchmark.pedantic(solution.trace, (sight,), rounds=3)
    report = solution.report
    rate = report.histories / report.seconds
    benchmark.extra_info["histories per second"] = rate
    tell(
        f"Monte Carlo, sun {sun:g} deg: {rate:.3g} histories/s, {report.histories:.3g} histories, "
        f"largest standard error {max(report.residual):.2%}"
    )

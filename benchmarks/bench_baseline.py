"""airlight against the classic computations in plain C and NumPy: ratios of one run, one core.

Every contender gets the same input. They take turns, round by round, so that what else the
machine does slows all of them; a ratio is the median of the rounds' ratios. Beside each stands its
error, against quadratures that have converged: a faster number with a larger error is no gain.

Run with ``pytest benchmarks/bench_baseline.py``.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np
import pytest

from airlight.solver.tables.columns import columns
from baseline import checks, compiled, plain, work

ROUNDS = 5


@pytest.fixture(scope="module")
def c(tmp_path_factory: pytest.TempPathFactory) -> compiled.Classic:
    if compiled.compiler() is None:
        pytest.skip("no C compiler: there is no cc, and CC names none")
    classic = compiled.Classic(tmp_path_factory.mktemp("classic"))
    for one in (classic, plain):  # what gives wrong numbers is not timed
        checks.columns_are_golden(one)
        checks.look_ups_are_the_tables(one)
        checks.gathers_are_exact_in_even_light(one)
    return classic


@pytest.fixture(autouse=True)
def one_core(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "1")


def seconds(run: Callable[[], object]) -> float:
    started = perf_counter()
    run()
    return perf_counter() - started


def contest(
    title: str,
    contenders: dict[str, tuple[Callable[[], object], int, str]],
    tell: Callable[[str], None],
) -> dict[str, float]:
    """Times contenders in turns; the first is what the others' speeds are ratios to.

    A contender is what to run, over how many items, and its error in words. Gives the ratios.
    """
    for run, _, _ in contenders.values():
        run()  # compiles, and warms the caches
    times = np.array(
        [[seconds(run) / items for run, items, _ in contenders.values()] for _ in range(ROUNDS)]
    )
    ratios = np.median(times[:, :1] / times, axis=0)
    tell(f"{title}; time of one, speed relative to the first, error")
    for (name, (_, _, error)), one, ratio in zip(
        contenders.items(), np.median(times, axis=0), ratios, strict=True
    ):
        tell(f"    {name:44s} {1e6 * one:12.4g} us  x {ratio:<8.3g} {error}")
    return dict(zip(contenders, ratios.tolist(), strict=True))


@pytest.mark.benchmark(group="against the baseline")
def test_columns(benchmark: Any, c: compiled.Classic, tell: Callable[[str], None]) -> None:
    medium, (r, mu, length) = work.whole_air(), work.rays(10_000)
    by_rule = partial(columns, r, mu, length, work.BOTTOM, medium.density)
    true = np.exp(-by_rule(nodes=48, panels=12) @ medium.extinction)
    worst = {}

    def contender(name: str, run: Callable[[], Any]) -> tuple[str, tuple[Any, int, str]]:
        off = np.abs(np.exp(-run() @ medium.extinction) - true).max(axis=1)
        worst[name] = off.max()
        error = f"of transmittance: median {np.median(off):.1e}, worst {off.max():.1e}"
        return name, (run, r.size, error)

    contenders = dict(
        [
            contender("C, 500 steps", lambda: c.columns(r, mu, length, work.AIR, 500)),
            contender("C, 30 steps", lambda: c.columns(r, mu, length, work.AIR, 30)),
            contender("NumPy, 500 steps", lambda: plain.columns(r, mu, length, work.AIR, 500)),
            contender("airlight, 8 points a leg", partial(by_rule, nodes=8, panels=1)),
            contender("airlight, 6 panels of 24 a leg (usual)", by_rule),
        ]
    )
    benchmark.extra_info["ratios"] = contest("columns along a ray", contenders, tell)
    assert worst["airlight, 8 points a leg"] < worst["C, 500 steps"]
    benchmark.pedantic(partial(by_rule, nodes=8, panels=1), rounds=3)


@pytest.mark.benchmark(group="against the baseline")
def test_look_up(benchmark: Any, c: compiled.Classic, tell: Callable[[str], None]) -> None:
    table, where = work.first_order(), work.positions(200_000)
    grid = table.layout.grid
    read = partial(table.look_up, where.r, where.mu, where.mu_s, where.nu)
    expected = read()

    def contender(name: str, run: Callable[[], Any]) -> tuple[str, tuple[Any, int, str]]:
        off = np.abs(run() - expected).max() / expected.max()
        return name, (run, len(where), f"difference to airlight's: {off:.0e} of the largest")

    contenders = dict(
        [
            contender("C", lambda: c.look_up(table.values, where, grid)),
            contender("NumPy", lambda: plain.look_up(table.values, where, grid)),
            contender("airlight, Table.look_up", read),
        ]
    )
    benchmark.extra_info["ratios"] = contest("look-up of three channels", contenders, tell)
    benchmark.pedantic(read, rounds=3)


@pytest.mark.benchmark(group="against the baseline")
def test_one_order(benchmark: Any, c: compiled.Classic, tell: Callable[[str], None]) -> None:
    # A gather gives one texel of one order; a sweep gives one order of the whole planet. What is
    # compared is an order of the planet: a gather times the texels of the table. The look-ups
    # that integrate a gathered order along lines of sight come on top and are left out.
    table, some, few = work.first_order(), work.positions(400, lit_air=True), work.positions(40)
    grid, medium = table.layout.grid, work.whole_air()
    given = (grid, medium.scattering[0], work.AIR[1], work.DIRECTIONS)
    judged = some[:48]
    off = np.abs(c.gather(table.values, judged, *given) / work.true_gather(judged) - 1.0)
    error = f"of order 2 gathered, below 20 km: median {np.median(off):.1%}, worst {off.max():.0%}"
    texels = int(np.prod(work.FULL_SIZE))

    default, fine = work.solved(), work.solved("fine")
    rng = np.random.default_rng(6)
    sight, _ = default.lines_of_sight(
        altitude=20e3 * rng.random(2000) ** 2, sun_zenith=rng.uniform(0.0, 84.0, 2000),
        view_zenith=rng.uniform(0.0, 180.0, 2000), azimuth=rng.uniform(0.0, 180.0, 2000),
    )  # fmt: skip
    more, truth = (
        one.relative_radiance(sight) - one.relative_radiance(sight, order=1)
        for one in (default, fine)
    )
    own = np.abs(more / truth - 1.0)[truth > 1e-6]
    own_error = (
        f"of all orders from 2 on along lines of sight, to fine: median {np.median(own):.2%}, "
        f"worst {own.max():.1%}"
    )

    contenders = {
        "C, a texel of 512 directions": (
            lambda: c.gather(table.values, some, *given), len(some), error,
        ),
        "NumPy, the same": (
            lambda: plain.gather(table.values, few, *given), len(few), "the same as C",
        ),
        "airlight, a whole solve / sweeps / texels": (
            work.solved, default.report.sweeps * texels, own_error,
        ),
    }  # fmt: skip
    title = f"one order of scattering, gas alone, per texel of {texels:,}"
    benchmark.extra_info["ratios"] = contest(title, contenders, tell)
    benchmark.pedantic(work.solved, rounds=3)

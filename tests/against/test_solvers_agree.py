"""Moments, direct and Monte Carlo: three methods that share no approximation, held together."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from airlight.solvers.montecarlo.settings import Settings as MonteCarloSettings
from airlight.validation.agreement import agreements, answers
from airlight.validation.cases import CASES, WAVELENGTHS
from airlight.validation.metrics import summarise

SOLVERS = (
    ("moments", "fine"),
    ("direct", "fine"),
    ("montecarlo", MonteCarloSettings(relative_error=0.006, most_histories=500_000)),
)
#: So many of the 60 lines of sight must agree at all wavelengths in all pairs; the bar is 40.
LEAST_LINES = 50
#: What no value may differ by, beyond three standard errors: the direct solver's table in twilight.
LARGEST = 0.03


@pytest.mark.slow
@pytest.mark.parametrize("planet", ["earth-atmosphere-plus", "mars-standard"])
def test_three_solvers_agree_from_ground_to_space(planet: str, tell: Callable[[str], None]) -> None:
    # Three independent methods; two values agree within 1 % or within three standard errors.
    given = answers(planet, SOLVERS)
    pairs = agreements(given)
    tell(f"{planet}: radiance per irradiance at 550 nm [sr⁻¹], and differences at all three [%]")
    tell(f"{'line of sight':48s} {'moments':>10s} {'direct':>10s} {'Monte Carlo':>19s}   "
         + "   ".join(f"{pair.name:>20s}" for pair in pairs))  # fmt: skip
    green = WAVELENGTHS.index(550.0)
    for n, case in enumerate(CASES):
        values = [one.radiance[n, green] for one in given]
        noise = given[2].standard_error[n, green]
        shown = "   ".join(
            " ".join(f"{100 * x:+6.2f}" for x in pair.relative[n])
            + ("!" if pair.disagree[n].any() else " ")
            for pair in pairs
        )
        tell(f"{case!s:48s} {values[0]:10.3e} {values[1]:10.3e} {values[2]:10.3e} ±{noise:.0e}   "
             f"{shown}")  # fmt: skip
    for one in given:
        tell(f"{planet}: {one.solver} took {one.seconds:.0f} s")
    agreeing = np.ones(len(CASES), dtype=bool)
    for pair in pairs:
        s = summarise(pair.relative, pair.judged)
        tell(
            f"{planet}, {pair.name}: {s.count} values, median {100 * s.median:.2f} %, 95 % "
            f"{100 * s.high:.2f} %, largest {100 * s.largest:.2f} %; "
            f"{int(pair.disagree.sum())} disagree"
        )
        agreeing &= pair.judged.any(axis=1) & ~pair.disagree.any(axis=1)
        assert (np.abs(pair.relative[pair.disagree]) < LARGEST).all()
    tell(f"{planet}: {int(agreeing.sum())} of {len(CASES)} lines of sight agree in all pairs")
    assert agreeing.sum() >= LEAST_LINES

"""Moments, direct and Monte Carlo: three methods that share no approximation, held together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from airlight.solver.direct.settings import DirectSettings
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.validation.agreement import Result, agreements, results
from airlight.validation.cases import CASES, WAVELENGTHS
from airlight.validation.metrics import summarise
from airlight.validation.suite import SuiteRun

SOLVERS = (
    ("moments", "fine"),
    ("direct", "fine"),
    ("montecarlo", MonteCarloSettings(relative_error=0.006, most_histories=500_000)),
)
#: Within 0.8 % of the moments on all lines of the check, in a third of the time of ``fine``: what
#: ``default`` errs by in twilight (3.6 %) are its steps of zenith.
DIRECT = DirectSettings(zenith_steps=20, keep_orders=False)
#: So much of the 60 lines of sight must agree at all wavelengths in all pairs; the bar is 40 of 60.
LEAST_LINES = 5 / 6
#: What no value may differ by, beyond three standard errors: the direct solver's table in twilight.
LARGEST = 0.03
EARTH, MARS = "earth-atmosphere-plus", "mars-standard"
#: Wavelengths that the check has, every which line of sight, quality of the moments and their
#: judges: light that a Mars with dust scatters in all orders, and that Earth's air scatters most.
#: The rest takes minutes, the direct solver on Mars and at ``fine`` 80 s a wavelength and moments
#: there at ``fine`` 110 s: it is for ``scripts/test --validation`` and ``airlight validate``.
CHECKED = (
    (MARS, (550.0,), 6, "default", SOLVERS[2:]),
    (EARTH, (440.0,), 6, "default", (("direct", DIRECT), SOLVERS[2])),
)
LATER = pytest.mark.validation

Answered = Callable[..., list[Result]]


@pytest.fixture
def answered(once: Callable[[str, Callable[[], Any]], Any]) -> Answered:
    """Direct and Monte Carlo at a wavelength, which is solved by one worker of a run."""
    return lambda planet, nm, every, judges=SOLVERS[1:]: once(
        f"{planet} at {nm:g} nm, every {every}, {len(judges)}",
        lambda: results(SuiteRun(), planet, judges, cases=CASES[::every], wavelengths=(nm,)),
    )


def joined(parts: Sequence[Result]) -> Result:
    """Answers of a solver at single wavelengths, as one."""
    return replace(
        parts[0],
        radiance=np.hstack([one.radiance for one in parts]),
        standard_error=np.hstack([one.standard_error for one in parts]),
        seconds=sum(one.seconds for one in parts),
    )


@LATER
@pytest.mark.parametrize("planet", [MARS, EARTH])
@pytest.mark.parametrize("nm", WAVELENGTHS)
def test_direct_and_monte_carlo_agree_at_a_wavelength(
    planet: str, nm: float, answered: Answered
) -> None:
    # As below, and the longest part of it, which several workers share.
    (pair,) = agreements(answered(planet, nm, 1))
    assert (np.abs(pair.relative[pair.disagree]) < LARGEST).all()
    assert (pair.judged & ~pair.disagree).sum() >= LEAST_LINES * len(pair.judged)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("planet", "wavelengths", "every", "quality", "judges"),
    [
        *CHECKED,
        *(
            pytest.param(planet, WAVELENGTHS, 1, "fine", SOLVERS[1:], marks=LATER)
            for planet in (MARS, EARTH)
        ),
    ],
)
def test_three_solvers_agree_from_ground_to_space(
    planet: str,
    wavelengths: tuple[float, ...],
    every: int,
    quality: str,
    judges: tuple[tuple[str, Any], ...],
    answered: Answered,
    tell: Callable[[str], None],
) -> None:
    # Three independent methods; two values agree within 1 % or within three standard errors.
    cases = CASES[::every]
    given = results(SuiteRun(), planet, (("moments", quality),), cases, wavelengths)
    apart = (answered(planet, nm, every, judges) for nm in wavelengths)
    given += [joined(parts) for parts in zip(*apart, strict=True)]
    pairs = agreements(given)
    shown_at = 550.0 if 550.0 in wavelengths else wavelengths[0]
    tell(f"{planet}: radiance per irradiance at {shown_at:g} nm, and differences at all [%]")
    names = "".join(f" {one.solver:>10s}" for one in given)
    tell(f"{'line of sight':48s}{names}   " + "   ".join(f"{pair.name:>20s}" for pair in pairs))
    column = wavelengths.index(shown_at)
    for n, case in enumerate(cases):
        values = "".join(f" {one.radiance[n, column]:10.3e}" for one in given)
        noise = given[-1].standard_error[n, column]
        shown = "   ".join(
            " ".join(f"{100 * x:+6.2f}" for x in pair.relative[n])
            + ("!" if pair.disagree[n].any() else " ")
            for pair in pairs
        )
        tell(f"{case!s:48s}{values} ±{noise:.0e}   {shown}")
    for one in given:
        tell(f"{planet}: {one.solver} took {one.seconds:.0f} s")
    agreeing = np.ones(len(cases), dtype=bool)
    for pair in pairs:
        s = summarise(pair.relative, pair.judged)
        tell(
            f"{planet}, {pair.name}: {s.count} values, median {100 * s.median:.2f} %, 95 % "
            f"{100 * s.high:.2f} %, largest {100 * s.largest:.2f} %; "
            f"{int(pair.disagree.sum())} disagree"
        )
        agreeing &= pair.judged.any(axis=1) & ~pair.disagree.any(axis=1)
        assert (np.abs(pair.relative[pair.disagree]) < LARGEST).all()
    tell(f"{planet}: {int(agreeing.sum())} of {len(cases)} lines of sight agree in all pairs")
    assert agreeing.sum() >= LEAST_LINES * len(cases)

"""Agreement of several solvers on the same cases."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from time import perf_counter
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.planets import load_planet
from airlight.solver.montecarlo.settings import MonteCarloSettings as MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.validation.cases import CASES, WAVELENGTHS, Case, geometry
from airlight.validation.metrics import in_standard_errors, relative_errors
from airlight.validation.planets import with_point_star
from airlight.validation.suite import SuiteRun

FloatArray = NDArray[np.float64]

#: Solvers with their qualities; the last is the reference of the others.
SOLVERS: Final[tuple[tuple[str, Any], ...]] = (
    ("moments", "fine"),
    ("direct", "fine"),
    ("montecarlo", MonteCarloSettings(relative_error=0.005, most_histories=1_000_000)),
)
#: Two solvers agree within this relative difference, or within this many standard errors.
TOLERANCE, NOISE = 0.01, 3.0
#: Radiances below this fraction of the star's irradiance are listed, but not assessed. [sr⁻¹]
LEAST_RADIANCE: Final = 1e-6


@dataclass(frozen=True)
class Result:
    """Radiances of one solver for all cases of a planet.

    Attributes
    ----------
    solver, quality : str
        Name and quality of the solver.
    radiance, standard_error : array, shape (cases, wavelengths)
        Value per irradiance of the star; the error is 0 for a method without noise. [sr⁻¹]
    seconds : float
        Wall time. [s]
    """

    solver: str
    quality: str
    radiance: FloatArray
    standard_error: FloatArray
    seconds: float


@dataclass(frozen=True)
class Agreement:
    """Comparison of two results.

    Attributes
    ----------
    first, second : Result
        Results compared; the second is the reference.
    judged : array of bool, shape (cases, wavelengths)
        Whether a value is bright enough for comparison.
    """

    first: Result
    second: Result
    judged: NDArray[np.bool_]

    @property
    def name(self) -> str:
        """Name of the pair, such as ``"moments - montecarlo"``."""
        return f"{self.first.solver} - {self.second.solver}"

    @property
    def relative(self) -> FloatArray:
        """Signed differences over the second's radiance. [1]"""
        return relative_errors(self.first.radiance, self.second.radiance)

    @property
    def noise(self) -> FloatArray:
        """Standard error of the difference. [sr⁻¹]"""
        return np.hypot(self.first.standard_error, self.second.standard_error)

    @property
    def in_errors(self) -> FloatArray:
        """Signed differences in standard errors; infinite between methods without noise. [1]"""
        return in_standard_errors(self.first.radiance, self.second.radiance, self.noise)

    @property
    def disagree(self) -> NDArray[np.bool_]:
        """Judged values that are neither within the tolerance nor within the noise."""
        far = ~(np.abs(self.relative) <= TOLERANCE)
        return self.judged & far & ~(np.abs(self.in_errors) <= NOISE)


def results(
    run: SuiteRun,
    planet_name: str,
    solvers: Sequence[tuple[str, Any]] = SOLVERS,
    cases: Sequence[Case] = CASES,
    wavelengths: Sequence[float] = WAVELENGTHS,
) -> list[Result]:
    """Radiances of all cases by each solver, under a point star.

    Without polarisation, which the direct solver does not support.

    Parameters
    ----------
    run : SuiteRun
    planet_name : str
        Name of a preset, or path of a file.
    solvers : sequence of (str, object)
        Names and qualities, or settings, as ``solve`` takes them.
    wavelengths : sequence of float
        Three by default. [nm]
    """
    planet = with_point_star(load_planet(planet_name))
    out = []
    for done, (name, quality) in enumerate(solvers):
        run.step(done, len(solvers), f"{planet_name}, {name}")
        started = perf_counter()
        solution = run.solve(planet, wavelengths, quality, solver=name, polarisation=False)
        lines, _ = solution.lines_of_sight(**geometry(planet, cases))
        if isinstance(solution, MonteCarloSolution):
            traced = solution.trace(lines)
            radiance, noise = traced.total, traced.total_error
        else:
            radiance = solution.relative_radiance(lines)
            noise = np.zeros_like(radiance)
        words = quality if isinstance(quality, str) else quality.as_text()
        out.append(Result(name, words, radiance, noise, perf_counter() - started))
    return out


def agreements(given: Sequence[Result]) -> list[Agreement]:
    """Comparison of each pair of results where the last, the reference, is bright enough."""
    bright = given[-1].radiance > LEAST_RADIANCE
    return [Agreement(a, b, bright) for a, b in combinations(given, 2)]

"""Moments against vector Monte Carlo on the grid of cases, in air with particles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.threads import Cancel
from airlight.planets import Planet, load_planet
from airlight.solvers import solve
from airlight.solvers.montecarlo.settings import Settings
from airlight.solvers.montecarlo.solution import MonteCarloSolution
from airlight.validation.agreement import LEAST_RADIANCE, NOISE
from airlight.validation.cases import CASES, WAVELENGTHS, Case, geometry
from airlight.validation.finite_disc import with_point_star
from airlight.validation.metrics import beyond_noise, relative_errors, summarise
from airlight.validation.suite import Bar, Part, Progress, ReportTable

FloatArray = NDArray[np.float64]

#: Planets with particles by Mie's theory, or with thick haze.
PLANETS: Final = ("earth", "mars", "venus")
#: Largest share of the values that noise and tolerance do not explain. [%]
ALLOWED: Final = 5.0
#: Tolerances beyond the noise: of I [1], and of Q/I and U/I [1].
TOLERANCE, DEGREE = 0.01, 0.01
#: Cosine of the angle from the star below which a line is in the aureole, whose light is hardly
#: polarised and a matter of the forward peak.
AUREOLE: Final = float(np.cos(np.radians(10.0)))
HISTORIES: Final = Settings(relative_error=0.003, most_histories=1_000_000)


@dataclass(frozen=True)
class Beside:
    """Light of the moments and of histories for the same lines of sight.

    Attributes
    ----------
    ours, scalar : array, shape (n, 3, nl), (n, nl)
        I, Q and U by the moments, and I without polarisation. [sr⁻¹]
    known, error : array, shape (n, 3, nl)
        I, Q and U by histories, and their standard errors. [sr⁻¹]
    nu : array, shape (n,)
        Cosine between line and star. [1]
    """

    ours: FloatArray
    scalar: FloatArray
    known: FloatArray
    error: FloatArray
    nu: FloatArray

    @property
    def judged(self) -> NDArray[np.bool_]:
        """Values outside the aureole, bright enough, and known to 1 %, shape (n, nl)."""
        light = self.known[:, 0]
        sure = (light > LEAST_RADIANCE) & (self.error[:, 0] < 0.01 * light)
        return np.asarray(sure & (self.nu < AUREOLE)[:, None])

    @property
    def relative(self) -> FloatArray:
        """Relative differences of I, shape (n, nl). [1]"""
        return relative_errors(self.ours[:, 0], self.known[:, 0])

    @property
    def degrees(self) -> FloatArray:
        """Differences of Q/I and U/I, shape (n, 2, nl). [1]"""
        ours, known = (
            one[:, 1:] / np.where(one[:, :1] > 0.0, one[:, :1], 1.0)
            for one in (self.ours, self.known)
        )
        return np.asarray(ours - known)

    @property
    def degree_noise(self) -> FloatArray:
        """Standard errors of the histories' Q/I and U/I, shape (n, 2, nl). [1]"""
        light = np.where(self.known[:, :1] > 0.0, self.known[:, :1], 1.0)
        share = self.known[:, 1:] / light
        return np.asarray(np.hypot(self.error[:, 1:], share * self.error[:, :1]) / light)

    @property
    def disagree(self) -> NDArray[np.bool_]:
        """Judged values that neither tolerance nor noise explains, shape (n, nl)."""
        light = beyond_noise(self.ours[:, 0], self.known[:, 0], self.error[:, 0], NOISE)
        far = np.abs(self.degrees) > DEGREE + NOISE * self.degree_noise
        return self.judged & ((np.abs(light) > TOLERANCE) | far.any(axis=1))


def beside(
    planet: Planet, wavelengths: tuple[float, ...] = WAVELENGTHS, quality: Any = "default",
    histories: Settings = HISTORIES, *, cases: tuple[Case, ...] = CASES,
    cancel: Cancel | None = None,
) -> Beside:  # fmt: skip
    """Solve a planet three times: polarised, scalar, and by histories.

    Parameters
    ----------
    planet : Planet
    wavelengths : tuple of float
        Wavelengths. [nm]
    quality : str or Settings
        Quality of the moments solver.
    histories : Settings
        Stopping rule of the histories.
    cases : tuple of Case
        Lines of sight.
    cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    where = geometry(planet, cases)
    vector, scalar = (
        solve(planet, wavelengths, quality, polarisation=one, cache=False, cancel=cancel)
        for one in (True, False)
    )
    judge = solve(planet, wavelengths, histories, solver="montecarlo", cancel=cancel)
    assert isinstance(judge, MonteCarloSolution)
    sight, _ = judge.lines_of_sight(**where)
    got = judge.trace(sight)
    return Beside(
        ours=vector.relative_stokes(sight),
        scalar=scalar.relative_radiance(sight),
        known=np.concatenate([got.total[:, None], got.polarised], axis=1),
        error=np.concatenate([got.total_error[:, None], got.polarised_error], axis=1),
        nu=sight.nu,
    )


def histories(
    *, planets: tuple[str, ...] = PLANETS, cases: tuple[Case, ...] = CASES,
    progress: Progress | None = None, cancel: Cancel | None = None,
) -> tuple[list[Bar], list[Part]]:  # fmt: skip
    """Bars and tables of the comparison.

    Parameters
    ----------
    planets : tuple of str
        Names of presets.
    cases : tuple of Case
        Lines of sight.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    bars, rows = [], []
    for done, name in enumerate(planets):
        if progress is not None:
            progress(done, len(planets), f"{name} by histories")
        found = beside(with_point_star(load_planet(name)), cases=cases, cancel=cancel)
        bars.append(
            Bar(
                name=f"{name}: values that noise, 1 % of I and {DEGREE:g} of the degree do not "
                "explain",
                got=100.0 * float(found.disagree.sum() / max(found.judged.sum(), 1)),
                allowed=ALLOWED, unit="%", source="the aim",
            )
        )  # fmt: skip
        rows.append((name, *summary(found)))
    return bars, [
        ReportTable(
            title="Moments against vector Monte Carlo",
            columns=[
                "planet", "values", "I, median [%]", "95 % [%]", "its noise, median [%]",
                "scalar I, median [%]", "95 % [%]", "Q/I and U/I, median", "95 %",
                "their noise, median", "not explained",
            ],
            rows=rows,
            note=f"{len(cases)} lines of sight from the ground to space, {len(WAVELENGTHS)} "
            f"wavelengths, default quality; {NOISE:g} standard errors count as noise; "
            "lines within 10° of the star are left out.",
        )
    ]  # fmt: skip


def summary(found: Beside) -> tuple[str, ...]:
    """Cells of a planet's row."""
    judged = found.judged
    light = summarise(found.relative, judged)
    scalar = summarise(relative_errors(found.scalar, found.known[:, 0]), judged)
    both = np.stack([judged, judged], axis=1)
    degree = summarise(found.degrees, both)
    noise = np.median((found.error[:, 0] / np.where(judged, found.known[:, 0], 1.0))[judged])
    return (
        f"{judged.sum()}", f"{100 * light.median:.2f}", f"{100 * light.high:.2f}",
        f"{100 * noise:.2f}", f"{100 * scalar.median:.2f}", f"{100 * scalar.high:.2f}",
        f"{degree.median:.4f}", f"{degree.high:.4f}",
        f"{np.median(found.degree_noise[both]):.4f}", f"{found.disagree.sum()}",
    )  # fmt: skip

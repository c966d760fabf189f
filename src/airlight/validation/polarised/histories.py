"""Moments solver against vector Monte Carlo on the cases, for atmospheres with particles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.planets import Planet, load_planet, replace
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.validation.agreement import LEAST_RADIANCE, NOISE
from airlight.validation.cases import CASES, WAVELENGTHS, Case, geometry
from airlight.validation.metrics import beyond_noise, relative_errors, summarise
from airlight.validation.planets import with_point_star
from airlight.validation.suite import Part, ReportTable, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

#: Largest fraction of the values that noise and tolerance do not explain. [%]
ALLOWED: Final = 5.0
#: Tolerances in addition to the noise: of I [1], and of Q/I and U/I [1].
TOLERANCE, DEGREE = 0.01, 0.01
#: Cosine of the angle from the star above which a line is in the aureole, which is hardly polarised
#: and depends on the forward peak.
AUREOLE: Final = float(np.cos(np.radians(10.0)))
HISTORIES: Final = MonteCarloSettings(relative_error=0.003, most_histories=65_536)


@dataclass(frozen=True, kw_only=True)
class PolarisedPlanet:
    """Planet of the polarisation suite, and its Monte Carlo settings.

    Attributes
    ----------
    planet : str
        Name of a preset, with a point star and without refraction.
    histories : MonteCarloSettings
        Stopping rule of the histories.
    level : float
        Altitude that replaces the ground in the cases. [m]
    latest : float
        Largest solar zenith angle at the target point; other cases are omitted. [deg]
    noise : float
        Largest relative standard error of I of compared values. [1]
    why : str
        Reason for omitted cases.
    """

    planet: str
    histories: MonteCarloSettings = HISTORIES
    level: float = 0.0
    latest: float = 180.0
    noise: float = 0.01
    why: str = ""


#: Atmospheres with molecules and a formula's aerosol; with Mie's droplets and soot; dust; thick
#: cloud.
PLANETS: Final = (
    PolarisedPlanet(planet="earth"),
    PolarisedPlanet(planet="earth-hazy"),
    PolarisedPlanet(planet="mars"),
    PolarisedPlanet(
        planet="venus",
        histories=MonteCarloSettings(relative_error=0.02, most_histories=16_384),
        level=70e3,
        latest=60.0,
        noise=0.03,
        why="the cloud's top, 70 km, stands for the ground, and the star is no lower than 30° "
        "there: below it, or with a lower star, histories have thousands of events each",
    ),
)


@dataclass(frozen=True)
class Beside:
    """Stokes parameters of both solvers for the same lines of sight.

    Attributes
    ----------
    ours, scalar : array, shape (n, 3, nl), (n, nl)
        I, Q and U by the moments, and I without polarisation. [sr⁻¹]
    known, error : array, shape (n, 3, nl)
        I, Q and U by histories, and their standard errors. [sr⁻¹]
    nu : array, shape (n,)
        Cosine between line and star. [1]
    noise : float
        Largest relative standard error of I of compared values. [1]
    """

    ours: FloatArray
    scalar: FloatArray
    known: FloatArray
    error: FloatArray
    nu: FloatArray
    noise: float = 0.01

    @property
    def aureole(self) -> NDArray[np.bool_]:
        """Values of lines near the star, shape (n, nl)."""
        near = np.asarray(self.nu >= AUREOLE)[:, None]
        return np.broadcast_to(near, self.known[:, 0].shape)

    @property
    def dark(self) -> NDArray[np.bool_]:
        """Values outside the aureole that are too dark to compare, shape (n, nl)."""
        return np.asarray(~self.aureole & (self.known[:, 0] <= LEAST_RADIANCE))

    @property
    def judged(self) -> NDArray[np.bool_]:
        """Compared values: outside the aureole, bright and accurate enough, shape (n, nl)."""
        sure = self.error[:, 0] < self.noise * self.known[:, 0]
        return np.asarray(sure & ~self.aureole & ~self.dark)

    @property
    def in_errors(self) -> FloatArray:
        """Differences of I, Q and U in the histories' standard errors, shape (n, 3, nl). [1]"""
        noise = np.where(self.error > 0.0, self.error, np.inf)
        return np.asarray((self.ours - self.known) / noise)

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
        """Compared values outside both tolerance and noise, shape (n, nl)."""
        light = beyond_noise(self.ours[:, 0], self.known[:, 0], self.error[:, 0], NOISE)
        far = np.abs(self.degrees) > DEGREE + NOISE * self.degree_noise
        return self.judged & ((np.abs(light) > TOLERANCE) | far.any(axis=1))


def beside(
    run: SuiteRun,
    planet: Planet,
    air: PolarisedPlanet,
    cases: Sequence[Case] = CASES,
    wavelengths: Sequence[float] = WAVELENGTHS,
) -> Beside:
    """Stokes parameters of a planet by the moments solver and by Monte Carlo.

    Parameters
    ----------
    run : SuiteRun
    air : PolarisedPlanet
        Settings of the comparison.
    cases : sequence of Case
        Lines of sight.
    wavelengths : sequence of float
        Wavelengths. [nm]
    """
    where = geometry(planet, cases, air.level)
    vector, scalar = (
        run.solve(planet, wavelengths, "default", polarisation=one) for one in (True, False)
    )
    judge = run.solve(planet, wavelengths, air.histories, solver="montecarlo")
    assert isinstance(judge, MonteCarloSolution)
    lines, _ = judge.lines_of_sight(**where)
    got = judge.trace(lines)
    return Beside(
        ours=vector.relative_stokes(lines),
        scalar=scalar.relative_radiance(lines),
        known=np.concatenate([got.total[:, None], got.polarised], axis=1),
        error=np.concatenate([got.total_error[:, None], got.polarised_error], axis=1),
        nu=lines.nu,
        noise=air.noise,
    )


def histories(
    run: SuiteRun,
    airs: Sequence[PolarisedPlanet] | None = None,
    cases: Sequence[Case] = CASES,
) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and tables of the comparison.

    Parameters
    ----------
    run : SuiteRun
    airs : sequence of PolarisedPlanet, optional
        ``PLANETS`` if left out.
    cases : sequence of Case
        Lines of sight.
    """
    thresholds, rows = [], []
    lines: list[Part] = []
    airs = PLANETS if airs is None else airs
    for done, air in enumerate(airs):
        run.step(done, len(airs), air.planet)
        planet = replace(with_point_star(load_planet(air.planet)), refraction="none")
        taken = [one for one in cases if one.sun <= air.latest]
        found = beside(run, planet, air, taken)
        name = f"values that noise, 1 % of I and {DEGREE:g} of the degree do not explain"
        share = 100.0 * float(found.disagree.sum() / max(found.judged.sum(), 1))
        thresholds.append(Threshold(f"{air.planet}: {name}", share, ALLOWED, "%", "target"))
        rows.append((air.planet, *summary(found)))
        lines.append(line_table(air, taken, len(cases), found))
    return thresholds, [
        ReportTable(
            title="Moments against vector Monte Carlo",
            columns=cells(
                "planet | lines | values judged | in the aureole, dark, noisy | "
                "noise of I, median [%] | I, median [%] | 95 % [%] | scalar I, median [%] | "
                "95 % [%] | Q/I and U/I, median | 95 % | their noise, median | "
                f"I, Q, U within {NOISE:g} standard errors [%] | χ² a value of I, Q, U | "
                "not explained"
            ),
            rows=rows,
            note=f"Lines of sight from the ground to space, {len(WAVELENGTHS)} wavelengths, "
            "default quality, straight light. Left out are lines within 10° of the star, values "
            f"below {LEAST_RADIANCE:g} of the star's irradiance, and those that histories know to "
            "no better than 1 % of I (venus: 3 %). χ² is the mean square of the differences over "
            "the histories' standard errors alone: 1 if the moments were exact. Not explained: "
            f"differences of more than {NOISE:g} standard errors and 1 % of I or {DEGREE:g} of the "
            "degree.",
        ),
        *lines,
    ]


def summary(found: Beside) -> tuple[str, ...]:
    """Cells of a planet's row."""
    judged = found.judged
    light = summarise(found.relative, judged)
    scalar = summarise(relative_errors(found.scalar, found.known[:, 0]), judged)
    both = np.stack([judged, judged], axis=1)
    degree = summarise(found.degrees, both)
    noise = np.median((found.error[:, 0] / np.where(judged, found.known[:, 0], 1.0))[judged])
    scores = [found.in_errors[:, k][judged] for k in range(3)]
    noisy = judged.size - judged.sum() - found.aureole.sum() - found.dark.sum()
    within = [f"{100 * np.mean(np.abs(one) <= NOISE):.0f}" for one in scores]
    chi_squares = [f"{np.mean(np.square(one)):.1f}" for one in scores]
    return cells(
        f"{len(found.nu)} | {judged.sum()} of {judged.size} | "
        f"{found.aureole.sum()}, {found.dark.sum()}, {noisy} | {100 * noise:.2f} | "
        f"{100 * light.median:.2f} | {100 * light.high:.2f} | "
        f"{100 * scalar.median:.2f} | {100 * scalar.high:.2f} | "
        f"{degree.median:.4f} | {degree.high:.4f} | {np.median(found.degree_noise[both]):.4f} | "
        f"{', '.join(within)} | {', '.join(chi_squares)} | {found.disagree.sum()}"
    )


def line_table(
    air: PolarisedPlanet, cases: Sequence[Case], whole: int, found: Beside
) -> ReportTable:
    """Table of the lines of sight of a planet: difference ± noise at each wavelength.

    Parameters
    ----------
    cases : sequence of Case, length n
        Compared lines of sight.
    whole : int
        Number of lines with the omitted ones.
    found : Beside
        Values of the lines, n of each.
    """
    known = np.where(found.known[:, 0] > 0.0, found.known[:, 0], np.nan)
    noise = found.error[:, 0] / known
    reasons = np.full(found.judged.shape, "noisy", dtype=object)
    reasons[found.judged] = ""
    reasons[found.dark] = "dark"
    reasons[found.aureole] = "aureole"
    rows, channels = [], range(noise.shape[1])
    for n, case in enumerate(cases):
        known_well = np.isfinite(noise[n]) & (noise[n] < 1.0)
        light = [f"{100 * found.relative[n, k]:+.2f} ± {100 * noise[n, k]:.2f}" for k in channels]
        degrees = [" ".join(f"{one:+.4f}" for one in found.degrees[n, :, k]) for k in channels]
        shown = [
            one[k] if known_well[k] else "unknown" for one in (light, degrees) for k in channels
        ]
        left = sorted({one for one in reasons[n] if one})
        mark = "not explained" if found.disagree[n].any() else ""
        rows.append((str(case), *shown, ", ".join([*left, *([mark] if mark else [])])))
    left_out = f" {whole - len(cases)} of {whole} lines are left out: {air.why}." if air.why else ""
    return ReportTable(
        title=f"{air.planet}: every line of sight by vector Monte Carlo",
        columns=[
            "line of sight",
            *(f"I, {nm:g} nm [%]" for nm in WAVELENGTHS),
            *(f"Q/I and U/I, {nm:g} nm" for nm in WAVELENGTHS),
            "",
        ],
        rows=rows,
        marks=["fail" if one.any() else "" for one in found.disagree],
        note=f"Differences, moments less histories; ± one standard error.{left_out}",
        folded=True,
    )

"""Suite ``solvers``: three independent methods on the same cases."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from airlight.planets import load_planet
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure
from airlight.validation.agreement import (
    LEAST_RADIANCE,
    NOISE,
    SOLVERS,
    Agreement,
    Result,
    agreements,
    results,
)
from airlight.validation.cases import CASES, WAVELENGTHS, Case, geometry
from airlight.validation.metrics import relative_errors, summarise
from airlight.validation.planets import with_point_star
from airlight.validation.suite import (
    Mark,
    Part,
    ReportPicture,
    ReportTable,
    Suite,
    SuiteRun,
    Threshold,
    cells,
)

#: A clear Earth, and a Mars with dust of optical depth 0.5.
PLANETS: Final = ("earth-atmosphere-plus", "mars-standard")
#: Smallest number of lines of sight per planet that must agree.
LEAST_CASES: Final = 40
#: Number of largest differences between a point star and a disc that are listed.
LISTED: Final = 6


def solvers(
    run: SuiteRun,
    solvers: Sequence[tuple[str, Any]] = SOLVERS,
    planets: Sequence[str] = PLANETS,
    cases: Sequence[Case] = CASES,
) -> Suite:
    """Comparison of solvers on the grid of cases.

    Parameters
    ----------
    run : SuiteRun
    solvers : sequence of (str, object)
        Two or more solvers; the last is the reference.
    planets : sequence of str
        Names of presets, or paths of files.
    cases : sequence of Case
        Grid of lines of sight.
    """
    thresholds: list[Threshold] = []
    parts: list[Part] = []
    agreement, times = [], []
    least = min(LEAST_CASES, len(cases))
    for planet in planets:
        given = results(run, planet, solvers, cases)
        pairs = agreements(given)
        for pair in pairs:
            name = (
                f"{planet}, {pair.name}: lines of sight that do not agree, or are too dark, of "
                f"{len(cases)}"
            )
            missed = int((pair.disagree.any(axis=1) | ~pair.judged.any(axis=1)).sum())
            source = f"at least {least} agree at every wavelength"
            thresholds.append(Threshold(name, missed, len(cases) - least, source=source))
        parts += [
            agreement_picture(planet, pairs, cases),
            _worst(planet, pairs, cases),
            finite_disc(run, planet, cases),
            _all(planet, given, pairs, cases),
        ]
        agreement += [_summary(planet, pair) for pair in pairs]
        times += [_time(planet, result) for result in given]
    return Suite(
        summary=(
            f"{len(cases)} lines of sight from the ground to space, sun 0° to 96°, three "
            f"wavelengths, on each of {len(planets)} planets, by solvers that share optics and "
            "geometry but no method: spherical-harmonic moments, the trapezoids and gathers of the "
            "Atmosphere Plus notes, and backward Monte Carlo. Two values agree if they differ by "
            "at most 1 % or by at most three standard errors. The star is a point."
        ),
        thresholds=thresholds,
        parts=[
            ReportTable(
                title="Agreement of each pair",
                columns=cells(
                    "planet | pair | lines of sight | values | median [%] | 95 % [%] | "
                    "largest [%] | RMS in standard errors | values that disagree | lines of sight"
                ),
                rows=agreement,
                note="The errors of a pair with Monte Carlo hold its noise: an RMS of about 1 in "
                "standard errors is noise alone.",
            ),
            *parts,
            ReportTable(
                title="Times and standard errors of the solvers",
                columns=cells(
                    "planet | solver | time [s] | standard error, median and largest [%]"
                ),
                rows=times,
                note="To solve and to compute all cases, without what was compiled before.",
            ),
        ],
        settings=[
            f"{name}: {quality if isinstance(quality, str) else quality.as_text()}"
            for name, quality in solvers
        ],
    )


def _summary(planet: str, pair: Agreement) -> tuple[str, ...]:
    s = summarise(pair.relative, pair.judged)
    errors = pair.in_errors[pair.judged]
    noisy = bool(np.isfinite(errors).all()) and errors.size
    return cells(
        f"{planet} | {pair.name} | {pair.judged.any(axis=1).sum()} | {s.count} | "
        f"{100 * s.median:.3f} | {100 * s.high:.3f} | {100 * s.largest:.2f} | "
        f"{f'{np.sqrt(np.mean(np.square(errors))):.2f}' if noisy else ''} | "
        f"{pair.disagree.sum()} | {pair.disagree.any(axis=1).sum()}"
    )


def _time(planet: str, result: Result) -> tuple[str, ...]:
    bright = result.radiance > LEAST_RADIANCE
    noise = summarise(
        relative_errors(result.radiance + result.standard_error, result.radiance), bright
    )
    shown = f"{100 * noise.median:.2f}, {100 * noise.largest:.2f}" if noise.largest > 0.0 else ""
    return planet, result.solver, f"{result.seconds:.1f}", shown


def _worst(
    planet: str, pairs: Sequence[Agreement], cases: Sequence[Case], count: int = 5
) -> ReportTable:
    """Table of the values of each pair that differ most beyond the noise."""
    rows: list[tuple[str, ...]] = []
    marks: list[Mark] = []
    for pair in pairs:
        size = np.where(pair.judged, np.abs(pair.relative), 0.0)
        # Differences explained by noise come last.
        order = np.where(np.abs(pair.in_errors) > NOISE, 1.0, 0.0) + size / (1.0 + size)
        order = np.where(pair.judged, order, -1.0)
        for flat in np.argsort(order, axis=None)[::-1][:count]:
            n, c = np.unravel_index(flat, order.shape)
            in_errors = pair.in_errors[n, c]
            rows.append(
                cells(
                    f"{pair.name} | {cases[n]} | {WAVELENGTHS[c]:g} | "
                    f"{pair.first.radiance[n, c]:.4e} | {pair.second.radiance[n, c]:.4e} | "
                    f"{100 * pair.relative[n, c]:+.2f} | "
                    f"{f'{in_errors:+.1f}' if np.isfinite(in_errors) else ''}"
                )
            )
            marks.append("fail" if pair.disagree[n, c] else "")
    return ReportTable(
        title=f"{planet}: the worst values of each pair",
        columns=cells(
            "pair | line of sight | wavelength [nm] | first [sr⁻¹] | second [sr⁻¹] | "
            "difference [%] | in standard errors"
        ),
        rows=rows,
        marks=marks,
        note="Beyond three standard errors first, then by size.",
    )


def _all(
    planet: str, given: Sequence[Result], pairs: Sequence[Agreement], cases: Sequence[Case]
) -> ReportTable:
    rows = []
    marks: list[Mark] = []
    for n, case in enumerate(cases):
        for c, nm in enumerate(WAVELENGTHS):
            radiances = [
                f"{result.radiance[n, c]:.4e}"
                + (f" ± {result.standard_error[n, c]:.0e}" if result.standard_error.any() else "")
                for result in given
            ]
            differences = [f"{100 * pair.relative[n, c]:+.2f}" for pair in pairs]
            dark = "" if pairs[0].judged[n, c] else "too dark to judge"
            rows.append([str(case), f"{nm:g}", *radiances, *differences, dark])
            marks.append("fail" if any(pair.disagree[n, c] for pair in pairs) else "")
    return ReportTable(
        title=f"{planet}: all values",
        columns=[
            *("line of sight", "wavelength [nm]"),
            *(f"{result.solver} [sr⁻¹]" for result in given),
            *(f"{pair.name} [%]" for pair in pairs),
            "",
        ],
        rows=rows,
        marks=marks,
        folded=True,
    )


def agreement_picture(
    planet: str, pairs: Sequence[Agreement], cases: Sequence[Case]
) -> ReportPicture:
    """Plot the differences of each pair over the cases in their order, with the noise as bars."""
    title = f"How far the solvers differ: {planet}"
    figure = new_figure(title, size=(9.5, 1.4 + 2.1 * len(pairs)))
    panels = np.atleast_1d(figure.subplots(len(pairs), 1, sharex=True, sharey=True))
    dots: Any = {"fmt": "o", "markersize": 2.6, "linewidth": 0.8}
    for axes, pair in zip(panels, pairs, strict=True):
        at = np.arange(len(cases), dtype=float)
        for c in range(pair.relative.shape[1]):
            seen = pair.judged[:, c]
            noise = 3.0 * pair.noise[:, c] / np.maximum(pair.second.radiance[:, c], 1e-300)
            ink, error = PALETTE[(1, 2, 0)[c % 3]], 100.0 * pair.relative[seen, c]
            axes.errorbar(at[seen] + 0.22 * (c - 1), error, 100.0 * noise[seen], color=ink, **dots)
        axes.axhspan(-1.0, 1.0, color="#eeeeee")
        axes.set_ylim(-4.0, 4.0)
        axes.set_title(f"{pair.name} [%]", fontsize=9.5, color=GREY, loc="left")
        for k in range(1, len(cases)):
            if cases[k].observer != cases[k - 1].observer:
                axes.axvline(k - 0.5, color=GREY, linewidth=0.7)
        grid(axes)
    starts = [k for k in range(len(cases)) if not k or cases[k].observer != cases[k - 1].observer]
    names = [
        "top" if cases[k].observer == "top" else f"{float(cases[k].observer) / 1e3:g} km"
        for k in starts
    ]
    panels[-1].set_xticks(starts, names, fontsize=8.5)
    panels[-1].set_xlabel("lines of sight in the grid's order, by the observer's altitude")
    caption = (
        "Grey: 1 %. Lines: three standard errors of the Monte Carlo. Red, green, blue: 680, 550, "
        "440 nm. Within an observer the sun sinks from left to right. Points beyond 4 % are in the "
        "table of the worst values."
    )
    return ReportPicture.from_figure(figure, title=title, caption=caption)


def finite_disc(run: SuiteRun, planet_name: str, cases: Sequence[Case] = CASES) -> ReportTable:
    """Compare the first order under a point star with that under the preset's disc, by quadrature.

    The solvers are compared under a point star: the disc is no matter of method. The direct solver
    weighs the visible part of the disc by the transmittance to its centre; the moments solver takes
    two points of a low disc; Monte Carlo samples it. When the disc is low in dense air, a point
    differs from the disc by what this table gives.

    Parameters
    ----------
    run : SuiteRun
    planet_name : str
        Name of a preset, or path of a file.
    cases : sequence of Case
        Lines of sight.
    """
    disc = load_planet(planet_name)
    by_star = []
    for planet in (with_point_star(disc), disc):
        judge = run.solve(planet, WAVELENGTHS, "default", solver="montecarlo")
        assert isinstance(judge, MonteCarloSolution)
        lines, _ = judge.lines_of_sight(**geometry(planet, cases))
        by_star.append(judge.first_order(lines)[:, 0])
    once, known = by_star
    bright = known > LEAST_RADIANCE
    off = np.where(bright, relative_errors(once, known), 0.0)
    by_case = np.abs(off).max(axis=1)
    order = np.argsort(by_case)[::-1][:LISTED]
    rows = [
        [
            str(cases[n]),
            *(f"{100 * x:+.2f}" if b else "dark" for x, b in zip(off[n], bright[n], strict=True)),
        ]
        for n in order
    ]
    return ReportTable(
        title=f"{planet_name}: single scattering under a point star, less that under its disc",
        columns=["line of sight", *(f"{nm:g} nm [%]" for nm in WAVELENGTHS)],
        rows=rows,
        note="By exact quadrature, no histories. A solver that weighs the visible part of the disc "
        f"with the transmittance to its middle errs by about so much. Median of all {len(cases)} "
        f"lines {100 * float(np.median(by_case)):.3f} %; the {len(rows)} largest are listed, not "
        "judged.",
    )

"""Suite ``solvers``: three independent methods on the same cases."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from airlight.validation.agreement import (
    LEAST_RADIANCE,
    NOISE,
    SOLVERS,
    Agreement,
    Result,
    agreements,
    results,
)
from airlight.validation.cases import CASES, WAVELENGTHS, Case
from airlight.validation.finite_disc import finite_disc
from airlight.validation.metrics import relative_errors, summarise
from airlight.validation.solvers_pictures import agreement_picture
from airlight.validation.suite import Cancel, Mark, Part, Progress, ReportTable, Suite, Threshold

#: A clear Earth, and a Mars with dust of optical depth 0.5.
PLANETS: Final = ("earth-atmosphere-plus", "mars-standard")
#: Smallest number of lines of sight per planet that must agree.
LEAST_CASES: Final = 40


def solvers(
    *, solvers: Sequence[tuple[str, Any]] = SOLVERS, planets: Sequence[str] = PLANETS,
    cases: Sequence[Case] = CASES, progress: Progress | None = None, cancel: Cancel | None = None,
) -> Suite:  # fmt: skip
    """Comparison of solvers on the grid of cases.

    Parameters
    ----------
    solvers : sequence of (str, object)
        Two or more solvers; the last is the reference.
    planets : sequence of str
        Names of presets, or paths of files.
    cases : sequence of Case
        Grid of lines of sight.
    """
    thresholds: list[Threshold] = []
    parts: list[Part] = []
    summary: list[tuple[tuple[str | int, ...], Mark]] = []
    for planet in planets:
        given = results(planet, solvers, cases=cases, progress=progress, cancel=cancel)
        pairs = agreements(given)
        least = min(LEAST_CASES, len(cases))
        for pair in pairs:
            thresholds.append(
                Threshold(
                    name=f"{planet}, {pair.name}: lines of sight that do not agree, or are too "
                    f"dark, of {len(cases)}",
                    got=int((pair.disagree.any(axis=1) | ~pair.judged.any(axis=1)).sum()),
                    allowed=len(cases) - least,
                    source=f"at least {least} agree at every wavelength",
                )
            )
            summary.append(_summary(planet, pair))
        parts += [
            agreement_picture(planet, pairs, cases),
            _worst(planet, pairs, cases),
            finite_disc(planet, cases=cases, cancel=cancel),
            _all(planet, given, pairs, cases),
        ]
        for result in given:
            summary.append(_time(planet, result))
    agreement = [entry for entry in summary if len(entry[0]) == 10]
    times = [entry[0] for entry in summary if len(entry[0]) == 4]
    return Suite(
        name="solvers",
        title="Three solvers",
        summary=(
            f"{len(cases)} lines of sight from the ground to space, sun 0° to 96°, three "
            f"wavelengths, on each of {len(planets)} planets, by solvers that share optics and "
            "geometry but no method: spherical-harmonic moments, the trapezoids and gathers of the "
            "Atmosphere Plus notes, and backward Monte Carlo. Two values agree if they differ by "
            "at most 1 % or by at most three standard errors. The star is a point."
        ),
        thresholds=thresholds,
        parts=[_agreement_table([row for row, _ in agreement], [m for _, m in agreement]),
               *parts, _times_table(times)],
        settings=[
            f"{name}: {quality if isinstance(quality, str) else quality.as_text()}"
            for name, quality in solvers
        ],
    )  # fmt: skip


def _summary(planet: str, pair: Agreement) -> tuple[tuple[str | int, ...], Mark]:
    s = summarise(pair.relative, pair.judged)
    errors = pair.in_errors[pair.judged]
    noisy = bool(np.isfinite(errors).all())
    row = (
        planet,
        pair.name,
        int(pair.judged.any(axis=1).sum()),
        s.count,
        f"{100 * s.median:.3f}",
        f"{100 * s.high:.3f}",
        f"{100 * s.largest:.2f}",
        f"{np.sqrt(np.mean(np.square(errors))):.2f}" if noisy and errors.size else "",
        int(pair.disagree.sum()),
        int(pair.disagree.any(axis=1).sum()),
    )
    return row, ""


def _time(planet: str, result: Result) -> tuple[tuple[str | int, ...], Mark]:
    bright = result.radiance > LEAST_RADIANCE
    noise = summarise(
        relative_errors(result.radiance + result.standard_error, result.radiance), bright
    )
    shown = f"{100 * noise.median:.2f}, {100 * noise.largest:.2f}" if noise.largest > 0.0 else ""
    return (planet, result.solver, f"{result.seconds:.1f}", shown), ""


def _agreement_table(rows: Sequence[Sequence[str | int]], marks: Sequence[Mark]) -> ReportTable:
    return ReportTable(
        title="Agreement of each pair",
        columns=[
            "planet", "pair", "lines of sight", "values", "median [%]", "95 % [%]", "largest [%]",
            "RMS in standard errors", "values that disagree", "lines of sight",
        ],
        rows=rows,
        marks=marks,
        note="The errors of a pair with Monte Carlo hold its noise: an RMS of about 1 in standard "
        "errors is noise alone.",
    )  # fmt: skip


def _times_table(rows: Sequence[Sequence[str | int]]) -> ReportTable:
    return ReportTable(
        title="What the solvers took",
        columns=["planet", "solver", "time [s]", "standard error, median and largest [%]"],
        rows=rows,
        note="To solve and to compute all cases, without what was compiled before.",
    )


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
                (
                    pair.name,
                    str(cases[n]),
                    f"{WAVELENGTHS[c]:g}",
                    f"{pair.first.radiance[n, c]:.4e}",
                    f"{pair.second.radiance[n, c]:.4e}",
                    f"{100 * pair.relative[n, c]:+.2f}",
                    f"{in_errors:+.1f}" if np.isfinite(in_errors) else "",
                )
            )
            marks.append("fail" if pair.disagree[n, c] else "")
    return ReportTable(
        title=f"{planet}: the worst values of each pair",
        columns=[
            "pair", "line of sight", "wavelength [nm]", "first [sr⁻¹]", "second [sr⁻¹]",
            "difference [%]", "in standard errors",
        ],
        rows=rows,
        marks=marks,
        note="Beyond three standard errors first, then by size.",
    )  # fmt: skip


def _all(
    planet: str, given: Sequence[Result], pairs: Sequence[Agreement], cases: Sequence[Case]
) -> ReportTable:
    rows = []
    marks: list[Mark] = []
    for n, case in enumerate(cases):
        for c, nm in enumerate(WAVELENGTHS):
            judged = bool(pairs[0].judged[n, c])
            rows.append(
                (
                    str(case),
                    f"{nm:g}",
                    *(
                        f"{result.radiance[n, c]:.4e}"
                        + (
                            f" ± {result.standard_error[n, c]:.0e}"
                            if result.standard_error.any()
                            else ""
                        )
                        for result in given
                    ),
                    *(f"{100 * pair.relative[n, c]:+.2f}" for pair in pairs),
                    "" if judged else "too dark to judge",
                )
            )
            marks.append("fail" if any(pair.disagree[n, c] for pair in pairs) else "")
    return ReportTable(
        title=f"{planet}: all values",
        columns=[
            "line of sight", "wavelength [nm]", *(f"{result.solver} [sr⁻¹]" for result in given),
            *(f"{pair.name} [%]" for pair in pairs), "",
        ],
        rows=rows,
        marks=marks,
        folded=True,
    )  # fmt: skip

"""Effect of the star's finite disc on single scattering.

The solvers treat the disc differently (transmittance to its centre, two points, random points) and
are therefore compared under a point star. This suite computes the effect of a low disc by
quadrature.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from airlight.planets import Planet, load_planet, replace
from airlight.solver import solve
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.validation.cases import CASES, WAVELENGTHS, Case, geometry
from airlight.validation.metrics import relative_errors
from airlight.validation.suite import Cancel, ReportTable

#: Number of largest differences listed.
LISTED = 6
#: Radiance per irradiance of the star below which a value is not compared. [sr⁻¹]
LEAST_RADIANCE = 1e-6


def with_point_star(planet: Planet) -> Planet:
    """Planet under a point star of the same irradiance."""
    return replace(planet, star=replace(planet.star, angular_radius=0.0))


def finite_disc(
    planet_name: str, *, cases: Sequence[Case] = CASES, cancel: Cancel | None = None
) -> ReportTable:
    """Comparison of the first order under a point star and under the preset's disc.

    Parameters
    ----------
    planet_name : str
        Name of a preset, or path of a file.
    cases : sequence of Case
        Lines of sight.
    """
    disc = load_planet(planet_name)
    by_star = []
    for planet in (with_point_star(disc), disc):
        judge = solve(planet, WAVELENGTHS, solver="montecarlo", cancel=cancel)
        assert isinstance(judge, MonteCarloSolution)
        lines, _ = judge.lines_of_sight(**geometry(planet, cases))
        by_star.append(judge.first_order(lines)[:, 0])
    once, known = by_star
    bright = known > LEAST_RADIANCE
    off = np.where(bright, relative_errors(once, known), 0.0)
    by_case = np.abs(off).max(axis=1)
    order = np.argsort(by_case)[::-1][:LISTED]
    rows = [
        (
            str(cases[n]),
            *(f"{100 * x:+.2f}" if b else "dark" for x, b in zip(off[n], bright[n], strict=True)),
        )
        for n in order
    ]
    return ReportTable(
        title=f"{planet_name}: light scattered once under a point star, less that under its disc",
        columns=["line of sight", *(f"{nm:g} nm [%]" for nm in WAVELENGTHS)],
        rows=rows,
        note="By exact quadrature, no histories. A solver that weighs the visible part of the disc "
        f"with the transmittance to its middle errs by about so much. Median of all {len(cases)} "
        f"lines {100 * float(np.median(by_case)):.3f} %; the {len(rows)} largest are listed, not "
        "judged.",
    )

"""Suite ``published``: published measurements and computations against airlight."""

from __future__ import annotations

from airlight.planets import load_planet
from airlight.validation.published.earth import (
    belts,
    colors,
    illuminances,
    zeniths,
)
from airlight.validation.published.mars import daylight
from airlight.validation.published.rayleigh_sphere import rayleigh_sphere
from airlight.validation.published.row import PublishedSection, Solve, solver
from airlight.validation.published.sunset import sunset
from airlight.validation.published.titan import full_disc
from airlight.validation.published.twilight import (
    TWILIGHT_WAVELENGTHS,
    average_aerosol,
)
from airlight.validation.published.venus import venus
from airlight.validation.suite import Cancel, Progress, Suite


def published(*, progress: Progress | None = None, cancel: Cancel | None = None) -> Suite:
    """Comparison with published values."""
    solve = solver(progress, cancel)
    others = [sunset(), daylight(solve), venus(solve), full_disc(solve), rayleigh_sphere(solve)]
    return suite_of([*earth(solve), *others])


def earth(solve: Solve, quality: object = "default") -> list[PublishedSection]:
    """Sections of the Earth: a clear day, and one with average aerosol.

    Parameters
    ----------
    solve : callable
        See ``row.Solve``.
    quality : str or MomentsSettings, optional
        Quality of the solver.
    """
    average = solve(load_planet("earth", average_aerosol()), TWILIGHT_WAVELENGTHS, quality)
    clear = solve(load_planet("earth"), TWILIGHT_WAVELENGTHS, quality)
    return [illuminances(average), zeniths(clear), colors(average), belts(clear)]


def suite_of(sections: list[PublishedSection]) -> Suite:
    """Build the section of the report."""
    thresholds = [threshold for section in sections for threshold in section.thresholds]
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        name="published",
        title="Published light",
        summary=(
            "Numbers that others measured or computed, beside those of the presets; nothing is "
            "fitted. A number is judged where its source states an error or a range, or where an "
            f"aim is set (see the source of the threshold): {met} of {len(thresholds)} are met. "
            "What else differs is mostly the air that day, which the presets do not know."
        ),
        thresholds=thresholds,
        parts=[section.table for section in sections],
        settings=[
            "Earth in the standard atmosphere, presets mars, venus and titan",
            "twilight: default quality, 400 to 720 nm",
            "Venus: preview quality, 400 to 1000 nm; Titan: preview quality",
        ],
    )

"""Suite ``published``: published measurements and computations against airlight."""

from __future__ import annotations

from dataclasses import replace

from airlight.planets import load_planet
from airlight.validation.published.earth import belts, colors, illuminances, zeniths
from airlight.validation.published.giant_planets import giant_planets
from airlight.validation.published.other_planets import daylight, full_disc, venus
from airlight.validation.published.rayleigh_sphere import rayleigh_sphere
from airlight.validation.published.row import PublishedSection
from airlight.validation.published.sunset import sunset
from airlight.validation.published.twilight import TWILIGHT_WAVELENGTHS, average_aerosol
from airlight.validation.suite import Suite, SuiteRun


def published(run: SuiteRun) -> Suite:
    """Compare with published light.

    Parameters
    ----------
    run : SuiteRun
    """
    preview = replace(run, quality="preview")  # deep air
    deep = [venus(preview), full_disc(preview), giant_planets(preview)]
    others = [daylight(run), *deep, rayleigh_sphere(run)]
    return suite_of([*earth(run), sunset(), *others])


def earth(run: SuiteRun) -> list[PublishedSection]:
    """Sections of the Earth: a clear day, and one with average aerosol."""
    average = run.solve(load_planet("earth", average_aerosol()), TWILIGHT_WAVELENGTHS)
    clear = run.solve(load_planet("earth"), TWILIGHT_WAVELENGTHS)
    return [illuminances(average), zeniths(clear), colors(average), belts(clear)]


def suite_of(sections: list[PublishedSection]) -> Suite:
    """Build the section of the report."""
    thresholds = [threshold for section in sections for threshold in section.thresholds]
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        summary=(
            "Numbers that others measured or computed, beside those of the presets; nothing is "
            "fitted but hazes of the giant planets, at other wavelengths. A number is judged where "
            "its source states an error or a range, or where a target is set (see the source of "
            f"the threshold): {met} of {len(thresholds)} are met. What else differs is mostly the "
            "air that day, which the presets do not know."
        ),
        thresholds=thresholds,
        parts=[section.table for section in sections],
        settings=[
            "Earth in the standard atmosphere, presets mars, venus, titan and the giants",
            "twilight: default quality, 400 to 720 nm",
            "Venus: preview quality, 400 to 1000 nm; Titan and the giants: preview quality",
        ],
    )

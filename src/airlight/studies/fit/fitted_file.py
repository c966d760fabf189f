"""Planet file of a fit: the initial planet with the fitted values."""

from __future__ import annotations

from typing import Any

from airlight.planets.reading.planet_file import planet_file
from airlight.studies.fit.fit_sky import SkyFit
from airlight.studies.fit.report import result_lines, warnings_of


def fitted_file(sky: SkyFit) -> str:
    """Text of the fitted planet's file, with a header of values and error bars."""
    comments = (
        f"{sky.name}, fitted to {sky.data.source} by airlight fit.",
        *result_lines(sky),
        *(f"Note: {one}." for one in warnings_of(sky)),
    )
    return planet_file(_short(sky.tables), comments)


def _short(value: Any) -> Any:
    """Tables with numbers rounded to eight digits."""
    if isinstance(value, dict):
        return {key: _short(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_short(one) for one in value]
    if isinstance(value, float):
        return float(f"{value:.8g}")
    if isinstance(value, str) and " " in value:
        first, _, rest = value.partition(" ")
        try:
            number = float(first)
        except ValueError:
            return value
        return f"{number:.10g} {rest}" if len(first) > 12 else value
    return value

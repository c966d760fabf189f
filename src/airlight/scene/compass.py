"""Compass bearings as text."""

from __future__ import annotations

import re
from typing import Final

#: Sixteen points of the compass, clockwise from north.
POINTS: Final = (
    "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
    "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW",
)  # fmt: skip
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)"
_FORM = re.compile(rf"({_NUMBER}|[NESW]+)\s*(?:°|deg)?\s*(?:/\s*({_NUMBER})\s*(?:°|deg)?)?", re.I)


def compass_bearing(text: str) -> tuple[float, float | None] | None:
    """Bearing, and elevation if there is one, of a text; None if it is neither.

    Parameters
    ----------
    text : str
        Point of the compass (``NE``) or degrees (``315``, ``-45``), then, after ``/``, an elevation
        above the horizontal of -90 to 90 degrees.

    Returns
    -------
    (float, float or None) or None
        Bearing, 0 north and 90 east, -360 to 360; elevation. [deg]

    Examples
    --------
    >>> compass_bearing("NE"), compass_bearing("315°/-20"), compass_bearing("sideways")
    ((45.0, None), (315.0, -20.0), None)
    """
    match = _FORM.fullmatch(text.strip())
    if match is None:
        return None
    word = match[1].upper()
    if word[-1].isalpha():
        if word not in POINTS:
            return None
        bearing = 22.5 * POINTS.index(word)
    else:
        bearing = float(word)
    elevation = None if match[2] is None else float(match[2])
    if not -360.0 <= bearing <= 360.0 or (elevation is not None and not -90.0 <= elevation <= 90.0):
        return None
    return bearing, elevation

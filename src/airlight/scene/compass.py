"""Compass bearings as text, and as numbers and quantities."""

from __future__ import annotations

import re
from typing import Final

from airlight.errors import ParameterError
from airlight.physics.units import Measure
from airlight.planets.schema.field import Wavelengths
from airlight.planets.schema.toml_table import TomlTable
from airlight.scene.limits import within

#: Sixteen points of the compass, clockwise from north.
POINTS: Final = (
    "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
    "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW",
)  # fmt: skip
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)"
_FORM = re.compile(rf"({_NUMBER}|[NESW]+)\s*(?:°|deg)?\s*(?:/\s*({_NUMBER})\s*(?:°|deg)?)?", re.I)


def compass_bearing(text: str) -> tuple[float, float | None] | None:
    """Bearing of a text, with an optional elevation; None if it is not a bearing.

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


def bearing(value: Measure, field: str) -> float:
    """Compass bearing of any value. [deg]

    Parameters
    ----------
    value : float, str or quantity
        Angle from -360 to 360, 0 north and 90 east, or a point of the compass: ``SW``. [deg]
    field : str
        Field named in the error.

    Examples
    --------
    >>> bearing("SW", "sun_azimuth"), bearing("90 deg", "heading"), bearing(-20.0, "heading")
    (225.0, 90.0, -20.0)
    """
    found = compass_bearing(value) if isinstance(value, str) else None
    if found is not None and found[1] is None:
        return found[0]
    try:
        return within(field, value, -360.0, 360.0, "deg")
    except ParameterError as error:
        allowed = f"{error.allowed}, or a point of the compass such as SW"
        raise ParameterError(field, value, allowed) from None


def read_bearing(table: TomlTable, name: str, wavelengths: Wavelengths) -> float:
    """Bearing of a key of a file: a point of the compass, or an angle with its unit. [deg]"""
    value = table.raw(name)
    if isinstance(value, str) and compass_bearing(value) is not None and value[-1:].isalpha():
        return bearing(value, table.name_of(name))
    return table.number(name, "deg", "225 deg or SW")

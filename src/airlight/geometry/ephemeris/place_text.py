"""Places as text: latitude, longitude and, with its unit, altitude."""

from __future__ import annotations

import re

from airlight.errors import ParameterError

_FORM = "LAT,LON such as 59.33N,18.07E or 59.33,18.07, and an altitude with its unit: ,35km"
_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+))\s*(?:°|deg)?\s*([NSEW]?)\s*", re.IGNORECASE)


def read_place(text: str, field: str = "at") -> tuple[float, float, str | None]:
    """Parse a place.

    Parameters
    ----------
    text : str
        Latitude and longitude in degrees, with N, S, E, W or signs (north and east positive), and
        optionally an altitude with its unit, separated by commas.
    field : str
        Field named in the error.

    Returns
    -------
    latitude, longitude : float
        Coordinates, north and east positive. [deg]
    altitude : str or None
        Text of the altitude.

    Raises
    ------
    ParameterError
        If the text has another form, or a number is out of range.

    Examples
    --------
    >>> read_place("59.33N,18.07E")
    (59.33, 18.07, None)
    >>> read_place("4.59°S, 137.44E, 2m")
    (-4.59, 137.44, '2m')
    """
    parts = text.split(",")
    if len(parts) not in (2, 3):
        raise ParameterError(field, text, _FORM)
    latitude = _coordinate(text, parts[0], "NS", 90.0, field)
    longitude = _coordinate(text, parts[1], "EW", 360.0, field)
    altitude = parts[2].strip() if len(parts) == 3 else None
    if altitude is not None and not altitude[-1:].isalpha():
        raise ParameterError(field, text, _FORM)
    return latitude, longitude, altitude


def is_named(text: str) -> bool:
    """Whether a place is given by its name, which begins with a letter.

    Examples
    --------
    >>> is_named("Dead Sea"), is_named("K2"), is_named("59.33N,18.07E"), is_named("-4.5,137")
    (True, True, False, False)
    """
    return text.lstrip()[:1].isalpha()


def written_place(latitude: float, longitude: float) -> str:
    """Place as text.

    Examples
    --------
    >>> written_place(59.33, -18.07)
    '59.3300°N 18.0700°W'
    """
    north = "N" if latitude >= 0.0 else "S"
    east = "E" if longitude >= 0.0 else "W"
    return f"{abs(latitude):.4f}°{north} {abs(longitude):.4f}°{east}"


def _coordinate(text: str, part: str, letters: str, limit: float, field: str) -> float:
    match = _NUMBER.fullmatch(part)
    if match is None or (match[2] and match[2].upper() not in letters):
        raise ParameterError(field, text, _FORM)
    if match[2] and match[1][0] in "+-":
        raise ParameterError(field, text, "a letter or a sign, not both")
    value = float(match[1]) * (-1.0 if match[2].upper() in ("S", "W") else 1.0)
    if not -limit <= value <= limit:
        name = "latitudes" if letters == "NS" else "longitudes"
        raise ParameterError(field, text, f"{name} from {-limit:g} to {limit:g} deg")
    return value

"""Range check of the scene's values: a finite number between two limits, or text with a unit."""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.errors import ParameterError
from airlight.units import quantity

#: Largest altitude of an observer, and one below every known basin. [m]
HIGHEST_ALTITUDE: Final = 1e12
DEEPEST_ALTITUDE: Final = -1e4
#: Units in which a text is read.
_READ: Final = ("m", "deg")


def within(field: str, value: object, low: float, high: float, unit: str) -> float:
    """Return the value as a float, if it is a number between two limits.

    Parameters
    ----------
    field : str
        Field named in the error.
    value : object
        Value to check, or text with a unit, such as ``"400 km"``; a bool is not a number.
    low, high : float
        Allowed range, both ends included. [unit]
    unit : str
        Unit named in the error.

    Returns
    -------
    float
        Finite value. [unit]

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.

    Examples
    --------
    >>> within("scene.sun_zenith", 200.0, 0.0, 180.0, "deg")
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: scene.sun_zenith is 200.0; allowed: 0 to 180 deg
    >>> within("scene.altitude", "400 km", 0.0, 1e12, "m")
    400000.0
    """
    allowed = f"{low:g} to {high:g} {unit}" if low < high else f"{low:g} {unit}"
    if isinstance(value, str) and unit in _READ:
        try:
            value = quantity(value, unit, field)
        except ParameterError:
            expected = f"{allowed}, as a number or as text with a unit"
            raise ParameterError(field, value, expected) from None
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise ParameterError(field, value, allowed)
    if not low <= value <= high:
        raise ParameterError(field, value, allowed)
    return float(value)

"""Conversion and range check of scalar scene parameters."""

from __future__ import annotations

from typing import Final

from airlight.errors import ParameterError
from airlight.physics.units import Measure, quantity

#: Largest altitude of an observer, and a lower limit below every known basin. [m]
HIGHEST_ALTITUDE: Final = 1e12
DEEPEST_ALTITUDE: Final = -1e4


def within(field: str, value: Measure, low: float, high: float, unit: str) -> float:
    """Value as a float within limits.

    Parameters
    ----------
    field : str
        Field named in the error.
    value : float, str or quantity
        Value to check, see ``airlight.physics.units.quantity``; a bool is not a number.
    low, high : float
        Allowed range, both ends included. [unit]
    unit : str
        Unit of the range, and of a number without one.

    Returns
    -------
    float
        Finite value. [unit]

    Examples
    --------
    >>> within("scene.sun_zenith", 200.0, 0.0, 180.0, "deg")
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: scene.sun_zenith is 200.0; allowed: 0 to 180 deg
    >>> within("scene.altitude", "400 km", 0.0, 1e12, "m")
    400000.0
    """
    allowed = f"{low:g} to {high:g}" if low < high else f"{low:g}"
    allowed += "" if unit == "1" else f" {unit}"
    text = isinstance(value, str)
    expected = f"{allowed}, as a number or as text with a unit" if text else allowed
    number = quantity(value, unit, field, bare=not text, allowed=expected)
    if not low <= number <= high:
        raise ParameterError(field, value, allowed)
    return number

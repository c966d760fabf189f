"""The check at the door of the scene: a finite number between two limits."""

from __future__ import annotations

import numpy as np

from airlight.errors import ParameterError


def within(field: str, value: object, low: float, high: float, unit: str) -> float:
    """The value as a float, if it is a number between two limits.

    Parameters
    ----------
    field : str
        Named in the error.
    value : object
        What was given; a bool or a text is no number.
    low, high : float
        The allowed range, both ends included. [unit]
    unit : str
        Named in the error.

    Returns
    -------
    float
        Finite. [unit]

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
    """
    allowed = f"{low:g} to {high:g} {unit}" if low < high else f"{low:g} {unit}"
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise ParameterError(field, value, allowed)
    if not low <= value <= high:
        raise ParameterError(field, value, allowed)
    return float(value)

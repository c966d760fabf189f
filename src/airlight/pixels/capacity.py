"""Capacity of the shaders: what a graphics device can solve and draw."""

from __future__ import annotations

from airlight.errors import ParameterError
from airlight.pixels.shown import MOST_CONSTITUENTS, WAVELENGTHS


def check_capacity(wavelengths: int, constituents: int = 1) -> None:
    """Refuse what exceeds the capacity of the shaders.

    Parameters
    ----------
    wavelengths, constituents : int
        Number of wavelengths, and of constituents including the one that bends light.

    Raises
    ------
    ParameterError
        If there are too many wavelengths or constituents.

    Examples
    --------
    >>> check_capacity(5)
    Traceback (most recent call last):
    airlight.errors.ParameterError: wavelengths is 5; allowed: at most 4 on the GPU
    """
    if wavelengths > WAVELENGTHS:
        raise ParameterError("wavelengths", wavelengths, f"at most {WAVELENGTHS} on the GPU")
    if constituents > MOST_CONSTITUENTS:
        raise ParameterError(
            "constituents", constituents, f"at most {MOST_CONSTITUENTS} on the GPU"
        )

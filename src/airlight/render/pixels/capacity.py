"""Capacity of the shaders: largest numbers of wavelengths and constituents."""

from __future__ import annotations

from airlight.errors import ParameterError
from airlight.render.pixels.render_tables import MAX_CONSTITUENTS, WAVELENGTHS


def check_capacity(wavelengths: int, constituents: int = 1, *, field: str = "wavelengths") -> None:
    """Raise if wavelengths or constituents exceed the capacity of the shaders.

    Parameters
    ----------
    wavelengths, constituents : int
        Number of wavelengths, and of constituents including the refraction column.
    field : str
        Name of the wavelengths in the message.

    Examples
    --------
    >>> check_capacity(5)
    Traceback (most recent call last):
    airlight.errors.ParameterError: wavelengths is 5; allowed: at most 4 on the GPU
    """
    if wavelengths > WAVELENGTHS:
        raise ParameterError(field, wavelengths, f"at most {WAVELENGTHS} on the GPU")
    if constituents > MAX_CONSTITUENTS:
        raise ParameterError("constituents", constituents, f"at most {MAX_CONSTITUENTS} on the GPU")

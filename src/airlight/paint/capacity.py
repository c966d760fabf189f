"""Capacity of the shaders: planets that a graphics device can solve and draw."""

from __future__ import annotations

from typing import TYPE_CHECKING

from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet


def fits(planet: Planet, wavelengths: int) -> bool:
    """Whether the shaders have the capacity for a planet and a number of wavelengths.

    Parameters
    ----------
    planet : Planet
        Planet whose constituents the shaders must hold.
    wavelengths : int
        Number of wavelengths.
    """
    try:
        check_capacity(planet, wavelengths)
    except ParameterError:
        return False
    return True


def check_capacity(planet: Planet, wavelengths: int) -> None:
    """Refuse a planet that exceeds the capacity of the shaders.

    Parameters
    ----------
    planet : Planet
        Planet whose constituents the shaders must hold.
    wavelengths : int
        Number of wavelengths.

    Raises
    ------
    ParameterError
        If there are too many wavelengths or constituents.
    """
    from airlight.pixels.shown import MOST_CONSTITUENTS, WAVELENGTHS

    if wavelengths > WAVELENGTHS:
        raise ParameterError("--wavelengths", wavelengths, f"at most {WAVELENGTHS} on the GPU")
    constituents = len(planet.constituents) + (planet.refraction != "none")  # "bending" is one
    if constituents > MOST_CONSTITUENTS:
        allowed = f"at most {MOST_CONSTITUENTS} on the GPU"
        raise ParameterError("constituents", constituents, allowed)

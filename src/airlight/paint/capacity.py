"""Planets that a GPU has the capacity to solve and render."""

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
        check_planet(planet, wavelengths)
    except ParameterError:
        return False
    return True


def check_planet(planet: Planet, wavelengths: int) -> None:
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
    from airlight.pixels.capacity import check_capacity

    constituents = len(planet.constituents) + (planet.refraction != "none")  # "bending" is one
    check_capacity(wavelengths, constituents, field="--wavelengths")

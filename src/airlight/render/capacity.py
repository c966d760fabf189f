"""Capacity check of a planet for the GPU: wavelengths and constituents."""

from __future__ import annotations

from typing import TYPE_CHECKING

from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet


def fits(planet: Planet, wavelengths: int) -> bool:
    """Whether a planet and a number of wavelengths fit the shaders.

    Parameters
    ----------
    planet : Planet
        Planet, whose constituents are counted.
    """
    try:
        check_planet(planet, wavelengths)
    except ParameterError:
        return False
    return True


def check_planet(planet: Planet, wavelengths: int) -> None:
    """Raise if a planet exceeds the capacity of the shaders."""
    from airlight.render.pixels.capacity import check_capacity

    constituents = len(planet.constituents) + (planet.refraction != "none")  # "refraction" is one
    check_capacity(wavelengths, constituents)

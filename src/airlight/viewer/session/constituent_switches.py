"""A planet with some of its constituents switched off."""

from __future__ import annotations

from airlight.planets.parameters import replace
from airlight.planets.planet import Planet


def switched(planet: Planet, off: tuple[int, ...]) -> Planet:
    """The planet without what some constituents scatter and absorb; they keep their places.

    Parameters
    ----------
    planet : Planet
        Not changed.
    off : tuple of int
        Places of the constituents that are switched off.

    Returns
    -------
    Planet
        If no gas is left that bends light, it goes straight.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> earth = load_planet("earth-atmosphere-plus")
    >>> [one.scattering for one in switched(earth, (1,)).constituents][1:]
    [0.0, 0.0]
    """
    if not off:
        return planet
    constituents = tuple(
        replace(one, scattering=0.0, absorption=0.0, matter=None, phase_function=None)
        if index in off
        else one
        for index, one in enumerate(planet.constituents)
    )
    refraction = planet.refraction if any(one.bends for one in constituents) else "none"
    return replace(planet, constituents=constituents, refraction=refraction)

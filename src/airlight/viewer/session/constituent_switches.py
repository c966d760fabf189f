"""Planets with some of their constituents switched off."""

from __future__ import annotations

from airlight.planets.parameters import replace
from airlight.planets.planet import Planet


def switched(planet: Planet, off: tuple[int, ...]) -> Planet:
    """Planet in which some constituents neither scatter nor absorb; indices are unchanged.

    Parameters
    ----------
    planet : Planet
        Planet with all constituents; not modified.

    Returns
    -------
    Planet
        Planet without refraction if no refracting gas is left.

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

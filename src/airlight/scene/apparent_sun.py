"""Altitude at which the sun is seen through a planet's air."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from airlight.geometry.bending import raised_star
from airlight.planets.medium import Medium
from airlight.solvers.light_paths import LightPaths

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Wavelength whose bending is meant. [nm]
_WAVELENGTH = 550.0


def apparent_altitude(planet: Planet, altitude: float, sun_zenith: float) -> float | None:
    """Apparent altitude of the sun's centre; None where light goes straight or it is not seen.

    Parameters
    ----------
    planet : Planet
        Planet.
    altitude : float
        Altitude of the observer. [m]
    sun_zenith : float
        True zenith angle of the sun. [deg]

    Returns
    -------
    float or None
        Altitude above the horizontal. [deg]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> f"{apparent_altitude(load_planet('earth'), 0.0, 90.0):.2f}"  # refraction lifts the low sun
    '0.47'
    """
    low, high = planet.wavelength_limits
    medium = Medium.from_planet(planet, [min(max(_WAVELENGTH, low), high)])
    paths = LightPaths.of(medium)
    if paths.shell is None or altitude > planet.thickness:
        return None
    x = float(paths.optical_radius(np.array(planet.bottom_radius + altitude)))
    shell = paths.shell
    true = math.cos(math.radians(sun_zenith))
    seen = float(raised_star(x, true, shell.bottom, shell.top, paths.lift))
    lowest = -math.sqrt(max(1.0 - (shell.bottom / x) ** 2, 0.0))
    return None if seen < lowest else math.degrees(math.asin(seen))

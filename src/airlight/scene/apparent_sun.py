"""Apparent altitude of sun and moon under refraction."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from airlight.geometry.refraction import apparent_sun_cosine
from airlight.planets.medium import Medium
from airlight.solver.refracted_geometry import RefractedGeometry

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Wavelength whose refractivity is used. [nm]
_WAVELENGTH = 550.0
#: Number of bisections of the apparent zenith angle.
_HALVINGS = 50
#: Depth below the horizon, over the refraction there, from which refraction is 0.
_FADED = 4.0


def apparent_altitude(planet: Planet, altitude: float, sun_zenith: float) -> float | None:
    """Apparent altitude of the sun's centre; None without refraction or if it is not visible.

    Parameters
    ----------
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
    geometry = _geometry(planet)
    if geometry.shell is None or altitude > planet.thickness:
        return None
    x = float(geometry.optical_radius(np.array(planet.bottom_radius + altitude)))
    shell = geometry.shell
    true = math.cos(math.radians(sun_zenith))
    seen = float(apparent_sun_cosine(x, true, shell.bottom, shell.top, geometry.refraction_table))
    lowest = -math.sqrt(max(1.0 - (shell.bottom / x) ** 2, 0.0))
    return None if seen < lowest else math.degrees(math.asin(seen))


def apparent_zenith(planet: Planet, altitude: float, zenith: float) -> float:
    """Apparent zenith angle of a body at infinity, from inside or outside the atmosphere.

    Below the horizon, refraction fades out with depth from its value on the horizon, so that a
    camera that follows a setting sun moves continuously.

    Parameters
    ----------
    zenith : float
        True zenith angle. [deg]

    Returns
    -------
    float
        Apparent zenith angle. [deg]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> f"{apparent_zenith(load_planet('earth'), 0.0, 90.0):.2f}"
    '89.53'
    """
    geometry = _geometry(planet)
    if geometry.shell is None:
        return zenith
    shell, r = geometry.shell, planet.bottom_radius + altitude
    outside = altitude > planet.thickness
    x = r if outside else float(geometry.optical_radius(np.array(r)))

    def true(seen: float) -> float:
        at, mu = x, math.cos(math.radians(seen))
        if outside:
            sine = x * math.sin(math.radians(seen)) / shell.top
            if mu >= 0.0 or sine >= 1.0:
                return seen
            at, mu = shell.top, -math.sqrt(1.0 - sine * sine)
        return seen + math.degrees(
            float(geometry.refraction_angle(np.array([at]), np.array([mu]))[0])
        )

    # slightly above the horizon, so that rounding does not direct the ray into the ground
    horizon = 180.0 - math.degrees(math.asin(min(shell.bottom / x * (1.0 + 1e-12), 1.0)))
    lift = true(horizon) - horizon
    hidden = zenith - horizon - lift
    if hidden >= 0.0:
        return zenith - lift * max(1.0 - hidden / max(_FADED * lift, 1e-12), 0.0)
    low, high = 0.0, horizon
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if true(middle) < zenith else (low, middle)
    return 0.5 * (low + high)


def _geometry(planet: Planet) -> RefractedGeometry:
    low, high = planet.wavelength_limits
    return RefractedGeometry.of(
        Medium.from_planet(planet.without_clouds, [min(max(_WAVELENGTH, low), high)])
    )

"""Planet whose ground is the floor of a basin, below the zero of altitudes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.world import WORLDS
from airlight.physics.optics.density_profile import Row
from airlight.physics.units import Measure, quantity
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.parameters import instance_of, parameters, replace
from airlight.planets.reading.reader import PlanetLike, load_planet

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Height of the observer above the floor of a basin. [m]
EYES: Final = 2.0
#: Scale heights below the reference level beyond which nothing is continued.
_MOST: Final = 10.0


@parameters
class Continued(Profile):
    """Profile over a ground below its reference level.

    Below the reference level the density continues with its local scale height: exact for an
    exponential, error 4e-4 for 440 m of the U.S. Standard Atmosphere.

    Parameters
    ----------
    profile : Profile
        Profile above the reference level.
    depth : float
        Depth of the ground below the reference level. [m]

    Examples
    --------
    >>> from airlight.planets.matter.profiles import Exponential
    >>> edges, pieces = Continued(profile=Exponential(scale_height=8e3), depth=8e3).row(108e3)
    >>> edges.tolist(), f"{pieces[0, 0]:.6f}"  # e times the density, at the ground
    ([0.0, 8000.0, 108000.0], '2.718282')
    """

    profile: Annotated[Profile, instance_of(Profile)]
    depth: float

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        edges, pieces = self.profile.row(thickness - self.depth)
        a, b, c, d = (float(one) for one in pieces[0])
        density = max(a + d, 0.0)
        rate = (a * b + c) / density if density > 0.0 else 0.0
        if -rate * self.depth > _MOST:
            allowed = f"at least {self.depth / _MOST:.4g} m to be continued {self.depth:.4g} m down"
            raise ParameterError("scale height at the reference level", -1.0 / rate, allowed)
        below = np.array([[density * np.exp(-rate * self.depth), rate, 0.0, 0.0]])
        return np.append(0.0, edges + self.depth), np.concatenate([below, pieces])

    def column(self, thickness: float) -> float:
        """Vertical column above the reference level. [m]"""
        return self.profile.column(thickness - self.depth)


def lowered_ground(planet: PlanetLike, altitude: Measure) -> Planet:
    """Planet with all of its ground lowered to an altitude below 0.

    Profiles are continued below their reference level, see ``Continued``; optical depths and
    columns of the planet's file refer to the part above it. Altitudes count from the new ground.

    Parameters
    ----------
    planet : Planet, str, Path or Solution
        Planet, see ``load_planet``; it is returned as it is for an altitude of 0 or more.
    altitude : float
        Altitude of the floor, down to the deepest basin of the planet's ``body``. [m]

    Returns
    -------
    Planet

    Raises
    ------
    ParameterError
        If the planet has no such basin.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> shore = lowered_ground(load_planet("earth"), -430.0)  # the Dead Sea
    >>> shore.bottom_radius, shore.top_radius
    (6370570.0, 6471000.0)
    """
    planet, altitude = load_planet(planet), quantity(altitude, "m", "altitude", bare=True)
    if altitude >= 0.0:
        return planet
    _deepest(planet, altitude)
    depth, ground = -altitude, planet.ground
    return replace(
        planet,
        bottom_radius=planet.bottom_radius - depth,
        ground=replace(ground, cloud_altitude=ground.cloud_altitude + depth),
        constituents=tuple(
            replace(one, profile=Continued(profile=one.profile, depth=depth))
            for one in planet.constituents
        ),
    )


def stands_on_floor(planet: Planet, altitude: float) -> tuple[Planet, float]:
    """Planet lowered to an observer at negative altitude, and the altitude above its ground. [m]

    Parameters
    ----------
    planet : Planet
        Planet; returned unchanged with an altitude of 0 or more.
    altitude : float
        Altitude of the observer, who is ``EYES`` above the ground, or less at the bottom of the
        basin. [m]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> shore, height = stands_on_floor(load_planet("earth"), -430.0)
    >>> shore.bottom_radius, height
    (6370568.0, 2.0)
    """
    if altitude >= 0.0:
        return planet, altitude
    floor = max(altitude - EYES, _deepest(planet, altitude))
    return lowered_ground(planet, floor), altitude - floor


def _deepest(planet: Planet, altitude: float) -> float:
    """Deepest basin of a planet, at or below an altitude. [m]"""
    if planet.body is None:
        allowed = "0 m or more: a planet without a body has no known basins"
        raise ParameterError("altitude", altitude, allowed)
    basin = WORLDS[planet.body].deepest_basin
    if not altitude >= basin:
        allowed = f"{basin:g} m, the deepest basin of {planet.body}, or more"
        raise ParameterError("altitude", altitude, allowed)
    return basin

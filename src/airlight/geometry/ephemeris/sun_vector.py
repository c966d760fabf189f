"""Direction of the sun from a world, in its rotating frame."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.ephemeris.instant import ephemeris_time
from airlight.geometry.ephemeris.world import World
from airlight.physics.constants import ASTRONOMICAL_UNIT, SPEED_OF_LIGHT

FloatArray = NDArray[np.float64]
#: Seconds of a day.
_DAY = 86400.0


class SolarPoint(NamedTuple):
    """Subsolar point of a world, and the season.

    Attributes
    ----------
    latitude, longitude : float
        Planetocentric coordinates, longitude -180 to 180, east positive; on Earth the latitude is
        the sun's declination. [deg]
    distance : float
        Distance to the centre of the sun. [m]
    solar_longitude : float
        Angle Ls of the sun along its apparent orbit from the northern spring equinox, 0 to 360: on
        Mars the areocentric solar longitude, on Titan Saturn's season. [deg]
    """

    latitude: float
    longitude: float
    distance: float
    solar_longitude: float


def solar_point(world: World, days: float) -> SolarPoint:
    """Subsolar point.

    Parameters
    ----------
    days : float
        Days since 2000-01-01 12:00 UTC, without light travel time.

    Notes
    -----
    Apparent position, with aberration by the world's orbital motion. Neglected: parallax between
    centre and ground, at most 0.0024° (included in ``sun_seen`` on Earth), and Titan's motion about
    Saturn in the aberration (0.001°).

    Examples
    --------
    The equinox of Saturn of 11 August 2009:

    >>> from airlight.geometry.ephemeris.world import world_named
    >>> abs(solar_point(world_named("titan"), 3510.0).latitude) < 0.3
    True
    """
    return _earth_point(days) if world.name == "earth" else _point(world, days)


def _earth_point(days: float) -> SolarPoint:
    from astronomy import Body, GeoVector, RotateVector, Rotation_EQJ_EQD, SiderealTime, SunPosition

    time = ephemeris_time(days)
    vector = RotateVector(Rotation_EQJ_EQD(time), GeoVector(Body.Sun, time, aberration=True))
    flat = math.hypot(vector.x, vector.y)
    east = math.degrees(math.atan2(vector.y, vector.x)) - 15.0 * SiderealTime(time)
    return SolarPoint(
        latitude=math.degrees(math.atan2(vector.z, flat)),
        longitude=math.remainder(east, 360.0),
        distance=ASTRONOMICAL_UNIT * math.hypot(flat, vector.z),
        solar_longitude=SunPosition(time).elon % 360.0,
    )


def _point(world: World, days: float) -> SolarPoint:
    from astronomy import Body, HelioState

    time = ephemeris_time(days)
    node, across, pole = _axes(world, days)
    state = HelioState(Body[world.orbit], time)
    place = np.array([state.x, state.y, state.z]) * ASTRONOMICAL_UNIT
    speed = np.array([state.vx, state.vy, state.vz]) * ASTRONOMICAL_UNIT / _DAY
    away = place
    if world.orbit_radius:
        turn = math.radians(_meridian(world, days))
        away = place - world.orbit_radius * (math.cos(turn) * node + math.sin(turn) * across)
    distance = float(np.linalg.norm(away))
    seen = -away / distance + speed / SPEED_OF_LIGHT
    seen /= np.linalg.norm(seen)
    north = float(seen @ pole)
    along = math.degrees(math.atan2(seen @ across, seen @ node))
    # Ls: from the node where the sun's apparent orbit crosses the equator northwards.
    normal = np.cross(place, speed)
    spring = np.cross(pole, normal)
    ahead = np.cross(normal, spring) / np.linalg.norm(normal)
    season = math.degrees(math.atan2(seen @ ahead, seen @ spring))
    return SolarPoint(
        latitude=math.degrees(math.asin(min(max(north, -1.0), 1.0))),
        longitude=math.remainder(along - _meridian(world, days), 360.0),
        distance=distance,
        solar_longitude=season % 360.0,
    )


def meridian_axes(
    world: World, days: float, longitude: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Point of the equator at a longitude, east of it, and north pole; unit vectors of the ICRF.

    Parameters
    ----------
    world : World
        World other than Earth.
    days : float
        Days since 2000-01-01 12:00 UTC.
    longitude : float
        Longitude, east positive. [deg]
    """
    node, across, pole = _axes(world, days)
    turn = math.radians(_meridian(world, days) + longitude)
    out = math.cos(turn) * node + math.sin(turn) * across
    return out, np.cross(pole, out), pole


def _axes(world: World, days: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Ascending node of the equator, 90° east of it, and north pole; unit vectors of the ICRF."""
    if world.spin is not None:
        ascension, declination = world.spin.right_ascension, world.spin.declination
    else:
        from astronomy import Body, RotationAxis

        axis = RotationAxis(Body[world.orbit], ephemeris_time(days))
        ascension, declination = 15.0 * axis.ra, axis.dec
    a, d = math.radians(ascension), math.radians(declination)
    pole = np.array([math.cos(d) * math.cos(a), math.cos(d) * math.sin(a), math.sin(d)])
    node = np.array([-math.sin(a), math.cos(a), 0.0])
    return node, np.cross(pole, node), pole


def _meridian(world: World, days: float) -> float:
    """Angle from the ascending node of the equator to the prime meridian. [deg]"""
    time = ephemeris_time(days)
    if world.spin is not None:
        return float(world.spin.meridian + world.spin.rate * time.tt)
    from astronomy import Body, RotationAxis

    return float(RotationAxis(Body[world.orbit], time).spin)

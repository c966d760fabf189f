"""Local solar time, and the season by the sun's longitude."""

from __future__ import annotations

import math

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.geometry.ephemeris.world import World

#: Number of iterations for a season, each of which reduces the error to a fifth or less.
_STEPS = 60
_CLOSE = 1e-7


def true_solar_time(world: World, longitude: float, days: float) -> float:
    """Local true solar time: 12 when the sun crosses the meridian; a solar day has 24 hours. [h]

    Parameters
    ----------
    longitude : float
        Longitude, east positive. [deg]
    days : float
        Days since 2000-01-01 12:00 UTC.
    """
    point = solar_point(world, days)
    return (12.0 + (longitude - point.longitude) / 15.0) % 24.0


def time_of_season(world: World, solar_longitude: float, after: float) -> float:
    """First time at which the sun's longitude Ls has a value. [day]

    Parameters
    ----------
    solar_longitude : float
        Longitude Ls: 0 spring, 90 summer, 180 autumn, 270 winter of the northern half; 0 to 360.
        [deg]
    after : float
        Earliest time, days since 2000-01-01 12:00 UTC.

    Raises
    ------
    ParameterError
        If the longitude is outside its range.

    Examples
    --------
    >>> from airlight.geometry.ephemeris.instant import time_at
    >>> from airlight.geometry.ephemeris.world import world_named
    >>> time_at(time_of_season(world_named("mars"), 0.0, 7000.0)).date().isoformat()  # Mars year 35
    '2019-03-23'
    """
    if not 0.0 <= solar_longitude <= 360.0:
        raise ParameterError("solar_longitude", solar_longitude, "0 to 360 deg")
    now = solar_point(world, after).solar_longitude
    rate = world.year / 360.0
    days = after + rate * ((solar_longitude - now) % 360.0)
    for _ in range(_STEPS):
        now = solar_point(world, days).solar_longitude
        step = math.remainder(solar_longitude - now, 360.0)
        if abs(step) < _CLOSE:
            break
        days += rate * step
    return days if days >= after - 1e-3 else time_of_season(world, solar_longitude, days + 1.0)

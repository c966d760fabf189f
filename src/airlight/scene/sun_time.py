"""Position of the sun by local solar time and declination, and the inverse.

The formulas are in the Python subset that is also emitted as JavaScript.
"""

from __future__ import annotations

import math
from typing import Final

from airlight.geometry.ephemeris.sun_formula import days_of_date, point_below_sun
from airlight.scene.great_circle import DEGREE, RADIAN, bearing_of

#: Rotation of the sky in an hour. [deg]
_HOUR: Final = 15.0


def sun_at(latitude: float, declination: float, hour: float) -> tuple[float, float]:
    """Zenith angle and compass bearing of the sun from declination and local solar time. [deg]

    Parameters
    ----------
    latitude, declination : float
        Geographic latitude and the sun's declination. [deg]
    hour : float
        Local solar time: 12 when the sun is highest; a planet's day has 24. [h]

    Examples
    --------
    >>> zenith, azimuth = sun_at(50.0, 0.0, 6.0)  # at the equinox it rises in the east at six
    >>> round(zenith, 9), round(azimuth, 9)
    (90.0, 90.0)
    """
    turn, tilt = _HOUR * (12.0 - hour) * RADIAN, declination * RADIAN
    out, east, pole = (
        math.cos(tilt) * math.cos(turn),
        math.cos(tilt) * math.sin(turn),
        math.sin(tilt),
    )
    sine, cosine = math.sin(latitude * RADIAN), math.cos(latitude * RADIAN)
    up, north = cosine * out + sine * pole, cosine * pole - sine * out
    return math.atan2(math.hypot(north, east), up) * DEGREE, bearing_of(north, east, 180.0)


def time_of(latitude: float, zenith: float, azimuth: float) -> tuple[float, float]:
    """Declination [deg] and local solar time [h] of the sun from its direction; see ``sun_at``.

    Examples
    --------
    >>> declination, hour = time_of(50.0, *sun_at(50.0, 20.0, 15.5))
    >>> round(declination, 9), round(hour, 9)
    (20.0, 15.5)
    """
    flat, up = math.sin(zenith * RADIAN), math.cos(zenith * RADIAN)
    north, east = flat * math.cos(azimuth * RADIAN), flat * math.sin(azimuth * RADIAN)
    sine, cosine = math.sin(latitude * RADIAN), math.cos(latitude * RADIAN)
    out, pole = cosine * up - sine * north, sine * up + cosine * north
    hour = 12.0 - math.atan2(east, out) * DEGREE / _HOUR
    return math.atan2(pole, math.hypot(out, east)) * DEGREE, hour - 24.0 * math.floor(hour / 24.0)


def sun_on_date(
    world: float, latitude: float, longitude: float, year: float, day: float, hour: float
) -> tuple[float, float]:
    """Zenith angle and compass bearing of the sun at a place and date. [deg]

    Parameters
    ----------
    world : float
        Index in ``airlight.geometry.ephemeris.sun_formula.NUMBERED``.
    latitude, longitude : float
        Place, north and east positive. [deg]
    year, day, hour : float
        Year, day of the year from 1, and time, UTC [h].

    Examples
    --------
    >>> zenith, azimuth = sun_on_date(0.0, 59.33, 18.07, 2026.0, 172.0, 20.0 + 10.0 / 60.0)
    >>> f"{zenith:.1f} {azimuth:.1f}"  # Stockholm, 21 June, two minutes after sunset
    '91.0 323.9'
    """
    north, east, _ = point_below_sun(world, days_of_date(year, day, hour))
    return sun_at(latitude, north, 12.0 + (longitude - east) / _HOUR)

"""Moon in the sky of a place on Earth by a short analytic theory, for live pictures.

In the Python subset that is also emitted as JavaScript. From 1950 to 2050 the error is at most
0.09°, 0.022° on average; ``ephemeris.sky`` is more accurate and slower. The phase is
topocentric, up to 1° from the geocentric one.

Longitude and latitude: the fourteen largest terms of Brown's theory, after Montenbruck & Pfleger,
Astronomy on the Personal Computer (4th edition, 2000), section 3.2. Parallax: Astronomical Almanac,
Low-precision formulae for geocentric coordinates of the Moon, section D. Sidereal time: IAU (1982).
"""

from __future__ import annotations

import math
from typing import Final

from airlight.geometry.ephemeris.sun_formula import days_of_date, point_below_sun

_RADIAN: Final = math.pi / 180.0
_ARCSECOND: Final = math.pi / 648000.0
#: Terrestrial minus universal time, as in ``sun_formula``. [day]
_AHEAD: Final = 63.5 / 86400.0
#: Radius of the Moon over that of Earth's equator; astronomical unit over the latter. [1]
_MOON: Final = 1737.4 / 6378.137
_UNIT: Final = 149597870.7 / 6378.137


def _turns(x: float) -> float:
    """Angle of a number of turns, modulo one turn. [rad]"""
    return 2.0 * math.pi * (x - math.floor(x))


def moon_place(days: float) -> tuple[float, float, float]:
    """Ecliptic longitude and latitude of the Moon, of date, and its distance.

    Parameters
    ----------
    days : float
        Days since 2000-01-01 12:00 UTC.

    Returns
    -------
    longitude, latitude : float
        Geocentric, of the ecliptic and equinox of date. [rad]
    distance : float
        Distance of the centres, in radii of Earth's equator. [1]

    Examples
    --------
    >>> _, _, distance = moon_place(0.0)
    >>> round(distance)
    63
    """
    t = (days + _AHEAD) / 36525.0
    mean = 0.606433 + 1336.855225 * t
    l = _turns(0.374897 + 1325.552410 * t)
    s = _turns(0.993133 + 99.997361 * t)
    d = _turns(0.827361 + 1236.853086 * t)
    f = _turns(0.259086 + 1342.227825 * t)
    along = (
        22640.0 * math.sin(l) - 4586.0 * math.sin(l - 2.0 * d) + 2370.0 * math.sin(2.0 * d)
        + 769.0 * math.sin(2.0 * l) - 668.0 * math.sin(s) - 412.0 * math.sin(2.0 * f)
        - 212.0 * math.sin(2.0 * l - 2.0 * d) - 206.0 * math.sin(l + s - 2.0 * d)
        + 192.0 * math.sin(l + 2.0 * d) - 165.0 * math.sin(s - 2.0 * d) - 125.0 * math.sin(d)
        - 110.0 * math.sin(l + s) + 148.0 * math.sin(l - s) - 55.0 * math.sin(2.0 * f - 2.0 * d)
    )  # fmt: skip
    argument = f + (along + 412.0 * math.sin(2.0 * f) + 541.0 * math.sin(s)) * _ARCSECOND
    h = f - 2.0 * d
    across = (
        -526.0 * math.sin(h)
        + 44.0 * math.sin(l + h)
        - 31.0 * math.sin(h - l)
        - 23.0 * math.sin(s + h)
        + 11.0 * math.sin(h - s)
        - 25.0 * math.sin(f - 2.0 * l)
        + 21.0 * math.sin(f - l)
    )
    longitude = _turns(mean) + along * _ARCSECOND
    latitude = (18520.0 * math.sin(argument) + across) * _ARCSECOND
    parallax = (
        0.9508
        + 0.0518 * math.cos((134.9 + 477198.85 * t) * _RADIAN)
        + 0.0095 * math.cos((259.2 - 413335.38 * t) * _RADIAN)
        + 0.0078 * math.cos((235.7 + 890534.23 * t) * _RADIAN)
        + 0.0028 * math.cos((269.9 + 954397.70 * t) * _RADIAN)
    )
    return longitude, latitude, 1.0 / math.sin(parallax * _RADIAN)


def moon_at(latitude: float, longitude: float, days: float) -> tuple[float, float, float, float]:
    """Topocentric position of the Moon in the sky, without refraction.

    Parameters
    ----------
    latitude, longitude : float
        Place, north and east positive. [deg]
    days : float
        Days since 2000-01-01 12:00 UTC.

    Returns
    -------
    zenith, azimuth : float
        True zenith angle, and compass bearing, -180 to 180. [deg]
    phase : float
        Phase angle, 0 full, 180 new. [deg]
    radius : float
        Angular radius. [deg]

    Examples
    --------
    Stockholm, 21 June 2026, 20:10 UTC; the ephemeris: 15.61° high, bearing 235.1°

    >>> zenith, azimuth, phase, radius = moon_at(59.33, 18.07, 9668.0 + 8.0 / 24.0 + 10.0 / 1440.0)
    >>> f"{90.0 - zenith:.1f} {azimuth + 360.0:.0f}"
    '15.6 235'
    """
    along, up, distance = moon_place(days)
    century = days / 36525.0
    tilt = (23.43929 - 0.01300 * century) * _RADIAN
    flat = distance * math.cos(up)
    x = flat * math.cos(along)
    level = flat * math.sin(along)
    height = distance * math.sin(up)
    y = level * math.cos(tilt) - height * math.sin(tilt)
    z = level * math.sin(tilt) + height * math.cos(tilt)
    turn = (280.46061837 + 360.98564736629 * days + longitude) * _RADIAN
    # towards the local meridian, east and the pole, from the place itself
    lift = latitude * _RADIAN
    out = math.cos(turn) * x + math.sin(turn) * y - math.cos(lift)
    east = math.cos(turn) * y - math.sin(turn) * x
    pole = z - math.sin(lift)
    high = math.cos(lift) * out + math.sin(lift) * pole
    north = math.cos(lift) * pole - math.sin(lift) * out
    away = math.sqrt(out * out + east * east + pole * pole)
    zenith = math.atan2(math.sqrt(north * north + east * east), high) / _RADIAN
    # the sun from the Moon, in the same axes
    below, beside, far = point_below_sun(0.0, days)
    hour = (beside - longitude) * _RADIAN
    sun = far * _UNIT * math.cos(below * _RADIAN)
    a, b = sun * math.cos(hour) - out, sun * math.sin(hour) - east
    c = far * _UNIT * math.sin(below * _RADIAN) - pole
    aside_x, aside_y, aside_z = b * pole - c * east, c * out - a * pole, a * east - b * out
    across = math.sqrt(aside_x * aside_x + aside_y * aside_y + aside_z * aside_z)
    phase = math.atan2(across, -(a * out + b * east + c * pole)) / _RADIAN
    radius = math.atan2(_MOON, math.sqrt(away * away - _MOON * _MOON)) / _RADIAN
    return zenith, math.atan2(east, north) / _RADIAN, phase, radius


def moon_on_date(
    latitude: float, longitude: float, year: float, day: float, hour: float
) -> tuple[float, float, float, float]:
    """Moon at a place and date; results of ``moon_at``.

    Parameters
    ----------
    latitude, longitude : float
        Place on Earth, north and east positive. [deg]
    year, day, hour : float
        Year, day of the year from 1, and time, UTC [h].
    """
    return moon_at(latitude, longitude, days_of_date(year, day, hour))

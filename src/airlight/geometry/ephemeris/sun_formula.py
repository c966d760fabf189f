"""Subsolar point by a short analytic theory, for live pictures.

In the Python subset that is also emitted as JavaScript. Orbital elements and rotation are linear in
time; perturbations and nutation are neglected. From 1950 to 2050 the error is at most 0.01° on
Earth, 0.05° on Mars and 0.25° on Titan; ``ephemeris.sky`` is more accurate and slower.

Elements: Standish & Williams, Approximate positions of the planets (JPL Solar System Dynamics),
table 1, valid from 1800 to 2050, J2000 ecliptic and equinox. Rotation of Mars and Titan: Archinal
et al. (2018), Celestial Mechanics and Dynamical Astronomy 130, 22, the long terms of Mars taken at
J2000; of Earth, the mean sidereal time of the IAU (1982) and the precession of Lieske et al.
(1977).
"""

from __future__ import annotations

import math
from typing import Final

_RADIAN: Final = math.pi / 180.0
#: Terrestrial minus universal time at J2000, and its rate; from 1950 to 2026 within 10 s. [day]
_AHEAD: Final = 63.5 / 86400.0
_GAIN: Final = 0.6 / 86400.0 / 365.25
#: Light time of an astronomical unit. [day]
_LIGHT: Final = 499.0047838 / 86400.0
#: Obliquity of the ecliptic at J2000. [deg]
_OBLIQUITY: Final = 23.43928
#: Worlds in the order of the tables below.
NUMBERED: Final = ("earth", "mars", "titan")


def orbit_of(world: float, century: float) -> tuple[float, float, float, float, float, float]:
    """Elements of an orbit, some centuries after J2000; worlds as in ``NUMBERED``.

    Semimajor axis [au], eccentricity [1], inclination, mean longitude, and the longitudes of the
    perihelion and of the ascending node [deg].
    """
    t = century
    if world == 1:
        return (
            1.52371034 + 0.00001847 * t,
            0.09339410 + 0.00007882 * t,
            1.84969142 - 0.00813131 * t,
            -4.55343205 + 19140.30268499 * t,
            -23.94362959 + 0.44441088 * t,
            49.55953891 - 0.29257343 * t,
        )
    if world == 2:
        return (
            9.53667594 - 0.00125060 * t,
            0.05386179 - 0.00050991 * t,
            2.48599187 + 0.00193609 * t,
            49.95424423 + 1222.49362201 * t,
            92.59887831 - 0.41897216 * t,
            113.66242448 - 0.28867794 * t,
        )
    return (
        1.00000261 + 0.00000562 * t,
        0.01671123 - 0.00004392 * t,
        -0.00001531 - 0.01294668 * t,
        100.46457166 + 35999.37244981 * t,
        102.93768193 + 0.32327364 * t,
        0.0,
    )


def spin_of(world: float, days: float) -> tuple[float, float, float]:
    """Right ascension and declination of the pole, and angle of the prime meridian. [deg]"""
    t = days / 36525.0
    if world == 1:
        return (
            317.68110 - 0.1086 * t,
            52.88634 - 0.0616 * t,
            176.63181 + 350.891982443297 * (days + _AHEAD + _GAIN * days),
        )
    if world == 2:
        return 39.4827, 83.4279, 186.5855 + 22.5769768 * (days + _AHEAD)
    return -0.641 * t, 90.0 - 0.557 * t, 190.46062 + 360.98564737 * days - 0.641 * t


def point_below_sun(world: float, days: float) -> tuple[float, float, float]:
    """Latitude and longitude of the subsolar point, and the sun's distance.

    Parameters
    ----------
    world : int
        Index in ``NUMBERED``.
    days : float
        Days since 2000-01-01 12:00 UTC.

    Returns
    -------
    latitude, longitude : float
        Planetocentric, east, -180 to 180. [deg]
    distance : float
        Distance. [au]

    Examples
    --------
    >>> latitude, longitude, distance = point_below_sun(1, 4.5)  # Mars24: 174.7272° W
    >>> f"{latitude:.1f} {longitude:.1f} {distance:.3f}"
    '-25.0 -174.7 1.394'
    """
    # the sun's direction is that of the light which left it: planetary aberration
    mean_axis = 1.0
    if world == 1:
        mean_axis = 1.524
    if world == 2:
        mean_axis = 9.54
    century = (days + _AHEAD - _LIGHT * mean_axis) / 36525.0
    axis, shape, tilt, along, perihelion, node = orbit_of(world, century)
    mean = (along - perihelion) * _RADIAN
    anomaly = mean
    for _step in range(8):
        anomaly = mean + shape * math.sin(anomaly)
    ahead = axis * (math.cos(anomaly) - shape)
    aside = axis * math.sqrt(1.0 - shape * shape) * math.sin(anomaly)
    distance = axis * (1.0 - shape * math.cos(anomaly))
    # in the plane from the node, then to the ecliptic and to the equator of J2000
    turn = (perihelion - node) * _RADIAN
    flat = ahead * math.cos(turn) - aside * math.sin(turn)
    rise = ahead * math.sin(turn) + aside * math.cos(turn)
    lean, ascend = tilt * _RADIAN, node * _RADIAN
    x = flat * math.cos(ascend) - rise * math.cos(lean) * math.sin(ascend)
    level = flat * math.sin(ascend) + rise * math.cos(lean) * math.cos(ascend)
    height = rise * math.sin(lean)
    oblique = _OBLIQUITY * _RADIAN
    y = level * math.cos(oblique) - height * math.sin(oblique)
    z = level * math.sin(oblique) + height * math.cos(oblique)
    ascension, declination, meridian = spin_of(world, days)
    a, d = ascension * _RADIAN, declination * _RADIAN
    # components of the sun's direction, -(x, y, z): to the equator's node, east of it, to the pole
    east = math.cos(a) * x + math.sin(a) * y
    nodal = math.sin(a) * x - math.cos(a) * y
    across = math.sin(d) * east - math.cos(d) * z
    pole = -math.cos(d) * east - math.sin(d) * z
    longitude = math.atan2(across, nodal) / _RADIAN - meridian
    latitude = math.atan2(pole, math.sqrt(across * across + nodal * nodal)) / _RADIAN
    return latitude, longitude - 360.0 * math.floor(longitude / 360.0 + 0.5), distance


def days_of_date(year: float, day: float, hour: float) -> float:
    """Days since 2000-01-01 12:00 UTC of a date.

    Parameters
    ----------
    year : float
        Whole number.
    day : float
        Day of the year, 1 to 366.
    hour : float
        Time, UTC. [h]

    Examples
    --------
    >>> days_of_date(2026.0, 172.0, 20.0)  # 21 June
    9668.333333333334
    """
    before = year - 1.0
    leaps = math.floor(before / 4.0) - math.floor(before / 100.0) + math.floor(before / 400.0)
    return 365.0 * (year - 2000.0) + leaps - 484.0 + day - 1.5 + hour / 24.0


def date_after(year: float, day: float, hour: float, hours: float) -> tuple[float, float, float]:
    """Year, day of the year, 1 to 366, and hour, 0 to 24, some hours after a date. [h]

    Examples
    --------
    >>> date_after(2024.0, 366.0, 23.5, 1.0)
    (2025.0, 1.0, 0.5)
    >>> date_after(2026.0, 1.0, 0.0, -24.0)
    (2025.0, 365.0, 0.0)
    """
    first, later = year, hour + hours
    passed = day + math.floor(later / 24.0)
    while passed < 1.0:
        first -= 1.0
        passed += days_of_date(first + 1.0, 1.0, 0.0) - days_of_date(first, 1.0, 0.0)
    length = days_of_date(first + 1.0, 1.0, 0.0) - days_of_date(first, 1.0, 0.0)
    while passed > length:
        passed -= length
        first += 1.0
        length = days_of_date(first + 1.0, 1.0, 0.0) - days_of_date(first, 1.0, 0.0)
    return first, passed, later - 24.0 * math.floor(later / 24.0)

"""Great circles: positions and directions after a movement over a sphere.

The formulas are in the Python subset that is also emitted as JavaScript, for flight on the page.
"""

from __future__ import annotations

import math
from typing import Final

#: Factor from degrees to radians. [1]
RADIAN: Final = math.pi / 180.0
DEGREE: Final = 180.0 / math.pi
#: Angle from the zenith below which a direction has no azimuth. [rad]
_UPRIGHT: Final = 1e-12


def compass(angle: float) -> float:
    """Bearing normalised to 0 to 360. [deg]

    Parameters
    ----------
    angle : float
        Bearing, of any number of turns. [deg]

    Examples
    --------
    >>> compass(-90.0), compass(725.0)
    (270.0, 5.0)
    """
    return angle - 360.0 * math.floor(angle / 360.0)


def bearing_of(north: float, east: float, otherwise: float) -> float:
    """Compass bearing of a direction by its horizontal components. [deg]

    Parameters
    ----------
    north, east : float
        Components of a unit vector. [1]
    otherwise : float
        Bearing to return for a vertical direction. [deg]

    Examples
    --------
    >>> bearing_of(0.0, 1.0, 7.0), bearing_of(0.0, 0.0, 7.0)
    (90.0, 7.0)
    """
    level = math.hypot(north, east)
    found = compass(math.atan2(east, north) * DEGREE)
    return found if level >= _UPRIGHT else otherwise


def travelled(
    latitude: float, longitude: float, course: float, angle: float
) -> tuple[float, float, float]:
    """Latitude, longitude and course at the end of a great-circle path. [deg]

    Parameters
    ----------
    latitude, longitude : float
        Position at the start. [deg]
    course : float
        Compass bearing at the start. [deg]
    angle : float
        Length of the path, seen from the sphere's centre. [rad]

    Examples
    --------
    >>> quarter = travelled(0.0, 10.0, 90.0, math.pi / 2.0)  # of the equator
    >>> [round(one, 9) for one in quarter]
    [0.0, 100.0, 90.0]
    """
    # Components in the frame of the first meridian: in the equator's plane, east, north.
    sine, cosine = math.sin(latitude * RADIAN), math.cos(latitude * RADIAN)
    northward, eastward = math.cos(course * RADIAN), math.sin(course * RADIAN)
    far, near = math.sin(angle), math.cos(angle)
    out = cosine * near - sine * northward * far
    east = eastward * far
    north = sine * near + cosine * northward * far
    along_out = -sine * northward * near - cosine * far
    along_east = eastward * near
    along_north = cosine * northward * near - sine * far
    turn = math.atan2(east, out)
    flat = math.hypot(out, east)
    outward = along_out * math.cos(turn) + along_east * math.sin(turn)
    ahead = along_north * flat - north * outward
    aside = along_east * math.cos(turn) - along_out * math.sin(turn)
    return (
        math.atan2(north, flat) * DEGREE,
        compass(longitude + turn * DEGREE + 180.0) - 180.0,
        bearing_of(ahead, aside, course),
    )


def carried_star(
    zenith: float, bearing: float, course: float, angle: float, new_course: float
) -> tuple[float, float]:
    """Zenith angle and bearing of a star after a great-circle path of the observer. [deg]

    Parameters
    ----------
    zenith, bearing : float
        Direction of the star at the start. [deg]
    course, angle : float
        Course and length of the path; see ``travelled``. [deg], [rad]
    new_course : float
        Course at the end of the path. [deg]

    Examples
    --------
    >>> carried_star(30.0, 90.0, 90.0, math.pi / 6.0, 90.0)[0] < 1e-9  # it is overhead now
    True
    """
    flat, up = math.sin(zenith * RADIAN), math.cos(zenith * RADIAN)
    apart = (bearing - course) * RADIAN
    ahead, aside = flat * math.cos(apart), flat * math.sin(apart)
    on = ahead * math.cos(angle) - up * math.sin(angle)
    over = up * math.cos(angle) + ahead * math.sin(angle)
    level = math.hypot(on, aside)
    turned = compass(new_course + math.atan2(aside, on) * DEGREE)
    return math.atan2(level, over) * DEGREE, turned if level >= _UPRIGHT else bearing

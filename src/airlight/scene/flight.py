"""Flight over a planet: movement of observer, camera and sun by keys, mouse and wheel.

Horizontal motion follows a great circle at constant altitude; the camera keeps its zenith angle and
its angle to the course, the sun its direction in space. Speeds are proportional to the distance to
the ground. The formulas are in the Python subset that is also emitted as JavaScript.
"""

from __future__ import annotations

import math
from typing import Final

from airlight.scene.great_circle import DEGREE, RADIAN, carried_star, compass, travelled
from airlight.scene.limits import HIGHEST_ALTITUDE

#: Lowest altitude of flight. [m]
LOWEST_ALTITUDE: Final = 1.0
#: Speed over distance to the ground. [1/s]
RATE: Final = 0.8
#: Offset of that distance, so that an observer can leave the ground. [m]
FOOTING: Final = 5.0
#: Factor of the field of view per notch of the wheel. [1]
NOTCH: Final = 1.15
#: Factor of the distance to the ground per notch: 15 lead from the ground to 10 000 km. [1]
CLIMB: Final = 2.6
#: Upper limit of the factor by which turns are wider near the zenith. [1]
_WIDEST_TURN: Final = 5.0


def within(altitude: float) -> float:
    """Altitude clamped to the limits of flight. [m]

    Examples
    --------
    >>> within(-3.0), within(1e15)
    (1.0, 1000000000000.0)
    """
    return min(max(altitude, LOWEST_ALTITUDE), HIGHEST_ALTITUDE)


def climbed(altitude: float, look_zenith: float, ahead: float, up: float, reach: float) -> float:
    """Altitude after forward and vertical motion. [m]

    Parameters
    ----------
    altitude : float
        Altitude at the start. [m]
    look_zenith : float
        Zenith angle of the line of sight, which ahead follows. [deg]
    ahead, up : float
        Speeds relative to the usual speed. [1]
    reach : float
        Duration, in units in which the usual speed covers the distance to the ground. [1]

    Examples
    --------
    >>> climbed(95.0, 90.0, 0.0, 1.0, math.log(2.0))  # twice as far from 5 m below the ground
    195.0
    """
    climb = ahead * math.cos(look_zenith * RADIAN) + up
    return within((altitude + FOOTING) * math.exp(climb * reach) - FOOTING)


def course_of(look_zenith: float, heading: float, right: float, ahead: float) -> float:
    """Compass bearing of a movement to the right and ahead. [deg]"""
    return heading + math.atan2(right, ahead * math.sin(look_zenith * RADIAN)) * DEGREE


def angle_flown(
    altitude: float,
    higher: float,
    look_zenith: float,
    right: float,
    ahead: float,
    reach: float,
    bottom_radius: float,
) -> float:
    """Central angle of a flown distance. [rad]

    Parameters
    ----------
    altitude, higher : float
        Altitudes at the start and at the end. [m]
    look_zenith : float
        Zenith angle of the line of sight. [deg]
    right, ahead : float
        Speeds relative to the usual speed. [1]
    reach : float
        Duration; see ``climbed``. [1]
    bottom_radius : float
        Radius of the planet. [m]
    """
    middle = 0.5 * (altitude + higher)
    level = math.hypot(ahead * math.sin(look_zenith * RADIAN), right)
    return level * reach * (middle + FOOTING) / (bottom_radius + middle)


def turned(
    latitude: float,
    longitude: float,
    heading: float,
    sun_zenith: float,
    sun_azimuth: float,
    course: float,
    angle: float,
) -> tuple[float, float, float, float, float]:
    """Position, heading and sun direction after motion along a great circle. [deg]

    Parameters
    ----------
    latitude, longitude, heading, sun_zenith, sun_azimuth : float
        Values at the start; heading and azimuth are compass bearings. [deg]
    course : float
        Compass bearing at the start of the path. [deg]
    angle : float
        Length of the path, seen from the planet's centre. [rad]

    Returns
    -------
    latitude, longitude, heading, sun_zenith, sun_azimuth : float
        Final values; the camera keeps its angle to the course. [deg]
    """
    new_latitude, new_longitude, new_course = travelled(latitude, longitude, course, angle)
    zenith, azimuth = carried_star(sun_zenith, sun_azimuth, course, angle, new_course)
    new_heading = compass(new_course + heading - course)
    return new_latitude, new_longitude, new_heading, zenith, azimuth


def looked(look_zenith: float, heading: float, right: float, down: float) -> tuple[float, float]:
    """View-zenith angle and heading after a camera rotation. [deg]

    Parameters
    ----------
    look_zenith, heading : float
        Values before the turn. [deg]
    right, down : float
        Drag angles to the right and down. [deg]

    Examples
    --------
    >>> looked(90.0, 350.0, 20.0, -5.0)
    (85.0, 10.0)
    """
    widen = 1.0 / max(math.sin(look_zenith * RADIAN), 1.0 / _WIDEST_TURN)
    return min(max(look_zenith + down, 0.0), 180.0), compass(heading + right * widen)


def risen(altitude: float, notches: float) -> float:
    """Altitude after wheel notches, positive upwards. [m]"""
    return within((altitude + FOOTING) * math.exp(notches * math.log(CLIMB)) - FOOTING)


def sun_dragged(zenith: float, azimuth: float, right: float, down: float) -> tuple[float, float]:
    """Zenith angle and bearing of the sun after a drag over the sky. [deg]

    Beyond the zenith it continues down the other side.

    Parameters
    ----------
    zenith, azimuth : float
        Direction before the movement. [deg]
    right, down : float
        Angles of the movement. [deg]

    Examples
    --------
    >>> sun_dragged(20.0, 90.0, 0.0, -30.0)
    (10.0, 270.0)
    """
    lower = zenith + down
    over = lower < 0.0 or lower > 180.0
    far = 360.0 - lower if lower > 180.0 else -lower
    reached = far if over else lower
    half = 180.0 if over else 0.0
    return min(max(reached, 0.0), 180.0), compass(azimuth + right + half)

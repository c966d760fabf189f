"""Flight over a planet: how keys, mouse and wheel move observer, camera and sun.

Level movement follows a great circle at one altitude; the camera keeps its angle to the zenith and
its angle to the course, the sun its direction in space. Every speed is in proportion to the
distance to the ground. Plain numbers only, in the subset of Python that becomes JavaScript too.
"""

from __future__ import annotations

import math
from typing import Final

from airlight.scene.great_circle import DEGREE, RADIAN, carried_star, compass, travelled
from airlight.scene.scene import HIGHEST_ALTITUDE

#: Lowest altitude that can be flown at. [m]
LOWEST_ALTITUDE: Final = 1.0
#: Speed over distance to the ground. [1/s]
RATE: Final = 0.8
#: Added to that distance, so that one gets away from the ground. [m]
FOOTING: Final = 5.0
#: Altitude and field of view grow by this factor with each notch of the wheel. [1]
NOTCH: Final = 1.15
#: Near the zenith a turn of the compass moves the picture less: it is at most so much wider. [1]
_WIDEST_TURN: Final = 5.0


def within(altitude: float) -> float:
    """The nearest altitude that can be flown at. [m]

    Examples
    --------
    >>> within(-3.0), within(1e15)
    (1.0, 1000000000000.0)
    """
    return min(max(altitude, LOWEST_ALTITUDE), HIGHEST_ALTITUDE)


def climbed(altitude: float, look_zenith: float, ahead: float, up: float, reach: float) -> float:
    """Altitude after flying ahead and up. [m]

    Parameters
    ----------
    altitude : float
        [m]
    look_zenith : float
        Zenith angle of the line of sight, which ahead follows. [deg]
    ahead, up : float
        Speed in parts of the usual one. [1]
    reach : float
        Time, in those in which the usual speed covers the distance to the ground. [1]

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
    """Way over the ground, seen from the planet's centre. [rad]

    Parameters
    ----------
    altitude, higher : float
        At the start and at the end. [m]
    look_zenith : float
        [deg]
    right, ahead : float
        Speed in parts of the usual one. [1]
    reach : float
        See ``climbed``. [1]
    bottom_radius : float
        Of the planet. [m]
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
    """Place, heading and sun after moving on a great circle. [deg]

    Parameters
    ----------
    latitude, longitude, heading, sun_zenith, sun_azimuth : float
        At the start; heading and azimuth are compass bearings. [deg]
    course : float
        Compass bearing of the way's start. [deg]
    angle : float
        Length of the way, seen from the planet's centre. [rad]

    Returns
    -------
    latitude, longitude, heading, sun_zenith, sun_azimuth : float
        The camera keeps its angle to the course. [deg]
    """
    new_latitude, new_longitude, new_course = travelled(latitude, longitude, course, angle)
    zenith, azimuth = carried_star(sun_zenith, sun_azimuth, course, angle, new_course)
    new_heading = compass(new_course + heading - course)
    return new_latitude, new_longitude, new_heading, zenith, azimuth


def looked(look_zenith: float, heading: float, right: float, down: float) -> tuple[float, float]:
    """Zenith angle of the line of sight, and heading, after the camera has turned. [deg]

    Parameters
    ----------
    look_zenith, heading : float
        [deg]
    right, down : float
        As seen on the picture. [deg]

    Examples
    --------
    >>> looked(90.0, 350.0, 20.0, -5.0)
    (85.0, 10.0)
    """
    widen = 1.0 / max(math.sin(look_zenith * RADIAN), 1.0 / _WIDEST_TURN)
    return min(max(look_zenith + down, 0.0), 180.0), compass(heading + right * widen)


def risen(altitude: float, notches: float) -> float:
    """Altitude after turning the wheel: away from the ground for notches above 0. [m]"""
    return within((altitude + FOOTING) * math.exp(notches * math.log(NOTCH)) - FOOTING)


def sun_dragged(zenith: float, azimuth: float, right: float, down: float) -> tuple[float, float]:
    """Zenith angle and bearing of the sun, moved by angles over the sky. [deg]

    Over the zenith it goes on down the other side.

    Parameters
    ----------
    zenith, azimuth : float
        [deg]
    right, down : float
        [deg]

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

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
#: Angle of the horizon from the nadir below which a drag turns the planet. [deg]
_WHOLE: Final = 45.0
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


def horizon_nadir(altitude: float, bottom_radius: float) -> float:
    """Angle of the geometric horizon from the nadir: half of the planet's angular diameter. [deg]

    Examples
    --------
    >>> round(horizon_nadir(6360e3, 6360e3), 6)
    30.0
    """
    height = max(altitude, 0.0)
    tangent = math.sqrt(height * (2.0 * bottom_radius + height))
    return math.atan2(bottom_radius, tangent) * DEGREE


def horizon_kept(look_zenith: float, altitude: float, higher: float, bottom_radius: float) -> float:
    """View-zenith angle after a change of altitude, with the horizon where it was. [deg]

    The angle from the nadir is in proportion to the horizon's, so that the planet stays in the
    picture however far the observer goes, and the way back leads to the first view.

    Parameters
    ----------
    look_zenith : float
        Zenith angle of the line of sight before. [deg]
    altitude, higher : float
        Altitudes before and after. [m]
    bottom_radius : float
        Radius of the planet. [m]

    Examples
    --------
    >>> round(horizon_kept(180.0 - 70.0, 4e5, 1e9, 6.371e6), 2)
    179.64
    """
    share = horizon_nadir(higher, bottom_radius) / horizon_nadir(altitude, bottom_radius)
    return max(180.0 - (180.0 - look_zenith) * share, 0.0)


def turns_planet(altitude: float, bottom_radius: float) -> bool:
    """Whether a drag turns the planet instead of the camera: it is less than 90° wide.

    Examples
    --------
    >>> turns_planet(4e5, 6.371e6), turns_planet(1e7, 6.371e6)
    (False, True)
    """
    return horizon_nadir(altitude, bottom_radius) < _WHOLE


def planet_hidden(
    look_zenith: float, altitude: float, bottom_radius: float, field_of_view: float
) -> bool:
    """Whether a far planet is outside the picture.

    Parameters
    ----------
    look_zenith, field_of_view : float
        Zenith angle of the line of sight, and width of the picture. [deg]
    altitude, bottom_radius : float
        Altitude and radius of the planet. [m]
    """
    beyond = 180.0 - look_zenith - horizon_nadir(altitude, bottom_radius)
    return turns_planet(altitude, bottom_radius) and beyond > 0.5 * field_of_view


def angle_dragged(
    altitude: float, bottom_radius: float, field_of_view: float, share: float
) -> float:
    """Central angle of a drag of the planet, whose nearest point follows the pointer. [rad]

    A planet that is a dot turns by half, not more, while the pointer crosses the picture.

    Parameters
    ----------
    altitude, bottom_radius : float
        Altitude and radius of the planet. [m]
    field_of_view : float
        Width of the picture. [deg]
    share : float
        Distance that the pointer has moved over the width of the picture. [1]

    Examples
    --------
    >>> round(angle_dragged(1e12, 6.371e6, 60.0, 1.0), 6)
    3.141593
    """
    return share * min(field_of_view * RADIAN * altitude / bottom_radius, math.pi)


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

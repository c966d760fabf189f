"""Geometry of the observer: horizon, camera target, rotation to the planet's frame."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.vectors import Vec3
from airlight.physics.units import Measure, quantity
from airlight.scene.compass import bearing, compass_bearing
from airlight.scene.limits import within

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Targets of a camera.
TARGETS = ("horizon", "nadir", "zenith", "sun", "moon")
_RADIAN = math.pi / 180.0


def horizon_zenith(altitude: Measure, bottom_radius: Measure) -> float:
    """Zenith angle of the geometric horizon.

    Parameters
    ----------
    altitude : float
        Altitude of the observer, at least 0. [m]
    bottom_radius : float
        Radius of the ground. [m]

    Returns
    -------
    float
        Zenith angle, 90 on the ground, towards 180 far away; refraction is neglected (at Earth's
        ground it raises the horizon by about half a degree). [deg]

    Notes
    -----
    cos(dip) = R/(R + h), written with the tangent, which does not cancel at small heights.

    Examples
    --------
    >>> round(horizon_zenith(6360e3, 6360e3), 6)  # cos(dip) = 1/2
    150.0
    """
    altitude = within("altitude", altitude, 0.0, math.inf, "m")
    bottom_radius = within("bottom_radius", bottom_radius, 0.0, math.inf, "m")
    dip = math.atan2(math.sqrt(altitude * (2.0 * bottom_radius + altitude)), bottom_radius)
    return 90.0 + math.degrees(dip)


def look_at(
    target: str,
    *,
    altitude: Measure,
    sun_zenith: Measure,
    bottom_radius: Measure,
    sun_azimuth: Measure = 180.0,
    moon: tuple[float, float] | None = None,
    planet: Planet | None = None,
) -> tuple[float, float]:
    """Camera angles towards a target.

    Parameters
    ----------
    target : str
        Name of the target: ``horizon`` (below the sun, on the ground's edge), ``nadir`` (with north
        up), ``zenith``, ``sun`` or ``moon``; or a compass bearing: ``NE``, degrees such as ``315``,
        with an optional elevation, ``315/20``; by default on the horizon.
    altitude : float
        Altitude of the observer. [m]
    sun_zenith : float
        True zenith angle of the sun at the observer. [deg]
    bottom_radius : float
        Radius of the ground. [m]
    sun_azimuth : float
        Compass bearing of the sun, for bearings and the moon. [deg]
    moon : (float, float), optional
        True zenith angle and compass bearing of the moon, if known. [deg]
    planet : Planet, optional
        Planet whose atmosphere refracts sun and moon; by default refraction is neglected.

    Returns
    -------
    (float, float)
        Zenith angle, and azimuth from the sun's side. [deg]

    Raises
    ------
    ParameterError
        If the target is unknown.

    Examples
    --------
    >>> look_at("sun", altitude=0.0, sun_zenith=80.0, bottom_radius=6360e3)
    (80.0, 0.0)
    >>> look_at("W/20", altitude=0.0, sun_zenith=80.0, bottom_radius=6360e3, sun_azimuth=225.0)
    (70.0, 45.0)
    """
    sun_zenith = quantity(sun_zenith, "deg", "sun_zenith", bare=True)
    sun_azimuth = bearing(sun_azimuth, "sun_azimuth")
    if target == "horizon":
        return horizon_zenith(altitude, bottom_radius), 0.0
    if target == "nadir":
        return 180.0, math.remainder(-sun_azimuth, 360.0)
    if target == "zenith":
        return 0.0, 0.0
    if target == "sun":
        return _seen(planet, altitude, sun_zenith), 0.0
    if target == "moon" and moon is not None:
        return _seen(planet, altitude, moon[0]), math.remainder(moon[1] - sun_azimuth, 360.0)
    towards = None if target == "moon" else compass_bearing(target)
    if towards is None:
        words = ", ".join(TARGETS[:-1])
        allowed = f"{words}, moon with a time, or a bearing such as NE, 315 or 315/20"
        raise ParameterError("look_at", target, allowed)
    turn, elevation = towards
    zenith = horizon_zenith(altitude, bottom_radius) if elevation is None else 90.0 - elevation
    return zenith, math.remainder(turn - sun_azimuth, 360.0)


def _seen(planet: Planet | None, altitude: Measure, zenith: float) -> float:
    """Apparent zenith angle of a body; the true angle without a planet. [deg]"""
    if planet is None:
        return zenith
    from airlight.scene.apparent_sun import apparent_zenith

    return apparent_zenith(planet, quantity(altitude, "m", "altitude", bare=True), zenith)


def ground_axes(latitude: float, longitude: float, sun_azimuth: float) -> tuple[Vec3, Vec3, Vec3]:
    """Scalar version of ``planet_frame``, by rows. [1]"""
    north_sine, north_cosine = math.sin(latitude * _RADIAN), math.cos(latitude * _RADIAN)
    east_sine, east_cosine = math.sin(longitude * _RADIAN), math.cos(longitude * _RADIAN)
    along, across = math.cos(sun_azimuth * _RADIAN), math.sin(sun_azimuth * _RADIAN)
    up = Vec3(north_cosine * east_cosine, north_cosine * east_sine, north_sine)
    sun = Vec3(
        -along * north_sine * east_cosine - across * east_sine,
        -along * north_sine * east_sine + across * east_cosine,
        along * north_cosine,
    )
    return (
        Vec3(sun.x, up.y * sun.z - up.z * sun.y, up.x),
        Vec3(sun.y, up.z * sun.x - up.x * sun.z, up.y),
        Vec3(sun.z, up.x * sun.y - up.y * sun.x, up.z),
    )


def planet_frame(latitude: float, longitude: float, sun_azimuth: float) -> NDArray[np.float64]:
    """Rotation from the observer's local frame to the frame that rotates with the planet.

    The planet's frame has z to the north pole and x through latitude 0, longitude 0.

    Parameters
    ----------
    latitude, longitude : float
        Coordinates of the point below the observer, north and east positive. [deg]
    sun_azimuth : float
        Compass bearing of the sun: 0 north, 90 east. [deg]

    Returns
    -------
    array, shape (3, 3)
        Rotation: ``planet = matrix @ local``. [1]

    Examples
    --------
    >>> north_pole = planet_frame(90.0, 0.0, 0.0) @ [0.0, 0.0, 1.0]
    >>> north_pole.round(12) + 0.0
    array([0., 0., 1.])
    """
    return np.array(ground_axes(latitude, longitude, sun_azimuth))

"""Unit vectors and camera axes from angles, in the local frame.

The observer's local frame has z to the zenith, x along the horizontal towards the sun's side and
y to the left of x. Azimuth is counted from x, **clockwise seen from above, like a compass**: an
observer who faces azimuth 0 has azimuth +90° on the right.

The scalar formulas are in the Python subset that is also emitted as JavaScript.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3

FloatArray = NDArray[np.float64]

_RADIAN = math.pi / 180.0


def direction_of(zenith: float, azimuth: float) -> Vec3:
    """Scalar version of ``direction``. [1]"""
    flat = math.sin(zenith * _RADIAN)
    turn = azimuth * _RADIAN
    return Vec3(flat * math.cos(turn), -flat * math.sin(turn), math.cos(zenith * _RADIAN))


def camera_frame(zenith: float, azimuth: float, roll: float) -> tuple[Vec3, Vec3, Vec3]:
    """Scalar version of ``camera_axes``. [1]"""
    forward, level = direction_of(zenith, azimuth), direction_of(90.0, azimuth + 90.0)
    upright = Vec3(
        level.y * forward.z - level.z * forward.y,
        level.z * forward.x - level.x * forward.z,
        level.x * forward.y - level.y * forward.x,
    )
    return rolled(level, upright, roll), rolled(upright, level, -roll), forward


def rolled(axis: Vec3, other: Vec3, angle: float) -> Vec3:
    """Axis, turned by ``angle`` degrees away from another one that is perpendicular to it. [1]

    A camera's up, turned away from its right, is the axis of a polarising filter.
    """
    cosine, sine = math.cos(angle * _RADIAN), math.sin(angle * _RADIAN)
    return Vec3(
        cosine * axis.x - sine * other.x,
        cosine * axis.y - sine * other.y,
        cosine * axis.z - sine * other.z,
    )


def direction(zenith: float, azimuth: float) -> FloatArray:
    """Unit vector from zenith angle and azimuth. [1]

    Parameters
    ----------
    zenith : float
        Angle from the zenith. [deg]
    azimuth : float
        Azimuth from the sun's side, clockwise seen from above. [deg]

    Returns
    -------
    array, shape (3,)
        Unit vector in the observer's local frame. [1]

    Examples
    --------
    >>> direction(90.0, 90.0).round(12) + 0.0
    array([ 0., -1.,  0.])
    """
    return np.array(direction_of(zenith, azimuth))


def camera_axes(zenith: float, azimuth: float, roll: float) -> FloatArray:
    """Right, up and forward of the camera in the observer's local frame.

    Parameters
    ----------
    zenith, azimuth : float
        Direction of the camera. At the zenith and the nadir the azimuth determines its rotation: it
        is the azimuth that the camera faces when it is tilted back to the horizon. [deg]
    roll : float
        Clockwise rotation of the camera about its line of sight, so that the picture turns
        counter-clockwise. [deg]

    Returns
    -------
    array, shape (3, 3)
        Orthonormal rows: right, up, forward. [1]

    Examples
    --------
    >>> camera_axes(90.0, 0.0, 0.0).round(12) + 0.0
    array([[ 0., -1.,  0.],
           [ 0.,  0.,  1.],
           [ 1.,  0.,  0.]])
    """
    return np.array(camera_frame(zenith, azimuth, roll))


def camera_angles(axes: FloatArray) -> tuple[float, float, float]:
    """Zenith angle, azimuth and roll of a camera; inverse of ``camera_axes``. [deg]

    Parameters
    ----------
    axes : array, shape (3, 3)
        Right, up and forward in the local frame, as rows. [1]
    """
    right, _, forward = axes
    zenith, azimuth = zenith_azimuth(forward)
    level, upright, _ = camera_axes(zenith, azimuth, 0.0)
    return zenith, azimuth, math.degrees(math.atan2(-right @ upright, right @ level))


def zenith_azimuth(towards: FloatArray) -> tuple[float, float]:
    """Zenith angle and azimuth of a direction in the local frame. [deg]"""
    x, y, z = (float(one) for one in towards)
    return math.degrees(math.atan2(math.hypot(x, y), z)), math.degrees(math.atan2(-y, x))


def level_axes(up: FloatArray, towards: FloatArray | None = None) -> FloatArray:
    """Axes of the local frame as rows: x horizontally towards a light, z to the zenith. [1]"""
    flat = np.zeros(3)
    if towards is not None:
        flat = towards - (towards @ up) * up
    if np.linalg.norm(flat) < 1e-12:
        flat = np.cross(up, [0.0, 0.0, 1.0] if abs(up[2]) < 0.9 else [1.0, 0.0, 0.0])
    x = flat / np.linalg.norm(flat)
    return np.stack([x, np.cross(up, x), up])

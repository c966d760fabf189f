"""Directions from angles, and the frame they are written in.

The observer's local frame has z to the zenith, x along the horizontal towards the sun's side and
y to the left of x. Azimuth is counted from x, **clockwise seen from above, like a compass**: an
observer who faces azimuth 0 has azimuth +90° on the right.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray


def direction(zenith: float, azimuth: float) -> NDArray[np.float64]:
    """Unit vector of a direction given by its angles.

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
    theta, phi = math.radians(zenith), math.radians(azimuth)
    flat = math.sin(theta)
    return np.array([flat * math.cos(phi), -flat * math.sin(phi), math.cos(theta)])


def camera_axes(zenith: float, azimuth: float, roll: float) -> NDArray[np.float64]:
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
    forward = direction(zenith, azimuth)
    level = direction(90.0, azimuth + 90.0)
    upright = np.cross(level, forward)
    turn = math.radians(roll)
    right = math.cos(turn) * level - math.sin(turn) * upright
    up = math.cos(turn) * upright + math.sin(turn) * level
    return np.stack([right, up, forward])

"""Directions from angles, and the frame they are written in.

The observer's local frame has z to the zenith, x along the horizontal towards the sun's side and
y to the left of x. Azimuth is counted from x, **clockwise seen from above, as a compass does**:
who looks at azimuth 0 has azimuth +90° at the right hand.
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
        From the sun's side, clockwise seen from above. [deg]

    Returns
    -------
    array, shape (3,)
        In the observer's local frame. [1]

    Examples
    --------
    >>> direction(90.0, 90.0).round(12) + 0.0
    array([ 0., -1.,  0.])
    """
    theta, phi = math.radians(zenith), math.radians(azimuth)
    flat = math.sin(theta)
    return np.array([flat * math.cos(phi), -flat * math.sin(phi), math.cos(theta)])


def camera_axes(zenith: float, azimuth: float, roll: float) -> NDArray[np.float64]:
    """The camera's right, up and forward in the observer's local frame.

    Parameters
    ----------
    zenith, azimuth : float
        Where the camera looks. At the zenith and the nadir the azimuth says which way it is
        turned: it is the one that the camera would see when it tilts back to the horizon. [deg]
    roll : float
        The camera turns clockwise about its line of sight by so much, so that what it
        sees turns counter-clockwise. [deg]

    Returns
    -------
    array, shape (3, 3)
        Rows: right, up, forward, orthonormal. [1]

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

"""Panorama of the whole sphere: columns are equal steps of azimuth, rows of elevation."""

from __future__ import annotations

import math
from math import cos, pi, sin

import numpy as np

from airlight.kernel import compiled_loop, kernel
from airlight.scene.projections.projection import FloatArray, Projection


@kernel
def panorama_ray(x, y, width, height, field_of_view):
    """View vector (right, up, forward) of a point of the picture; as ``rays``. [1]"""
    azimuth = 2.0 * pi * (x / width - 0.5)
    elevation = pi * (0.5 - y / height)
    level = cos(elevation)
    return level * sin(azimuth), sin(elevation), level * cos(azimuth)


@compiled_loop
def fill(x, y, width, height, field_of_view, out):
    """Write the rays of a grid of pixels to ``out``, shape (len(y), len(x), 3)."""
    for row in range(y.size):
        for column in range(x.size):
            right, up, forward = panorama_ray(x[column], y[row], width, height, field_of_view)
            out[row, column, 0] = right
            out[row, column, 1] = up
            out[row, column, 2] = forward


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors of a panorama whose centre looks straight ahead.

    The left and the right edge are one meridian, straight behind the camera.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Size of the picture. [pixel]
    field_of_view : float
        Angle of a full turn; no other is allowed. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward). [1]

    Examples
    --------
    >>> top = rays(np.array([3.0]), np.array([0.0]), 8, 4, 2.0 * math.pi)
    >>> [round(float(v), 12) + 0.0 for v in top[0, 0]]
    [0.0, 1.0, 0.0]
    """
    out = np.empty((len(y), len(x), 3))
    fill(x, y, width, height, field_of_view, out)
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Height of a pixel, and its width at the panorama's horizon. [rad]"""
    return math.pi / height


EQUIRECTANGULAR = Projection(
    name="equirectangular",
    rays=rays,
    pixel_angle=pixel_angle,
    fits=lambda width, height: width == 2 * height,
    shape="twice as wide as high",
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
)

"""Pinhole camera: straight lines stay straight."""

from __future__ import annotations

import math
from math import cos, sin, sqrt

import numpy as np

from airlight.kernel import compiled_loop, kernel
from airlight.scene.projections.projection import FloatArray, Projection


@kernel
def perspective_ray(x, y, width, height, field_of_view):
    """View vector (right, up, forward) of a point of the picture; as ``rays``. [1]"""
    slope = sin(0.5 * field_of_view) / cos(0.5 * field_of_view)
    right = (2.0 * x - width) / width * slope
    up = (height - 2.0 * y) / width * slope
    length = sqrt(1.0 + right * right + up * up)
    return right / length, up / length, 1.0 / length


@compiled_loop
def fill(x, y, width, height, field_of_view, out):
    """Write the rays of a grid of pixels to ``out``, shape (len(y), len(x), 3)."""
    for row in range(y.size):
        for column in range(x.size):
            right, up, forward = perspective_ray(x[column], y[row], width, height, field_of_view)
            out[row, column, 0] = right
            out[row, column, 1] = up
            out[row, column, 2] = forward


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors through a flat picture; the field of view is horizontal.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Size of the picture. [pixel]
    field_of_view : float
        Angle between the left and the right edge. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward). [1]

    Examples
    --------
    >>> import math
    >>> left_edge = rays(np.array([0.0]), np.array([1.0]), 4, 2, math.radians(90.0))
    >>> [round(float(v), 6) for v in left_edge[0, 0]]
    [-0.707107, 0.0, 0.707107]
    """
    out = np.empty((len(y), len(x), 3))
    fill(x, y, width, height, field_of_view, out)
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the central pixel. [rad]"""
    return 2.0 * math.tan(0.5 * field_of_view) / width


PERSPECTIVE = Projection(
    name="perspective",
    rays=rays,
    pixel_angle=pixel_angle,
    fits=lambda width, height: True,
    shape="any shape",
    field_of_view=60.0,
    field_of_view_limits=(1e-3, 170.0),
    look_zenith=90.0,
)

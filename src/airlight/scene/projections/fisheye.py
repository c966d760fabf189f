"""Equidistant fisheye of dome masters: distance from the centre is the angle off the axis."""

from __future__ import annotations

from math import cos, sin, sqrt

import numpy as np

from airlight.kernel import compiled_loop, kernel
from airlight.scene.projections.projection import FloatArray, Projection


@kernel
def fisheye_ray(x, y, width, height, field_of_view):
    """View vector (right, up, forward) of a point of the picture; as ``rays``. [1]"""
    diameter = min(width, height)
    across = 2.0 * x - width
    up = height - 2.0 * y
    square = across * across + up * up
    # Both sides are whole numbers for the pixels' centres: no rounding decides on the rim.
    if square > diameter * diameter:
        return 0.0, 0.0, 0.0
    distance = sqrt(square)
    theta = 0.5 * field_of_view * distance / diameter
    scale = sin(theta) / max(distance, 1e-12)  # at the centre both components are 0
    return scale * across, scale * up, cos(theta)


@compiled_loop
def fill(x, y, width, height, field_of_view, out):
    """Write the rays of a grid of pixels to ``out``, shape (len(y), len(x), 3)."""
    for row in range(y.size):
        for column in range(x.size):
            right, up, forward = fisheye_ray(x[column], y[row], width, height, field_of_view)
            out[row, column, 0] = right
            out[row, column, 1] = up
            out[row, column, 2] = forward


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors of the largest circle that fits the picture; zero outside it.

    A camera that looks at the zenith has its azimuth at the **bottom** of the picture, as usual for
    dome masters: the audience faces the bottom edge.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Size of the picture. [pixel]
    field_of_view : float
        Angle across the circle, up to a full turn. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward), zero outside the circle. [1]

    Examples
    --------
    >>> import math
    >>> centre = rays(np.array([2.0]), np.array([2.0]), 4, 4, math.pi)
    >>> [float(v) for v in centre[0, 0]]
    [0.0, 0.0, 1.0]
    """
    out = np.empty((len(y), len(x), 3))
    fill(x, y, width, height, field_of_view, out)
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of a pixel along a radius, the same over the picture. [rad]"""
    return field_of_view / min(width, height)


FISHEYE = Projection(
    name="fisheye",
    rays=rays,
    pixel_angle=pixel_angle,
    fits=lambda width, height: True,
    shape="any shape",
    field_of_view=180.0,
    field_of_view_limits=(1e-3, 360.0),
    look_zenith=0.0,
)

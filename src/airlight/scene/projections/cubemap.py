"""Cube map: six square faces side by side, in the order and orientation of graphics interfaces."""

from __future__ import annotations

from math import floor, sqrt

import numpy as np

from airlight.kernel import compiled_loop, kernel
from airlight.scene.projections.projection import FloatArray, Projection


@kernel
def cube_ray(x, y, width, height, field_of_view):
    """View vector (right, up, forward) of a point of the strip; as ``rays``. [1]

    ``across`` and ``above`` run from -1 to 1 over a face, towards its right and its top edge.
    Order +x, -x, +y, -y, +z, -z with x right, y up and z forward, oriented as in the OpenGL 4.6
    Core Profile specification, section 8.13.
    """
    face = min(max(floor(x / height), 0), 5)
    across = 2.0 * (x / height - face) - 1.0
    above = 1.0 - 2.0 * y / height
    if face == 0:
        right, up, forward = 1.0, above, -across
    elif face == 1:
        right, up, forward = -1.0, above, across
    elif face == 2:
        right, up, forward = across, 1.0, -above
    elif face == 3:
        right, up, forward = across, -1.0, above
    elif face == 4:
        right, up, forward = across, above, 1.0
    else:
        right, up, forward = -across, above, -1.0
    length = sqrt(1.0 + across * across + above * above)
    return right / length, up / length, forward / length


@compiled_loop
def fill(x, y, width, height, field_of_view, out):
    """Write the rays of a grid of pixels to ``out``, shape (len(y), len(x), 3)."""
    for row in range(y.size):
        for column in range(x.size):
            right, up, forward = cube_ray(x[column], y[row], width, height, field_of_view)
            out[row, column, 0] = right
            out[row, column, 1] = up
            out[row, column, 2] = forward


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors of a strip of six faces: right, left, up, down, ahead, behind.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Size of the strip: six faces wide, one high. [pixel]
    field_of_view : float
        Angle of a full turn; no other is allowed. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward). [1]

    Examples
    --------
    >>> ahead = rays(np.array([4.5]), np.array([0.5]), 6, 1, 6.283185307179586)
    >>> [float(v) for v in ahead[0, 0]]
    [0.0, 0.0, 1.0]
    """
    out = np.empty((len(y), len(x), 3))
    fill(x, y, width, height, field_of_view, out)
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the central pixel of a face. [rad]"""
    return 2.0 / height


CUBEMAP = Projection(
    name="cubemap",
    rays=rays,
    pixel_angle=pixel_angle,
    fits=lambda width, height: width == 6 * height,
    shape="six times as wide as high",
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
)

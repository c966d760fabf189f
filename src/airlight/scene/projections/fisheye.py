"""The equidistant fisheye of dome masters: distance from the centre is the angle off the axis."""

from __future__ import annotations

import numpy as np

from airlight.scene.projections.projection import FloatArray, Projection


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors of the largest circle that fits the picture; zero outside it.

    A camera that looks at the zenith has the azimuth it was turned to at the **bottom** of the
    picture, as dome masters have it: the audience faces the bottom edge.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Of the picture. [pixel]
    field_of_view : float
        Across the circle, up to a full turn. [rad]

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
    diameter = min(width, height)
    right = (2.0 * x - width)[np.newaxis, :] / diameter
    up = (height - 2.0 * y)[:, np.newaxis] / diameter
    distance = np.hypot(right, up)
    theta = 0.5 * field_of_view * distance
    # np.sinc(t/pi) = sin(t)/t, which is 1 at the centre
    scale = 0.5 * field_of_view * np.sinc(theta / np.pi)
    out = np.empty((len(y), len(x), 3))
    out[..., 0] = scale * right
    out[..., 1] = scale * up
    out[..., 2] = np.cos(theta)
    out[distance > 1.0] = 0.0
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of a pixel along a radius, the same everywhere. [rad]"""
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

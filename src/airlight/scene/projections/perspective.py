"""Perspective (rectilinear) projection of a pinhole camera."""

from __future__ import annotations

import math
from math import cos, sin, sqrt

from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.projections.projection import Projection


@kernel
def perspective_ray(x, y, width, height, field_of_view):
    """View vector of a point of the image plane; the field of view is horizontal.

    Parameters
    ----------
    x, y : float
        Distances from the left and the top edge. [pixel]
    width, height : int
        Size of the frame. [pixel]
    field_of_view : float
        Angle between the left and the right edge. [rad]

    Returns
    -------
    Vec3
        Unit vector: right, up, forward. [1]

    Examples
    --------
    >>> [round(v, 6) for v in perspective_ray(0.0, 1.0, 4, 2, math.radians(90.0))]  # left edge
    [-0.707107, 0.0, 0.707107]
    """
    slope = sin(0.5 * field_of_view) / cos(0.5 * field_of_view)
    right = (2.0 * x - width) / width * slope
    up = (height - 2.0 * y) / width * slope
    length = sqrt(1.0 + right * right + up * up)
    return Vec3(right / length, up / length, 1.0 / length)


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the central pixel. [rad]"""
    return 2.0 * math.tan(0.5 * field_of_view) / width


PERSPECTIVE = Projection(
    name="perspective",
    ray=perspective_ray,
    pixel_angle=pixel_angle,
    field_of_view=60.0,
    field_of_view_limits=(1e-3, 170.0),
    look_zenith=90.0,
)

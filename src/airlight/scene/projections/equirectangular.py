"""Panorama of the whole sphere: columns are equal steps of azimuth, rows of elevation."""

from __future__ import annotations

import math
from math import cos, pi, sin

from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.projections.projection import Projection


@kernel
def panorama_ray(x, y, width, height, field_of_view):
    """View vector of a point of a panorama whose centre looks straight ahead.

    The left and the right edge are one meridian, straight behind the camera.

    Parameters
    ----------
    x, y : float
        Distances from the left and the top edge. [pixel]
    width, height : int
        Size of the frame. [pixel]
    field_of_view : float
        Angle of a full turn; no other is allowed. [rad]

    Returns
    -------
    Vec3
        Unit vector: right, up, forward. [1]

    Examples
    --------
    >>> [round(v, 12) + 0.0 for v in panorama_ray(3.0, 0.0, 8, 4, 2.0 * math.pi)]  # the top
    [0.0, 1.0, 0.0]
    """
    azimuth = 2.0 * pi * (x / width - 0.5)
    elevation = pi * (0.5 - y / height)
    level = cos(elevation)
    return Vec3(level * sin(azimuth), sin(elevation), level * cos(azimuth))


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Height of a pixel, and its width at the panorama's horizon. [rad]"""
    return math.pi / height


EQUIRECTANGULAR = Projection(
    name="equirectangular",
    ray=panorama_ray,
    pixel_angle=pixel_angle,
    aspect=2,
    periodic=True,
    shape="twice as wide as high",
    size=(2048, 1024),
    sized=lambda width: (width, width // 2),
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
)

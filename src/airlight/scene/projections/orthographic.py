"""Orthographic camera: parallel lines of sight, for the whole disc of a planet."""

from __future__ import annotations

import math
from math import sin, sqrt

from airlight.kernel import kernel
from airlight.scene.projections.projection import Projection


@kernel
def orthographic_ray(x, y, width, height, field_of_view):
    """View vector of an image point; image distances are proportional to the sine of the angle.

    A line of sight at an angle θ from the direction of a planet's centre at a distance r passes the
    centre at r sin θ. Image distances are therefore proportional to distances from the planet's
    centre; for large r, lines of sight are parallel.

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
    right, up, forward : float
        Unit vector, zero more than a quarter of a turn off the axis. [1]

    Examples
    --------
    >>> orthographic_ray(3.0, 1.0, 4, 2, 2.0 * math.asin(0.5))  # half-way to the right edge
    (0.25, 0.0, 0.9682458365518543)
    """
    edge = sin(0.5 * field_of_view)
    right = (2.0 * x - width) / width * edge
    up = (height - 2.0 * y) / width * edge
    square = right * right + up * up
    if square > 1.0:
        return 0.0, 0.0, 0.0
    return right, up, sqrt(1.0 - square)


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the central pixel. [rad]"""
    return 2.0 * math.sin(0.5 * field_of_view) / width


def disc_extent(top_radius: float, width: int, height: int) -> float:
    """Length from left to right of a picture in which a planet's disc has a margin of 5 %. [m]

    Parameters
    ----------
    top_radius : float
        Radius of the top of the atmosphere. [m]

    Examples
    --------
    >>> disc_extent(1.0, 200, 100)
    4.2
    """
    return 2.1 * top_radius * max(1.0, width / height)


ORTHOGRAPHIC = Projection(
    name="orthographic",
    ray=orthographic_ray,
    pixel_angle=pixel_angle,
    size=(1024, 1024),
    field_of_view=180.0,
    field_of_view_limits=(1e-12, 180.0),
    look_zenith=180.0,
    connected=False,
    parallel=True,
)

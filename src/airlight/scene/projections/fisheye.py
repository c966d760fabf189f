"""Equidistant fisheye of dome masters: distance from the centre is the angle off the axis."""

from __future__ import annotations

from math import cos, sin, sqrt

from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.projections.projection import Projection


@kernel
def fisheye_ray(x, y, width, height, field_of_view):
    """View vector of a point in the largest circle that fits the picture; zero outside it.

    A camera that looks at the zenith has its azimuth at the **bottom** of the picture, as usual for
    dome masters: the audience faces the bottom edge.

    Parameters
    ----------
    x, y : float
        Distances from the left and the top edge. [pixel]
    width, height : int
        Size of the frame. [pixel]
    field_of_view : float
        Angle across the circle, up to a full turn. [rad]

    Returns
    -------
    Vec3
        Unit vector: right, up, forward; zero outside the circle. [1]

    Examples
    --------
    >>> fisheye_ray(2.0, 2.0, 4, 4, 3.0)  # the centre
    Vec3(x=0.0, y=0.0, z=1.0)
    """
    diameter = min(width, height)
    across = 2.0 * x - width
    up = height - 2.0 * y
    square = across * across + up * up
    # Both sides are integers for pixel centres: rounding does not matter at the rim.
    if square > diameter * diameter:
        return Vec3(0.0, 0.0, 0.0)
    distance = sqrt(square)
    theta = 0.5 * field_of_view * distance / diameter
    scale = sin(theta) / max(distance, 1e-12)  # at the centre both components are 0
    return Vec3(scale * across, scale * up, cos(theta))


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of a pixel along a radius, the same over the picture. [rad]"""
    return field_of_view / min(width, height)


FISHEYE = Projection(
    name="fisheye",
    ray=fisheye_ray,
    pixel_angle=pixel_angle,
    size=(1024, 1024),
    field_of_view=180.0,
    field_of_view_limits=(1e-3, 360.0),
    look_zenith=0.0,
    circular=True,
)

"""Cube map: six square faces side by side, in the order and orientation of graphics interfaces."""

from __future__ import annotations

from math import floor, sqrt

from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.projections.projection import Projection


@kernel
def cube_ray(x, y, width, height, field_of_view):
    """View vector of a point of a strip of six faces: right, left, up, down, ahead, behind.

    ``across`` and ``above`` run from -1 to 1 over a face, towards its right and its top edge.
    Order +x, -x, +y, -y, +z, -z with x right, y up and z forward, oriented as in the OpenGL 4.6
    Core Profile specification, section 8.13.

    Parameters
    ----------
    x, y : float
        Distances from the left and the top edge. [pixel]
    width, height : int
        Size of the frame: six faces wide, one high. [pixel]
    field_of_view : float
        Angle of a full turn; no other is allowed. [rad]

    Returns
    -------
    Vec3
        Unit vector: right, up, forward. [1]

    Examples
    --------
    >>> cube_ray(4.5, 0.5, 6, 1, 6.283185307179586)  # the middle of the fifth face
    Vec3(x=0.0, y=0.0, z=1.0)
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
    return Vec3(right / length, up / length, forward / length)


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the central pixel of a face. [rad]"""
    return 2.0 / height


CUBEMAP = Projection(
    name="cubemap",
    ray=cube_ray,
    pixel_angle=pixel_angle,
    aspect=6,
    shape="six times as wide as high",
    size=(6 * 512, 512),
    sized=lambda side: (6 * side, side),
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
    connected=False,
)

r"""Equal-area octahedral map of the sphere on a square.

Each quarter of the upper hemisphere is a triangle at the centre of the square, and the quarter
below it the triangle between that and the corner. In the unit triangle with :math:`r = a + b \le
1`, a ring has the fraction 2r dr of the area; with :math:`z = 1 - r^2` a ring of the hemisphere has
2π dz, or 4π r dr, the same fraction. Azimuth is linear in b along a ring.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt

from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel
from airlight.scene.projections.projection import Projection


@kernel
def octahedral_ray(x, y, width, height, field_of_view):
    """View vector of a point of the square; zenith in the middle, nadir in the corners.

    Ahead is the bottom edge's middle, on the right the right edge's.

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

    References
    ----------
    Clarberg (2008), "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", Journal of Graphics
    Tools 13(3), 53; Pharr, Jakob & Humphreys (2023), Physically Based Rendering, 4th edition,
    section 3.8.3, whose x is right here, y forward, and z up.

    Examples
    --------
    >>> [round(v, 12) + 0.0 for v in octahedral_ray(4.0, 2.0, 4, 4, 2.0 * pi)]  # the right edge
    [1.0, 0.0, 0.0]
    """
    u, v = 2.0 * x / width - 1.0, 2.0 * y / height - 1.0
    a, b = abs(u), abs(v)
    lower = a + b > 1.0
    r = 2.0 - a - b if lower else a + b
    # b - a is the same in the lower triangle, which is mirrored on its diagonal
    angle = 0.25 * pi * ((b - a) / r + 1.0) if r > 0.0 else 0.25 * pi
    level = r * sqrt(max(2.0 - r * r, 0.0))
    right, forward = level * cos(angle), level * sin(angle)
    up = r * r - 1.0 if lower else 1.0 - r * r
    return Vec3(-right if u < 0.0 else right, up, -forward if v < 0.0 else forward)


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Angle of the central pixel, at the zenith. [rad]"""
    return 4.0 / height


OCTAHEDRAL = Projection(
    name="octahedral",
    ray=octahedral_ray,
    pixel_angle=pixel_angle,
    aspect=1,
    shape="a square",
    size=(1024, 1024),
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
    connected=False,
)

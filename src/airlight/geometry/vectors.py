"""Vectors of kernels: a structure of three numbers, in shading languages a vector type."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from airlight.kernel import inlined, kernel


class Vec3(NamedTuple):
    """Vector, by its components."""

    x: float
    y: float
    z: float


@kernel
def dot(a, b):
    """Scalar product.

    Examples
    --------
    >>> dot(Vec3(1.0, 2.0, 3.0), Vec3(0.5, 0.0, 1.0))
    3.5
    """
    return a.x * b.x + a.y * b.y + a.z * b.z


@kernel
def cross(a, b):
    """Vector product.

    Examples
    --------
    >>> cross(Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0))
    Vec3(x=0.0, y=0.0, z=1.0)
    """
    return Vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


@kernel
def scaled(a, factor):
    """Vector times a number."""
    return Vec3(factor * a.x, factor * a.y, factor * a.z)


@kernel
def plus(a, b):
    """Sum of two vectors."""
    return Vec3(a.x + b.x, a.y + b.y, a.z + b.z)


@kernel
def minus(a, b):
    """Difference of two vectors."""
    return Vec3(a.x - b.x, a.y - b.y, a.z - b.z)


@kernel
def components(a, x_axis, y_axis, z_axis):
    """Components of a vector along three axes: the rotation whose matrix has them as rows."""
    return Vec3(dot(x_axis, a), dot(y_axis, a), dot(z_axis, a))


@kernel
def combined(a, x_axis, y_axis, z_axis):
    """Vector from its components along three axes: the inverse of ``components``.

    Examples
    --------
    >>> x, y, z = Vec3(0.0, 1.0, 0.0), Vec3(-1.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0)
    >>> combined(Vec3(1.0, 2.0, 3.0), x, y, z), components(Vec3(-2.0, 1.0, 3.0), x, y, z)
    (Vec3(x=-2.0, y=1.0, z=3.0), Vec3(x=1.0, y=2.0, z=3.0))
    """
    return Vec3(
        a.x * x_axis.x + a.y * y_axis.x + a.z * z_axis.x,
        a.x * x_axis.y + a.y * y_axis.y + a.z * z_axis.y,
        a.x * x_axis.z + a.y * y_axis.z + a.z * z_axis.z,
    )


@inlined
def start_vectors(mu, mu_s, nu):
    """Horizontal components of a line (x, y) and of the direction to the star (x). [1]

    The frame at the start of the line: z up, the star in the plane of x and z, the line on the side
    of y.

    Parameters
    ----------
    mu, mu_s, nu : float
        Cosines of the zenith angles of line and star, and of the angle between them. [1]
    """
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    sun_x = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    around = 1.0
    if sine * sun_x > 0.0:
        around = min(max((nu - mu * mu_s) / (sine * sun_x), -1.0), 1.0)
    return sine * around, sine * sqrt(max((1.0 - around) * (1.0 + around), 0.0)), sun_x

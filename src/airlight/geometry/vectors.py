"""Vectors of kernels: a structure of three numbers, in shading languages a vector type."""

from __future__ import annotations

from typing import NamedTuple

from airlight.kernel import kernel


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

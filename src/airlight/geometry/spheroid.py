"""Straight lines and an oblate spheroid, by the affine map that makes it a sphere.

The map stretches along the polar axis by 1/(1 - f), with the flattening f. Lines remain lines, and
the shells of an atmosphere are similar spheroids: their distance from the ground along its normal
is that of the map over the stretch of the normal.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from airlight.geometry.vectors import Vec3, dot, minus, plus, scaled
from airlight.kernel import kernel


class LowestPoint(NamedTuple):
    """Point at which a line of sight meets a spheroid, or comes nearest to it.

    Attributes
    ----------
    normal : Vec3
        Outward normal of the spheroid there. [1]
    altitude, distance : float
        Height along the normal, 0 on the ground, and distance from the observer. [m]
    """

    normal: Vec3
    altitude: float
    distance: float


@kernel
def stretched(a, pole, flattening):
    """Vector after the map: longer by 1/(1 - f) along the polar axis.

    Parameters
    ----------
    a, pole : Vec3
        Vector, and direction of the north pole. [1]
    flattening : float
        Flattening f of the spheroid. [1]

    Examples
    --------
    >>> stretched(Vec3(1.0, 0.0, 0.9), Vec3(0.0, 0.0, 1.0), 0.1)
    Vec3(x=1.0, y=0.0, z=1.0)
    """
    return plus(a, scaled(pole, dot(a, pole) * flattening / (1.0 - flattening)))


@kernel
def unit(a):
    """Unit vector of a direction; zero remains. [1]"""
    return scaled(a, 1.0 / sqrt(max(dot(a, a), 1e-30)))


@kernel
def lowest_point(ray, r, pole, flattening, radius):
    """``LowestPoint`` of a line of sight from outside.

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame, whose third axis leaves the centre. [1]
    r : float
        Distance of the observer from the centre. [m]
    pole : Vec3
        Direction of the north pole. [1]
    flattening, radius : float
        Flattening [1] and equatorial radius [m] of the spheroid.

    Examples
    --------
    >>> pole, down = Vec3(0.0, 0.0, 1.0), Vec3(0.0, 0.0, -1.0)
    >>> round(lowest_point(down, 3.0, pole, 0.1, 1.0).distance, 12)  # to the north pole
    2.1
    """
    eye = stretched(Vec3(0.0, 0.0, r), pole, flattening)
    way = stretched(ray, pole, flattening)
    length = sqrt(dot(way, way))
    along = dot(eye, way) / length
    near = minus(eye, scaled(way, along / length))
    impact = sqrt(dot(near, near))
    half = sqrt(max((radius - impact) * (radius + impact), 0.0))
    end = minus(near, scaled(way, half / length))
    slope = stretched(end, pole, flattening)
    size = sqrt(dot(slope, slope))
    altitude = max(impact - radius, 0.0) * impact / max(size, 1e-30)
    return LowestPoint(scaled(slope, 1.0 / max(size, 1e-30)), altitude, -(along + half) / length)


@kernel
def height_above_limb(ray, r, pole, flattening, radius):
    """Sine of the angle between a line of sight and the limb, positive above it, after the map. [1]

    Parameters
    ----------
    ray, r, pole, flattening, radius :
        Arguments of ``lowest_point``; the length of the direction is arbitrary.
    """
    eye = stretched(Vec3(0.0, 0.0, r), pole, flattening)
    way = unit(stretched(ray, pole, flattening))
    square = dot(eye, eye)
    mu = dot(eye, way) / sqrt(square)
    limb = radius / sqrt(square)
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    return mu * limb + sine * sqrt(max((1.0 - limb) * (1.0 + limb), 0.0))


@kernel
def spheroid_point(normal, pole, flattening, radius):
    """Point of a spheroid with a normal, from the centre. [m]

    Parameters
    ----------
    normal : Vec3
        Outward normal, which points to the geodetic latitude. [1]
    pole, flattening, radius :
        Arguments of ``lowest_point``.

    Examples
    --------
    >>> round(spheroid_point(Vec3(0.0, 0.0, 1.0), Vec3(0.0, 0.0, 1.0), 0.1, 2.0).z, 12)
    1.8
    """
    north = dot(normal, pole)
    squeeze = (1.0 - flattening) * (1.0 - flattening)
    point = minus(normal, scaled(pole, north * (1.0 - squeeze)))
    return scaled(point, radius / sqrt(1.0 - north * north * (1.0 - squeeze)))


@kernel
def relative_curvature(normal, way, pole, flattening):
    """Normal curvature of a spheroid along a direction, over that of its equator. [1]

    Euler's theorem, with the radii of curvature along the meridian and across it.

    Parameters
    ----------
    normal, way : Vec3
        Outward normal of the spheroid, and a direction, of which the horizontal part counts. [1]
    pole, flattening :
        Arguments of ``lowest_point``.

    Examples
    --------
    >>> pole, side = Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 0.0)
    >>> round(relative_curvature(pole, side, pole, 0.1), 12)  # 1 - f
    0.9
    >>> round(relative_curvature(side, pole, pole, 0.1), 12)  # (1 - f)^-2
    1.234567901235
    """
    north, rise = dot(normal, pole), dot(way, normal)
    level = dot(way, pole) - rise * north
    flat = max((dot(way, way) - rise * rise) * (1.0 - north * north), 1e-12)
    share = min(level * level / flat, 1.0)
    square = flattening * (2.0 - flattening)
    root = sqrt(1.0 - square * north * north)
    return share * root * root * root / (1.0 - square) + (1.0 - share) * root


@kernel
def beside_shadow(point, sun, pole, flattening, radius):
    """Distance of a point from the edge of a spheroid's shadow, negative outside. [m]

    To first order in the distance: the width of the star's disc from there is far less than the
    spheroid.

    Parameters
    ----------
    point, sun : Vec3
        Point from the centre [m], and direction of the star [1].
    pole, flattening, radius :
        Arguments of ``lowest_point``.

    Examples
    --------
    >>> place = Vec3(-2.0, 0.0, 1.0)  # above the shadow of a pole
    >>> round(beside_shadow(place, Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), 0.1, 1.0), 12)
    -0.1
    """
    place = stretched(point, pole, flattening)
    star = unit(stretched(sun, pole, flattening))
    away = minus(place, scaled(star, dot(place, star)))
    size = sqrt(dot(away, away))
    slope = stretched(scaled(away, 1.0 / max(size, 1e-30)), pole, flattening)
    return (radius - size) / max(sqrt(dot(slope, slope)), 1e-3)

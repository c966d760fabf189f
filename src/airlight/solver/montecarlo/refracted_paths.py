"""Refraction of Monte Carlo paths: refraction angle of a segment, apparent direction of the star.

Segments are traced in the optical radius, in which they are straight (``geometry.refraction``). At
each event, point and direction are rotated about the normal of the ray's plane by the segment's
refraction angle, which gives the true ones; stars stay fixed. The apparent direction of the star,
and the flattening of its disc, are read from ``solver.tables.refraction_table``.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.refraction import apparent_sun, refraction_angle
from airlight.kernel import compiled_loop, inlined
from airlight.solver.montecarlo.rays import BESIDE, per_y
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Quadrature points of a panel, and panels of a leg, of the refraction column.
_POINTS: Final = 8
_PANELS: Final = 3
#: Number of strips of the star's disc.
_STRIPS: Final = 96


class RefractionColumn(NamedTuple):
    """Density of the refraction column and its quadrature, in the optical radius.

    Attributes
    ----------
    strength : float
        See ``physics.optics.refracting_shell``; 0 without refraction. [m⁻²]
    table : array, shape (m,)
        Density at even steps of the square root of altitude. [1]
    refraction_table : array, shape (rows, columns, 2)
        Table from ``refraction_table``; empty without refraction. [1]
    nodes, weights : array, shape (n,)
        Quadrature rule of a panel.
    """

    strength: float
    table: FloatArray
    refraction_table: FloatArray
    nodes: FloatArray
    weights: FloatArray


def refraction_column(geometry: RefractedGeometry, nodes: int) -> RefractionColumn:
    """Refraction column of a medium, tabulated at ``nodes`` altitudes."""
    rule = gauss_legendre(_POINTS)
    medium = geometry.medium
    if geometry.shell is None:
        return RefractionColumn(
            0.0, np.zeros(2), geometry.refraction_table, rule.nodes, rule.weights
        )
    x = np.linspace(0.0, 1.0, nodes)
    table = np.ascontiguousarray(medium.density.at(medium.thickness * x * x)[-1])
    return RefractionColumn(
        geometry.refraction_strength, table, geometry.refraction_table, rule.nodes, rule.weights
    )


@inlined
def _leg_column(start_r, end_r, tangent, bottom, scale, refraction):
    """Refraction column of a leg on which the radius is monotone. [m]"""
    high, low = max(start_r, end_r), min(start_r, end_r)
    offset = 0.0
    if low - tangent <= BESIDE * (high - tangent):
        low = min(tangent, low)
    else:
        offset = sqrt((low - tangent) * (low + tangent))
    first = sqrt(max(min(start_r, end_r) - low, 0.0))
    width = (sqrt(max(high - low, 0.0)) - first) / _PANELS
    total = 0.0
    for part in range(_PANELS):
        for k in range(refraction.nodes.size):
            y = first + width * (part + refraction.nodes[k])
            total += refraction.weights[k] * per_y(y, low, offset, bottom, refraction.table, scale)
    return total * width


@compiled_loop
def refraction_on_path(r, mu, along, bottom, thickness, refraction):
    """Refraction angle of a ray's first segment.

    Parameters
    ----------
    r, mu : float
        Optical radius of the start [m] and cosine of the ray's zenith angle there [1].
    along : float
        Length of the segment in the optical radius. [m]
    bottom, thickness : float
        Optical radius of the ground and thickness of the shell. [m]

    Returns
    -------
    float
        Angle towards the ground. [rad]
    """
    scale = (refraction.table.size - 1) / sqrt(thickness)
    tangent = r * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    end = sqrt(max(r * r + along * (along + 2.0 * r * mu), tangent * tangent))
    if mu < 0.0 and along > -r * mu:
        column = _leg_column(r, tangent, tangent, bottom, scale, refraction)
        column += _leg_column(tangent, end, tangent, bottom, scale, refraction)
    else:
        column = _leg_column(r, end, tangent, bottom, scale, refraction)
    return refraction_angle(r, mu, refraction.strength, column)


@inlined
def rotated_with_ray(x, y, z, u, v, w, angle):
    """Point and direction, both rotated by the refraction angle in the plane of the ray.

    Parameters
    ----------
    x, y, z : float
        Point of the straight line. [m]
    u, v, w : float
        Direction of the ray there. [1]
    angle : float
        Result of ``refraction_on_path``. [rad]
    """
    r = sqrt(x * x + y * y + z * z)
    a, b, c = x / r, y / r, z / r
    mu = min(max(u * a + v * b + w * c, -1.0), 1.0)
    sine = sqrt((1.0 - mu) * (1.0 + mu))
    if sine < 1e-9:
        return x, y, z, u, v, w
    d, e, f = (u - mu * a) / sine, (v - mu * b) / sine, (w - mu * c) / sine
    keep, turn = cos(angle), sin(angle)
    p, q, s = keep * a + turn * d, keep * b + turn * e, keep * c + turn * f
    d, e, f = keep * d - turn * a, keep * e - turn * b, keep * f - turn * c
    return r * p, r * q, r * s, mu * p + sine * d, mu * q + sine * e, mu * s + sine * f


@inlined
def apparent_direction(point, r, star, bottom, top, refraction):
    """Apparent direction of a point of the star's disc, and the disc's flattening there.

    Parameters
    ----------
    point, r : Vec3, float
        Point and its optical radius. [m]
    star : Vec3
        True direction of the point of the star. [1]
    bottom, top : float
        Optical radii of the ground and of the top. [m]

    Returns
    -------
    a, b, c, mu, refraction_jacobian : float
        Direction, cosine of its zenith angle, and d apparent/d true cosine. [1]
    """
    a, b, c = star
    up, side, ahead = point.x / r, point.y / r, point.z / r
    true = min(max(a * up + b * side + c * ahead, -1.0), 1.0)
    mu, refraction_jacobian, _ = apparent_sun(r, true, bottom, top, refraction.refraction_table)
    sine = sqrt(max((1.0 - true) * (1.0 + true), 0.0))
    if refraction.refraction_table.shape[0] == 0 or sine < 1e-9:
        return a, b, c, true, refraction_jacobian
    level = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0)) / sine
    a, b, c = (a - true * up) * level, (b - true * side) * level, (c - true * ahead) * level
    return a + mu * up, b + mu * side, c + mu * ahead, mu, refraction_jacobian


def refracted_direct_irradiance(
    geometry: RefractedGeometry, star_radius: float, r: FloatArray, mu_s: FloatArray
) -> FloatArray:
    """Direct horizontal irradiance with refraction, per irradiance of the star, (n, nl). [1]

    Parameters
    ----------
    star_radius : float
        Angular radius of the star. [rad]
    r, mu_s : array, shape (n,)
        Optical radius [m], and zenith cosine of the star's true centre [1].
    """
    medium = geometry.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    # Strips of equal height on the disc, each with its true area.
    middle = (np.arange(_STRIPS) + 0.5) * (2.0 / _STRIPS) - 1.0
    area = np.sqrt(1.0 - middle**2)
    area = area / area.sum()
    zenith = np.arccos(np.clip(mu_s, -1.0, 1.0))[:, None] - star_radius * middle
    at = r[:, None] + 0.0 * zenith
    seen, refraction_jacobian = np.empty(at.shape), np.empty(at.shape)
    table, found = geometry.refraction_table, (seen.ravel(), refraction_jacobian.ravel())
    _seen(at.ravel(), np.cos(zenith).ravel(), bottom, top, table, *found)
    horizon = -np.sqrt(np.maximum((at - bottom) * (at + bottom), 0.0)) / at
    shines = seen > horizon
    up = np.where(shines, seen, 1.0)
    length = -at * up + np.sqrt((top - at) * (top + at) + (at * up) ** 2)
    depth = columns(at, up, length, bottom, medium.density) @ medium.extinction
    weight = np.where(shines, area * refraction_jacobian * np.maximum(seen, 0.0), 0.0)
    return np.asarray((weight[..., None] * np.exp(-depth)).sum(axis=1))


@compiled_loop
def _seen(x, mu_s, bottom, top, refraction_table, seen, refraction_jacobian):
    for k in range(x.size):
        seen[k], refraction_jacobian[k], _ = apparent_sun(
            x[k], mu_s[k], bottom, top, refraction_table
        )

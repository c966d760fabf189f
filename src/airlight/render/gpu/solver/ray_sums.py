"""Source integrals along a ray on the GPU, one azimuth at a time.

The source functions are those of ``solver.moments.first_order`` and ``sweep``.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from airlight.geometry.mappings.transmittance import altitude_coordinate, direction_coordinate
from airlight.geometry.refraction import star_points
from airlight.kernel import inlined
from airlight.kernel.lanes import lane_array, lane_view, splat
from airlight.render.pixels.render_tables import MAX_CONSTITUENTS
from airlight.solver.moments.first_order import ISOTROPIC, SECOND, transmittance_row
from airlight.solver.moments.ray_optics import sun_index
from airlight.solver.moments.source_function import StarNode, source_at_point


class RayAndStar(NamedTuple):
    """Ray and star of a texel.

    Attributes
    ----------
    ray, i, a : int
        Indices of the ray, its radius and its direction.
    mu_s, nu : float
        Cosine of the star's zenith angle at the start of the ray, and between star and ray. [1]
    """

    ray: int
    i: int
    a: int
    mu_s: float
    nu: float


@inlined
def star_from_point(turn, point, mu_s, nu):
    """Star-zenith cosine and cosine between star and ray, at a ray point. [1]

    ``turn`` is a field of ``Rays``; ``mu_s`` and ``nu`` are the cosines at the start of the ray.
    """
    mu_s_point = min(max(turn[point, 0] * mu_s + turn[point, 1] * nu, -1.0), 1.0)
    return mu_s_point, turn[point, 2] * mu_s + turn[point, 3] * nu


@inlined
def azimuth_cosine(mu, mu_s, nu):
    """Cosine of the azimuth between ray and star at a ray point. [1]"""
    spread = (1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s)
    return min(max((nu - mu * mu_s) / sqrt(max(spread, 1e-24)), -1.0), 1.0)


@inlined
def depth_towards(ratios, row, f, place, distance, extinction, constituents):
    """Optical depth from a point to the top of the shell, in a tabulated direction. [1]

    Parameters
    ----------
    ratios : array, shape (radii, directions, nc, 2)
        Ratios of a ``ColumnTable``, from ``rational_mean_density``.
    row, f : int, float
        Index of the radius below the point, and interpolation fraction.
    distance : float
        Distance to the top. [m]
    extinction : lanes, shape (nc,)
        Extinction coefficients. [m⁻¹]
    """
    tau = splat(0.0)
    for c in range(constituents):
        scale = ratios[row, place, c, 0] * (1.0 - f) + ratios[row + 1, place, c, 0] * f
        scaled = ratios[row, place, c, 1] * (1.0 - f) + ratios[row + 1, place, c, 1] * f
        tau = tau + extinction[c] * np.float32(distance * scaled / scale)
    return tau


@inlined
def depth_in_row(ratios, x, q, place, bottom, top, extinction, constituents):
    """``depth_towards`` from radius q with fractional row x. [1]

    Directions are equidistant in the distance to the top.
    """
    row = min(int(x), ratios.shape[0] - 2)
    f = x - row
    shortest = top - q
    longest = (1.0 + altitude_coordinate(q, bottom, top)) * sqrt((top - bottom) * (top + bottom))
    distance = shortest + place * ((longest - shortest) / (ratios.shape[1] - 1))
    return depth_towards(ratios, row, f, place, distance, extinction, constituents)


@inlined
def fill_phases(moments, nu, degree, constituents, phases):
    """Compute the phase function times scattering coefficient of each constituent. [m⁻¹ sr⁻¹]"""
    for c in range(constituents):
        total = splat(0.0)
        before, value = 0.0, 1.0
        for l in range(degree + 1):
            total = total + moments[c, l] * np.float32((2 * l + 1) * ISOTROPIC * value)
            following = ((2 * l + 1) * nu * value - l * before) / (l + 1)
            before, value = value, following
        phases[c] = total


@inlined
def fill_phase_f12(polarised_moments, nu, constituents, phases):
    """Compute F₁₂ of degree 2 times scattering coefficient of each constituent. [m⁻¹ sr⁻¹]"""
    part = np.float32(SECOND * (1.0 - nu) * (1.0 + nu))
    for c in range(constituents):
        phases[c] = polarised_moments[c, 0] * part


@inlined
def scattered_once(path, first_point, strengths, depths, sizes, tables):
    """Single-scattering integral along a ray: I, and Q in the plane of ray and star. [sr⁻¹]

    Parameters
    ----------
    path : RayAndStar
        Ray and star.
    first_point : int
        Point of the first row of ``depths`` after that of the ground.
    strengths : lanes, shape (points, nc + 1)
        Amount of each constituent at a point times the transmittance from there [m], and
        ``polarised_transmittance_ratio`` [1].
    depths : lanes, shape (1 + points, directions)
        Depths from ``depth_in_row``. [1]
    sizes, tables : GridSizes, Tables
        Inputs of the host.
    """
    bottom, top, directions = sizes.bottom, sizes.top, sizes.directions
    phases = lane_view(lane_array(MAX_CONSTITUENTS))
    phase_f12 = lane_view(lane_array(MAX_CONSTITUENTS))
    fill_phases(tables.moments, path.nu, sizes.degree, sizes.constituents, phases)
    fill_phase_f12(tables.polarised_moments, path.nu, sizes.constituents, phase_f12)
    radiance, polarised = splat(0.0), splat(0.0)
    for k in range(int(tables.start[path.i, path.a]), int(tables.start[path.i, path.a + 1])):
        q, row = tables.radius[k], 1 + k - first_point
        mu_sk, _ = star_from_point(tables.turn, k, path.mu_s, path.nu)
        seen, low, high = star_points(
            q, mu_sk, bottom, top, sizes.star_radius, tables.refraction_table
        )
        if seen <= 0.0:
            continue
        x = direction_coordinate(q, low, bottom, top) * (directions - 1)
        light = transmittance_row(depths, row, x, directions)
        if high > low:
            x = direction_coordinate(q, high, bottom, top) * (directions - 1)
            light = light + transmittance_row(depths, row, x, directions)
            light = light * np.float32(0.5)
        source, turned = splat(0.0), splat(0.0)
        for c in range(sizes.constituents):
            amount = strengths[k, c]
            source = source + phases[c] * amount
            turned = turned + phase_f12[c] * amount
        light = np.float32(seen) * light
        radiance = radiance + light * source
        polarised = polarised + light * turned * strengths[k, sizes.constituents]
    return radiance, polarised


@inlined
def gathered(path, first_point, rows, bright, polarised, sizes, tables):
    """Multiple-scattering integral along a ray: I, Q and U. [1]

    Parameters
    ----------
    path : RayAndStar
        Ray and star.
    first_point : int
        Point of the first row of ``rows``.
    rows : lanes, shape (points, s, 7 + N)
        For each point and sun the node of ``source_at_point``.
    bright, polarised : bool
        Constants: whether I, and whether Q and U are computed; otherwise they are 0.
    sizes, tables : GridSizes, Tables
        Inputs of the host.
    """
    radiance, stokes_q, stokes_u = splat(0.0), splat(0.0), splat(0.0)
    for k in range(int(tables.start[path.i, path.a]), int(tables.start[path.i, path.a + 1])):
        mu_sk, nu_k = star_from_point(tables.turn, k, path.mu_s, path.nu)
        x = sun_index(mu_sk, tables.place)
        column = min(int(x), sizes.sun_angles - 2)
        step = azimuth_cosine(tables.mu_along[k], mu_sk, nu_k)
        sine = sqrt(max((1.0 - step) * (1.0 + step), 0.0))
        star = StarNode(column, x - column, step, sine)
        light, point_q, point_u = source_at_point(
            rows, k - first_point, star, sizes.degree + 1, sizes.degree, bright, polarised, False
        )
        radiance, stokes_q, stokes_u = radiance + light, stokes_q + point_q, stokes_u + point_u
    return radiance, stokes_q, stokes_u

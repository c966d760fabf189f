"""Source integrals along a ray on the GPU, one azimuth at a time.

The source functions are those of ``solver.moments.first_order`` and ``sweep``.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.geometry.mappings.transmittance import altitude_coordinate, direction_coordinate
from airlight.geometry.refraction import star_points
from airlight.kernel import inlined
from airlight.kernel.lanes import splat
from airlight.solver.moments.first_order import ISOTROPIC, SECOND, transmittance_row
from airlight.solver.moments.ray_optics import sun_index
from airlight.solver.moments.source_function import source_at_point


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
def scattered_once(
    turn, radii, first, points, strong, strengths, phases, phase_f12, constituents, deep, depths,
    directions, mu_s, nu, bottom, top, star_radius, refraction_table,
):  # fmt: skip
    """Single-scattering integral along a ray: I, and Q in the plane of ray and star. [sr⁻¹]

    Parameters
    ----------
    turn, radii : array
        Arrays ``turn`` and ``radius`` of ``Rays``.
    first, points : int
        First point of the ray, and number of points.
    strong, deep : int
        Index of the first point in ``strengths`` and ``depths``.
    strengths : lanes, shape (points, nc + 1)
        Amount of each constituent at a point times the transmittance from there [m], and
        ``polarised_transmittance_ratio`` [1].
    phases, phase_f12 : lanes, shape (nc,)
        Arrays from ``fill_phases`` and ``fill_phase_f12``. [m⁻¹ sr⁻¹]
    depths : lanes, shape (points, directions)
        Depths from ``depth_in_row``. [1]
    mu_s, nu : float
        Cosines of the star at the start of the ray. [1]
    """
    radiance, polarised = splat(0.0), splat(0.0)
    for k in range(points):
        q = radii[first + k]
        mu_sk, _ = star_from_point(turn, first + k, mu_s, nu)
        seen, low, high = star_points(q, mu_sk, bottom, top, star_radius, refraction_table)
        if seen <= 0.0:
            continue
        x = direction_coordinate(q, low, bottom, top) * (directions - 1)
        light = transmittance_row(depths, deep + k, x, directions)
        if high > low:
            x = direction_coordinate(q, high, bottom, top) * (directions - 1)
            light = light + transmittance_row(depths, deep + k, x, directions)
            light = light * np.float32(0.5)
        source, turned = splat(0.0), splat(0.0)
        for c in range(constituents):
            amount = strengths[strong + k, c]
            source = source + phases[c] * amount
            turned = turned + phase_f12[c] * amount
        light = np.float32(seen) * light
        radiance = radiance + light * source
        polarised = polarised + light * turned * strengths[strong + k, constituents]
    return radiance, polarised


@inlined
def gathered(
    turn,
    mu_along,
    first,
    points,
    local,
    rows,
    mu_s,
    nu,
    places,
    sun_angles,
    degree,
    bright,
    polarised,
):
    """Multiple-scattering integral along a ray: I, Q and U. [1]

    Parameters
    ----------
    turn, mu_along : array
        Arrays of ``Rays``.
    local : int
        Index of the first point in ``rows``.
    rows : lanes, shape (points, s, 7 + N)
        For each point and sun the node of ``source_at_point``.
    places : array
        Lookup table ``Grid.place``.
    sun_angles, degree : int
        Number of sun elevations, and highest degree.
    bright, polarised : bool
        Constants: whether I, and whether Q and U are computed; otherwise they are 0.
    """
    radiance, stokes_q, stokes_u = splat(0.0), splat(0.0), splat(0.0)
    for k in range(points):
        mu_sk, nu_k = star_from_point(turn, first + k, mu_s, nu)
        x = sun_index(mu_sk, places)
        column = min(int(x), sun_angles - 2)
        step = np.float32(azimuth_cosine(mu_along[first + k], mu_sk, nu_k))
        sine = sqrt(max((np.float32(1.0) - step) * (np.float32(1.0) + step), np.float32(0.0)))
        light, point_q, point_u = source_at_point(
            rows, local + k, column, np.float32(x - column), step, sine, degree + 1, degree,
            bright, polarised, False,
        )  # fmt: skip
        radiance, stokes_q, stokes_u = radiance + light, stokes_q + point_q, stokes_u + point_u
    return radiance, stokes_q, stokes_u

"""Kernels of the solver passes from ray radiances to moments, for all orders.

``rays`` defines the index.
"""

from __future__ import annotations

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import INVERSE_PI, splat
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.reflection import mean_direct_reflectance
from airlight.render.gpu.solver.ray_sums import (
    RayAndStar,
    gathered,
    scattered_once,
)
from airlight.solver.moments.first_order import direct_light
from airlight.solver.moments.harmonics import EVEN, POLARISED, degree_of, polarised_function
from airlight.solver.moments.ray_optics import mu_r_at_end, sky_at, star_at_end, star_from_ray
from airlight.solver.moments.source_function import contracted, coupled_moments, odd_moment
from airlight.solver.stokes_frame import star_plane


@inlined
def ray_and_star(index, sizes, tables):
    """``RayAndStar`` of a texel (radius, direction, sun, azimuth).

    Parameters
    ----------
    sizes, tables : GridSizes, Tables
        Inputs of the host.
    """
    b = index % sizes.turns
    j = index // sizes.turns % sizes.sun_angles
    ray = index // (sizes.turns * sizes.sun_angles)
    i, a = ray // sizes.angles, ray % sizes.angles
    mu_s = tables.sun_cosines[j]
    return RayAndStar(ray, i, a, mu_s, star_from_ray(tables.mu[i, a], mu_s, tables.cosines[b]))


@inlined
def radiance_once(index, sizes, tables, first_point, shares, strengths, throughs, depths):
    """Single-scattering radiance of a ray, including ground reflection. [sr⁻¹]

    Texels (radius, direction, sun, azimuth) of I, and of Q in the plane of ray and star.
    """
    path = ray_and_star(index, sizes, tables)
    ray, i, a, mu_s, nu = path
    radiance, scattering_q = scattered_once(path, first_point, strengths, depths, sizes, tables)
    share = shares[ray]
    radiance = share * radiance
    if a < sizes.angles // 2:
        at_ground = star_at_end(tables.end, i, a, mu_s, nu)
        factor = mean_direct_reflectance(
            tables.ground, 0, at_ground, mu_r_at_end(tables.end, i, a, tables.mu[i, a]), nu
        )
        radiance = radiance + factor * INVERSE_PI * throughs[ray] * direct_light(
            at_ground,
            sizes.bottom,
            sizes.top,
            sizes.star_radius,
            depths,
            0,
            sizes.directions,
            tables.refraction_table,
        )
    return radiance, share * scattering_q


@inlined
def row(index, sizes, tables, first_point, factors, packed):
    """Moments at a ray point, contracted with ``factor``. [1]

    Texels (point, sun, ``rows`` of ``gathered``); points of one radius range.
    """
    block = sizes.degree + 2 + POLARISED
    part = index % block
    j = index // block % sizes.sun_angles
    point = first_point + index // (block * sizes.sun_angles)
    x = node_value(tables.radius[point], sizes.bottom, sizes.top, tables.first_nodes, tables.row)
    level = min(int(x), sizes.levels - 2)
    f = np.float32(x - level)
    if part == 0:
        return (np.float32(1.0) - f) * packed[level, j, 0] + f * packed[level + 1, j, 0]
    last = sizes.terms - POLARISED + EVEN
    if part > sizes.degree + 1:
        m = part - 2 - sizes.degree
        slanting = m >= EVEN
        if slanting:
            m = m - EVEN + 1
        moment, coupled = coupled_moments(packed, level, j, f, m, sizes.degree, False)
        even, odd = polarised_function(tables.mu_along[point], m)
        if slanting:
            even, odd = odd, even
        sent = factors[point, last] * moment + factors[point, last + 1] * coupled
        sent = np.float32(even) * sent
        if m > 0:
            coupled = odd_moment(packed, level, j, f, m, sizes.degree, False)
            sent = sent + np.float32(odd) * factors[point, last + 2] * coupled
        return sent
    m = part - 1
    total = contracted(factors, point, packed, level, j, f, m, sizes.degree, False)
    if m < EVEN:
        _, coupled = coupled_moments(packed, level, j, f, m, sizes.degree, False)
        total = total + factors[point, last + m - EVEN] * coupled
    return total


@inlined
def radiance_again(index, sizes, tables, first_point, shares, rows, bounces, irradiances):
    """Multiple-scattering radiance of a ray, from the previous iterate. [sr⁻¹]

    Texels (radius, direction, sun, azimuth).
    """
    path = ray_and_star(index, sizes, tables)
    ray, i, a, mu_s, nu = path
    radiance, _, _ = gathered(path, first_point, rows, True, False, sizes, tables)
    radiance = shares[ray] * radiance
    if a < sizes.angles // 2:
        at_ground = star_at_end(tables.end, i, a, mu_s, nu)
        sky = sky_at(irradiances, at_ground, tables.place, sizes.sun_angles)
        radiance = radiance + bounces[ray] * sky
    return radiance


@inlined
def polarised_again(index, sizes, tables, first_point, shares, rows):
    """Multiple-scattering Q and U of a ray, from the previous iterate. [sr⁻¹]

    Texels (radius, direction, sun, azimuth).
    """
    path = ray_and_star(index, sizes, tables)
    _, stokes_q, stokes_u = gathered(path, first_point, rows, False, True, sizes, tables)
    share = shares[path.ray]
    return share * stokes_q, share * stokes_u


@inlined
def azimuthal_once(index, sizes, tables, radiances, planes):
    """Fourier integrals over azimuth, from ``radiance_once``; texels of ``azimuthal``. [sr⁻¹]"""
    width = sizes.degree + 1 + POLARISED
    part = index % width
    start = index // width * sizes.turns
    total = splat(0.0)
    for b in range(sizes.turns):
        value = radiances[start + b]
        if part > sizes.degree:
            _, i, a, mu_s, nu = ray_and_star(start + b, sizes, tables)
            cosine, sine = star_plane(tables.mu[i, a], mu_s, nu)
            turn = cosine
            if part > sizes.degree + EVEN:
                turn = sine
            value = np.float32(turn) * planes[start + b]
        total = total + np.float32(azimuthal_weight(tables, part, b, sizes.degree)) * value
    return total


@inlined
def azimuthal_weight(tables, part, b, degree):
    """Weight of azimuth ``b`` in an integral of ``azimuthal``. [rad]"""
    if part > degree + EVEN:
        return tables.sines[part - degree - EVEN, b]
    if part > degree:
        return tables.multiples[part - degree - 1, b]
    return tables.multiples[part, b]


@inlined
def azimuthal(index, sizes, tables, radiances, stokes_qs, stokes_us):
    """Fourier integrals of the Stokes parameters over azimuth. [sr⁻¹]

    Texels (radius, direction, sun, integral): ∫ I cos mφ dφ, then ∫ Q cos mφ dφ of m = 0 to 2, and
    ∫ U sin mφ dφ of m = 1 and 2.
    """
    width = sizes.degree + 1 + POLARISED
    part = index % width
    start = index // width * sizes.turns
    total = splat(0.0)
    for b in range(sizes.turns):
        value = radiances[start + b]
        if part > sizes.degree + EVEN:
            value = stokes_us[start + b]
        elif part > sizes.degree:
            value = stokes_qs[start + b]
        total = total + np.float32(azimuthal_weight(tables, part, b, sizes.degree)) * value
    return total


@inlined
def gathered_moment(index, sizes, projections, azimuthals):
    """Moment of the radiance, or downward irradiance. [1]

    Texels (radius, sun, moment) of moments, then (radius, sun) of irradiance.
    """
    nodes = sizes.radii * sizes.sun_angles
    width, weights = sizes.degree + 1 + POLARISED, sizes.terms
    total = splat(0.0)
    if index >= nodes * sizes.terms:
        node = index - nodes * sizes.terms
        i, j = node // sizes.sun_angles, node % sizes.sun_angles
        start = sizes.radii * sizes.angles * weights + i * sizes.angles
        for a in range(sizes.angles):
            at = ((i * sizes.angles + a) * sizes.sun_angles + j) * width
            total = total + np.float32(projections[start + a]) * azimuthals[at]
        return total
    node, term = index // sizes.terms, index % sizes.terms
    i, j = node // sizes.sun_angles, node % sizes.sun_angles
    harmonics = sizes.terms - POLARISED
    m = sizes.degree + 1 + term - harmonics
    first, second = term, term + EVEN - 1  # weights of Q, and of U of m = 1 and 2
    if term < harmonics:
        l = degree_of(term)
        m = term - l * (l + 1) // 2
    elif term >= harmonics + EVEN:
        m = m - EVEN + 1
        first, second = term, term - EVEN + 1
    for a in range(sizes.angles):
        ray = i * sizes.angles + a
        at = (ray * sizes.sun_angles + j) * width + m
        start = ray * weights
        total = total + np.float32(projections[start + first]) * azimuthals[at]
        if term > harmonics:
            odd = azimuthals[at + EVEN - 1]
            total = total + np.float32(projections[start + second]) * odd
    return total


@inlined
def gathered_onto(index, sizes, projections, azimuthals, first):
    """Sum of ``gathered_moment`` and the first order."""
    return first[index] + gathered_moment(index, sizes, projections, azimuthals)

"""Texels of the solver's passes, from the radiances of rays to the moments of the light.

They serve the first order and each later one; ``rays`` explains how a texel is related to its
index.
"""

from __future__ import annotations

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, lane_array, load, splat
from airlight.optics.reflection import sky_factor, star_factor
from airlight.pixels.shown import MOST_CONSTITUENTS
from airlight.solvers.moments.first_order import direct_light, fill_phases, scattered_once
from airlight.solvers.moments.grid import radius_index
from airlight.solvers.moments.harmonics import degree_of
from airlight.solvers.moments.sweep import (
    contracted,
    gathered,
    leaving_at_end,
    sky_at,
    star_at_end,
    star_from_ray,
)


@inlined
def ray_and_star(index, sizes, tables):
    """Ray and star of a texel (radius, direction, sun, azimuth).

    Parameters
    ----------
    index : int
        Index of the texel.
    sizes, tables : Sizes, Tables
        Inputs from the host.

    Returns
    -------
    ray, i, a : int
        Indices of the ray, its radius and its direction.
    mu_s, nu : float
        Cosine of the star's zenith angle at the start of the ray, and between star and ray. [1]
    """
    b = index % sizes.turns
    j = index // sizes.turns % sizes.suns
    ray = index // (sizes.turns * sizes.suns)
    i, a = ray // sizes.angles, ray % sizes.angles
    mu_s = tables.sun_cosines[j]
    return ray, i, a, mu_s, star_from_ray(tables.mu[i, a], mu_s, tables.cosines[b])


@inlined
def radiance_once(index, sizes, tables, first_point, shares, strengths, throughs, depths):
    """Radiance of a ray by light that has been scattered or reflected once. [sr⁻¹]

    Texels (radius, direction, sun, azimuth).
    """
    ray, i, a, mu_s, nu = ray_and_star(index, sizes, tables)
    first = int(tables.start[i, a])
    points = int(tables.start[i, a + 1]) - first
    phases = lane_array(MOST_CONSTITUENTS)
    fill_phases(tables.moments, nu, sizes.degree, sizes.constituents, phases)
    radiance = load(shares, LANES * ray) * scattered_once(
        tables.turn,
        tables.radius,
        first,
        points,
        first,
        strengths,
        phases,
        sizes.constituents,
        1 + first - first_point,
        depths,
        sizes.directions,
        mu_s,
        nu,
        sizes.bottom,
        sizes.top,
        sizes.star_radius,
        tables.lift,
    )
    if a < sizes.angles // 2:
        at_ground = star_at_end(tables.end, i, a, mu_s, nu)
        factor = star_factor(
            tables.ground, 0, at_ground, leaving_at_end(tables.end, i, a, tables.mu[i, a]), nu
        )
        radiance = radiance + factor * INVERSE_PI * load(throughs, LANES * ray) * direct_light(
            at_ground,
            sizes.bottom,
            sizes.top,
            sizes.star_radius,
            depths,
            0,
            sizes.directions,
            tables.lift,
        )
    return radiance


@inlined
def row(index, sizes, tables, first_point, factors, packed):
    """Moments at a point of a ray, contracted with their contribution along the ray. [1]

    Texels (point, sun, 2 + N): s, then A_0 s … A_N s; the points of one span of radii.
    """
    block = sizes.degree + 2
    part = index % block
    j = index // block % sizes.suns
    point = first_point + index // (block * sizes.suns)
    x = radius_index(tables.radius[point], sizes.bottom, sizes.top, tables.row)
    level = min(int(x), sizes.levels - 2)
    f = np.float32(x - level)
    low = (level * sizes.suns + j) * (1 + sizes.terms) * LANES
    high = low + sizes.suns * (1 + sizes.terms) * LANES
    if part == 0:
        return (np.float32(1.0) - f) * load(packed, low) + f * load(packed, high)
    return contracted(
        factors, LANES * point * sizes.terms, packed, low, high, f, part - 1, sizes.degree
    )


@inlined
def radiance_again(index, sizes, tables, first_point, shares, rows, throughs, irradiances):
    """Radiance of a ray by light that was scattered or reflected in earlier orders. [sr⁻¹]

    Texels (radius, direction, sun, azimuth).
    """
    ray, i, a, mu_s, nu = ray_and_star(index, sizes, tables)
    first = int(tables.start[i, a])
    points = int(tables.start[i, a + 1]) - first
    radiance = load(shares, LANES * ray) * gathered(
        tables.turn,
        tables.mu_along,
        first,
        points,
        first - first_point,
        rows,
        mu_s,
        nu,
        tables.place,
        sizes.suns,
        sizes.degree,
    )
    if a < sizes.angles // 2:
        at_ground = star_at_end(tables.end, i, a, mu_s, nu)
        factor = sky_factor(tables.ground, 0, leaving_at_end(tables.end, i, a, tables.mu[i, a]))
        radiance = radiance + factor * INVERSE_PI * load(throughs, LANES * ray) * sky_at(
            irradiances, at_ground, tables.place, sizes.suns
        )
    return radiance


@inlined
def azimuthal(index, sizes, tables, radiances):
    """Fourier integral ∫ L cos mφ dφ of the radiance. [sr⁻¹]

    Texels (radius, direction, sun, m).
    """
    m = index % (sizes.degree + 1)
    start = index // (sizes.degree + 1) * sizes.turns
    total = splat(0.0)
    for b in range(sizes.turns):
        total = total + np.float32(tables.multiples[m, b]) * load(radiances, LANES * (start + b))
    return total


@inlined
def gathered_moment(index, sizes, projections, azimuthals):
    """Moment of the incoming light, or irradiance of a level surface from above. [1]

    Texels (radius, sun, moment), and after them (radius, sun).
    """
    nodes = sizes.radii * sizes.suns
    width = sizes.degree + 1
    total = splat(0.0)
    if index >= nodes * sizes.terms:
        node = index - nodes * sizes.terms
        i, j = node // sizes.suns, node % sizes.suns
        weights = sizes.radii * sizes.angles * sizes.terms + i * sizes.angles
        for a in range(sizes.angles):
            at = ((i * sizes.angles + a) * sizes.suns + j) * width
            total = total + np.float32(projections[weights + a]) * load(azimuthals, LANES * at)
        return total
    node, term = index // sizes.terms, index % sizes.terms
    i, j = node // sizes.suns, node % sizes.suns
    l = degree_of(term)
    m = term - l * (l + 1) // 2
    for a in range(sizes.angles):
        ray = i * sizes.angles + a
        at = (ray * sizes.suns + j) * width + m
        total = total + np.float32(projections[ray * sizes.terms + term]) * load(
            azimuthals, LANES * at
        )
    return total


@inlined
def gathered_onto(index, sizes, projections, azimuthals, first):
    """Sum of ``gathered_moment`` and the first order."""
    return load(first, LANES * index) + gathered_moment(index, sizes, projections, azimuthals)

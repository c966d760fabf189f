"""Sweep: moments of the next order of scattering from those of the previous ones.

For each radius and direction the radiance is a quadrature along a ray, and the source function at a
point is a sum over the moments. Factors that depend on the ray alone, Legendre functions and
interpolation in radius, are contracted first, so that the inner loop over sun angles and azimuths
sums only N + 1 cosines. Eight wavelengths run in the lanes of a register.

Between grid nodes rational interpolation is used: with s = 1/sqrt(M_00) at each node, the value is
lerp(M·s)/lerp(s). It is exact at the nodes and, for exponential M, half-way between them, and keeps
M_00 positive, which linear interpolation does not in twilight, where M falls e-fold within a
degree.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, folded, lane_view, load, splat
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.reflection import diffuse_reflectance
from airlight.solver.moments.harmonics import legendre_functions
from airlight.solver.moments.ray_optics import (
    add_polarised,
    mu_r_at_end,
    project,
    project_polarised,
    sky_at,
    star_at_end,
    star_from_ray,
    transmittance_ray,
)
from airlight.solver.moments.ray_source import (
    LevelPoint,
    by_level,
    factor_count,
    fill_factors,
    order_registers,
    registers_of,
    source_four_suns,
)
from airlight.solver.moments.source_function import StarNode, source_at_point
from airlight.solver.moments.star_places import StarNodes, place_stars

#: Legendre functions below this along a whole ray are neglected: high orders on steep rays. [1]
_STEEP = 1e-4
#: Number of rays whose points are processed together if the moments exceed the cache.
_TOGETHER = 6
_CACHED = 1_000_000


@inlined
def _sweep(i, tables, field, ground, degrees, out, sky_out, narrow):
    """``sweep_radius``, or ``sweep_radius_narrow`` if ``narrow``, a constant."""
    # Unpacked once: in the loop each access of a tuple would count references.
    grid, rays, norm, azimuths, air, expansion = tables
    bottom, top, radii, sun_cosines, first_nodes, rows_at, places = grid
    (
        all_mu,
        all_weights,
        all_flux,
        _,
        starts,
        totals,
        ends,
        ray_radii,
        mu_along,
        turns_along,
        amounts,
        depths,
    ) = rays
    cosines, multiples, sines = azimuths
    extinction, moments, surface, _, polarised_moments = air
    sun_angles = sun_cosines.size
    degree = multiples.shape[0] - 1
    turns = cosines.size
    harmonics = (degree + 1) * (degree + 2) // 2
    constituents = totals.shape[2]
    angles = all_mu.shape[1]
    all_wide, _, sent = order_registers(degree, narrow)
    registers = factor_count(degree, narrow)
    together = 1
    if field.size > _CACHED:
        together = _TOGETHER
    most = longest = 1
    for first_ray in range(0, angles, together):
        after = min(first_ray + together, angles)
        most = max(most, starts[i, after] - starts[i, first_ray])
    for a in range(angles):
        longest = max(longest, starts[i, a + 1] - starts[i, a])
    rows = lane_view(np.empty((most, sun_angles, 1 + all_wide + sent, LANES), np.float32))
    factors = lane_view(np.empty((most, registers, LANES), np.float32))
    levels = np.empty(most, np.int64)
    fractions = np.empty(most, np.float32)
    degrees_at = np.empty(most, np.int64)
    wide_at = np.empty(most, np.int64)
    order = np.empty(most, np.int64)
    turned = np.empty(2 * most, np.float32)
    functions = np.empty(harmonics)
    reach = np.empty(degree + 1)
    orders_of = np.empty(angles, np.int64)
    azimuthal = np.empty((degree + 1, LANES), np.float32)
    polarised = np.empty((5, LANES), np.float32)
    azimuthal_lanes, polarised_lanes = lane_view(azimuthal), lane_view(polarised)
    groups = -(-turns // LANES) * LANES
    around = np.empty(2 * groups, np.float32)
    for b in range(groups):
        cosine = cosines[min(b, turns - 1)]
        around[b] = np.float32(cosine)
        around[groups + b] = np.float32(sqrt((1.0 - cosine) * (1.0 + cosine)))
    table = np.empty(places.size, np.float32)
    for k in range(places.size):
        table[k] = np.float32(places[k])
    columns = np.empty((longest, LANES), np.float32)
    shares = np.empty((longest, LANES), np.float32)
    star_cosines = np.empty((longest, LANES), np.float32)
    star_sines = np.empty((longest, LANES), np.float32)
    stars = StarNodes(columns, shares, star_cosines, star_sines)
    along_rays = (mu_along, amounts, depths)
    extinction = lane_view(extinction)
    optics = (extinction, lane_view(moments), lane_view(polarised_moments))
    field, ground, norm = lane_view(field), lane_view(ground), lane_view(norm)
    moments_out, sky_lanes = lane_view(out), lane_view(sky_out)
    out[:] = 0.0
    sky_out[:] = 0.0
    for a in range(angles):
        mu = all_mu[i, a]
        sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
        below = a < angles // 2
        if a % together == 0:
            head = starts[i, a]
            for ray in range(a, min(a + together, angles)):
                reach[:] = 0.0
                for point in range(starts[i, ray], starts[i, ray + 1]):
                    k = point - head
                    x = node_value(ray_radii[point], bottom, top, first_nodes, rows_at)
                    row = min(int(x), radii.size - 2)
                    levels[k], fractions[k] = row, np.float32(x - row)
                    degrees_at[k] = max(degrees[row], degrees[row + 1])
                    fill_factors(
                        point,
                        along_rays,
                        optics,
                        expansion,
                        degrees_at[k],
                        functions,
                        k,
                        factors,
                        narrow,
                    )
                    for l in range(degree + 1):
                        for m in range(l + 1):
                            reach[m] = max(reach[m], abs(functions[l * (l + 1) // 2 + m]))
                orders_of[ray] = 1
                for m in range(degree + 1):
                    if reach[m] > _STEEP:
                        orders_of[ray] = m + 1
                for point in range(starts[i, ray], starts[i, ray + 1]):
                    k = point - head
                    wide_at[k] = registers_of(min(orders_of[ray], degrees_at[k] + 1), narrow)
            count = starts[i, min(a + together, angles)] - head
            by_level(levels, count, radii.size, order)
            for start in range(0, sun_angles, 4):
                for index in range(count):
                    k = order[index]
                    between = LevelPoint(k, levels[k], fractions[k], wide_at[k], degrees_at[k])
                    source_four_suns(
                        between, factors, sun_angles, field, start, degree, rows, narrow
                    )
        first = starts[i, a] - head
        points = starts[i, a + 1] - starts[i, a]
        orders = orders_of[a]
        for k in range(points):
            point = starts[i, a] + k
            turned[2 * (first + k)] = np.float32(turns_along[point, 0] + turns_along[point, 1] * mu)
            turned[2 * (first + k) + 1] = np.float32(turns_along[point, 1] * sine)
        reflected = splat(0.0)
        if below:
            transmittance = transmittance_ray(extinction, totals[i, a], 0, constituents)
            factor = diffuse_reflectance(surface, 0, mu_r_at_end(ends, i, a, mu))
            reflected = factor * INVERSE_PI * transmittance
        legendre_functions(mu, expansion, functions)
        exact = norm[i, a]
        for j in range(sun_angles):
            mu_s = sun_cosines[j]
            sine_s = np.float32(sqrt((1.0 - mu_s) * (1.0 + mu_s)))
            azimuthal[:] = 0.0
            polarised[:] = 0.0
            for b in range(turns):
                lane = b % LANES
                if lane == 0:
                    ahead = load(around, b) * sine_s
                    aside = load(around, groups + b) * sine_s
                    place_stars(
                        turned,
                        first,
                        points,
                        ahead,
                        aside,
                        np.float32(mu_s),
                        table,
                        sun_angles,
                        stars,
                    )
                radiance, stokes_q, stokes_u = splat(0.0), splat(0.0), splat(0.0)
                for k in range(points):
                    star = StarNode(
                        int(columns[k, lane]),
                        shares[k, lane],
                        star_cosines[k, lane],
                        star_sines[k, lane],
                    )
                    light, point_q, point_u = source_at_point(
                        rows, first + k, star, wide_at[first + k], degree, True, True, narrow
                    )
                    radiance = radiance + light
                    stokes_q = stokes_q + point_q
                    stokes_u = stokes_u + point_u
                if narrow:
                    radiance, stokes_q, stokes_u = (
                        folded(radiance),
                        folded(stokes_q),
                        folded(stokes_u),
                    )
                radiance = exact * radiance
                stokes_q, stokes_u = exact * stokes_q, exact * stokes_u
                add_polarised(polarised_lanes, multiples, sines, b, stokes_q, stokes_u)
                if below:
                    nu = star_from_ray(mu, mu_s, cosines[b])
                    mu_sg = star_at_end(ends, i, a, mu_s, nu)
                    radiance = radiance + reflected * sky_at(ground, mu_sg, places, sun_angles)
                for m in range(orders):
                    azimuthal_lanes[m] += multiples[m, b] * radiance
            weight = all_weights[i, a]
            project(azimuthal_lanes, functions, weight, degree, orders, j, moments_out)
            project_polarised(polarised_lanes, mu, weight, j, harmonics, moments_out)
            if not below:
                sky_lanes[j] += np.float32(all_flux[i, a]) * azimuthal_lanes[0]


@compiled_loop
def sweep_radius(i, tables, field, ground, degrees, out, sky_out):
    """Moments of the next order at one radius, for all sun angles.

    Parameters
    ----------
    i : int
        Index of the radius.
    tables : SweepTables
        Shell, its rays, and its optics.
    field : array, shape (r, s, 1 + k, 8)
        Moments of the previous orders, as (s, M·s) per node; see the head of this file.
    ground : array, shape (1, s, 2, 8)
        Diffuse irradiance of the ground by these, as (s, E·s) per node.
    degrees : array, shape (r,)
        Highest active degree at each radius, see ``active_degrees``.
    out : array, shape (s, k, 8)
        Receives the moments at this radius.
    sky_out : array, shape (s, 8)
        Receives the diffuse horizontal irradiance from above.
    """
    _sweep(i, tables, field, ground, degrees, out, sky_out, False)


@compiled_loop
def sweep_radius_narrow(i, tables, field, ground, degrees, out, sky_out):
    """``sweep_radius`` for at most four wavelengths, two moments in a register.

    Both halves of ``tables.norm`` and of ``tables.air`` have the same wavelengths; ``field`` has
    pairs of moments, see ``packing.pair_order``.
    """
    _sweep(i, tables, field, ground, degrees, out, sky_out, True)

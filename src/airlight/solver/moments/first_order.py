"""First order: moments of single scattering and of reflected direct light."""

from __future__ import annotations

from math import pi, sqrt
from typing import Final

import numpy as np

from airlight.geometry.mappings.transmittance import direction_coordinate
from airlight.geometry.refraction import direct_horizontal_weights
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import (
    HALF_LANES,
    INVERSE_PI,
    LANES,
    exponential,
    folded,
    lane_view,
    largest,
    load,
    load_two,
    pair,
    splat,
    store,
)
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.reflection import mean_direct_reflectance
from airlight.solver.moments.harmonics import legendre_functions
from airlight.solver.moments.ray_optics import (
    mu_r_at_end,
    optical_depth,
    polarised_transmittance_ratio,
    project,
    project_polarised,
    star_at_end,
    star_from_ray,
    transmittance_ray,
)
from airlight.solver.moments.star_places import (
    DISC_NODES,
    RayPoints,
    StarPoints,
    fill_disc,
    fill_refraction_row,
    place_star_points,
)
from airlight.solver.stokes_frame import star_plane

#: Phase function of isotropic scattering. [sr⁻¹]
ISOTROPIC: Final = 0.25 / pi
#: F₁₂ of degree 2 per (1 - ν²): 5/(4π) d²₀₂. [sr⁻¹]
SECOND: Final = 5.0 * ISOTROPIC * sqrt(6.0) / 4.0


@inlined
def transmittance_row(depths, local, x, directions):
    """Transmittance of eight wavelengths between the directions of one row. [1]"""
    place = min(int(x), directions - 2)
    f = np.float32(x - place)
    return exponential(
        0.0 - ((np.float32(1.0) - f) * depths[local, place] + f * depths[local, place + 1])
    )


@inlined
def direct_light(mu_s, bottom, top, star_radius, depths, local, directions, refraction_table):
    """Direct horizontal irradiance of the ground, per irradiance at the top. [1]

    Row ``local`` of ``depths`` is that of the ground.
    """
    from_low, from_high, low, high = direct_horizontal_weights(
        bottom, mu_s, bottom, top, star_radius, refraction_table
    )
    x = direction_coordinate(bottom, low, bottom, top) * (directions - 1)
    light = transmittance_row(depths, local, x, directions) * np.float32(from_low)
    x = direction_coordinate(bottom, high, bottom, top) * (directions - 1)
    return light + transmittance_row(depths, local, x, directions) * np.float32(from_high)


@inlined
def fill_depths(ratios, x, q, shell, extinction, workspace, first, out, narrow):
    """Optical depths from a radius to the top of the shell, in the tabulated directions. [1]

    Parameters
    ----------
    ratios : array, shape (radii, nc, 2, directions)
        ``Setup.star_ratios``.
    x : float
        Fractional row of the point's radius. [1]
    q : float
        Radius of the point. [m]
    shell : tuple of float
        Radii of the ground and of the top. [m]
    extinction : lanes, shape (nc,)
        Extinction coefficients. [m⁻¹]
    first : int
        Index of the point's first value in ``out``.
    out : array
        Receives eight wavelengths per direction, or four if ``narrow``.
    narrow : bool
        Whether both halves of ``extinction`` are equal; a constant.
    """
    bottom, top = shell
    constituents, directions = ratios.shape[1], ratios.shape[3]
    row = min(int(x), ratios.shape[0] - 2)
    f = np.float32(x - row)
    g = np.float32(1.0) - f
    shortest = top - q
    longest = sqrt(max((q - bottom) * (q + bottom), 0.0)) + sqrt((top - bottom) * (top + bottom))
    step = (longest - shortest) / (directions - 1)
    flat, columns = ratios.reshape(-1), lane_view(workspace)
    for lane in range(LANES):
        workspace[constituents, lane] = np.float32(lane * step)
    along = columns[constituents]
    for start in range(0, directions, LANES):
        d = min(start, directions - LANES)
        distance = along + np.float32(shortest + d * step)
        for c in range(constituents):
            low = 2 * (row * constituents + c) * directions + d
            high = low + 2 * constituents * directions
            scale = g * load(flat, low) + f * load(flat, high)
            low, high = low + directions, high + directions
            scaled = g * load(flat, low) + f * load(flat, high)
            columns[c] = distance * scaled / scale
        if narrow:
            for lane in range(0, LANES, 2):
                tau = splat(0.0)
                for c in range(constituents):
                    column = pair(workspace[c, lane], workspace[c, lane + 1])
                    tau = tau + extinction[c] * column
                store(out, first + HALF_LANES * (d + lane), tau)
        else:
            for lane in range(LANES):
                tau = splat(0.0)
                for c in range(constituents):
                    tau = tau + extinction[c] * workspace[c, lane]
                store(out, first + LANES * (d + lane), tau)


@inlined
def transmittance_tabled(depths, row, places, lane, directions, narrow):
    """Transmittance to the star at one azimuth, or at two if ``narrow``. [1]

    Parameters
    ----------
    depths : array
        Rows from ``fill_depths``.
    row : int
        Index of the point's row.
    places : array, shape (points, 8)
        Fractional indices of directions, from ``place_star_points``.
    lane : int
        Index of the first of these azimuths.
    narrow : bool
        A constant.
    """
    x = places[row, lane]
    place = min(int(x), directions - 2)
    if narrow:
        y = places[row, lane + 1]
        second = min(int(y), directions - 2)
        f = pair(x - np.float32(place), y - np.float32(second))
        one, two = HALF_LANES * (row * directions + place), HALF_LANES * (row * directions + second)
        low, high = load_two(depths, one, two), load_two(depths, one + HALF_LANES, two + HALF_LANES)
    else:
        f = splat(x - np.float32(place))
        at = LANES * (row * directions + place)
        low, high = load(depths, at), load(depths, at + LANES)
    return exponential(0.0 - (low + f * (high - low)))


@inlined
def fill_phase_pairs(moments, scatterers, count, nu, degree, phases):
    """``fill_phases`` for scattering constituents, ``nu`` and results in lanes."""
    for c in range(count):
        phases[c] = splat(0.0)
    before, value = splat(0.0), splat(1.0)
    for l in range(degree + 1):
        weight = value * np.float32((2 * l + 1) * ISOTROPIC)
        for c in range(count):
            phases[c] += moments[scatterers[c], l] * weight
        inverse = 1.0 / (l + 1)
        following = nu * value * np.float32((2 * l + 1) * inverse)
        following = following - before * np.float32(l * inverse)
        before = value
        value = following


@inlined
def _first_order(i, tables, rows, ratios, refraction_table, out, sky_out, narrow):
    """First-order moments at one radius; ``narrow``, a constant: at most four wavelengths."""
    # Unpacked once: in the loop each access of a tuple would count references.
    grid, rays, norm, azimuths, air, expansion = tables
    bottom, top, _, sun_cosines, first_nodes, _, _ = grid
    (
        all_mu,
        all_weights,
        all_flux,
        _,
        starts,
        totals,
        ends,
        ray_radii,
        _,
        turns_along,
        amounts,
        depths,
    ) = rays
    cosines, multiples, sines = azimuths
    extinction, moments, surface, star_radius, polarised_moments = air
    sun_angles = sun_cosines.size
    degree = multiples.shape[0] - 1
    turns = cosines.size
    harmonics = (degree + 1) * (degree + 2) // 2
    constituents = totals.shape[2]
    angles = all_mu.shape[1]
    most = 1
    for a in range(angles):
        most = max(most, starts[i, a + 1] - starts[i, a])
    directions = ratios.shape[3]
    width = LANES
    if narrow:
        width = HALF_LANES
    extinction, moments, norm = lane_view(extinction), lane_view(moments), lane_view(norm)
    polarised_moments, moments_out = lane_view(polarised_moments), lane_view(out)
    sky_lanes = lane_view(sky_out)
    scatterers = np.empty(constituents, np.int64)
    count = 0
    for c in range(constituents):
        if largest(moments[c, 0]) > 0.0:
            scatterers[count] = c
            count += 1
    workspace = np.empty((constituents + 1, LANES), np.float32)
    sun_depths = np.empty(most * directions * width, np.float32)
    ground = np.empty((1, directions, LANES), np.float32)
    shell = bottom, top
    fill_depths(ratios, 0.0, bottom, shell, extinction, workspace, 0, ground.reshape(-1), False)
    ground_depths = lane_view(ground)
    strength = lane_view(np.empty((most, max(count, 1), LANES), np.float32))
    phase_f12 = lane_view(np.empty((most, LANES), np.float32))
    phase = lane_view(np.empty((max(count, 1), LANES), np.float32))
    functions = np.empty(harmonics)
    azimuthal = np.empty((degree + 1, LANES), np.float32)
    polarised = np.empty((5, LANES), np.float32)
    azimuthal_lanes, polarised_lanes = lane_view(azimuthal), lane_view(polarised)
    turned = np.empty(2 * most, np.float32)
    places = np.empty(7 * most, np.float32)
    columns = max(refraction_table.shape[1], 2)
    lifts = np.empty(most * 2 * columns, np.float32)
    disc = np.empty(3 * DISC_NODES, np.float32)
    fill_disc(disc)
    groups = -(-turns // LANES) * LANES
    around = np.empty(groups, np.float32)
    for b in range(groups):
        around[b] = np.float32(cosines[min(b, turns - 1)])
    seen = np.empty((most, LANES), np.float32)
    low_at = np.empty((most, LANES), np.float32)
    high_at = np.empty((most, LANES), np.float32)
    kinds = np.empty(most, np.int64)
    along, stars = RayPoints(turned, places, lifts), StarPoints(seen, low_at, high_at, kinds)
    size = np.float32(max(star_radius, 1e-9))
    star_tables = bottom, top, star_radius, ground_depths, directions, refraction_table
    out[:] = 0.0
    sky_out[:] = 0.0
    for a in range(angles):
        mu = all_mu[i, a]
        sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
        below = a < angles // 2
        first = starts[i, a]
        points = starts[i, a + 1] - first
        for k in range(points):
            q = ray_radii[first + k]
            x = node_value(q, bottom, top, first_nodes, rows)
            at = k * directions * width
            fill_depths(ratios, x, q, shell, extinction, workspace, at, sun_depths, narrow)
            transmittance = exponential(
                0.0 - optical_depth(depths[first + k], 0, extinction, constituents)
            )
            beta_1 = splat(0.0)
            for c in range(count):
                amount = transmittance * np.float32(amounts[first + k, scatterers[c]])
                strength[k, c] = amount
                beta_1 = beta_1 + polarised_moments[scatterers[c], 0] * amount
            polarised_ratio = polarised_transmittance_ratio(
                depths[first + k], 0, polarised_moments, constituents
            )
            phase_f12[k] = polarised_ratio * beta_1
            turned[2 * k] = np.float32(turns_along[first + k, 0] + turns_along[first + k, 1] * mu)
            turned[2 * k + 1] = np.float32(turns_along[first + k, 1] * sine)
            longest = sqrt(max((q - bottom) * (q + bottom), 0.0)) + sqrt(
                (top - bottom) * (top + bottom)
            )
            places[7 * k] = np.float32(q)
            places[7 * k + 1] = np.float32((top - q) * (top + q))
            places[7 * k + 2] = np.float32(top - q)
            places[7 * k + 3] = np.float32((directions - 1) / (longest - (top - q)))
            horizon = fill_refraction_row(refraction_table, q, bottom, top, 2 * columns * k, lifts)
            places[7 * k + 4] = np.float32(horizon)
            places[7 * k + 5] = np.float32(horizon_cosine(q, bottom))
            places[7 * k + 6] = np.float32(bottom / q)
        whole = splat(0.0)
        mu_r = 0.0
        if below:
            whole = transmittance_ray(extinction, totals[i, a], 0, constituents) * INVERSE_PI
            mu_r = mu_r_at_end(ends, i, a, mu)
        legendre_functions(mu, expansion, functions)
        exact = norm[i, a]
        step = 1
        if narrow:
            step = 2
        for j in range(sun_angles):
            mu_s = sun_cosines[j]
            sine_s = np.float32(sqrt((1.0 - mu_s) * (1.0 + mu_s)))
            azimuthal[:] = 0.0
            polarised[:] = 0.0
            lit = False
            for b in range(0, turns, step):
                lane = b % LANES
                if lane == 0:
                    ahead = load(around, b) * sine_s
                    lit = place_star_points(
                        along,
                        points,
                        ahead,
                        np.float32(mu_s),
                        size,
                        columns,
                        disc,
                        directions,
                        stars,
                    )
                second = min(b + step - 1, turns - 1)
                nu = star_from_ray(mu, mu_s, cosines[b])
                nu_2 = star_from_ray(mu, mu_s, cosines[second])
                radiance, scattering_q = splat(0.0), splat(0.0)
                if lit:
                    fill_phase_pairs(
                        moments,
                        scatterers,
                        count,
                        pair(np.float32(nu), np.float32(nu_2)),
                        degree,
                        phase,
                    )
                    for k in range(points):
                        if kinds[k] == 0:
                            continue
                        light = transmittance_tabled(
                            sun_depths, k, low_at, lane, directions, narrow
                        )
                        if kinds[k] == 2:
                            light = light + transmittance_tabled(
                                sun_depths, k, high_at, lane, directions, narrow
                            )
                            light = light * np.float32(0.5)
                        if narrow:
                            light = light * pair(seen[k, lane], seen[k, lane + 1])
                        else:
                            light = light * seen[k, lane]
                        source = splat(0.0)
                        for c in range(count):
                            source = source + phase[c] * strength[k, c]
                        radiance = radiance + light * source
                        scattering_q = scattering_q + light * phase_f12[k]
                    radiance = exact * radiance
                    part = np.float32(SECOND * (1.0 - nu) * (1.0 + nu))
                    part_2 = np.float32(SECOND * (1.0 - nu_2) * (1.0 + nu_2))
                    scattering_q = exact * scattering_q * pair(part, part_2)
                if below:
                    mu_sg = star_at_end(ends, i, a, mu_s, nu)
                    reflected = reflected_star(surface, mu_sg, mu_r, nu, star_tables)
                    if narrow:
                        mu_sg = star_at_end(ends, i, a, mu_s, nu_2)
                        reflected_2 = reflected_star(surface, mu_sg, mu_r, nu_2, star_tables)
                        reflected = pair(reflected, reflected_2)
                    radiance = radiance + whole * reflected
                if not (lit or below):
                    continue
                if b + step > turns:  # the last azimuth is alone
                    radiance = pair(radiance, splat(0.0))
                    scattering_q = pair(scattering_q, splat(0.0))
                cosine, sine_b = star_plane(mu, mu_s, nu)
                stokes_q, stokes_u = (
                    scattering_q * np.float32(cosine),
                    scattering_q * np.float32(sine_b),
                )
                if narrow:
                    cosine, sine_b = star_plane(mu, mu_s, nu_2)
                    stokes_q = pair(stokes_q, scattering_q * np.float32(cosine))
                    stokes_u = pair(stokes_u, scattering_q * np.float32(sine_b))
                for m in range(degree + 1):
                    azimuthal_lanes[m] += pair(multiples[m, b], multiples[m, second]) * radiance
                for m in range(3):
                    polarised_lanes[m] += pair(multiples[m, b], multiples[m, second]) * stokes_q
                for m in range(1, 3):
                    polarised_lanes[2 + m] += pair(sines[m, b], sines[m, second]) * stokes_u
            if narrow:
                for m in range(degree + 1):
                    azimuthal_lanes[m] = folded(azimuthal_lanes[m])
                for m in range(5):
                    polarised_lanes[m] = folded(polarised_lanes[m])
            weight = all_weights[i, a]
            project(azimuthal_lanes, functions, weight, degree, degree + 1, j, moments_out)
            project_polarised(polarised_lanes, mu, weight, j, harmonics, moments_out)
            if not below:
                sky_lanes[j] += np.float32(all_flux[i, a]) * azimuthal_lanes[0]


@inlined
def reflected_star(surface, mu_s, mu_r, nu, star_tables):
    """Direct irradiance of the ground times ``mean_direct_reflectance``. [1]

    Parameters
    ----------
    star_tables : tuple
        Arguments of ``direct_light`` apart from ``mu_s`` and ``local``.
    """
    bottom, top, star_radius, depths, directions, refraction_table = star_tables
    light = direct_light(mu_s, bottom, top, star_radius, depths, 0, directions, refraction_table)
    return mean_direct_reflectance(surface, 0, mu_s, mu_r, nu) * light


@compiled_loop
def first_order_radius(i, tables, rows, ratios, refraction_table, out, sky_out):
    """Moments of first-order radiance at one radius, for all sun angles.

    Parameters
    ----------
    i, tables, out, sky_out :
        As in ``sweep_radius``.
    rows : array, shape (n,)
        Rows of ``ratios`` at the altitude nodes, from ``column_rows``. [1]
    refraction_table : array, shape (rows, columns, 2)
        Table from ``refraction_table``. [1]
    """
    _first_order(i, tables, rows, ratios, refraction_table, out, sky_out, False)


@compiled_loop
def first_order_radius_narrow(i, tables, rows, ratios, refraction_table, out, sky_out):
    """``first_order_radius`` for at most four wavelengths, two azimuths in a register.

    Both halves of ``tables.norm`` and of ``tables.air`` have the same wavelengths.
    """
    _first_order(i, tables, rows, ratios, refraction_table, out, sky_out, True)

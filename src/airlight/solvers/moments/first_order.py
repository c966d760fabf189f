"""The light scattered once and the sunlight reflected once: where the sweeps begin."""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.geometry.bending import level_light, star_points
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, exponential, load, splat, store
from airlight.mappings.transmittance import altitude_coordinate, direction_coordinate
from airlight.solvers.moments.harmonics import legendre_functions
from airlight.solvers.moments.sweep import optical_depth, project


@compiled_loop
def interpolate_row(ratios, x, shortest, longest, out):
    """Columns from one radius in all directions of a table, whose distances lie evenly. [m]"""
    row = min(int(x), ratios.shape[0] - 2)
    f = x - row
    step = (longest - shortest) / (ratios.shape[1] - 1)
    for j in range(ratios.shape[1]):
        for c in range(ratios.shape[2]):
            scale = ratios[row, j, c, 0] * (1.0 - f) + ratios[row + 1, j, c, 0] * f
            scaled = ratios[row, j, c, 1] * (1.0 - f) + ratios[row + 1, j, c, 1] * f
            out[j, c] = (shortest + j * step) * scaled / scale


@compiled_loop
def first_order_radius(i, grid, rays, share, azimuths, air, expansion, columns, lift, out, sky_out):
    """Moments of the light scattered or reflected once, at all sun elevations of one radius.

    Parameters
    ----------
    i, grid, rays, share, azimuths, air, expansion, out, sky_out :
        As in ``sweep_radius``.
    columns : array, shape (radii, directions, nc, 2)
        Of a ``ColumnTable``, from ``mean_density_ratios``.
    lift : array, shape (rows, columns, 2)
        From ``star_lift``. [1]
    """
    # Arrays are taken out of their tuples once: inside the loop each access would count references.
    bottom, top, _, sun_cosines, _, _ = grid
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
    cosines, multiples = azimuths
    extinction, moments, albedo, star_radius = air
    suns = sun_cosines.size
    degree = multiples.shape[0] - 1
    terms = (degree + 1) * (degree + 2) // 2
    constituents = totals.shape[2]
    angles = all_mu.shape[1]
    tangent = sqrt((top - bottom) * (top + bottom))
    most = 0
    for a in range(angles):
        most = max(most, starts[i, a + 1] - starts[i, a])
    directions = columns.shape[1]
    sun_columns = np.empty((max(most, 1), directions, constituents))
    ground_columns = np.empty((directions, constituents))
    interpolate_row(columns, 0.0, top - bottom, tangent, ground_columns)
    strength = np.empty(max(most, 1) * constituents * LANES, np.float32)
    phase = np.empty(constituents * LANES, np.float32)
    functions = np.empty(terms)
    azimuthal = np.empty((degree + 1) * LANES, np.float32)
    here = np.empty(constituents)
    out[:] = 0.0
    sky_out[:] = 0.0
    for a in range(angles):
        mu = all_mu[i, a]
        below = a < angles // 2
        first = starts[i, a]
        points = starts[i, a + 1] - first
        turn = turns_along[first : first + points]
        for k in range(points):
            q = ray_radii[first + k]
            x = altitude_coordinate(q, bottom, top)
            interpolate_row(
                columns,
                x * (columns.shape[0] - 1),
                top - q,
                (1.0 + x) * tangent,
                sun_columns[k],
            )
            through = exponential(
                0.0 - optical_depth(depths[first + k], 0, extinction, constituents)
            )
            for c in range(constituents):
                store(
                    strength,
                    LANES * (k * constituents + c),
                    through * np.float32(amounts[first + k, c]),
                )
        if below:
            reflected = (
                load(albedo, 0)
                * INVERSE_PI
                * exponential(0.0 - optical_depth(totals[i, a], 0, extinction, constituents))
            )
        else:
            reflected = splat(0.0)
        legendre_functions(mu, expansion, functions)
        sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
        exact = load(share, LANES * (i * angles + a))
        for j in range(suns):
            mu_s = sun_cosines[j]
            sun_sine = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
            azimuthal[:] = 0.0
            for b in range(cosines.size):
                nu = min(max(mu * mu_s + sine * sun_sine * cosines[b], -1.0), 1.0)
                for c in range(constituents):
                    total = splat(0.0)
                    before, value = 0.0, 1.0
                    for l in range(degree + 1):
                        total = total + load(moments, LANES * (c * (degree + 1) + l)) * np.float32(
                            (2 * l + 1) * 0.07957747154594767 * value
                        )
                        following = ((2 * l + 1) * nu * value - l * before) / (l + 1)
                        before, value = value, following
                    store(phase, LANES * c, total)
                radiance = splat(0.0)
                for k in range(points):
                    q = ray_radii[first + k]
                    mu_sk = min(max(turn[k, 0] * mu_s + turn[k, 1] * nu, -1.0), 1.0)
                    seen, low, high = star_points(q, mu_sk, bottom, top, star_radius, lift)
                    if seen <= 0.0:
                        continue
                    x = direction_coordinate(q, low, bottom, top) * (directions - 1)
                    light = through_row(sun_columns[k], x, extinction, here)
                    if high > low:
                        x = direction_coordinate(q, high, bottom, top) * (directions - 1)
                        light = light + through_row(sun_columns[k], x, extinction, here)
                        light = light * np.float32(0.5)
                    source = splat(0.0)
                    for c in range(constituents):
                        source = source + load(phase, LANES * c) * load(
                            strength, LANES * (k * constituents + c)
                        )
                    radiance = radiance + np.float32(seen) * light * source
                radiance = radiance * exact
                if below:
                    mu_sg = min(max(ends[i, a, 0] * mu_s + ends[i, a, 1] * nu, -1.0), 1.0)
                    radiance = radiance + reflected * direct_light(
                        mu_sg, bottom, top, star_radius, extinction, ground_columns, lift, here
                    )
                for m in range(degree + 1):
                    at = LANES * m
                    store(azimuthal, at, load(azimuthal, at) + multiples[m, b] * radiance)
            project(azimuthal, functions, all_weights[i, a], degree, j * terms * LANES, out)
            if not below:
                at = LANES * j
                flux = np.float32(all_flux[i, a])
                store(sky_out, at, load(sky_out, at) + flux * load(azimuthal, 0))


@inlined
def through_row(columns, x, extinction, here):
    """Transmittance of eight wavelengths at a place between the columns of one row. [1]"""
    place = min(int(x), columns.shape[0] - 2)
    f = x - place
    for c in range(columns.shape[1]):
        here[c] = columns[place, c] * (1.0 - f) + columns[place + 1, c] * f
    return exponential(0.0 - optical_depth(here, 0, extinction, columns.shape[1]))


@inlined
def direct_light(mu_s, bottom, top, star_radius, extinction, ground_columns, lift, here):
    """Irradiance of level ground by the star itself, per irradiance at the top. [1]"""
    from_low, from_high, low, high = level_light(bottom, mu_s, bottom, top, star_radius, lift)
    directions = ground_columns.shape[0] - 1
    x = direction_coordinate(bottom, low, bottom, top) * directions
    light = through_row(ground_columns, x, extinction, here) * np.float32(from_low)
    x = direction_coordinate(bottom, high, bottom, top) * directions
    return light + through_row(ground_columns, x, extinction, here) * np.float32(from_high)

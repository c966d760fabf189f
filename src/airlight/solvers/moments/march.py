"""Radiance along a stretch of a ray, from a solution's moments: for queries and for the renderer.

The stretch itself is integrated; nothing is ever the difference of two large numbers. Single
scattering of the star uses the exact phase function and the exact shadow; light scattered before
comes from the moments.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import place_edges, shadow_edges
from airlight.geometry.sun_disc import mean_cosine, visible_fraction
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, exponential, load, splat, store
from airlight.mappings.transmittance import altitude_coordinate, direction_coordinate
from airlight.solvers.moments.first_order import direct_light, sun_elevation
from airlight.solvers.moments.grid import Grid
from airlight.solvers.moments.harmonics import legendre_functions
from airlight.solvers.moments.sweep import Air, optical_depth, place_of
from airlight.tables.columns import trace

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


class Light(NamedTuple):
    """All that a march needs of the solution of eight wavelengths.

    Attributes
    ----------
    grid : Grid
        The nodes of ``field``.
    air : Air
        The optics after the removal of forward peaks.
    scattering : array, shape (nc·8,)
        True scattering coefficients. [m⁻¹]
    constants : array, shape (k,)
        Of the harmonics.
    field : array
        As in ``sweep_radius``; all orders together.
    sky : array, shape (r·s·2·8,)
        Irradiance of a level surface by scattered light, as (s, E·s) per node; the first radius
        is the ground.
    columns : array, shape (radii, directions, nc)
        Of a ``ColumnTable``. [m]
    density_edges, coefficients : array
        Of ``DensitySegments``.
    """

    grid: Grid
    air: Air
    scattering: Float32Array
    constants: FloatArray
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    density_edges: FloatArray
    coefficients: FloatArray


class Workspace(NamedTuple):
    """Scratch of one thread: edges and points of one ray, and small rows."""

    edges: FloatArray
    path: tuple[FloatArray, ...]
    functions: FloatArray
    here: FloatArray


@compiled_loop
def sun_columns(q, mu_s, light, here):
    """Columns from a point towards the star, from the table. [m]"""
    bottom, top = light.grid.bottom_radius, light.grid.top_radius
    values = light.columns
    x = altitude_coordinate(q, bottom, top) * (values.shape[0] - 1)
    row = min(int(x), values.shape[0] - 2)
    f = x - row
    x = direction_coordinate(q, mu_s, bottom, top) * (values.shape[1] - 1)
    place = min(int(x), values.shape[1] - 2)
    e = x - place
    for c in range(values.shape[2]):
        low = values[row, place, c] * (1.0 - e) + values[row, place + 1, c] * e
        high = values[row + 1, place, c] * (1.0 - e) + values[row + 1, place + 1, c] * e
        if low > 0.0 and high > 0.0:
            root_low, root_high = sqrt(low), sqrt(high)
            here[c] = (root_low * (1.0 - f) + root_high * f) / (
                (1.0 - f) / root_low + f / root_high
            )
        else:
            here[c] = low * (1.0 - f) + high * f


@compiled_loop
def march(r, mu, mu_s, nu, length, to_ground, orders, phase, panels, rule, light, work, out):
    """Radiance of a stretch of air, and of the ground behind it, per irradiance of the star.

    Parameters
    ----------
    r, mu, mu_s, nu : float
        Start radius [m]; cosines of the view's and the star's zenith angle there, and between
        view and star. [1]
    length : float
        Of the stretch, inside the shell. [m]
    to_ground : bool
        Whether the stretch ends on the ground.
    orders : int
        1: single scattering and the ground's reflection of the star alone; 0: all the rest;
        2: both together.
    phase : array, shape (nc·8,)
        Phase functions at ``nu``. [sr⁻¹]
    panels : int
        Panels a leg.
    rule : tuple of arrays
        Nodes, weights, running integrals of a panel.
    light : Light
        The solution.
    work : Workspace
        Overwritten.
    out : array, shape (16,)
        Receives the radiance of air and ground [sr⁻¹] of eight wavelengths, then the
        transmittance of the stretch [1] with forward peaks counted as unscattered.
    """
    grid, air = light.grid, light.air
    bottom, top = grid.bottom_radius, grid.top_radius
    suns = grid.sun_cosines.size
    terms = light.constants.size
    constituents = light.density_edges.shape[0]
    degree = air.moments.size // (LANES * constituents) - 1
    block = (1 + terms) * LANES
    first_cut, second_cut = shadow_edges(r, mu, mu_s, nu, bottom)
    edge_count = place_edges(r, mu, length, panels, first_cut, second_cut, work.edges)
    count = trace(
        r, mu, work.edges, edge_count, rule, bottom, light.density_edges, light.coefficients,
        work.path,
    )
    distance, radius, weight, density, column, total_column = work.path
    radiance = splat(0.0)
    for k in range(count):
        q = min(max(radius[k], bottom), top)
        t = distance[k]
        w = np.float32(weight[k])
        mu_sq = min(max((r * mu_s + t * nu) / q, -1.0), 1.0)
        through = exponential(0.0 - optical_depth(column[k], 0, air.extinction, constituents))
        source = splat(0.0)
        if orders != 0:
            seen = visible_fraction(sun_elevation(q, mu_sq, bottom), air.star_radius)
            if seen > 0.0:
                sun_columns(q, mu_sq, light, work.here)
                for c in range(constituents):
                    source = source + (
                        load(light.scattering, LANES * c) * load(phase, LANES * c)
                    ) * np.float32(density[k, c])
                source = source * exponential(
                    0.0 - optical_depth(work.here, 0, air.extinction, constituents)
                ) * np.float32(seen)
        if orders != 1:
            mu_q = min(max((r * mu + t) / q, -1.0), 1.0)
            legendre_functions(mu_q, light.constants, work.functions)
            spread = (1.0 - mu_q) * (1.0 + mu_q) * (1.0 - mu_sq) * (1.0 + mu_sq)
            step = (nu - mu_q * mu_sq) / sqrt(max(spread, 1e-24))
            step = min(max(step, -1.0), 1.0)
            before, multiple = 1.0, 1.0
            for m in range(degree + 1):
                if m == 1:
                    multiple = step
                elif m > 1:
                    before, multiple = multiple, 2.0 * step * multiple - before
                for l in range(m, degree + 1):
                    work.functions[l * (l + 1) // 2 + m] *= multiple
            x = altitude_coordinate(q, bottom, top) * (grid.radii.size - 1)
            row = min(int(x), grid.radii.size - 2)
            f = x - row
            x = place_of(mu_sq, grid.place)
            place = min(int(x), suns - 2)
            e = x - place
            w00 = np.float32((1.0 - f) * (1.0 - e))
            w01 = np.float32((1.0 - f) * e)
            w10 = np.float32(f * (1.0 - e))
            w11 = np.float32(f * e)
            a00 = (row * suns + place) * block
            a01 = a00 + block
            a10 = a00 + suns * block
            a11 = a10 + block
            scale = (
                w00 * load(light.field, a00) + w01 * load(light.field, a01)
                + w10 * load(light.field, a10) + w11 * load(light.field, a11)
            )
            gathered = splat(0.0)
            for l in range(degree + 1):
                strength = splat(0.0)
                for c in range(constituents):
                    strength = strength + load(
                        air.moments, LANES * (c * (degree + 1) + l)
                    ) * np.float32(density[k, c])
                part = splat(0.0)
                for m in range(l + 1):
                    index = l * (l + 1) // 2 + m
                    at = LANES * (1 + index)
                    part = part + np.float32(work.functions[index]) * (
                        w00 * load(light.field, a00 + at) + w01 * load(light.field, a01 + at)
                        + w10 * load(light.field, a10 + at) + w11 * load(light.field, a11 + at)
                    )
                gathered = gathered + strength * part
            source = source + gathered / scale
        radiance = radiance + through * source * w
    through = splat(1.0)
    if count > 0:
        through = exponential(0.0 - optical_depth(total_column, 0, air.extinction, constituents))
    if to_ground:
        mu_sg = min(max((r * mu_s + length * nu) / bottom, -1.0), 1.0)
        received = ground_light(mu_sg, orders, light, work)
        radiance = radiance + through * received * load(air.albedo, 0) * np.float32(0.3183098861837907)
    store(out, 0, radiance)
    store(out, LANES, through)


@compiled_loop
def ground_light(mu_s, orders, light, work):
    """Irradiance of level ground by star and sky, per irradiance of the star. [1]"""
    grid, air = light.grid, light.air
    received = splat(0.0)
    if orders != 0:
        received = received + direct_light(
            mu_s, grid.bottom_radius, grid.top_radius, air, light.columns[0], work.here
        )
    if orders != 1:
        x = place_of(mu_s, grid.place)
        place = min(int(x), grid.sun_cosines.size - 2)
        e = np.float32(x - place)
        g = np.float32(1.0) - e
        low = place * 2 * LANES
        received = received + (
            g * load(light.sky, low + LANES) + e * load(light.sky, low + 3 * LANES)
        ) / (g * load(light.sky, low) + e * load(light.sky, low + 2 * LANES))
    return received


@compiled_loop
def direct_irradiance(r, mu_s, light, work, out):
    """Irradiance of a level surface by the star, for arrays of radii and star cosines. [1]"""
    bottom = light.grid.bottom_radius
    constituents = light.density_edges.shape[0]
    for k in range(r.size):
        elevation = sun_elevation(r[k], mu_s[k], bottom)
        seen = visible_fraction(elevation, light.air.star_radius)
        cosine = max(mu_s[k], 0.0) * seen
        if r[k] <= bottom:
            cosine = mean_cosine(mu_s[k], mu_s[k], light.air.star_radius)
        sun_columns(r[k], mu_s[k], light, work.here)
        through = exponential(
            0.0 - optical_depth(work.here, 0, light.air.extinction, constituents)
        )
        store(out[k], 0, through * np.float32(cosine))


@compiled_loop
def sky_irradiance(r, mu_s, light, out):
    """Irradiance of a level surface by the sky, for arrays of radii and star cosines. [1]"""
    grid = light.grid
    bottom, top = grid.bottom_radius, grid.top_radius
    suns = grid.sun_cosines.size
    for k in range(r.size):
        x = altitude_coordinate(r[k], bottom, top) * (grid.radii.size - 1)
        row = min(int(x), grid.radii.size - 2)
        f = x - row
        x = place_of(mu_s[k], grid.place)
        place = min(int(x), suns - 2)
        e = x - place
        scale = splat(0.0)
        value = splat(0.0)
        for corner in range(4):
            up, right = corner // 2, corner % 2
            weight = np.float32((f if up else 1.0 - f) * (e if right else 1.0 - e))
            at = ((row + up) * suns + place + right) * 2 * LANES
            scale = scale + weight * load(light.sky, at)
            value = value + weight * load(light.sky, at + LANES)
        store(out[k], 0, value / scale)

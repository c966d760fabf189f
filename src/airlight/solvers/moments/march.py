"""Radiance along a stretch of a ray, from a solution's moments: for queries and for the renderer.

The stretch itself is integrated; nothing is ever the difference of two large numbers. Single
scattering of the star uses the exact phase function and the exact shadow; light scattered before
comes from the moments. All wavelengths are marched together, in groups of eight lanes: factors of
geometry alone are computed once per point.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.bending import bend_angle, star_points, turned
from airlight.geometry.path import MAX_EDGES, place_edges, shadow_edges
from airlight.geometry.shell import radius_along
from airlight.kernel import compiled_loop
from airlight.kernel.borrowing import borrowed
from airlight.kernel.lanes import LANES, load, splat, store
from airlight.solvers.moments.grid import Grid, radius_index
from airlight.solvers.moments.harmonics import Harmonics, directed_functions
from airlight.solvers.moments.source import (
    gathered_light,
    scattered_star,
    star_at,
    through_columns,
)
from airlight.solvers.moments.sweep import Air, sun_index
from airlight.tables.column_ratios import columns_to_top
from airlight.tables.columns import cut_at_corners, trace_resolved

#: Rays marched side by side: neighbours read the same moments, which then stay in the cache.
PACKET: Final = 16

#: Peaks of ``march`` that keep no constituent's light apart.
NO_PEAKS: Final = (-1, -1)

#: A stretch is steep if its length over the shell's thickness is less; and in full daylight if
#: the star's zenith cosine is larger at both ends. Eight points then err by less than 1e-3.
STEEP: Final = 4.0
#: Length over the shell's thickness above which a stretch grazes the densest air.
GRAZING: Final = 9.0
#: By day, the light scattered before is left out at points that scatter less than this part of
#: their stretch: at most a dozen of them, in the thinnest air.
FAINT: Final = 5e-4
FULL_DAY: Final = 0.1

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


class Light(NamedTuple):
    """Arrays of a solution for the march; w is the number of lanes, a multiple of 8.

    Attributes
    ----------
    grid : Grid
        Nodes of ``field``.
    air : Air
        Optics after the removal of forward peaks, w lanes.
    scattering : array, shape (nc·w,)
        True scattering coefficients. [m⁻¹]
    expansion : Harmonics
        Harmonics of the moments.
    field : array, shape (r·s·(1 + k)·w,)
        Moments of all orders together, as (s, M·s) per node; see ``sweep``.
    sky : array, shape (r·s·2·w,)
        Irradiance of a level surface by scattered light, as (s, E·s) per node; the first radius
        is the ground.
    columns : array, shape (radii, directions, nc, 2)
        Ratios of a ``ColumnTable``, from ``mean_density_ratios``. [1]
    density : array, shape (nodes, nc)
        Densities from ``density_table``.
    strongest, brightest : array, shape (nc,)
        Largest extinction and largest scattering of each constituent at any wavelength. [m⁻¹]
    lift : array, shape (rows, columns, 2)
        Table from ``star_lift``; without rows where light is not bent. [1]
    bend : float
        Bending over impact parameter and column of the last constituent. [m⁻²]
    ends : array, shape (n,)
        Altitudes at which panels end, from ``panel_ends``. [m]
    """

    grid: Grid
    air: Air
    scattering: Float32Array
    expansion: Harmonics
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    density: FloatArray
    strongest: FloatArray
    brightest: FloatArray
    lift: FloatArray
    bend: float
    ends: FloatArray


class Workspace(NamedTuple):
    """Workspace of one thread, and the results of ``march``, for packets of PACKET rays.

    Attributes
    ----------
    edges, counts, distance, radius, weight, density, column, total, scratch :
        Quantities of the rays, overwritten by ``march``.
    functions, here, there, rho, depths, faint :
        Quantities of one point, overwritten by ``march``.
    received : array, shape (w,)
        Irradiance of the ground from ``ground_light``. [1]
    radiance, through : array, shape (PACKET, w)
        Radiance of the air [sr⁻¹] and transmittance [1], from ``march``.
    first, second : array, shape (PACKET, w)
        Light of the peaks of ``march`` over their phase functions. [1]
    """

    edges: FloatArray
    counts: NDArray[np.int64]
    distance: FloatArray
    radius: FloatArray
    weight: FloatArray
    density: FloatArray
    column: FloatArray
    total: FloatArray
    scratch: FloatArray
    functions: Float32Array
    here: FloatArray
    there: FloatArray
    rho: Float32Array
    depths: Float32Array
    faint: FloatArray
    received: Float32Array
    radiance: Float32Array
    through: Float32Array
    first: Float32Array
    second: Float32Array


def new_workspace(points: int, constituents: int, terms: int, lanes: int) -> Workspace:
    """Workspace of rays of at most ``points`` points, ``terms`` harmonics and ``lanes`` lanes."""
    return Workspace(
        edges=np.empty(MAX_EDGES),
        counts=np.empty(PACKET, np.int64),
        distance=np.empty((PACKET, points)),
        radius=np.empty((PACKET, points)),
        weight=np.empty((PACKET, points)),
        density=np.empty((PACKET, constituents, points)),
        column=np.empty((PACKET, constituents, points)),
        total=np.empty((PACKET, constituents)),
        scratch=np.empty(points),
        functions=np.empty(terms, np.float32),
        here=np.empty(constituents),
        there=np.empty(constituents),
        rho=np.empty(constituents, np.float32),
        depths=np.empty(constituents, np.float32),
        faint=np.empty(PACKET),
        received=np.empty(lanes, np.float32),
        radiance=np.empty((PACKET, lanes), np.float32),
        through=np.empty((PACKET, lanes), np.float32),
        first=np.empty((PACKET, lanes), np.float32),
        second=np.empty((PACKET, lanes), np.float32),
    )


class Packet(NamedTuple):
    """Up to PACKET stretches of rays inside the shell.

    Attributes
    ----------
    r, mu, mu_s, nu : array, shape (PACKET,)
        Start radius [m]; cosines of the view's and the star's zenith angle there, and between
        view and star. [1]
    length : array, shape (PACKET,)
        Lengths of the stretches. [m]
    phase : array, shape (PACKET, nc·w)
        Phase functions at ``nu``. [sr⁻¹]
    """

    r: FloatArray
    mu: FloatArray
    mu_s: FloatArray
    nu: FloatArray
    length: FloatArray
    phase: Float32Array


def new_packet(width: int) -> Packet:
    """Empty packet whose rows of phase functions have ``width`` values."""
    r, mu, mu_s, nu, length = (np.empty(PACKET) for _ in range(5))
    return Packet(r, mu, mu_s, nu, length, np.empty((PACKET, width), np.float32))


@compiled_loop
def march(packet, rays, orders, peaks, panels, rules, light, work):
    """Compute the radiance of stretches of air per irradiance of the star, and transmittance.

    Parameters
    ----------
    packet : Packet
        The stretches.
    rays : int
        Number of stretches.
    orders : int
        1: the star's light scattered once; 0: all the rest; 2: both together.
    peaks : (int, int)
        Constituents whose share of the star's light, scattered once, is also found without their
        phase functions; ``NO_PEAKS`` for none.
    panels : int
        Number of panels a leg.
    rules : three tuples of arrays
        Nodes, weights, running integrals of a panel: for stretches that are steep and in full
        daylight, where the source is smooth; for most; and for those that graze the ground.
    light : Light
        The solution.
    work : Workspace
        Receives ``radiance`` and ``through``, the latter with forward peaks counted as
        unscattered; ``first`` and ``second``, of ``peaks``.
    """
    packet, light, work = borrowed((packet, light, work))
    bottom, top = light.grid.bottom_radius, light.grid.top_radius
    place_table, row_table = light.grid.place, light.grid.row
    radii = light.grid.radii.size
    suns = light.grid.sun_cosines.size
    extinction, moments = light.air.extinction, light.air.moments
    star_radius, lanes = light.air.star_radius, light.air.ground.albedo.size
    scattering, field, sun_table = light.scattering, light.field, light.columns
    expansion, table = light.expansion, light.density
    strongest, brightest = light.strongest, light.brightest
    lift, bend, ends = light.lift, light.bend, light.ends
    degree = expansion.degree
    functions, here, there = work.functions, work.here, work.there
    edges, counts = work.edges, work.counts
    rho, depths, faint = work.rho, work.depths, work.faint
    distance, radius, weight = work.distance, work.radius, work.weight
    density, column, total = work.density, work.column, work.total
    radiance, through = work.radiance, work.through
    first_light, second_light = work.first, work.second
    first_peak, second_peak = peaks
    starts, cosines, sun_cosines, angles, lengths, phases = packet
    constituents = table.shape[1]
    block = (1 + (degree + 1) * (degree + 2) // 2) * lanes
    most = 0
    for p in range(rays):
        r, mu, mu_s, nu = starts[p], cosines[p], sun_cosines[p], angles[p]
        first_cut, second_cut = shadow_edges(r, mu, mu_s, nu, bottom)
        edge_count = place_edges(r, mu, lengths[p], panels, first_cut, second_cut, edges)
        edge_count = cut_at_corners(r, mu, bottom, ends, edges, edge_count)
        path = (distance[p], radius[p], weight[p], density[p], column[p], total[p], work.scratch)
        end = min(mu_s, (r * mu_s + lengths[p] * nu) / radius_along(r, mu, lengths[p]))
        slant = lengths[p] / (top - bottom)
        day = end > FULL_DAY
        rule = rules[1] if slant < GRAZING else rules[2]
        if day and slant < STEEP:
            rule = rules[0]
        counts[p] = trace_resolved(
            r, mu, edges, edge_count, rule, bottom, top - bottom, table, strongest, path
        )
        most = max(most, counts[p])
        depth = 0.0
        for c in range(constituents):
            depth += brightest[c] * total[p, c]
        faint[p] = FAINT * min(depth, 1.0) if day else 0.0
        for at in range(0, lanes, LANES):
            store(radiance[p], at, splat(0.0))
            store(first_light[p], at, splat(0.0))
            store(second_light[p], at, splat(0.0))
            store(through[p], at, through_columns(total[p], extinction, constituents, lanes, at))
    for k in range(most):
        for p in range(rays):
            if k >= counts[p]:
                continue
            r, mu, mu_s, nu = starts[p], cosines[p], sun_cosines[p], angles[p]
            phase, bright = phases[p], radiance[p]
            q = min(max(radius[p, k], bottom), top)
            t = distance[p, k]
            w = np.float32(weight[p, k])
            mu_q = min(max((r * mu + t) / q, -1.0), 1.0)
            mu_sq = min(max((r * mu_s + t * nu) / q, -1.0), 1.0)
            nu_q = nu
            if bend > 0.0:
                angle = bend_angle(r, mu, bend, column[p, constituents - 1, k])
                mu_sq, nu_q = turned(mu_q, mu_sq, nu, angle)
                mu_sq = min(max(mu_sq, -1.0), 1.0)
            for c in range(constituents):
                rho[c] = np.float32(density[p, c, k])
                depths[c] = np.float32(column[p, c, k])
            seen, low, high = 0.0, 0.0, 0.0
            if orders != 0:
                seen, low, high = star_points(q, mu_sq, bottom, top, star_radius, lift)
                if seen > 0.0:
                    columns_to_top(q, low, bottom, top, sun_table, here)
                if high > low:
                    columns_to_top(q, high, bottom, top, sun_table, there)
            w00, w01, w10, w11 = np.float32(0.0), np.float32(0.0), np.float32(0.0), np.float32(0.0)
            a00 = 0
            depth = 0.0
            for c in range(constituents):
                depth += brightest[c] * density[p, c, k]
            gathers = orders != 1 and depth * weight[p, k] >= faint[p]
            if gathers:
                spread = (1.0 - mu_q) * (1.0 + mu_q) * (1.0 - mu_sq) * (1.0 + mu_sq)
                step = (nu_q - mu_q * mu_sq) / sqrt(max(spread, 1e-24))
                directed_functions(mu_q, min(max(step, -1.0), 1.0), expansion, functions)
                x = radius_index(q, bottom, top, row_table)
                row = min(int(x), radii - 2)
                f = x - row
                x = sun_index(mu_sq, place_table)
                place = min(int(x), suns - 2)
                e = x - place
                w00 = np.float32((1.0 - f) * (1.0 - e))
                w01 = np.float32((1.0 - f) * e)
                w10 = np.float32(f * (1.0 - e))
                w11 = np.float32(f * e)
                a00 = (row * suns + place) * block
            a10 = a00 + suns * block
            for at in range(0, lanes, LANES):
                source = splat(0.0)
                through_air = through_columns(depths, extinction, constituents, lanes, at)
                if seen > 0.0:
                    star = star_at(
                        seen, here, there, high > low, extinction, constituents, lanes, at
                    )
                    source = star * scattered_star(rho, scattering, phase, constituents, lanes, at)
                    if first_peak >= 0:
                        once = through_air * star * load(scattering, lanes * first_peak + at)
                        once = once * (w * rho[first_peak])
                        store(first_light[p], at, load(first_light[p], at) + once)
                    if second_peak >= 0:
                        once = through_air * star * load(scattering, lanes * second_peak + at)
                        once = once * (w * rho[second_peak])
                        store(second_light[p], at, load(second_light[p], at) + once)
                if gathers:
                    source = source + gathered_light(
                        rho, moments, field, functions, a00, a10, block, w00, w01, w10, w11,
                        degree, constituents, lanes, at,
                    )  # fmt: skip
                store(bright, at, load(bright, at) + through_air * source * w)

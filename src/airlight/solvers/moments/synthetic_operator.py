"""Synthetic operator K: matrix of a plane-parallel sweep, by rows of one radius.

``synthetic_acceleration`` inverts 1 - K. Weights of the moments are summed over the quadrature
points of each ray at the interpolation levels of the sweep, transferred to the radii from which the
levels are interpolated, and projected onto the moments of the ray's radius.
"""

from __future__ import annotations

import numpy as np

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import INVERSE_PI, LANES, exponential, load, splat, store
from airlight.optics.altitude_nodes import node_value
from airlight.optics.reflection import diffuse_reflectance
from airlight.solvers.moments.harmonics import legendre_functions
from airlight.solvers.moments.ray_optics import mu_r_at_end, optical_depth, transmittance_ray


@compiled_loop
def synthetic_rows(i, grid, rays, norm, mu_along, air, expansion, degree, order, out, bounced):
    """Weights of the moments at all levels in the radiance of the rays from one radius.

    Parameters
    ----------
    i, grid, rays, norm, air, expansion :
        As in ``sweep_radius``.
    mu_along : array, shape (p,)
        Zenith cosine of the rays at their points. [1]
    degree, order : int
        Limits of the moments: l up to ``degree``, m up to ``order``.
    out : array, shape (a·r·pairs·8,)
        Receives the weight of each moment (l, m), ordered by m and then l, in each ray. [1]
    bounced : array, shape (a·8,)
        Receives the weight of the ground's irradiance. [1]
    """
    bottom, top, radii, _, first_nodes, rows_at, _ = grid
    extinction, moments, surface, _, _ = air
    highest = expansion.degree
    starts, ray_radii = rays.start, rays.radius
    amounts, depths, totals = rays.amount, rays.column, rays.total
    constituents = extinction.size // LANES
    angles = rays.mu.shape[1]
    pairs = out.size // (angles * radii.size * LANES)
    functions = np.empty((highest + 1) * (highest + 2) // 2)
    strengths = np.empty((degree + 1) * LANES, np.float32)
    out[:] = 0.0
    bounced[:] = 0.0
    for a in range(angles):
        exact = load(norm, LANES * (i * angles + a))
        for k in range(starts[i, a], starts[i, a + 1]):
            legendre_functions(mu_along[k], expansion, functions)
            depth = optical_depth(depths[k], 0, extinction, constituents)
            transmittance = exponential(0.0 - depth) * exact
            for l in range(degree + 1):
                strength = splat(0.0)
                for c in range(constituents):
                    strength = strength + load(
                        moments, LANES * (c * (highest + 1) + l)
                    ) * np.float32(amounts[k, c])
                store(strengths, LANES * l, strength * transmittance)
            x = node_value(ray_radii[k], bottom, top, first_nodes, rows_at)
            row = min(int(x), radii.size - 2)
            f = x - row
            low = (a * radii.size + row) * pairs * LANES
            high = low + pairs * LANES
            for m in range(order + 1):
                for l in range(m, degree + 1):
                    value = functions[l * (l + 1) // 2 + m]
                    strength = load(strengths, LANES * l)
                    store(out, low, load(out, low) + np.float32(value * (1.0 - f)) * strength)
                    store(out, high, load(out, high) + np.float32(value * f) * strength)
                    low += LANES
                    high += LANES
        if a < angles // 2:
            transmittance = transmittance_ray(extinction, totals[i, a], 0, constituents)
            mu_r = mu_r_at_end(rays.end, i, a, rays.mu[i, a])
            store(
                bounced,
                LANES * a,
                diffuse_reflectance(surface, 0, mu_r) * INVERSE_PI * transmittance,
            )


@compiled_loop
def gather_levels(cubics, weights, angles, out):
    """Weights of the moments at the radii of the sweep, from those at the levels.

    Parameters
    ----------
    cubics : array, shape (f, r)
        Matrix from ``levels.finer_weights``, mostly 0. [1]
    weights : array, shape (a·f·pairs·8,)
        Weights from ``synthetic_rows``, at f levels. [1]
    angles : int
        Number a of rays.
    out : array, shape (a·r·pairs·8,)
        Receives the weights at r radii. [1]
    """
    levels, radii = cubics.shape
    size = weights.size // (angles * levels)
    out[:] = 0.0
    for a in range(angles):
        for level in range(levels):
            low = (a * levels + level) * size
            for i in range(radii):
                weight = cubics[level, i]
                if weight != 0.0:
                    at = (a * radii + i) * size
                    for n in range(0, size, LANES):
                        store(out, at + n, load(out, at + n) + weight * load(weights, low + n))


@compiled_loop
def project_radii(projections, weights, first, width, radii, out):
    """Projection of the weights of rays, for one m, onto quantities of their radius.

    Parameters
    ----------
    projections : array, shape (q, a)
        Factors of the rays in each quantity. [1]
    weights : array, shape (a·r·pairs·8,)
        Weights of the moments in the rays. [1]
    first, width, radii : int
        Index of the first moment of this m among the pairs, number of its moments, and number r of
        radii.
    out : array, shape (q·columns·8,)
        Receives the weights of the moments at each radius in the quantities, in the first r·width
        columns; others are unchanged. [1]
    """
    quantities, angles = projections.shape
    pairs = weights.size // (angles * radii * LANES)
    row = out.size // quantities
    for q in range(quantities):
        for i in range(radii):
            for k in range(width):
                at = LANES * (i * pairs + first + k)
                total = splat(0.0)
                for a in range(angles):
                    factor = np.float32(projections[q, a])
                    total = total + factor * load(weights, at + a * radii * pairs * LANES)
                store(out, q * row + LANES * (i * width + k), total)

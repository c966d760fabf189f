"""Synthetic operator K: matrix of a plane-parallel sweep, by rows of one radius.

``synthetic_acceleration`` inverts 1 - K. Weights of the moments are summed over the quadrature
points of each ray at the interpolation levels of the sweep, transferred to the radii from which the
levels are interpolated, and projected onto the moments of the ray's radius.
"""

from __future__ import annotations

import numpy as np

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import INVERSE_PI, LANES, exponential, lane_view, splat
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.reflection import diffuse_reflectance
from airlight.solver.moments.harmonics import legendre_functions
from airlight.solver.moments.ray_optics import mu_r_at_end, optical_depth, transmittance_ray


@compiled_loop
def synthetic_rows(i, tables, degree, order, out, bounced):
    """Weights of the moments at all levels in the radiance of the rays from one radius.

    Parameters
    ----------
    i, tables :
        As in ``sweep_radius``.
    degree, order : int
        Limits of the moments: l up to ``degree``, m up to ``order``.
    out : array, shape (a, r, pairs, 8)
        Receives the weight of each moment (l, m), ordered by m and then l, in each ray. [1]
    bounced : array, shape (a, 8)
        Receives the weight of the ground's irradiance. [1]
    """
    grid, rays, norm, _, air, expansion = tables
    bottom, top, radii, _, first_nodes, rows_at, _ = grid
    extinction, moments, surface, _, _ = air
    highest = expansion.degree
    starts, ray_radii, mu_along = rays.start, rays.radius, rays.mu_along
    amounts, depths, totals = rays.amount, rays.column, rays.total
    extinction, moments, norm = lane_view(extinction), lane_view(moments), lane_view(norm)
    constituents = extinction.shape[0]
    angles = rays.mu.shape[1]
    functions = np.empty((highest + 1) * (highest + 2) // 2)
    strengths = lane_view(np.empty((degree + 1, LANES), np.float32))
    weights, bounces = lane_view(out), lane_view(bounced)
    out[:] = 0.0
    bounced[:] = 0.0
    for a in range(angles):
        exact = norm[i, a]
        for k in range(starts[i, a], starts[i, a + 1]):
            legendre_functions(mu_along[k], expansion, functions)
            depth = optical_depth(depths[k], 0, extinction, constituents)
            transmittance = exponential(0.0 - depth) * exact
            for l in range(degree + 1):
                strength = splat(0.0)
                for c in range(constituents):
                    strength = strength + moments[c, l] * np.float32(amounts[k, c])
                strengths[l] = strength * transmittance
            x = node_value(ray_radii[k], bottom, top, first_nodes, rows_at)
            row = min(int(x), radii.size - 2)
            f = x - row
            pair = 0
            for m in range(order + 1):
                for l in range(m, degree + 1):
                    value = functions[l * (l + 1) // 2 + m]
                    weights[a, row, pair] += np.float32(value * (1.0 - f)) * strengths[l]
                    weights[a, row + 1, pair] += np.float32(value * f) * strengths[l]
                    pair += 1
        if a < angles // 2:
            transmittance = transmittance_ray(extinction, totals[i, a], 0, constituents)
            mu_r = mu_r_at_end(rays.end, i, a, rays.mu[i, a])
            bounces[a] = diffuse_reflectance(surface, 0, mu_r) * INVERSE_PI * transmittance


@compiled_loop
def gather_levels(cubics, weights, out):
    """Weights of the moments at the radii of the sweep, from those at the levels.

    Parameters
    ----------
    cubics : array, shape (f, r)
        Matrix from ``levels.finer_weights``, mostly 0. [1]
    weights : array, shape (a, f, pairs, 8)
        Weights from ``synthetic_rows``, at f levels. [1]
    out : array, shape (a, r, pairs, 8)
        Array to which the weights at r radii are added. [1]
    """
    levels, radii = cubics.shape[0], cubics.shape[1]
    given, found = lane_view(weights), lane_view(out)
    for a in range(given.shape[0]):
        for level in range(levels):
            for i in range(radii):
                weight = cubics[level, i]
                if weight != 0.0:
                    for n in range(given.shape[2]):
                        found[a, i, n] += weight * given[a, level, n]


@compiled_loop
def project_radii(projections, weights, first, width, out):
    """Projection of the weights of rays, for one m, onto quantities of their radius.

    Parameters
    ----------
    projections : array, shape (q, a)
        Factors of the rays in each quantity. [1]
    weights : array, shape (a, r, pairs, 8)
        Weights of the moments in the rays. [1]
    first, width : int
        Index of the first moment of this m among the pairs, and number of its moments.
    out : array, shape (q, columns, 8)
        Receives the weights of the moments at each radius in the quantities, in the first r·width
        columns; others are unchanged. [1]
    """
    quantities, angles = projections.shape[0], projections.shape[1]
    given, found = lane_view(weights), lane_view(out)
    for q in range(quantities):
        for i in range(given.shape[1]):
            for k in range(width):
                total = splat(0.0)
                for a in range(angles):
                    total = total + np.float32(projections[q, a]) * given[a, i, first + k]
                found[q, i * width + k] = total

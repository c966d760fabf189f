"""Rays of a sweep, common to all wavelengths and sun angles."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import MAX_EDGES, place_edges, ray_length
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.refraction import refraction_angle, turned
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import compiled_loop
from airlight.physics.optics.density_profile import DensitySegments
from airlight.solver.moments.directions import directions
from airlight.solver.moments.grid import MomentsGrid
from airlight.solver.tables.columns import (
    density_nodes,
    new_path,
    split_at_profile_edges,
    trace_resolved,
)

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

#: Panel ends of a medium without layers aloft.
NO_ENDS: Final[FloatArray] = np.zeros(0)


class Rays(NamedTuple):
    """Rays from all radii of a grid at all zenith angles of a quadrature.

    Attributes
    ----------
    mu, weight : array, shape (r, a)
        Zenith cosine and its weight in ∫ dmu; the first half of a row points below the horizon. [1]
    flux : array, shape (r, a)
        Weight in ∫ mu dmu over the upper hemisphere. [1]
    length : array, shape (r, a)
        Distance to the ground or to the top. [m]
    start : array, shape (r, a + 1)
        Index of the first point of a ray in the arrays below.
    total : array, shape (r, a, nc)
        Columns over the whole ray. [m]
    end : array, shape (r, a, 2)
        Cosine of the star's zenith angle at the end of the ray, as coefficients of that cosine at
        the start and of the cosine between star and ray. [1]
    radius, mu_along : array, shape (p,)
        Radius of the points [m], and zenith cosine of the ray there [1].
    turn : array, shape (p, 4)
        Cosines of the star's zenith angle, and between star and ray, at the point; coefficients as
        in ``end``. [1]
    amount : array, shape (p, nc)
        Density times quadrature weight. [m]
    column : array, shape (p, nc)
        Column from the start of the ray to the point. [m]
    """

    mu: FloatArray
    weight: FloatArray
    flux: FloatArray
    length: FloatArray
    start: IntArray
    total: FloatArray
    end: FloatArray
    radius: FloatArray
    mu_along: FloatArray
    turn: FloatArray
    amount: FloatArray
    column: FloatArray


@compiled_loop
def _turn(r, mu, distance, radius, angle, out):
    """Row of ``Rays.turn`` at a point of a ray with the refraction angle ``angle`` up to it."""
    mu_along = min(max((r * mu + distance) / radius, -1.0), 1.0)
    out[0], out[2] = turned(mu_along, r / radius, 0.0, angle)
    out[1], out[3] = turned(mu_along, distance / radius, 1.0, angle)
    return mu_along


@compiled_loop
def trace_into(grid, panels, rule, nodes, strongest, refraction_strength, ends, path, rays):
    """Rays of ``trace_rays`` written to ``rays``; returns the number of points."""
    count = 0
    end, edges = np.empty(4), np.empty(MAX_EDGES)
    mu, constituents = rays.mu, nodes.values.shape[1]
    last = constituents - 1
    for i in range(mu.shape[0]):
        r = grid.radii[i]
        for a in range(mu.shape[1]):
            rays.start[i, a] = count
            below = a < mu.shape[1] // 2
            length = ray_length(r, mu[i, a], grid.bottom_radius, grid.top_radius)
            # The first half of the quadrature meets the ground, regardless of rounding.
            if below and mu[i, a] >= horizon_cosine(r, grid.bottom_radius):
                length = max(-r * mu[i, a], 0.0)
            rays.length[i, a] = length
            edge_count = place_edges(r, mu[i, a], length, panels, 0.0, 0.0, edges)
            edge_count = split_at_profile_edges(
                r, mu[i, a], grid.bottom_radius, ends, edges, edge_count
            )
            points = trace_resolved(r, mu[i, a], edges, edge_count, rule, nodes, strongest, path)
            for c in range(constituents):
                rays.total[i, a, c] = path[5][c] if points > 0 else 0.0
            if below:
                angle = refraction_angle(r, mu[i, a], refraction_strength, rays.total[i, a, last])
                _turn(r, mu[i, a], length, grid.bottom_radius, angle, end)
                rays.end[i, a, 0], rays.end[i, a, 1] = end[0], end[1]
            for k in range(points):
                q = min(max(path[1][k], grid.bottom_radius), grid.top_radius)
                rays.radius[count] = q
                angle = refraction_angle(r, mu[i, a], refraction_strength, path[4][last, k])
                rays.mu_along[count] = _turn(r, mu[i, a], path[0][k], q, angle, rays.turn[count])
                for c in range(constituents):
                    rays.amount[count, c] = path[3][c, k] * path[2][k]
                    rays.column[count, c] = path[4][c, k]
                count += 1
        rays.start[i, mu.shape[1]] = count
    return count


def trace_rays(
    grid: MomentsGrid,
    density: DensitySegments,
    strongest: FloatArray,
    angles: tuple[int, ...],
    nodes: int,
    panels: int = 1,
    *,
    refraction_strength: float = 0.0,
    ends: FloatArray = NO_ENDS,
) -> Rays:
    """Rays of a sweep.

    Parameters
    ----------
    grid : MomentsGrid
        Grid whose radii the rays start from.
    density : DensitySegments
        Density profiles.
    strongest : array, shape (nc,)
        Largest extinction of each constituent at any wavelength. [m⁻¹]
    angles : tuple of int
        Numbers of zenith angles, see ``directions``.
    nodes, panels : int
        Points per panel, and panels per leg.
    refraction_strength : float
        See ``RefractedGeometry``; 0 for straight rays. [m⁻²]
    ends : array, shape (n,)
        Altitudes at which panels end, from ``panel_ends``. [m]
    """
    mu, weight, flux = directions(grid, angles)
    per_ray = nodes * (2 * panels + 6 + 2 * ends.size)
    constituents = density.edges.shape[0]
    room = mu.size * per_ray
    rays = Rays(
        mu,
        weight,
        flux,
        np.empty(mu.shape),
        np.empty((mu.shape[0], mu.shape[1] + 1), np.int64),
        np.empty((*mu.shape, constituents)),
        np.zeros((*mu.shape, 2)),
        np.empty(room),
        np.empty(room),
        np.empty((room, 4)),
        np.empty((room, constituents)),
        np.empty((room, constituents)),
    )
    count = trace_into(
        grid,
        panels,
        gauss_legendre(nodes).as_tuple(),
        density_nodes(density, (grid.bottom_radius, grid.top_radius)),
        strongest,
        refraction_strength,
        ends,
        new_path(per_ray, constituents),
        rays,
    )
    return rays._replace(
        radius=rays.radius[:count].copy(),
        mu_along=rays.mu_along[:count].copy(),
        turn=rays.turn[:count].copy(),
        amount=rays.amount[:count].copy(),
        column=rays.column[:count].copy(),
    )

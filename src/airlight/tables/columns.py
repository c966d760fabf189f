"""Columns: the integral of each constituent's relative density along a ray. [m]

An optical depth is a sum of columns times extinction coefficients, so columns serve every
wavelength. ``trace`` integrates along one ray (relative error below 1e-5 with the settings here,
1e-13 with ``panels=8``); ``ColumnTable`` holds the columns to the top of the shell on Bruneton's
2017 mapping for look-ups that are good to 1e-3.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.path import MAX_EDGES, place_edges, place_nodes, ray_length
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop, kernel
from airlight.mappings.transmittance import (
    altitude_coordinate,
    cosine_from_coordinate,
    direction_coordinate,
    radius_from_coordinate,
)
from airlight.optics.density_profile import DensitySegments, relative_density

FloatArray = NDArray[np.float64]

#: Shape of the table for look-ups: radii, directions.
TABLE_SHAPE = (96, 256)


@compiled_loop
def trace(r, mu, edges, edge_count, rule, bottom_radius, density_edges, coefficients, path):
    """Points along a ray with the air's densities there and the columns up to there.

    Parameters
    ----------
    r, mu : float
        Start of the ray. [m], [1]
    edges, edge_count : array, int
        Panels, from ``place_edges``. [m]
    rule : tuple of arrays
        Nodes (n,), weights (n,) and running integrals (n, n) on [0, 1].
    bottom_radius : float
        [m]
    density_edges, coefficients : array, shapes (nc, ns + 1), (nc, ns, 4)
        Of ``DensitySegments``.
    path : tuple of arrays
        Receives distance (p,) [m], radius (p,) [m], weight (p,) [m], density (p, nc) [1],
        column (p, nc) [m] for each point, and the whole column (nc,) [m].

    Returns
    -------
    int
        Number of points.
    """
    nodes, weights, running = rule
    distance, radius, weight, density, column, total = path
    count = place_nodes(r, mu, edges, edge_count, nodes, weights, distance, radius, weight)
    n = nodes.size
    constituents = density_edges.shape[0]
    for i in range(constituents):
        total[i] = 0.0
        for first in range(0, count, n):
            for k in range(first, first + n):
                density[k, i] = relative_density(
                    radius[k] - bottom_radius, density_edges[i], coefficients[i]
                )
            for k in range(n):
                running_column = 0.0
                for j in range(n):
                    at = first + j
                    running_column += running[k, j] * density[at, i] * weight[at] / weights[j]
                # A running integral of a steep profile may dip below its start by rounding.
                column[first + k, i] = total[i] + max(running_column, 0.0)
            for k in range(first, first + n):
                total[i] += density[k, i] * weight[k]
    return count


def new_path(points: int, constituents: int) -> tuple[FloatArray, ...]:
    """Room for what ``trace`` finds along one ray of at most so many points."""
    return (
        np.empty(points),
        np.empty(points),
        np.empty(points),
        np.empty((points, constituents)),
        np.empty((points, constituents)),
        np.empty(constituents),
    )


@compiled_loop
def _columns(radii, cosines, lengths, panels, rule, bottom_radius, density_edges, coefficients, edges, path, out):
    for k in range(radii.size):
        count = place_edges(radii[k], cosines[k], lengths[k], panels, 0.0, 0.0, edges)
        trace(radii[k], cosines[k], edges, count, rule, bottom_radius, density_edges, coefficients, path)
        for i in range(out.shape[1]):
            out[k, i] = path[5][i]


def columns(
    r: ArrayLike,
    mu: ArrayLike,
    length: ArrayLike,
    bottom_radius: float,
    density: DensitySegments,
    *,
    nodes: int = 24,
    panels: int = 6,
) -> FloatArray:
    """Columns along stretches of rays, by quadrature.

    Parameters
    ----------
    r, mu, length : array, shapes that broadcast to (...)
        Start radius [m], cosine of the view zenith angle [1] and length [m] of each stretch,
        which must lie inside the shell.
    bottom_radius : float
        [m]
    density : DensitySegments
        The profiles.
    nodes, panels : int
        Gauss-Legendre points a panel and panels a leg.

    Returns
    -------
    array, shape (..., constituents)
        [m]
    """
    r, mu, length = np.broadcast_arrays(*(np.asarray(x, float) for x in (r, mu, length)))
    rule = gauss_legendre(nodes)
    constituents = density.edges.shape[0]
    out = np.empty((r.size, constituents))
    points = nodes * (2 * panels + 2)
    _columns(
        r.ravel(), mu.ravel(), length.ravel(), panels, (rule.nodes, rule.weights, rule.running),
        bottom_radius, density.edges, density.coefficients, np.empty(MAX_EDGES),
        new_path(points, constituents), out,
    )
    return out.reshape(*r.shape, constituents)


@dataclass(frozen=True)
class ColumnTable:
    """Columns from any point to the top of the shell, along rays that miss the ground.

    Attributes
    ----------
    bottom_radius, top_radius : float
        [m]
    values : array, shape (radii, directions, constituents)
        On the mapping of ``airlight.mappings.transmittance``, ends included. [m]
    """

    bottom_radius: float
    top_radius: float
    values: FloatArray

    @classmethod
    def build(
        cls,
        bottom_radius: float,
        top_radius: float,
        density: DensitySegments,
        shape: tuple[int, int] = TABLE_SHAPE,
    ) -> ColumnTable:
        """Integrate every entry of the table (relative error below 1e-5)."""
        x, y = np.meshgrid(np.linspace(0, 1, shape[0]), np.linspace(0, 1, shape[1]), indexing="ij")
        r, mu, length = np.empty(shape), np.empty(shape), np.empty(shape)
        _table_rays(x, y, bottom_radius, top_radius, r, mu, length)
        values = columns(r, mu, length, bottom_radius, density, nodes=16, panels=3)
        return cls(bottom_radius, top_radius, values)


@compiled_loop
def _table_rays(x, y, bottom_radius, top_radius, r, mu, length):
    for i in range(x.shape[0]):
        for j in range(x.shape[1]):
            r[i, j] = min(radius_from_coordinate(x[i, j], bottom_radius, top_radius), top_radius)
            mu[i, j] = cosine_from_coordinate(y[i, j], r[i, j], bottom_radius, top_radius)
            # From the mapping itself: the horizon ray must not be taken for one into the ground.
            shortest = top_radius - r[i, j]
            tangent = sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
            longest = x[i, j] * tangent + tangent
            length[i, j] = shortest + y[i, j] * (longest - shortest)

"""Columns: the integral of each constituent's relative density along a ray. [m]

An optical depth is a sum of columns times extinction coefficients, so columns serve every
wavelength. ``columns`` integrates the profiles themselves; ``trace_ray`` reads densities tabulated
at the altitude nodes and yields the points, densities and running columns of a ray march
(relative error below 1e-4). ``ColumnTable`` holds columns to the top of the shell, its directions
by Bruneton's 2017 mapping, accurate to 1e-3.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.mappings.transmittance import cosine_from_coordinate, radius_from_coordinate
from airlight.geometry.path import MAX_EDGES, insert_edge, place_edges, place_nodes
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import chord
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.threads import run_blocks
from airlight.physics.optics.altitude_nodes import altitude_node
from airlight.physics.optics.density_profile import DensitySegments, relative_density

FloatArray = NDArray[np.float64]

#: Shape of the table for look-ups: radii, directions.
TABLE_SHAPE = (160, 288)
#: Optical depth of a ray above which more panels are placed at its start. [1]
THICK = 15.0
#: Rays in one block of work.
_BLOCK = 1024


def density_table(density: DensitySegments) -> FloatArray:
    """Relative densities at the altitude nodes, for linear interpolation, shape (n, nc). [1]"""
    return np.ascontiguousarray(density.at_nodes.T)


class DensityNodes(NamedTuple):
    """Densities of a shell at its altitude nodes.

    Attributes
    ----------
    bottom_radius, thickness : float
        Radius of the ground and thickness of the shell. [m]
    first_nodes : array, shape (CELLS + 1,)
        Index of the first altitude node of each cell, see ``altitude_nodes``. [1]
    values : array, shape (n, nc)
        Densities from ``density_table``. [1]
    """

    bottom_radius: float
    thickness: float
    first_nodes: FloatArray
    values: FloatArray


def density_nodes(density: DensitySegments, shell: tuple[float, float]) -> DensityNodes:
    """Densities at the altitude nodes of a shell with these radii. [m]"""
    bottom, top = shell
    return DensityNodes(bottom, top - bottom, density.first_nodes, density_table(density))


@compiled_loop
def accumulate_columns(count, rule, nodes, path):
    """Densities at the points of a ray, and columns up to each.

    Parameters
    ----------
    count : int
        Number of points, of all panels.
    rule, nodes :
        Arguments of ``trace_ray``.
    path : tuple of arrays
        Arrays of ``trace_ray``, in which distance, radius and weight are already filled.
    """
    _, weights, running = rule
    bottom_radius, thickness, first_nodes, table = nodes
    _, radius, weight, density, column, total, scratch = path
    n = weights.size
    constituents = table.shape[1]
    for k in range(count):
        node, f = altitude_node(radius[k], bottom_radius, thickness, first_nodes)
        for i in range(constituents):
            density[i, k] = table[node, i] + (table[node + 1, i] - table[node, i]) * f
    for i in range(constituents):
        so_far = 0.0
        for first in range(0, count, n):
            # Value divided by the weight of the point in the rule: the integrand on [0, 1].
            whole = 0.0
            for j in range(n):
                amount = density[i, first + j] * weight[first + j]
                whole += amount
                column[i, first + j] = amount / weights[j]
            for k in range(n):
                running_column = 0.0
                for j in range(n):
                    running_column += running[k, j] * column[i, first + j]
                # The running integral of a steep profile may be negative by rounding.
                scratch[k] = so_far + max(running_column, 0.0)
            for k in range(n):
                column[i, first + k] = scratch[k]
            so_far += whole
        total[i] = so_far


@compiled_loop
def trace_ray(r, mu, edges, edge_count, rule, nodes, path):
    """Points along a ray, with densities and columns up to them.

    Parameters
    ----------
    r, mu : float
        Start of the ray. [m], [1]
    edges, edge_count : array, int
        Panel edges from ``place_edges`` and their number. [m]
    rule : tuple of arrays
        Nodes (n,), weights (n,) and running integrals (n, n) on [0, 1].
    nodes : DensityNodes
        Densities.
    path : tuple of arrays
        Receives distance (p,) [m], radius (p,) [m], weight (p,) [m], density (nc, p) [1],
        column (nc, p) [m] for each point, and the whole column (nc,) [m]; the last is a workspace.

    Returns
    -------
    int
        Number of points.
    """
    points, weights, _ = rule
    count = place_nodes(r, mu, edges, edge_count, points, weights, path[0], path[1], path[2])
    accumulate_columns(count, rule, nodes, path)
    return count


@compiled_loop
def trace_resolved(r, mu, edges, edge_count, rule, nodes, strongest, path):
    """``trace_ray`` with more panels at the start of an optically thick ray.

    A panel of n points integrates exp(-τ) well while τ over it stays below about n²/8. Where the
    whole ray is thicker, panels end at optical depths 0.5, 3 and 12, from a first trace and again
    from the refined one.

    Parameters
    ----------
    strongest : array, shape (nc,)
        Largest extinction of each constituent at any wavelength. [m⁻¹]
    r, mu, edges, edge_count, rule, nodes, path :
        Arguments of ``trace_ray``; six more edges and panels must fit.

    Returns
    -------
    int
        Number of points.
    """
    count = trace_ray(r, mu, edges, edge_count, rule, nodes, path)
    for _ in range(2):
        tau = 0.0
        for i in range(strongest.size):
            tau += strongest[i] * path[5][i]
        if tau <= THICK:
            return count
        cuts = (
            _distance_at_depth(0.5, count, strongest, path),
            _distance_at_depth(3.0, count, strongest, path),
            _distance_at_depth(12.0, count, strongest, path),
        )
        for cut in cuts:
            edge_count = insert_edge(edges, edge_count, cut)
        count = trace_ray(r, mu, edges, edge_count, rule, nodes, path)
    return count


@compiled_loop
def _distance_at_depth(depth, count, strongest, path):
    """Distance at which a traced ray reaches an optical depth, linear between its points. [m]"""
    before, start = 0.0, 0.0
    for k in range(count):
        tau = 0.0
        for i in range(strongest.size):
            tau += strongest[i] * path[4][i, k]
        if tau >= depth and tau > before:
            return start + (path[0][k] - start) * (depth - before) / (tau - before)
        before, start = tau, path[0][k]
    return 0.0


def new_path(points: int, constituents: int) -> tuple[FloatArray, ...]:
    """Workspace of ``trace_ray`` for one ray of at most ``points`` points."""
    return (
        np.empty(points),
        np.empty(points),
        np.empty(points),
        np.empty((constituents, points)),
        np.empty((constituents, points)),
        np.empty(constituents),
        np.empty(points),
    )


@compiled_loop
def split_at_profile_edges(r, mu, bottom_radius, breakpoints, edges, count):
    """Add panel edges where a ray crosses breakpoints of the profiles.

    Parameters
    ----------
    r, mu, bottom_radius : float
        Start of the ray and radius of the ground. [m], [1], [m]
    breakpoints : array, shape (n,)
        Altitudes of the breakpoints, from ``DensitySegments``. [m]
    edges, count : array, int
        Edges from ``place_edges`` and their number; edges are added in place. [m]

    Returns
    -------
    int
        Number of edges after the additions.
    """
    tangent = r * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    for k in range(breakpoints.size):
        radius = bottom_radius + breakpoints[k]
        if tangent < radius:
            beside = chord(r, mu, radius)
            count = insert_edge(edges, count, -r * mu - beside)
            count = insert_edge(edges, count, -r * mu + beside)
    return count


@compiled_loop
def _columns(radii, cosines, lengths, panels, rule, bottom_radius, density, out):
    nodes, weights, _ = rule
    density_edges, coefficients, breakpoints = density
    edges = np.empty(MAX_EDGES)
    points = nodes.size * MAX_EDGES
    distance, radius, weight = np.empty(points), np.empty(points), np.empty(points)
    for k in range(radii.size):
        r, mu = radii[k], cosines[k]
        edge_count = place_edges(r, mu, lengths[k], panels, 0.0, 0.0, edges)
        edge_count = split_at_profile_edges(r, mu, bottom_radius, breakpoints, edges, edge_count)
        count = place_nodes(r, mu, edges, edge_count, nodes, weights, distance, radius, weight)
        for i in range(out.shape[1]):
            total = 0.0
            for at in range(count):
                total += weight[at] * relative_density(
                    radius[at] - bottom_radius, density_edges[i], coefficients[i]
                )
            out[k, i] = total


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
    """Columns along segments of rays, by quadrature.

    Parameters
    ----------
    r, mu, length : array, shapes that broadcast to (...)
        Start radius [m], cosine of the view zenith angle [1] and length [m] of each segment,
        which must lie inside the shell.
    bottom_radius : float
        Radius of the ground. [m]
    density : DensitySegments
        The profiles.
    nodes, panels : int
        Gauss-Legendre points per panel and panels per leg.

    Returns
    -------
    array, shape (..., constituents)
        Columns. [m]
    """
    r, mu, length = np.broadcast_arrays(*(np.asarray(x, float) for x in (r, mu, length)))
    constituents = density.edges.shape[0]
    out = np.empty((r.size, constituents))
    rays, rule = (r.ravel(), mu.ravel(), length.ravel()), gauss_legendre(nodes).as_tuple()

    def block(index: int) -> None:
        rows = slice(index * _BLOCK, (index + 1) * _BLOCK)
        _columns(
            *(one[rows] for one in rays), panels, rule, bottom_radius, density.arrays, out[rows]
        )

    run_blocks(block, -(-r.size // _BLOCK))
    return out.reshape(*r.shape, constituents)


@dataclass(frozen=True)
class ColumnTable:
    """Columns from any point to the top of the shell, along rays that miss the ground.

    Attributes
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    radii : array, shape (radii,)
        Radii of the rows, from the ground to the top. [m]
    values : array, shape (radii, directions, constituents)
        Columns; directions on the mapping of ``geometry.mappings.transmittance``, ends included.
        [m]
    """

    bottom_radius: float
    top_radius: float
    radii: FloatArray
    values: FloatArray

    @classmethod
    def build(
        cls,
        bottom_radius: float,
        top_radius: float,
        density: DensitySegments,
        shape: tuple[int, int] = TABLE_SHAPE,
        radii: FloatArray | None = None,
    ) -> ColumnTable:
        """Table by quadrature of every entry (relative error below 1e-5).

        Parameters
        ----------
        bottom_radius, top_radius : float
            Radii of the ground and of the top of the shell. [m]
        shape : tuple of int
            Numbers of rows and of directions.
        radii : array, optional
            Radii of the rows; without, those of Bruneton's mapping. [m]
        """
        if radii is None:
            radii = even_radii(bottom_radius, top_radius, shape[0])
        values = np.empty((radii.size, shape[1], density.edges.shape[0]))
        r, mu, length = (np.empty(values.shape[:2]) for _ in range(3))
        table_rays(radii, bottom_radius, top_radius, r, mu, length)

        def row(index: int) -> None:
            values[index] = columns(
                r[index], mu[index], length[index], bottom_radius, density, nodes=16, panels=3
            )

        run_blocks(row, radii.size)
        return cls(bottom_radius, top_radius, radii, values)


def even_radii(bottom_radius: float, top_radius: float, count: int) -> FloatArray:
    """Radii even in the distance to the horizon, from the ground to the top, shape (count,). [m]"""
    x = np.linspace(0.0, 1.0, count)
    r = vectorized(radius_from_coordinate)(x, bottom_radius, top_radius)
    return np.asarray(np.minimum(r, top_radius))


@compiled_loop
def table_rays(radii, bottom_radius, top_radius, r, mu, length):
    """Radius [m], cosine [1] and distance to the top [m] of each entry, shape (rows, columns)."""
    tangent = sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
    for i in range(r.shape[0]):
        q = radii[i]
        horizon = sqrt(max((q - bottom_radius) * (q + bottom_radius), 0.0))
        for j in range(r.shape[1]):
            y = j / (r.shape[1] - 1.0)
            r[i, j] = q
            mu[i, j] = cosine_from_coordinate(y, q, bottom_radius, top_radius)
            # From the mapping itself, so that the horizon ray does not count as one into the
            # ground.
            shortest = top_radius - q
            length[i, j] = shortest + y * (horizon + tangent - shortest)

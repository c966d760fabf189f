"""Ray march of the direct solver: single scattering and gathered radiance along a line of sight."""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import MAX_EDGES, place_edges
from airlight.geometry.shell import horizon_cosine, radius_along
from airlight.geometry.sun_disc import sun_elevation, visible_fraction
from airlight.kernel import compiled_loop
from airlight.physics.optics.reflection import Reflection
from airlight.solver.direct.layout import Layout, angle_cell, radius_cell, sun_cell, view_cell
from airlight.solver.direct.settings import DirectSettings
from airlight.solver.direct.trapezoid import graded, uniform
from airlight.solver.layered_columns import column_radii
from airlight.solver.tables.column_ratios import column_rows, columns_to_top, rational_mean_density
from airlight.solver.tables.columns import (
    TABLE_SHAPE,
    ColumnTable,
    DensityNodes,
    accumulate_columns,
    density_nodes,
    new_path,
    split_at_profile_edges,
    trace_resolved,
)

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class LineOptics(NamedTuple):
    """Optical properties of a medium for ray marches.

    Attributes
    ----------
    bottom, top, star_radius : float
        Radii of ground and top [m], and angular radius of the star [rad].
    scattering : array, shape (ns, nl)
        Coefficients of the scattering constituents. [m⁻¹]
    extinction : array, shape (nc, nl)
        Extinction coefficients. [m⁻¹]
    scatterers : array, shape (ns,)
        Indices of the scattering constituents among all.
    strongest : array, shape (nc,)
        Largest extinction at any wavelength. [m⁻¹]
    nodes : DensityNodes
        Densities.
    breakpoints : array, shape (n,)
        Altitudes of breakpoints of the profiles, ground and top included. [m]
    rows : array, shape (n,)
        Rows of ``ratios`` at the altitude nodes. [1]
    ratios : array, shape (radii, directions, nc, 2)
        Table from ``rational_mean_density``: columns to the star for multiple scattering. [1]
    rule : tuple of arrays
        Nodes, weights and running integrals of the trapezoid.
    ground : Reflection
        Reflectance of the ground, at all wavelengths.
    graded : bool
        Whether the rule applies to each leg of a ray rather than to the whole ray.
    """

    bottom: float
    top: float
    star_radius: float
    scattering: FloatArray
    extinction: FloatArray
    scatterers: IntArray
    strongest: FloatArray
    nodes: DensityNodes
    breakpoints: FloatArray
    rows: FloatArray
    ratios: FloatArray
    rule: tuple[FloatArray, FloatArray, FloatArray]
    ground: Reflection
    graded: bool


def line_optics(medium: Medium, settings: DirectSettings, steps: int) -> LineOptics:
    """Optical properties of a medium, for lines of ``steps`` steps."""
    scatterers = np.flatnonzero(medium.scattering.max(axis=1) > 0.0)
    radii = column_radii(medium, TABLE_SHAPE[0])
    shell = medium.bottom_radius, medium.top_radius
    table = ColumnTable.build(*shell, medium.density, TABLE_SHAPE, radii)
    rule = (graded if settings.graded else uniform)(steps)
    return LineOptics(
        medium.bottom_radius,
        medium.top_radius,
        medium.lights[0].angular_radius,
        np.ascontiguousarray(medium.scattering[scatterers]),
        medium.extinction,
        scatterers,
        medium.extinction.max(axis=1),
        density_nodes(medium.density, shell),
        medium.density.breakpoints,
        column_rows(table, medium.density),
        rational_mean_density(table),
        rule.as_tuple(),
        medium.ground,
        settings.graded,
    )


class GatheredTable(NamedTuple):
    """Table of gathered radiance.

    Attributes
    ----------
    axes : Layout
        Its axes.
    values : array, shape (radii·views, sun_angles, angles, ns·nl)
        Gathered radiance G, or its logarithm. [sr⁻¹]
    logarithmic : bool
        Whether it is the logarithm.
    """

    axes: Layout
    values: FloatArray
    logarithmic: bool


class Line(NamedTuple):
    """Workspace of one line of sight with at most p points, and the results of ``prepare``.

    Attributes
    ----------
    path : tuple of arrays
        See ``airlight.solver.tables.columns.trace_ray``.
    source : array, shape (p, ns·nl)
        Scattering coefficient times transmittance to the start times weight. [1]
    transmittance : array, shape (nl,)
        Transmittance of the whole line. [1]
    stencil : array, shape (p, 4)
        Neighbours of each point in radius and view, as rows of the table.
    shares : array, shape (p, 4)
        Weights of these rows. [1]
    edges, columns : array
        Workspace for ``trace_segment``.
    sun : tuple of arrays
        Workspace for a ray to the star, as ``path``.
    """

    path: tuple[FloatArray, ...]
    source: FloatArray
    transmittance: FloatArray
    stencil: IntArray
    shares: FloatArray
    edges: FloatArray
    columns: FloatArray
    sun: tuple[FloatArray, ...]


def new_line(air: LineOptics) -> Line:
    """Workspace of one line, for one thread."""
    constituents, wavelengths = air.extinction.shape
    points = air.rule[0].size * (MAX_EDGES if air.graded else 1)
    return Line(
        new_path(points, constituents),
        np.empty((points, air.scattering.size)),
        np.empty(wavelengths),
        np.empty((points, 4), np.int64),
        np.empty((points, 4)),
        np.empty(MAX_EDGES),
        np.empty(constituents),
        new_path(points, constituents),
    )


@compiled_loop
def trace_segment(r, mu, length, first_cut, second_cut, air, edges, path):
    """Points, densities and columns along a segment of a ray.

    Parameters
    ----------
    r, mu, length : float
        Start radius, zenith cosine and length. [m], [1], [m]
    first_cut, second_cut : float
        Distances at which the planet's shadow begins and ends; ignored unless graded. [m]
    air, edges, path :
        See ``LineOptics`` and ``Line``.

    Returns
    -------
    int
        Number of points.
    """
    if air.graded:
        count = place_edges(r, mu, length, 1, first_cut, second_cut, edges)
        count = split_at_profile_edges(r, mu, air.bottom, air.breakpoints, edges, count)
        return trace_resolved(r, mu, edges, count, air.rule, air.nodes, air.strongest, path)
    nodes, weights, _ = air.rule
    for k in range(nodes.size):
        path[0][k] = length * nodes[k]
        path[1][k] = radius_along(r, mu, path[0][k])
        path[2][k] = length * weights[k]
    accumulate_columns(nodes.size, air.rule, air.nodes, path)
    return nodes.size


@compiled_loop
def prepare(r, mu, length, first_cut, second_cut, air, line):
    """Prepare the points of a line and their weights at its start; returns their number."""
    count = trace_segment(r, mu, length, first_cut, second_cut, air, line.edges, line.path)
    _, _, weight, density, column, total, _ = line.path
    source, transmittance = line.source, line.transmittance
    scattering, extinction, scatterers = air.scattering, air.extinction, air.scatterers
    wavelengths = extinction.shape[1]
    for l in range(wavelengths):
        tau = 0.0
        for c in range(extinction.shape[0]):
            tau += extinction[c, l] * total[c]
        transmittance[l] = exp(-tau)
        for k in range(count):
            tau = 0.0
            for c in range(extinction.shape[0]):
                tau += extinction[c, l] * column[c, k]
            arriving = weight[k] * exp(-tau)
            for i in range(scatterers.size):
                source[k, i * wavelengths + l] = (
                    scattering[i, l] * density[scatterers[i], k] * arriving
                )
    return count


@compiled_loop
def place_rows(r, mu, count, axes, line):
    """Fill ``stencil`` and ``shares``: table rows around each point of a prepared line."""
    distance, radius = line.path[0], line.path[1]
    for k in range(count):
        q = min(max(radius[k], axes.bottom), axes.top)
        low, high, f = radius_cell(q, axes)
        first, second, e = view_cell(q, (r * mu + distance[k]) / q, axes)
        line.stencil[k, 0] = low * axes.views + first
        line.stencil[k, 1] = low * axes.views + second
        line.stencil[k, 2] = high * axes.views + first
        line.stencil[k, 3] = high * axes.views + second
        line.shares[k, 0] = (1.0 - f) * (1.0 - e)
        line.shares[k, 1] = (1.0 - f) * e
        line.shares[k, 2] = f * (1.0 - e)
        line.shares[k, 3] = f * e


@compiled_loop
def add_gathered(r, mu_s, nu, count, table, line, out):
    """Add multiple scattering along a prepared line, from the gathered radiance.

    Parameters
    ----------
    r, mu_s, nu : float
        Coordinates of the start. [m], [1]
    count : int
        Number of points of the line.
    table : GatheredTable
        Gathered radiance.
    line : Line
        Line after ``prepare`` and ``place_rows``.
    out : array, shape (nl,)
        Receives the light, per irradiance of the star. [sr⁻¹]
    """
    axes, values, logarithmic = table
    distance, radius = line.path[0], line.path[1]
    stencil, shares, source = line.stencil, line.shares, line.source
    wavelengths = out.size
    channels = values.shape[3]
    m0, m1, d = angle_cell(nu, axes)
    for k in range(count):
        s0, s1, e = sun_cell((r * mu_s + distance[k] * nu) / radius[k], axes)
        w00, w01 = (1.0 - e) * (1.0 - d), (1.0 - e) * d
        w10, w11 = e * (1.0 - d), e * d
        for first in range(0, channels, wavelengths):
            for l in range(wavelengths):
                q = first + l
                value = 0.0
                for corner in range(4):
                    row = stencil[k, corner]
                    value += shares[k, corner] * (
                        w00 * values[row, s0, m0, q]
                        + w01 * values[row, s0, m1, q]
                        + w10 * values[row, s1, m0, q]
                        + w11 * values[row, s1, m1, q]
                    )
                if logarithmic:
                    value = exp(value)
                out[l] += source[k, q] * value


@compiled_loop
def add_once(r, mu_s, nu, count, phase, nested, air, line, out):
    """Add single scattering along a prepared line.

    Parameters
    ----------
    phase : array, shape (ns·nl,)
        Phase functions at nu. [sr⁻¹]
    nested : bool
        Whether columns to the star are integrated by the rule rather than looked up.
    air, line :
        Medium, and line after ``prepare``.
    """
    distance, radius = line.path[0], line.path[1]
    source, sun_columns = line.source, line.columns
    extinction = air.extinction
    wavelengths = out.size
    for k in range(count):
        q = min(max(radius[k], air.bottom), air.top)
        mu_sk = min(max((r * mu_s + distance[k] * nu) / q, -1.0), 1.0)
        seen = visible_fraction(sun_elevation(q, mu_sk, air.bottom), air.star_radius)
        if seen <= 0.0:
            continue
        star_columns(q, mu_sk, nested, air, line.edges, line.sun, sun_columns)
        for l in range(wavelengths):
            tau = 0.0
            for c in range(extinction.shape[0]):
                tau += extinction[c, l] * sun_columns[c]
            light = seen * exp(-tau)
            for at in range(l, phase.size, wavelengths):
                out[l] += source[k, at] * phase[at] * light


@compiled_loop
def star_columns(r, mu_s, nested, air, edges, path, out):
    """Columns from a point to the star, or along the horizon if its centre has set. [m]"""
    mu = max(mu_s, horizon_cosine(r, air.bottom))
    if not nested:
        first_nodes = air.nodes.first_nodes
        columns_to_top(r, mu, air.bottom, air.top, first_nodes, air.rows, air.ratios, out)
        return
    length = -r * mu + ((air.top - r) * (air.top + r) + r * r * mu * mu) ** 0.5
    trace_segment(r, mu, max(length, 0.0), 0.0, 0.0, air, edges, path)
    for c in range(out.size):
        out[c] = path[5][c]


def axes_shape(axes: Layout, channels: int) -> tuple[int, int, int, int]:
    """Shape of a table of gathered radiance."""
    return axes.radii * axes.views, axes.sun_angles, axes.angles, channels

"""Beam: extinction of the cloud along straight lines to the sun, cell by cell."""

from __future__ import annotations

from math import exp, floor, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined, kernel

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Direction cosines below this are taken as this: lines end after a finite number of cells. [1]
LEAST_COSINE = 1e-9
#: A distance that is never reached. [m]
NEVER = 1e30
#: Unscaled optical depth at which a line ends. [1]
OPAQUE = 1e3
#: Optical depth across a cell below which the mean transmittance is that of the middle. [1]
_THIN = 1e-4


class BeamCells(NamedTuple):
    """Cells that lines cross.

    Attributes
    ----------
    extinction : array, shape (levels, ny, nx)
        Extinction of the cloud at 550 nm. [m⁻¹]
    edges : array, shape (levels + 1,)
        Altitudes of the edges of levels. [m]
    corner, widths : tuple of two float
        Coordinates of the western and southern sides; widths of a cell. [m]
    periodic : bool
        Whether the cells repeat themselves sideways.
    below : int
        Levels below the cloud, which have none.
    interpolated : bool
        Whether extinction is linear between the middles of cells, in a plane.
    curvature : float
        Reciprocal of the planet's radius; 0 for a plane. [m⁻¹]
    """

    extinction: Float32Array
    edges: FloatArray
    corner: tuple[float, float]
    widths: tuple[float, float]
    periodic: bool
    below: int
    interpolated: bool
    curvature: float


@kernel
def wrapped(index, count):
    """Index of a periodic cell."""
    return index - count * floor(index / count)


@inlined
def level_of(edges, altitude, upwards):
    """Level of an altitude, at an edge that ahead; -1 below all and their number above all."""
    low, high = 0, edges.size
    while low < high:
        middle = (low + high) // 2
        if edges[middle] < altitude or (upwards and edges[middle] == altitude):
            low = middle + 1
        else:
            high = middle
    return low - 1


@inlined
def first_crossing(place, step):
    """Distance in cells to the next face ahead of a place, and the cell before it."""
    cell = floor(place)
    if step > 0.0:
        return cell + 1.0 - place, cell
    if place == cell:
        cell -= 1
    return place - cell, cell


@inlined
def neighbours(place, count, periodic):
    """Cells with middles around a place, in cells from the side, and the share of the second."""
    low = floor(place - 0.5)
    share = place - 0.5 - low
    high = low + 1
    if periodic:
        return wrapped(low, count), wrapped(high, count), share
    return min(max(low, 0), count - 1), min(max(high, 0), count - 1), share


@inlined
def interpolated_extinction(point, cells):
    """Extinction at a point inside the cloud's levels, linear between cells. [m⁻¹]"""
    extinction, edges, corner, widths, periodic, below, _, _ = cells
    levels, ny, nx = extinction.shape
    x, y, z = point
    i, i_next, p = neighbours((x - corner[0]) / widths[0], nx, periodic)
    j, j_next, q = neighbours((y - corner[1]) / widths[1], ny, periodic)
    depth = edges[levels] - edges[levels - 1]
    k, k_next, r = neighbours((z - edges[below]) / depth, levels - below, False)
    k, k_next = k + below, k_next + below
    low = (1.0 - q) * ((1.0 - p) * extinction[k, j, i] + p * extinction[k, j, i_next])
    low += q * ((1.0 - p) * extinction[k, j_next, i] + p * extinction[k, j_next, i_next])
    high = (1.0 - q) * ((1.0 - p) * extinction[k_next, j, i] + p * extinction[k_next, j, i_next])
    high += q * ((1.0 - p) * extinction[k_next, j_next, i] + p * extinction[k_next, j_next, i_next])
    return (1.0 - r) * low + r * high


#: Points of Gauss's rule of two points on [0, 1].
GAUSS = (0.5 - 0.5 / 3.0**0.5, 0.5 + 0.5 / 3.0**0.5)


@inlined
def mean_extinction(start, direction, first, last, cell, cells):
    """Mean extinction on a line within a cell, between two distances from its start. [m⁻¹]"""
    level, j, i = cell
    if not cells.interpolated:
        return cells.extinction[level, j, i]
    if level < cells.below:
        return 0.0
    total = 0.0
    for part in GAUSS:
        along = first + part * (last - first)
        point = (
            start[0] + along * direction[0],
            start[1] + along * direction[1],
            start[2] + along * direction[2],
        )
        total += 0.5 * interpolated_extinction(point, cells)
    return total


@inlined
def distance_of_rise(rise, slope, bend, rising):
    r"""Distance at which a ray has risen by a height: the root of c s + b s² = h. [m]

    Parameters
    ----------
    rise : float
        Height h, below 0 for a ray that falls. [m]
    slope, bend : float
        Slope c at the start [1], and b, half of the curvature of its height, 0 or more [m⁻¹].
    rising : bool
        Whether that is where the ray rises; if not and it turns before, ``NEVER``.
    """
    square = slope * slope + 4.0 * bend * rise
    if square < 0.0:
        return NEVER
    root = sqrt(square)
    if not rising:
        return 2.0 * rise / (slope - root)
    if slope > 0.0:
        return 2.0 * rise / (slope + root)
    return (root - slope) / (2.0 * bend)


@inlined
def next_level(level, z, slope, bend, rising, edges):
    """Distance to the next edge of a level, or before it to where the ray turns. [m]"""
    if rising:
        return distance_of_rise(edges[level + 1] - z, slope, bend, True)
    edge = distance_of_rise(edges[level] - z, slope, bend, False)
    return min(edge, -0.5 * slope / bend) if bend > 0.0 else edge


@inlined
def depth_towards(point, direction, cells):
    """Integral of the extinction from a point to the end of the box. [1]

    On a sphere, the height of a straight ray is that of a parabola over the distance; it may fall
    below the cloud and rise through it again. A ray that meets the ground ends there.

    Parameters
    ----------
    point, direction : tuple of three float
        Coordinates [m], and a unit vector.
    cells : BeamCells
    """
    extinction, edges, corner, widths, periodic, below, _, curvature = cells
    x, y, z = point
    a, b, c = direction
    levels, ny, nx = extinction.shape
    bend = 0.5 * curvature * (1.0 - c * c)
    rising = c > 0.0 or (c == 0.0 and bend > 0.0)
    if bend == 0.0:
        c = max(c, LEAST_COSINE) if rising else min(c, 0.0 - LEAST_COSINE)
    bottom, top = edges[0], edges[levels]
    if (rising and z >= top) or (not rising and z <= bottom):
        return 0.0
    start = 0.0
    if z < bottom:
        start = distance_of_rise(bottom - z, c, bend, True)
    if z > top:
        start = distance_of_rise(top - z, c, bend, False)
    if rising or bend > 0.0:
        end = distance_of_rise(top - z, c, bend, True)
    else:
        end = distance_of_rise(bottom - z, c, bend, False)
    level = level_of(edges, min(max(z + start * (c + start * bend), bottom), top), rising)
    level = min(max(level, 0), levels - 1)
    next_z = next_level(level, z, c, bend, rising, edges)
    du, dv = a / widths[0], b / widths[1]
    rate_u, rate_v = max(abs(du), 1e-30), max(abs(dv), 1e-30)
    step_u, step_v = (1 if du > 0.0 else -1), (1 if dv > 0.0 else -1)
    along, total, placed = start, 0.0, False
    i, j, next_u, next_v = 0, 0, 0.0, 0.0
    while along < end and total < OPAQUE:
        if not placed:
            ahead, i = first_crossing((x + along * a - corner[0]) / widths[0], du)
            next_u = along + ahead / rate_u
            ahead, j = first_crossing((y + along * b - corner[1]) / widths[1], dv)
            next_v = along + ahead / rate_v
            if periodic:
                i, j = wrapped(i, nx), wrapped(j, ny)
            placed = True
        inside = i >= 0 and i < nx and j >= 0 and j < ny
        if not inside and (
            (i < 0 and du <= 0.0)
            or (i >= nx and du >= 0.0)
            or (j < 0 and dv <= 0.0)
            or (j >= ny and dv >= 0.0)
        ):
            break
        if level < below:  # through levels without cloud at once
            following, placed = min(next_z, end), False
        else:
            following = min(min(next_u, next_v), min(next_z, end))
            if inside:
                mean = mean_extinction(point, direction, along, following, (level, j, i), cells)
                total += mean * (following - along)
        along = max(following, along)
        if next_z <= following:
            if rising:
                level += 1
            elif bend > 0.0 and next_z >= -0.5 * c / bend:
                rising = True
            else:
                level -= 1
            if level < 0 or level >= levels:
                break
            next_z = next_level(level, z, c, bend, rising, edges)
        if placed and next_u <= following:
            next_u += 1.0 / rate_u
            i += step_u
            if periodic:
                i = 0 if i == nx else (nx - 1 if i < 0 else i)
        if placed and next_v <= following:
            next_v += 1.0 / rate_v
            j += step_v
            if periodic:
                j = 0 if j == ny else (ny - 1 if j < 0 else j)
    return total


@compiled_loop
def beam_row(y, sun, points, columns, cells, out):
    """Optical depths at 550 nm along the beam at level edges in a row of columns.

    Parameters
    ----------
    y : int
        Row.
    sun : tuple of three float
        Unit vector to the sun.
    points : tuple of two int
        Points across a column along x and y.
    columns : tuple
        Altitudes of edges, and corner and widths of the columns, as of ``BeamCells``.
    cells : BeamCells
    out : array, shape (points, nx, edges)
        Receives the depths. [1]
    """
    edges, corner, widths = columns
    across, along = points
    for x in range(out.shape[1]):
        for p in range(across * along):
            east = corner[0] + widths[0] * (x + (p % across + 0.5) / across)
            north = corner[1] + widths[1] * (y + (p // across + 0.5) / along)
            for k in range(edges.size):
                place = (east, north, edges[k])
                out[p, x, k] = np.float32(depth_towards(place, sun, cells))


@kernel
def middle_of_exponential(depth):
    """Distance of the mean of exp(-depth s), s from 0 to 1, before the middle, ½ - <s>. [1]"""
    if abs(depth) < 0.01:
        return depth / 12.0
    if depth > 80.0:
        return 0.5 - 1.0 / depth
    return 0.5 - 1.0 / depth + 1.0 / (exp(depth) - 1.0)


@compiled_loop
def mean_beam_row(y, depths, optics, across, out):
    """Mean transmittance of the beam in the cells of a row, its centre, and that on the ground.

    Parameters
    ----------
    y : int
        Row.
    depths : array, shape (points, nx, levels + 1)
        See ``beam_row``. [1]
    optics : tuple of two arrays, shapes (levels + 1, 4) and (4,)
        Minus the logarithm of the irradiance without cloud, and scaled extinction of the cloud over
        that at 550 nm. [1]
    across : tuple of two int
        Points across a column along x and y.
    out : tuple of three arrays, shapes (levels, ny, nx, 4), (levels, ny, nx, 3, 4), (ny, nx, 4)
        Receive the transmittance, the offset of its centre from the middle of a cell towards x, y
        and z, in cells, and the transmittance at the ground. [1]
    """
    air, cloud = optics
    mean, offset, ground = out
    points, nx, edges = depths.shape
    for x in range(nx):
        for w in range(cloud.size):
            total = 0.0
            for p in range(points):
                total += exp(0.0 - cloud[w] * depths[p, x, 0] - air[0, w])
            ground[y, x, w] = np.float32(total / points)
            for k in range(1, edges):
                total, east, north, up = 0.0, 0.0, 0.0, 0.0
                for p in range(points):
                    depth = cloud[w] * depths[p, x, k] + air[k, w]
                    below = cloud[w] * depths[p, x, k - 1] + air[k - 1, w]
                    if abs(below - depth) < _THIN:
                        part = exp(-0.5 * (below + depth))
                    else:
                        part = (exp(0.0 - depth) - exp(0.0 - below)) / (below - depth)
                    total += part
                    up += part * middle_of_exponential(below - depth)
                    east += part * ((p % across[0] + 0.5) / across[0] - 0.5)
                    north += part * ((p // across[0] + 0.5) / across[1] - 0.5)
                mean[k - 1, y, x, w] = np.float32(total / points)
                total = max(total, 1e-30)
                offset[k - 1, y, x, 0, w] = np.float32(east / total)
                offset[k - 1, y, x, 1, w] = np.float32(north / total)
                offset[k - 1, y, x, 2, w] = np.float32(up / total)


def centred(
    amounts: Float32Array, extinction: Float32Array, offset: Float32Array, periodic: bool
) -> Float32Array:
    r"""Amounts of scattered light, shared with neighbours so that each keeps its optical centre.

    A sweep spreads the light that the beam gives to a cell evenly. In cells that are optically
    thick most of it is where the beam enters: it moves to the neighbour there by

    .. math:: 2 |o| \kappa / (\kappa + \kappa'),

    with the offset o in cells and the neighbour's extinction κ'.

    Parameters
    ----------
    amounts : array, shape (levels, ny, nx, 4)
        Light that a cell scatters, over the horizontal area.
    extinction : array, shape (levels, ny, nx)
        Extinction of the cloud. [m⁻¹]
    offset : array, shape (levels, ny, nx, 3, 4)
        See ``mean_beam_row``. [1]
    periodic : bool
        Whether the cells repeat themselves sideways.
    """
    for axis, component in ((0, 2), (1, 1), (2, 0)):
        if amounts.shape[axis] == 1:
            continue
        for sign in (1, -1):
            beyond = np.roll(extinction, -sign, axis=axis)
            edge = [slice(None)] * 3
            edge[axis] = slice(-1, None) if sign > 0 else slice(0, 1)
            share = 2.0 * extinction / np.maximum(extinction + beyond, np.float32(1e-30))
            if axis == 0 or not periodic:
                share[tuple(edge)] = 0.0
            moved = amounts * share[..., None] * np.maximum(sign * offset[..., component, :], 0.0)
            np.minimum(moved, amounts, out=moved)
            amounts = amounts - moved + np.roll(moved, sign, axis=axis)
    return amounts

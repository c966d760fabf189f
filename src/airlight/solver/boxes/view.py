"""Radiance along lines of sight through a box.

Single scattering has the exact phase function and the unscaled scattering coefficient, in scaled
extinction (TMS; Nakajima & Tanaka 1988, J. Quant. Spectrosc. Radiat. Transfer 40, 51, eq. 15), and
that of the forward peak before and after it (``forward_peak``). The beam is followed to the sun
from points of the line. Higher orders are those of the moments.
"""

from __future__ import annotations

from math import acos, exp, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.solver.boxes.beam import (
    LEAST_COSINE,
    BeamCells,
    depth_towards,
    first_crossing,
    level_of,
    mean_extinction,
    neighbours,
    wrapped,
)
from airlight.solver.boxes.forward_peak import ANGLES, LARGEST_ROOT, ROOTS

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Scaled optical depth of a step along a line, and largest number of steps in a cell.
_STEP, _MOST_STEPS = 0.5, 8
#: Transmittance below which a line ends. [1]
_DARK = 1e-5


class ViewTables(NamedTuple):
    """Box as lines of sight see it.

    Attributes
    ----------
    cells : BeamCells
        Cells of the field.
    moments : array, shape (nx, ny, levels, terms, w)
        Moments of the diffuse radiance. [1]
    degrees : array of int, shape (terms,)
        Degrees of the harmonics.
    cloud, cloud_single, cloud_source : array, shapes (w,), (w,), (degrees, w)
        See ``BoxOptics``.
    air, air_source, air_phase : array, shapes (levels, w), (levels, degrees, w) and
        (levels, moments, w); the last has (2l + 1)/4π times unscaled scattering times moments.
        [m⁻¹]
    air_depth : array, shape (levels + 1, w)
        Scaled vertical optical depth of the air above an edge. [1]
    ground : array, shape (nx, ny, w)
        Diffuse irradiance of the ground. [1]
    albedo : array, shape (w,)
        Albedo of the ground. [1]
    sun : tuple of three float
        Unit vector to the sun.
    peak, peak_depth : array, shapes (angles, roots, w) and (w,)
        See ``forward_peak``. [sr⁻¹], [1]
    """

    cells: BeamCells
    moments: Float32Array
    degrees: NDArray[np.int64]
    cloud: FloatArray
    cloud_single: FloatArray
    cloud_source: FloatArray
    air: FloatArray
    air_source: FloatArray
    air_phase: FloatArray
    air_depth: FloatArray
    ground: Float32Array
    albedo: FloatArray
    sun: tuple[float, float, float]
    peak: FloatArray
    peak_depth: FloatArray


class ViewLines(NamedTuple):
    """Lines of sight, and what is seen along them.

    Attributes
    ----------
    origins, directions : array, shape (n, 3)
        Coordinates [m], and unit vectors away from the observer.
    functions : array, shape (n, terms)
        Harmonics of the direction of the light. [1]
    phase : array, shape (n, w)
        Phase function of the cloud between sun and view. [sr⁻¹]
    radiance, transmittance : array, shape (n, w)
        Receive radiance over the beam's irradiance [sr⁻¹], and scaled transmittance of the line.
    distance : array, shape (n,)
        Receives the distance at which the line leaves the box; negative if it ends on the ground.
        [m]
    """

    origins: FloatArray
    directions: FloatArray
    functions: FloatArray
    phase: FloatArray
    radiance: FloatArray
    transmittance: FloatArray
    distance: FloatArray


@inlined
def _inside(origin, direction, cells):
    """Distances at which a line enters and leaves the box. [m]"""
    extinction, edges, corner, widths, periodic, _, _, _ = cells
    levels, ny, nx = extinction.shape
    near, far = 0.0, 1e30
    for axis in range(3):
        low, high = edges[0], edges[levels]
        if axis < 2:
            if periodic:
                continue
            low, high = corner[axis], corner[axis] + widths[axis] * (nx if axis == 0 else ny)
        slope = direction[axis]
        if abs(slope) < LEAST_COSINE:
            if origin[axis] < low or origin[axis] > high:
                return 0.0, -1.0
            continue
        first, last = (low - origin[axis]) / slope, (high - origin[axis]) / slope
        near, far = max(near, min(first, last)), min(far, max(first, last))
    return near, far


@inlined
def _sun_depth(point, level, tables, out):
    """Unscaled depth of the cloud from a point to the sun; fill ``out`` with the scaled one. [1]"""
    sun, edges = tables.sun, tables.cells.edges
    depth = depth_towards(point, sun, tables.cells)
    part = (edges[level + 1] - point[2]) / (edges[level + 1] - edges[level])
    part = min(max(part, 0.0), 1.0)
    above, below = tables.air_depth[level + 1], tables.air_depth[level]
    for w in range(out.size):
        air = (1.0 - part) * above[w] + part * below[w]
        out[w] = tables.cloud[w] * depth + air / sun[2]
    return depth


@inlined
def _peak_row(nu, table, out):
    """Fill ``out`` (roots, w) with the table at a cosine of the scattering angle."""
    place = (acos(min(max(nu, -1.0), 1.0)) / pi) ** (2.0 / 3.0) * ANGLES
    low = min(int(place), ANGLES - 1)
    part = place - low
    for r in range(ROOTS):
        for w in range(out.shape[1]):
            out[r, w] = (1.0 - part) * table[low, r, w] + part * table[low + 1, r, w]


@inlined
def _source_phase(x, phase, row, w):
    """Phase function of the source after a depth x of scattering by the peak. [sr⁻¹]"""
    place = min(sqrt(x) * ((ROOTS - 1) / LARGEST_ROOT), ROOTS - 1.001)
    low = int(place)
    part = place - low
    return exp(0.0 - x) * phase + (1.0 - part) * row[low, w] + part * row[low + 1, w]


@inlined
def _scattered(point, level, amount, functions, tables, out):
    """Fill ``out`` with the source of higher orders at a point of a level. [m⁻¹ sr⁻¹]"""
    cells, moments, degrees = tables.cells, tables.moments, tables.degrees
    extinction, edges, corner, widths, periodic, _, _, _ = cells
    levels, ny, nx = extinction.shape
    i, i_next, p = neighbours((point[0] - corner[0]) / widths[0], nx, periodic)
    j, j_next, q = neighbours((point[1] - corner[1]) / widths[1], ny, periodic)
    middle = 0.5 * (edges[level] + edges[level + 1])
    other = min(level + 1, levels - 1) if point[2] > middle else max(level - 1, 0)
    r = 0.0
    if other != level:
        r = (point[2] - middle) / (0.5 * (edges[other] + edges[other + 1]) - middle)
    out[:] = 0.0
    for t in range(degrees.size):
        l = degrees[t]
        for w in range(out.size):
            low = (1.0 - q) * (
                (1.0 - p) * moments[i, j, level, t, w] + p * moments[i_next, j, level, t, w]
            ) + q * (
                (1.0 - p) * moments[i, j_next, level, t, w]
                + p * moments[i_next, j_next, level, t, w]
            )
            high = (1.0 - q) * (
                (1.0 - p) * moments[i, j, other, t, w] + p * moments[i_next, j, other, t, w]
            ) + q * (
                (1.0 - p) * moments[i, j_next, other, t, w]
                + p * moments[i_next, j_next, other, t, w]
            )
            factor = amount * tables.cloud_source[l, w] + tables.air_source[level, l, w]
            out[w] += functions[t] * factor * ((1.0 - r) * low + r * high)
    for w in range(out.size):
        out[w] = max(out[w], 0.0)


@inlined
def _mean_of_exponential(depth):
    """(1 - exp(-x))/x. [1]"""
    if abs(depth) < 1e-4:
        return 1.0 - 0.5 * depth
    return (1.0 - exp(0.0 - depth)) / depth


@inlined
def _on_ground(point, tables, radiance, transmittance, work):
    """Add the light of the ground at a point."""
    cells = tables.cells
    _, ny, nx = cells.extinction.shape
    i, i_next, p = neighbours((point[0] - cells.corner[0]) / cells.widths[0], nx, cells.periodic)
    j, j_next, q = neighbours((point[1] - cells.corner[1]) / cells.widths[1], ny, cells.periodic)
    lit = tables.sun[2] > 0.0
    if lit:
        _sun_depth(point, 0, tables, work)
    ground = tables.ground
    for w in range(radiance.size):
        light = (1.0 - q) * ((1.0 - p) * ground[i, j, w] + p * ground[i_next, j, w]) + q * (
            (1.0 - p) * ground[i, j_next, w] + p * ground[i_next, j_next, w]
        )
        if lit:
            light += tables.sun[2] * exp(0.0 - work[w])
        radiance[w] += transmittance[w] * tables.albedo[w] / pi * light


@compiled_loop
def view_block(first, last, lines, tables):
    """Radiance and transmittance of some lines of sight.

    Parameters
    ----------
    first, last : int
        Lines.
    lines : ViewLines
    tables : ViewTables
    """
    cells, sun = tables.cells, tables.sun
    extinction, edges, corner, widths, periodic, _below, _, _ = cells
    levels, ny, nx = extinction.shape
    count = tables.cloud.size
    before, after, source = np.empty(count), np.empty(count), np.empty(count)
    air_phase = np.zeros((levels, count))
    row = np.empty((ROOTS, count))
    has_air = np.zeros(levels, np.bool_)
    for k in range(levels):
        for w in range(count):
            has_air[k] |= tables.air[k, w] > 0.0
    lit = sun[2] > 0.0
    for n in range(first, last):
        radiance, transmittance = lines.radiance[n], lines.transmittance[n]
        radiance[:], transmittance[:] = 0.0, 1.0
        origin = (lines.origins[n, 0], lines.origins[n, 1], lines.origins[n, 2])
        c = lines.directions[n, 2]
        if abs(c) < LEAST_COSINE:
            c = LEAST_COSINE
        direction = (lines.directions[n, 0], lines.directions[n, 1], c)
        nu = direction[0] * sun[0] + direction[1] * sun[1] + direction[2] * sun[2]
        air_phase[:] = 0.0
        earlier, now = 0.0, 1.0
        for l in range(tables.air_phase.shape[1]):
            for k in range(levels):
                for w in range(count):
                    air_phase[k, w] += now * tables.air_phase[k, l, w]
            earlier, now = now, ((2 * l + 1) * nu * now - l * earlier) / (l + 1)
        _peak_row(nu, tables.peak, row)
        seen, to_sun, to_sun_after = 0.0, 0.0, 0.0
        start, end = _inside(origin, direction, cells)
        lines.distance[n] = 0.0
        if end <= start:
            continue
        upwards = c > 0.0
        z = min(max(origin[2] + start * c, edges[0]), edges[levels])
        level = min(max(level_of(edges, z, upwards), 0), levels - 1)
        ahead_u, i = first_crossing(
            (origin[0] + start * direction[0] - corner[0]) / widths[0], direction[0]
        )
        ahead_v, j = first_crossing(
            (origin[1] + start * direction[1] - corner[1]) / widths[1], direction[1]
        )
        if periodic:
            i, j = wrapped(i, nx), wrapped(j, ny)
        else:
            i, j = min(max(i, 0), nx - 1), min(max(j, 0), ny - 1)
        pace_u = widths[0] / max(abs(direction[0]), 1e-30)
        pace_v = widths[1] / max(abs(direction[1]), 1e-30)
        next_u = start + ahead_u * pace_u
        next_v = start + ahead_v * pace_v
        along = start
        known = False
        while along < end:
            edge = edges[level + 1] if upwards else edges[level]
            next_z = (edge - origin[2]) / c
            following = min(min(next_u, next_v), min(next_z, end))
            following = max(following, along)
            amount = mean_extinction(origin, direction, along, following, (level, j, i), cells)
            if (amount > 0.0 or has_air[level]) and following > along:
                thickest = 0.0
                for w in range(count):
                    total = amount * tables.cloud[w] + tables.air[level, w]
                    thickest = max(thickest, total * (following - along))
                steps = min(1 + int(thickest / _STEP), _MOST_STEPS)
                length = (following - along) / steps
                for step in range(steps):
                    ends = along + (step + 1) * length
                    middle = ends - 0.5 * length
                    if lit and not known:
                        point = (
                            origin[0] + along * direction[0],
                            origin[1] + along * direction[1],
                            origin[2] + along * direction[2],
                        )
                        to_sun = _sun_depth(point, level, tables, before)
                        known = True
                    if lit:
                        point = (
                            origin[0] + ends * direction[0],
                            origin[1] + ends * direction[1],
                            origin[2] + ends * direction[2],
                        )
                        to_sun_after = _sun_depth(point, level, tables, after)
                    point = (
                        origin[0] + middle * direction[0],
                        origin[1] + middle * direction[1],
                        origin[2] + middle * direction[2],
                    )
                    _scattered(point, level, amount, lines.functions[n], tables, source)
                    for w in range(count):
                        depth = (amount * tables.cloud[w] + tables.air[level, w]) * length
                        light = source[w] * _mean_of_exponential(depth)
                        if lit:
                            path = seen + 0.5 * (amount * length + to_sun + to_sun_after)
                            x = tables.peak_depth[w] * path
                            phase = _source_phase(x, lines.phase[n, w], row, w)
                            single = amount * tables.cloud_single[w] * phase
                            single += air_phase[level, w]
                            both = _mean_of_exponential(depth + after[w] - before[w])
                            light += single * exp(0.0 - before[w]) * both
                            before[w] = after[w]
                        radiance[w] += transmittance[w] * length * light
                        transmittance[w] *= exp(0.0 - depth)
                    seen += amount * length
                    to_sun = to_sun_after
            else:
                known = False
            along = following
            if along >= end:
                break
            brightest = 0.0
            for w in range(count):
                brightest = max(brightest, transmittance[w])
            if brightest < _DARK:
                break
            if next_z <= following:
                level += 1 if upwards else -1
                if level < 0 or level >= levels:
                    break
            if next_u <= following:
                next_u += pace_u
                i += 1 if direction[0] > 0.0 else -1
                if periodic:
                    i = 0 if i >= nx else (nx - 1 if i < 0 else i)
                elif i < 0 or i >= nx:
                    break
            if next_v <= following:
                next_v += pace_v
                j += 1 if direction[1] > 0.0 else -1
                if periodic:
                    j = 0 if j >= ny else (ny - 1 if j < 0 else j)
                elif j < 0 or j >= ny:
                    break
        lines.distance[n] = end
        height = origin[2] + end * c - edges[0]
        if not upwards and height < 1e-6 * (edges[levels] - edges[0]):
            lines.distance[n] = 0.0 - end
            point = (origin[0] + end * direction[0], origin[1] + end * direction[1], edges[0])
            _on_ground(point, tables, radiance, transmittance, after)

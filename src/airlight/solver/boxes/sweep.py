r"""Sweep: light of one level of a box in one hemisphere of directions, from the moments before.

Discrete ordinates on cells by diamond differences. With the source q and the faces through which
light enters, in each direction

.. math:: \\psi = \\frac{q + \\sum_i (2|\\mu_i|/\\Delta_i)\\, \\psi_{i,\\mathrm{in}}}
          {\\kappa + \\sum_i 2|\\mu_i|/\\Delta_i}, \\qquad
          \\psi_{i,\\mathrm{out}} = 2\\psi - \\psi_{i,\\mathrm{in}}.

Where that is negative, ψ follows from the balance without light through that face (set to zero;
Lewis & Miller 1984, Computational Methods of Neutron Transport, section 4-2). Both halves of a
register have the same four wavelengths, for two directions of an octant.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import (
    HALF_LANES,
    folded,
    lane_array,
    lane_view,
    load_half,
    maximum,
    splat,
    store_half,
    where_positive,
)
from airlight.solver.boxes.directions import SIGNS

Float32Array = NDArray[np.float32]


class SweepCells(NamedTuple):
    """Cells and their optics, for four wavelengths.

    Attributes
    ----------
    extinction : array, shape (levels, ny, nx)
        Extinction of the cloud at 550 nm. [m⁻¹]
    beam : array, shape (levels, ny, nx, 4)
        Mean irradiance of the beam, normal to it. [1]
    lit : array, shape (levels, ny, nx, 4)
        Extinction of the cloud at 550 nm times that, as the sweep sees it (``beam.centred``). [m⁻¹]
    cloud, cloud_source : array, shapes (4,), (degree + 1, 4)
        See ``BoxOptics``. [1]
    air, air_source : array, shapes (levels, 4), (levels, degree + 1, 4)
        See ``BoxOptics``. [m⁻¹]
    degrees : array of int, shape (terms,)
        Degrees of the harmonics.
    thickness : array, shape (levels,)
        Depth of the levels. [m]
    flat : tuple of two bool
        Whether light does not vary along x, and along y.
    """

    extinction: Float32Array
    beam: Float32Array
    lit: Float32Array
    cloud: Float32Array
    cloud_source: Float32Array
    air: Float32Array
    air_source: Float32Array
    degrees: NDArray[np.int64]
    thickness: Float32Array
    flat: tuple[bool, bool]


class SweepDirections(NamedTuple):
    """Directions in pairs, by hemisphere and octant.

    Attributes
    ----------
    slopes : array, shape (2, 4, pairs, 3, 8)
        Twice the magnitudes of μ_x and μ_y over the cell's widths, and of μ_z. [m⁻¹], [1]
    functions, weighted : array, shape (2, 4, pairs, terms, 8)
        Harmonics, and harmonics times solid angle. [1], [sr]
    crossing : array, shape (2, 4, pairs, 3, 8)
        Signed direction cosines times solid angle. [sr]
    sun : array, shape (terms,)
        Harmonics of the direction of the beam. [1]
    """

    slopes: Float32Array
    functions: Float32Array
    weighted: Float32Array
    crossing: Float32Array
    sun: Float32Array


class SweepLight(NamedTuple):
    """Light of a box.

    Attributes
    ----------
    moments : tuple of two arrays, shape (levels, ny, nx, terms, 4)
        Moments of downward and of upward light. [1]
    heads : array, shape (2, 4, ny, nx, pairs, 8)
        Light through the horizontal faces that the sweep has reached. [sr⁻¹]
    sides, fronts : array, shapes (2, 4, levels, ny, pairs, 8), (2, 4, levels, nx, pairs, 8)
        Light that enters at the sides, along x and y. It is replaced by that which leaves
        opposite, if the box is periodic. [sr⁻¹]
    currents : tuple of three arrays
        Net irradiance through faces towards x, y and z but for light that enters the box, shapes
        (levels, ny, nx + 1, 4), (levels, ny + 1, nx, 4) and, by hemisphere,
        (2, levels + 1, ny, nx, 4). [1]
    sources : array, shape (2, ny, nx, terms, 4)
        Workspace: moments of the source of a level, by hemisphere. [m⁻¹]
    """

    moments: tuple[Float32Array, Float32Array]
    heads: Float32Array
    sides: Float32Array
    fronts: Float32Array
    currents: tuple[Float32Array, Float32Array, Float32Array]
    sources: Float32Array


@inlined
def _through_cell(source, extinction, slopes, entering):
    """Mean light of a cell, and light that leaves it along x, y and z."""
    a, b, c = slopes
    x, y, z = entering
    ax, by, cz = a * x, b * y, c * z
    mean = (source + ax + by + cz) / (extinction + a + b + c)
    # Twice: without one face's light another may become negative.
    zero = splat(0.0)
    one = splat(1.0)
    for _ in range(2):
        open_x = where_positive(mean + mean - x, one, zero)
        open_y = where_positive(mean + mean - y, one, zero)
        open_z = where_positive(mean + mean - z, one, zero)
        arriving = source + 0.5 * (ax * (open_x + 1.0) + by * (open_y + 1.0) + cz * (open_z + 1.0))
        mean = arriving / (extinction + a * open_x + b * open_y + c * open_z + 1e-30)
    return (
        mean,
        maximum(mean + mean - x, 0.0) * open_x,
        maximum(mean + mean - y, 0.0) * open_y,
        maximum(mean + mean - z, 0.0) * open_z,
    )


@compiled_loop
def sweep_level(level, hemisphere, periodic, cells, ways, light):
    """Light of one level in one hemisphere of directions.

    Parameters
    ----------
    level : int
        Level, from the ground.
    hemisphere : int
        0 for light downwards, 1 for light upwards.
    periodic : bool
        Whether light that leaves at a side enters opposite, in the next sweep.
    cells : SweepCells
    ways : SweepDirections
    light : SweepLight
        Its moments and currents of this hemisphere are replaced.
    """
    extinctions, beam, lit, cloud, cloud_source, air, air_source, degrees, thickness, flat = cells
    flat_x, flat_y = flat
    slopes, functions, weighted, crossing, sun = ways
    moments, heads, sides, fronts, currents, works = light
    current_x, current_y, current_z = currents
    ny, nx = extinctions.shape[1], extinctions.shape[2]
    terms, pairs = functions.shape[3], functions.shape[2]
    highest = cloud_source.shape[0]
    before, after = moments[0].reshape(-1), moments[1].reshape(-1)
    own = before if hemisphere == 0 else after
    flat_beam, flat_lit, flat_source = beam.reshape(-1), lit.reshape(-1), cloud_source.reshape(-1)
    flat_extinction = extinctions.reshape(-1)
    flat_air, flat_air_source = air.reshape(-1), air_source.reshape(-1)
    flat_x_current, flat_y_current = current_x.reshape(-1), current_y.reshape(-1)
    flat_z_current = current_z.reshape(-1)
    slope, function, weight = lane_view(slopes), lane_view(functions), lane_view(weighted)
    cross = lane_view(crossing)
    head, side, front = lane_view(heads), lane_view(sides), lane_view(fronts)
    work = works.reshape(-1)
    start = hemisphere * ny * nx * terms * HALF_LANES
    sums = lane_view(lane_array(terms))
    row = lane_view(lane_array(pairs))
    scattering, once = lane_view(lane_array(highest)), lane_view(lane_array(highest))
    inverse = np.float32(1.0) / thickness[level]
    own_air = load_half(flat_air, level * HALF_LANES)
    for place in range(ny * nx):
        cell = level * ny * nx + place
        amount = flat_extinction[cell]
        direct = load_half(flat_beam, cell * HALF_LANES)
        given = load_half(flat_lit, cell * HALF_LANES)
        for l in range(highest):
            share = load_half(flat_source, l * HALF_LANES)
            clear = load_half(flat_air_source, (level * highest + l) * HALF_LANES)
            scattering[l] = share * amount + clear
            once[l] = share * given + clear * direct
        for t in range(terms):
            at = (cell * terms + t) * HALF_LANES
            total = load_half(before, at) + load_half(after, at)
            at = start + (place * terms + t) * HALF_LANES
            l = degrees[t]
            store_half(work, at, scattering[l] * total + once[l] * sun[t])
    for octant in range(4):
        step_x, step_y = SIGNS[octant]
        for line in range(ny):
            y = line if step_y > 0 else ny - 1 - line
            for p in range(pairs):
                row[p] = side[hemisphere, octant, level, y, p]
            for column in range(nx):
                x = column if step_x > 0 else nx - 1 - column
                cell = (level * ny + y) * nx + x
                amount = extinctions[level, y, x]
                extinction = load_half(cloud, 0) * amount + own_air
                base = start + (y * nx + x) * terms * HALF_LANES
                for t in range(terms):
                    sums[t] = splat(0.0)
                through_x, through_y, through_z = splat(0.0), splat(0.0), splat(0.0)
                for p in range(0, pairs, 2):
                    first, second = splat(0.0), splat(0.0)
                    other_first, other_second = splat(0.0), splat(0.0)
                    for t in range(0, terms - 1, 2):
                        source = load_half(work, base + t * HALF_LANES)
                        following = load_half(work, base + (t + 1) * HALF_LANES)
                        first += function[hemisphere, octant, p, t] * source
                        second += function[hemisphere, octant, p + 1, t] * source
                        other_first += function[hemisphere, octant, p, t + 1] * following
                        other_second += function[hemisphere, octant, p + 1, t + 1] * following
                    if terms % 2:
                        last = terms - 1
                        source = load_half(work, base + last * HALF_LANES)
                        first += function[hemisphere, octant, p, last] * source
                        second += function[hemisphere, octant, p + 1, last] * source
                    first = maximum(first + other_first, 0.0)
                    second = maximum(second + other_second, 0.0)
                    mean, out_x, out_y, out_z = _through_cell(
                        first,
                        extinction,
                        (
                            slope[hemisphere, octant, p, 0],
                            slope[hemisphere, octant, p, 1],
                            slope[hemisphere, octant, p, 2] * inverse,
                        ),
                        (
                            row[p],
                            front[hemisphere, octant, level, x, p],
                            head[hemisphere, octant, y, x, p],
                        ),
                    )
                    other, other_x, other_y, other_z = _through_cell(
                        second,
                        extinction,
                        (
                            slope[hemisphere, octant, p + 1, 0],
                            slope[hemisphere, octant, p + 1, 1],
                            slope[hemisphere, octant, p + 1, 2] * inverse,
                        ),
                        (
                            row[p + 1],
                            front[hemisphere, octant, level, x, p + 1],
                            head[hemisphere, octant, y, x, p + 1],
                        ),
                    )
                    if flat_x:
                        out_x, other_x = mean, other
                    if flat_y:
                        out_y, other_y = mean, other
                    row[p], row[p + 1] = out_x, other_x
                    front[hemisphere, octant, level, x, p] = out_y
                    front[hemisphere, octant, level, x, p + 1] = other_y
                    head[hemisphere, octant, y, x, p] = out_z
                    head[hemisphere, octant, y, x, p + 1] = other_z
                    through_x += cross[hemisphere, octant, p, 0] * out_x
                    through_x += cross[hemisphere, octant, p + 1, 0] * other_x
                    through_y += cross[hemisphere, octant, p, 1] * out_y
                    through_y += cross[hemisphere, octant, p + 1, 1] * other_y
                    through_z += cross[hemisphere, octant, p, 2] * out_z
                    through_z += cross[hemisphere, octant, p + 1, 2] * other_z
                    for t in range(terms):
                        sums[t] = (
                            sums[t]
                            + weight[hemisphere, octant, p, t] * mean
                            + weight[hemisphere, octant, p + 1, t] * other
                        )
                for t in range(terms):
                    total = folded(sums[t])
                    at = (cell * terms + t) * HALF_LANES
                    if octant > 0:
                        total = total + load_half(own, at)
                    store_half(own, at, total)
                at = ((level * ny + y) * (nx + 1) + x + (step_x > 0)) * HALF_LANES
                _add(flat_x_current, at, through_x)
                at = ((level * (ny + 1) + y + (step_y > 0)) * nx + x) * HALF_LANES
                _add(flat_y_current, at, through_y)
                face = hemisphere * (extinctions.shape[0] + 1) + level + hemisphere
                at = ((face * ny + y) * nx + x) * HALF_LANES
                _add(flat_z_current, at, through_z)
            if periodic:
                for p in range(pairs):
                    side[hemisphere, octant, level, y, p] = row[p]


@inlined
def _add(array, at, value):
    """Add both halves of lanes to four elements."""
    store_half(array, at, load_half(array, at) + folded(value))

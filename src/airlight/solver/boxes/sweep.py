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
    any_negative,
    folded,
    lane_array,
    lane_view,
    load_half,
    maximum,
    minimum,
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
    slopes : array, shape (pairs, 3, 8)
        Twice the magnitudes of μ_x and μ_y over the cell's widths, and of μ_z. [m⁻¹], [1]
    functions, weighted : array, shapes (2, pairs, terms, 8), (2, terms, pairs, 8)
        Harmonics, and harmonics times solid angle, of the first octant, in ``order``. [1], [sr]
    crossing : array, shape (2, 4, pairs, 3, 8)
        Signed direction cosines times solid angle. [sr]
    sun : array, shape (terms,)
        Harmonics of the direction of the beam. [1]
    order : array of int, shape (terms,)
        Harmonics by class: even in x and y, odd in x, odd in y, odd in both.
    classes : array of int, shape (5,)
        First places of the classes in that order, and the number of terms.
    """

    slopes: Float32Array
    functions: Float32Array
    weighted: Float32Array
    crossing: Float32Array
    sun: Float32Array
    order: NDArray[np.int64]
    classes: NDArray[np.int64]


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
    work : array, shape (2, 4, ny, nx, pairs, 8)
        Workspace: source of a level, then its mean light, by hemisphere and octant. [m⁻¹ sr⁻¹]
    """

    moments: tuple[Float32Array, Float32Array]
    heads: Float32Array
    sides: Float32Array
    fronts: Float32Array
    currents: tuple[Float32Array, Float32Array, Float32Array]
    work: Float32Array


@inlined
def _through_cell(source, extinction, slopes, entering):
    """Mean light of a cell, and light that leaves it along x, y and z."""
    a, b, c = slopes
    x, y, z = entering
    ax, by, cz = a * x, b * y, c * z
    mean = (source + ax + by + cz) / (extinction + a + b + c)
    twice = mean + mean
    out_x, out_y, out_z = twice - x, twice - y, twice - z
    if any_negative(minimum(minimum(out_x, out_y), out_z)):
        # Twice: without one face's light another may become negative.
        zero = splat(0.0)
        one = splat(1.0)
        open_x, open_y, open_z = one, one, one
        for _ in range(2):
            open_x = where_positive(mean + mean - x, one, zero)
            open_y = where_positive(mean + mean - y, one, zero)
            open_z = where_positive(mean + mean - z, one, zero)
            arriving = source + 0.5 * (
                ax * (open_x + 1.0) + by * (open_y + 1.0) + cz * (open_z + 1.0)
            )
            mean = arriving / (extinction + a * open_x + b * open_y + c * open_z + 1e-30)
        twice = mean + mean
        out_x = maximum(twice - x, 0.0) * open_x
        out_y = maximum(twice - y, 0.0) * open_y
        out_z = maximum(twice - z, 0.0) * open_z
    return mean, out_x, out_y, out_z


@inlined
def _fill_sources(y, level, hemisphere, cells, ways, light):
    """Fill a row of ``light.work`` with the sources in all directions of a hemisphere."""
    extinctions, beam, lit, _, cloud_source, _, air_source, degrees, _, _ = cells
    sun, order, classes = ways.sun, ways.order, ways.classes
    ny, nx = extinctions.shape[1], extinctions.shape[2]
    terms, highest = order.size, cloud_source.shape[0]
    before, after = light.moments[0].reshape(-1), light.moments[1].reshape(-1)
    flat_beam, flat_lit, flat_source = beam.reshape(-1), lit.reshape(-1), cloud_source.reshape(-1)
    flat_air_source = air_source.reshape(-1)
    function, work = lane_view(ways.functions), lane_view(light.work)
    scattering, once = lane_view(lane_array(highest)), lane_view(lane_array(highest))
    source = lane_view(lane_array(terms))
    parts = lane_view(lane_array(4))
    for x in range(nx):
        cell = (level * ny + y) * nx + x
        amount = extinctions[level, y, x]
        direct = load_half(flat_beam, cell * HALF_LANES)
        given = load_half(flat_lit, cell * HALF_LANES)
        for l in range(highest):
            share = load_half(flat_source, l * HALF_LANES)
            clear = load_half(flat_air_source, (level * highest + l) * HALF_LANES)
            scattering[l] = share * amount + clear
            once[l] = share * given + clear * direct
        for n in range(terms):
            t = order[n]
            at = (cell * terms + t) * HALF_LANES
            l = degrees[t]
            total = load_half(before, at) + load_half(after, at)
            source[n] = scattering[l] * total + once[l] * sun[t]
        for p in range(function.shape[1]):
            for c in range(4):
                total = splat(0.0)
                for n in range(classes[c], classes[c + 1]):
                    total += function[hemisphere, p, n] * source[n]
                parts[c] = total
            low, high = parts[0] + parts[2], parts[1] + parts[3]
            work[hemisphere, 0, y, x, p] = maximum(low + high, 0.0)
            work[hemisphere, 1, y, x, p] = maximum(low - high, 0.0)
            low, high = parts[0] - parts[2], parts[1] - parts[3]
            work[hemisphere, 2, y, x, p] = maximum(low + high, 0.0)
            work[hemisphere, 3, y, x, p] = maximum(low - high, 0.0)


@inlined
def _sweep_row(y, level, hemisphere, octant, cells, ways, light, row):
    """Replace the sources of a row by its mean light in the directions of an octant."""
    extinctions, _, _, cloud, _, air, _, _, thickness, flat = cells
    flat_x, flat_y = flat
    ny, nx = extinctions.shape[1], extinctions.shape[2]
    slope, cross = lane_view(ways.slopes), lane_view(ways.crossing)
    head, front, work = lane_view(light.heads), lane_view(light.fronts), lane_view(light.work)
    x_currents, y_currents = light.currents[0].reshape(-1), light.currents[1].reshape(-1)
    z_currents = light.currents[2].reshape(-1)
    step_x, step_y = SIGNS[octant]
    inverse = np.float32(1.0) / thickness[level]
    own_air = load_half(air.reshape(-1), level * HALF_LANES)
    own_cloud = load_half(cloud, 0)
    for column in range(nx):
        x = column if step_x > 0 else nx - 1 - column
        extinction = own_cloud * extinctions[level, y, x] + own_air
        through_x, through_y, through_z = splat(0.0), splat(0.0), splat(0.0)
        for p in range(slope.shape[0]):
            mean, out_x, out_y, out_z = _through_cell(
                work[hemisphere, octant, y, x, p],
                extinction,
                (slope[p, 0], slope[p, 1], slope[p, 2] * inverse),
                (
                    row[p],
                    front[hemisphere, octant, level, x, p],
                    head[hemisphere, octant, y, x, p],
                ),
            )
            if flat_x:
                out_x = mean
            if flat_y:
                out_y = mean
            row[p] = out_x
            front[hemisphere, octant, level, x, p] = out_y
            head[hemisphere, octant, y, x, p] = out_z
            work[hemisphere, octant, y, x, p] = mean
            through_x += cross[hemisphere, octant, p, 0] * out_x
            through_y += cross[hemisphere, octant, p, 1] * out_y
            through_z += cross[hemisphere, octant, p, 2] * out_z
        at = ((level * ny + y) * (nx + 1) + x + (step_x > 0)) * HALF_LANES
        _add(x_currents, at, through_x)
        at = ((level * (ny + 1) + y + (step_y > 0)) * nx + x) * HALF_LANES
        _add(y_currents, at, through_y)
        face = hemisphere * (extinctions.shape[0] + 1) + level + hemisphere
        at = ((face * ny + y) * nx + x) * HALF_LANES
        _add(z_currents, at, through_z)


@inlined
def _sum_moments(y, level, hemisphere, ways, light):
    """Replace the moments of a row by those of its mean light in all directions."""
    order, classes = ways.order, ways.classes
    moments = light.moments[0] if hemisphere == 0 else light.moments[1]
    _, ny, nx, terms, _ = moments.shape
    own = moments.reshape(-1)
    weight, work = lane_view(ways.weighted), lane_view(light.work)
    pairs = weight.shape[2]
    parts = lane_view(lane_array(4 * pairs))
    for x in range(nx):
        cell = (level * ny + y) * nx + x
        for p in range(pairs):
            first, second = work[hemisphere, 0, y, x, p], work[hemisphere, 1, y, x, p]
            third, fourth = work[hemisphere, 2, y, x, p], work[hemisphere, 3, y, x, p]
            low, high = first + second, third + fourth
            parts[p], parts[2 * pairs + p] = low + high, low - high
            low, high = first - second, third - fourth
            parts[pairs + p], parts[3 * pairs + p] = low + high, low - high
        for c in range(4):
            for n in range(classes[c], classes[c + 1]):
                total = splat(0.0)
                for p in range(pairs):
                    total += weight[hemisphere, n, p] * parts[c * pairs + p]
                store_half(own, (cell * terms + order[n]) * HALF_LANES, folded(total))


@compiled_loop
def sweep_level(level, hemisphere, periodic, cells, ways, light):
    """Light of one level in one hemisphere of directions.

    Rows of cells are passed northwards, then southwards. Sources and moments are those of a
    quarter of the directions: from octant to octant harmonics at most change their sign.

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
    ny = cells.extinction.shape[1]
    side = lane_view(light.sides)
    pairs = side.shape[4]
    row = lane_view(lane_array(pairs))
    for line in range(ny):
        _fill_sources(line, level, hemisphere, cells, ways, light)
        for octant in range(2):
            for p in range(pairs):
                row[p] = side[hemisphere, octant, level, line, p]
            _sweep_row(line, level, hemisphere, octant, cells, ways, light, row)
            if periodic:
                for p in range(pairs):
                    side[hemisphere, octant, level, line, p] = row[p]
    for line in range(ny):
        y = ny - 1 - line
        for octant in range(2, 4):
            for p in range(pairs):
                row[p] = side[hemisphere, octant, level, y, p]
            _sweep_row(y, level, hemisphere, octant, cells, ways, light, row)
            if periodic:
                for p in range(pairs):
                    side[hemisphere, octant, level, y, p] = row[p]
        _sum_moments(y, level, hemisphere, ways, light)


@inlined
def _add(array, at, value):
    """Add both halves of lanes to four elements."""
    store_half(array, at, load_half(array, at) + folded(value))

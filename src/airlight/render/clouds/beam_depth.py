"""Optical depth of clouds towards the sun, from the middle of cells and from the lowest faces."""

from __future__ import annotations

from math import floor, sqrt

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.render.clouds.cell_level import CellLevel

Float32Array = NDArray[np.float32]

#: Optical depth at which a beam ends. [1]
_OPAQUE = 40.0
#: Steps of a beam over the smallest width of a cell; and longer ones, of a first light. [1]
STEP = 0.5
LONG_STEP = 1.5


def beam_depths(
    field: CloudField,
    clear: Float32Array,
    towards: tuple[float, float, float],
    radius: float,
    *,
    step: float = STEP,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> tuple[Float32Array, Float32Array]:
    """Optical depth at 550 nm towards the sun, on a sphere.

    Parameters
    ----------
    clear : array, shape (nz, ny, nx)
        Result of ``clear_distances``. [m]
    towards : tuple of three float
        Unit vector to the sun: east, north, up; it may be below the horizon. [1]
    radius : float
        Radius of the ground. [m]
    step : float
        Step over the smallest width of a cell. [1]

    Returns
    -------
    depth, base_depth : array of float32, shapes (nz, ny, nx) and (ny, nx)
        Depth from the middle of cells, and from the middle of the lowest faces. [1]
    """
    cells = np.ascontiguousarray(field.extinction.transpose(2, 1, 0))
    levels = np.append(np.arange(cells.shape[0]), -0.5)
    out = np.empty((levels.size, *cells.shape[1:]), np.float32)
    box = np.array([*field.spacing, field.base + radius])
    periodic, length = field.beyond == "periodic", step * min(field.spacing)

    def fill(k: int) -> None:
        _fill(levels[k], cells, clear, box, length, np.asarray(towards), periodic, out[k])

    run_blocks(fill, levels.size, progress=progress, cancel=cancel, message="shadows of clouds")
    return out[:-1], out[-1]


@compiled_loop
def _fill(level, cells, clear, box, step, towards, periodic, out):
    nz, ny, nx = cells.shape
    flat = 1.0 - towards[2] * towards[2]
    for j in range(ny):
        for i in range(nx):
            altitude, s, depth = (level + 0.5) * box[2], 0.5 * step, 0.0
            while depth < _OPAQUE:
                up = altitude + s * towards[2] + s * s * flat / (2.0 * box[3])
                rising = towards[2] + s * flat / box[3]
                z = up / box[2] - 0.5
                if z > nz - 0.5 and rising >= 0.0:
                    break
                if z < -0.5:
                    if rising > 0.0:
                        # on to the base
                        short = (-0.5 - z) * box[2]
                        more = (
                            2.0
                            * short
                            / (rising + sqrt(rising * rising + 2.0 * short * flat / box[3]))
                        )
                        s += max(more, step)
                    else:
                        s += step - rising * box[3] / max(flat, 1e-9) * 2.0
                    continue
                x, y = i + s * towards[0] / box[0], j + s * towards[1] / box[1]
                if not periodic and (x < -0.5 or y < -0.5 or x > nx - 0.5 or y > ny - 0.5):
                    break
                nearest, _ = cell_before(x + 0.5, nx, periodic)
                beside, _ = cell_before(y + 0.5, ny, periodic)
                free = clear[min(max(int(z + 0.5), 0), nz - 1), beside, nearest]
                if free > 0.0:
                    s += step * (1.0 + floor(free / step))
                    continue
                depth += step * cell_value(cells, CellLevel(nx, ny, 0), x, y, z, periodic)
                s += step
            out[j, i] = depth


@inlined
def cell_value(cells, level, x, y, z, periodic):
    """Linear interpolation between the middles of cells, whose places are whole numbers.

    Parameters
    ----------
    cells : array, shape (nz, rows, columns)
        Values.
    level : CellLevel
        Columns and rows.
    x, y, z : float
        Place. [cells]
    periodic : bool
        Whether cells repeat themselves along x and y.
    """
    nz, nx, ny = cells.shape[0], level.columns, level.rows
    i, e = cell_before(x, nx, periodic)
    j, f = cell_before(y, ny, periodic)
    k, g = cell_before(z, nz, False)
    right, back, up = cell_after(i, nx, periodic), cell_after(j, ny, periodic), min(k + 1, nz - 1)
    j, back = level.first + j, level.first + back
    low = (1.0 - f) * ((1.0 - e) * cells[k, j, i] + e * cells[k, j, right]) + f * (
        (1.0 - e) * cells[k, back, i] + e * cells[k, back, right]
    )
    high = (1.0 - f) * ((1.0 - e) * cells[up, j, i] + e * cells[up, j, right]) + f * (
        (1.0 - e) * cells[up, back, i] + e * cells[up, back, right]
    )
    return (1.0 - g) * low + g * high


@inlined
def plane_value(cells, level, x, y, periodic):
    """``cell_value`` of cells of one altitude, shape (rows, columns)."""
    nx, ny = level.columns, level.rows
    i, e = cell_before(x, nx, periodic)
    j, f = cell_before(y, ny, periodic)
    right, back = cell_after(i, nx, periodic), cell_after(j, ny, periodic)
    j, back = level.first + j, level.first + back
    low = (1.0 - e) * cells[j, i] + e * cells[j, right]
    high = (1.0 - e) * cells[back, i] + e * cells[back, right]
    return (1.0 - f) * low + f * high


@inlined
def cell_before(place, count, periodic):
    """Index of the cell before a place, and the fraction of the step to the next one. [1]"""
    if not periodic:
        place = min(max(place, 0.0), count - 1.0)
    whole = floor(place)
    index = whole
    if periodic:
        index = whole % count
    return index, place - whole


@inlined
def cell_after(index, count, periodic):
    """Index of the cell after another one."""
    following = index + 1
    if following >= count:
        following = 0 if periodic else count - 1
    return following

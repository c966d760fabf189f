"""Higher orders of scattering at a place in clouds, of the box and of the finer one inside it."""

from __future__ import annotations

from typing import Annotated, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import in_shaders, inlined
from airlight.kernel.lanes import lane_view, pair, splat
from airlight.render.clouds.beam_depth import cell_after, cell_before
from airlight.render.clouds.cloud_textures import INNER

Float32Array = NDArray[np.float32]

#: Width beside the sides of the finer box in which both mix, over its own width. [1]
MIXED: Final = 0.1


class InnerSource(NamedTuple):
    """Source of the finer box inside the box of a layer.

    Attributes
    ----------
    west, south, wide, long : float
        Its western and southern sides from those of the field, and its widths. [cells of the field]
    columns, rows : int
        Its columns and rows; 0 if there is no such box.
    source : array, shape (mz, my, mx, pairs, 8)
        See ``LayerTables.source``.
    """

    west: float
    south: float
    wide: float
    long: float
    columns: int
    rows: int
    source: Annotated[Float32Array, INNER]


def no_inner() -> InnerSource:
    """``InnerSource`` without columns."""
    return InnerSource(0.0, 0.0, 1.0, 1.0, 0, 0, np.zeros((1, 1, 1, 1, 8), np.float32))


@inlined
def inner_place(x, y, nx, ny, inner, periodic):
    """Place in the finer box over its widths, and its share there. [1]

    Parameters
    ----------
    x, y : float
        Place in the field, from the middle of the first cell. [cells]
    nx, ny : int
        Columns and rows of the field.
    inner : InnerSource
    periodic : bool
        Whether the field repeats itself sideways.
    """
    u, v = x + 0.5 - inner.west, y + 0.5 - inner.south
    if periodic:
        u -= nx * np.floor(u / nx)
        v -= ny * np.floor(v / ny)
    u, v = u / inner.wide, v / inner.long
    near = min(min(u, 1.0 - u), min(v, 1.0 - v))
    return u, v, min(max(near / MIXED, 0.0), 1.0)


@inlined
def mixed_source(source, rows, place, periodic, harmonics):
    """Source linear between cells, in the direction of harmonics, by halves of a register. [sr⁻¹]

    Parameters
    ----------
    source : array, shape (mz, rows, mx, pairs, 8)
        See ``LayerTables.source``.
    rows : CellLevel
        Columns and rows to be read.
    place : Vec3
        Place over the widths of the box. [1]
    periodic : bool
        Whether columns and rows repeat themselves.
    harmonics : array
        Harmonics of the direction. [1]
    """
    mz, mx, my = source.shape[0], rows.columns, rows.rows
    # linear also in the outer halves of the lowest and the highest levels
    level_z = place.z * mz - 0.5
    k = min(max(int(level_z), 0), max(mz - 2, 0))
    ez = level_z - k
    above = min(k + 1, mz - 1)
    i, ex = cell_before(place.x * mx - 0.5, mx, periodic)
    j, ey = cell_before(place.y * my - 0.5, my, periodic)
    right, back = cell_after(i, mx, periodic), cell_after(j, my, periodic)
    total = splat(0.0)
    for corner in range(8):
        east, north = corner % 2, corner // 2 % 2
        column, row = (right if east == 1 else i), (back if north == 1 else j)
        level = above if corner > 3 else k
        weight = (
            (ex if east == 1 else 1.0 - ex)
            * (ey if north == 1 else 1.0 - ey)
            * (ez if corner > 3 else 1.0 - ez)
        )
        if weight != 0.0:
            part = cell_source(source, level, rows.first + row, column, harmonics)
            total = total + part * np.float32(weight)
    return total


@inlined
def cell_source(source, level, row, column, harmonics):
    """Source of a cell in the direction of harmonics, by halves of a register. [sr⁻¹]

    Parameters
    ----------
    source, harmonics :
        Arguments of ``mixed_source``.
    level, row, column : int
        Cell.
    """
    values, total = lane_view(source), splat(0.0)
    for n in range(source.shape[3]):
        factor = pair(np.float32(harmonics[2 * n]), np.float32(harmonics[2 * n + 1]))
        total = total + factor * values[level, row, column, n]
    return total


def source_of_terms(source, level, row, column, harmonics):
    """``cell_source`` of texels of four wavelengths, shape (mz, rows, mx·terms), in shaders."""
    values, total, first = lane_view(source), splat(0.0), column * harmonics.size
    for n in range(harmonics.size):
        total = total + values[level, row, first + n] * np.float32(harmonics[n])
    return total


in_shaders(cell_source, source_of_terms)

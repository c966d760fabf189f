"""Patches in which a periodic field continues beyond its box, so that it does not seem to repeat.

The plane is divided into squares with rough edges, all alike. The four in the middle, together a
quarter wider than the box, hold it; each other one is the periodic field displaced, with its own
light, so that its cover is that of a field on larger scales than the box: of random displacements
the nearest. On both sides of an edge a patch turns into its neighbour. Edges are never inside the
box.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.power_law_field import power_law_field
from airlight.kernel import inlined
from airlight.render.clouds.beam_depth import plane_value
from airlight.render.clouds.cell_level import CellLevel
from airlight.render.clouds.cloud_textures import PLANE, VOLUME

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Width of a patch over that of the box. [1]
WIDTH: Final = 0.625
#: Largest displacement of an edge over the width of a patch: edges are outside the box. [1]
BENT: Final = 1.0 - 0.5 / WIDTH
#: Width of the band beside an edge in which patches mix, over the width of a patch. [1]
MIXED: Final = 0.04
#: Longest waves of an edge over the width of a patch, and exponent of its spectrum. [1]
_LONGEST: Final = 0.2
_SLOPE: Final = -3.0
#: Columns and rows of a patch, and of patches with displacements of their own: a power of 2.
_CELLS: Final = 256
_PATCHES: Final = 64
#: Number of random displacements of which one is chosen for a patch.
_TRIALS: Final = 24
#: Exponent of the spectrum of cover along a line, and its longest waves [patch].
_COVER_SLOPE: Final = -2.0
_COVER_LONGEST: Final = 24.0


class PatchEdges(NamedTuple):
    """Edges of patches, on columns and rows of a patch.

    Attributes
    ----------
    east, north : array, shape (rows, columns)
        Displacement of edges at the corners of cells over the width of a patch. [1]
    free : array, shape (rows, columns)
        Distance from any point of a cell within which there is no band of an edge. [m]
    moved : array, shape (patches, patches, 2)
        Displacement of the periodic field in a patch to the east and to the north, 0 in those of
        the box. [m]
    """

    east: Annotated[Float32Array, PLANE]
    north: Annotated[Float32Array, PLANE]
    free: Annotated[FloatArray, PLANE]
    moved: Annotated[FloatArray, VOLUME]


@lru_cache(maxsize=8)
def patch_edges(width: float, length: float) -> PatchEdges:
    """Edges of the patches of a box, without displacements.

    Parameters
    ----------
    width, length : float
        Sides of the box to the east and to the north. [m]
    """
    from scipy.ndimage import distance_transform_edt, maximum_filter

    grid = CloudGrid(columns=_CELLS, levels=1, spacing=1.0 / _CELLS, depth=1.0)
    random = np.random.default_rng(1)
    waves = [power_law_field(grid, random, slope=_SLOPE, longest=_LONGEST) for _ in range(2)]
    east, north = (
        np.asarray(0.99 * (BENT - MIXED) * one / np.abs(one).max(), np.float32) for one in waves
    )
    # patches at the corners of cells, and cells whose corners are in bands or in several patches
    places = np.arange(_CELLS + 1) / _CELLS
    wide = [np.pad(one, (0, 1), mode="wrap") for one in (east, north)]
    several = np.zeros((_CELLS, _CELLS), bool)
    for bent in (places + wide[0], places[:, None] + wide[1]):
        corners = np.stack([bent[:-1, :-1], bent[:-1, 1:], bent[1:, :-1], bent[1:, 1:]])
        several |= np.ptp(np.floor(corners), axis=0) > 0.0
        several |= np.abs(corners - np.round(corners)).min(axis=0) < MIXED
    # between cells a column or a row less than between their middles
    near = np.pad(maximum_filter(several, size=3, mode="wrap"), _CELLS // 2, mode="wrap")
    steps = length * WIDTH / _CELLS, width * WIDTH / _CELLS
    inner = slice(_CELLS // 2, _CELLS // 2 + _CELLS)
    free = distance_transform_edt(~near, sampling=steps)[inner, inner]
    return PatchEdges(east, north, np.ascontiguousarray(free), np.zeros((_PATCHES, _PATCHES, 2)))


def displacements(covered: NDArray[np.bool_], width: float, length: float) -> FloatArray:
    """Displacements of the patches of a field, see ``PatchEdges.moved``. [m]

    Parameters
    ----------
    covered : array of bool, shape (nx, ny)
        Whether a column of the field has clouds.
    width, length : float
        Sides of the box to the east and to the north. [m]
    """
    from scipy.ndimage import uniform_filter

    shape = np.array(covered.shape)
    window = np.maximum(np.round(WIDTH * shape).astype(int), 1)
    cover = uniform_filter(covered.astype(float), size=tuple(window), mode="wrap")
    random = np.random.default_rng(2)
    grid = CloudGrid(columns=_PATCHES, levels=1, spacing=1.0, depth=1.0)
    large = power_law_field(grid, random, slope=_COVER_SLOPE, longest=_COVER_LONGEST)
    ranks = large.argsort(axis=None).argsort().reshape(large.shape) + 0.5
    wanted = np.quantile(cover, ranks / ranks.size)
    trials = random.integers(0, shape, (_PATCHES, _PATCHES, _TRIALS, 2))
    found = cover[trials[..., 0], trials[..., 1]]
    best = np.abs(found - wanted[..., None]).argmin(axis=2)[..., None, None]
    column, row = np.moveaxis(np.take_along_axis(trials, best, axis=2)[:, :, 0], 2, 0)
    places = (np.arange(_PATCHES) - 0.5) * WIDTH  # middles of patches from that of the box
    east = places - ((column + 0.5) / shape[0] - 0.5)
    north = places[:, None] - ((row + 0.5) / shape[1] - 0.5)
    moved = np.stack([east % 1.0 * width, north % 1.0 * length], axis=-1)
    moved[:2, :2] = 0.0
    return moved


class Patch(NamedTuple):
    """Patch at a place.

    Attributes
    ----------
    right, up : float
        Displacement of the periodic field to the east and to the north. [m]
    free : float
        Distance within which it is the only one; 0 where there are two. [m]
    share : float
        Share of the neighbour, up to a half. [1]
    other_right, other_up : float
        Displacement of the neighbour. [m]
    """

    right: float
    up: float
    free: float
    share: float
    other_right: float
    other_up: float


@inlined
def patch_at(east, north, width, length, edges):
    """``Patch`` at a place.

    Parameters
    ----------
    east, north : float
        Place from the middle of the box. [m]
    width, length : float
        Sides of the box to the east and to the north. [m]
    edges : PatchEdges
        Result of ``patch_edges``.
    """
    x, y = 1.0 + east / (WIDTH * width), 1.0 + north / (WIDTH * length)
    column, row = np.floor(x), np.floor(y)
    near_x, near_y = 0.5 - abs(x - column - 0.5), 0.5 - abs(y - row - 0.5)
    if 0.0 < x < 2.0 and 0.0 < y < 2.0:  # edges between the four of the box part nothing
        near_x, near_y = 1.0 - abs(x - 1.0), 1.0 - abs(y - 1.0)
    free = WIDTH * min((near_x - BENT) * width, (near_y - BENT) * length)
    share, to_east, to_north = 0.0, 0, 0
    if free <= 0.0:
        rows, columns = edges.free.shape[0], edges.free.shape[1]
        across, along = (x - column) * columns, (y - row) * rows
        free = edges.free[min(int(along), rows - 1), min(int(across), columns - 1)]
        cells = CellLevel(columns, rows, 0)
        x += plane_value(edges.east, cells, across, along, True)
        y += plane_value(edges.north, cells, across, along, True)
        column, row = np.floor(x), np.floor(y)
        if free <= 0.0:
            near_x, near_y = 0.5 - abs(x - column - 0.5), 0.5 - abs(y - row - 0.5)
            share = max(0.5 - 0.5 * min(near_x, near_y) / MIXED, 0.0)
            if near_x < near_y:
                to_east = 1 if x - column > 0.5 else -1
            else:
                to_north = 1 if y - row > 0.5 else -1
    count = edges.moved.shape[0]
    i, j = int(column) % count, int(row) % count
    m, n = (int(column) + to_east) % count, (int(row) + to_north) % count
    return Patch(
        edges.moved[j, i, 0],
        edges.moved[j, i, 1],
        free,
        share,
        edges.moved[n, m, 0],
        edges.moved[n, m, 1],
    )

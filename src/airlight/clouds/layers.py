"""Layer clouds: stratus, stratocumulus and altocumulus by the optical depth of their columns.

Optical depth is log-normal about a pattern of cells, with a k^(-5/3) spectrum below their size
(Cahalan et al. 1994, JAS 51, 2434). Liquid water is adiabatic above a common base with a constant
number of droplets: extinction is proportional to h^(2/3), optical depth to the 5/3rd power of the
depth (Brenguier et al. 2000, JAS 57, 803).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from airlight.clouds.grid import Grid
from airlight.clouds.power_law_field import power_law_field

FloatArray = NDArray[np.float64]

#: Shear that stretches cells to twice their width. [s⁻¹]
STRETCHING: Final = 5e-3
#: Share of columns whose depth is at most that of the clouds.
_DEEPEST: Final = 0.995


@dataclass(frozen=True, kw_only=True)
class Pattern:
    """Pattern of a layer.

    Parameters
    ----------
    cells : float
        Logarithm of the optical depth in the middle of a cell over that at its edge. [1]
    spread : float
        Standard deviation of the logarithm of the k^(-5/3) part. [1]
    patches : float
        Standard deviation of the logarithm of patches of many cells. [1]
    """

    cells: float
    spread: float
    patches: float = 0.0


STRATUS: Final = Pattern(cells=0.0, spread=0.25)
STRATOCUMULUS: Final = Pattern(cells=1.3, spread=0.5, patches=0.2)
ALTOCUMULUS: Final = Pattern(cells=2.0, spread=0.5, patches=0.8)


def layer_extinction(
    grid: Grid,
    random: np.random.Generator,
    *,
    pattern: Pattern,
    cell: float,
    cover: float,
    shear: float,
) -> FloatArray:
    """Relative extinction of a layer of a cover, shape of the grid. [1]

    Parameters
    ----------
    grid, random, cell, cover, shear
        See ``heaps.heap_extinction``; shear stretches cells along the wind, in rolls.
    pattern : Pattern
        Contrasts of the layer.
    """
    stretch = 1.0 + abs(shear) / STRETCHING
    fine = power_law_field(grid, random, longest=cell, stretch=stretch)
    logarithm = pattern.spread * fine
    if pattern.patches:
        coarse = power_law_field(grid, random, slope=-2.5, longest=12.0 * cell)
        logarithm = logarithm + pattern.patches * coarse
    if pattern.cells:
        logarithm = logarithm + pattern.cells * cell_pattern(grid, random, cell, stretch)
    columns = np.exp(logarithm)
    if cover < 1.0:
        columns = np.maximum(columns - np.quantile(columns, 1.0 - cover), 0.0)
    depths = columns**0.6
    depths *= grid.depth / np.quantile(depths[depths > 0.0], _DEEPEST)
    layer = adiabatic(grid, np.minimum(depths, grid.depth))
    wanted = layer.sum(axis=2)
    for axis in (0, 1):  # tops slope between columns rather than step
        layer = 0.5 * layer + 0.25 * (np.roll(layer, 1, axis) + np.roll(layer, -1, axis))
    return np.asarray(layer * (wanted / np.maximum(layer.sum(axis=2), 1e-30))[..., None])


def adiabatic(grid: Grid, depths: FloatArray) -> FloatArray:
    """Means over cells of h^(2/3) up to the top of each column, shape of the grid. [m^(2/3)]

    Parameters
    ----------
    grid : Grid
        Box.
    depths : array, shape (columns, columns)
        Depths of the columns. [m]
    """
    edges = np.arange(grid.levels + 1) * grid.level
    filled = np.minimum(edges, depths[..., None]) ** (5.0 / 3.0)
    return np.asarray(0.6 * np.diff(filled, axis=2) / grid.level)


def cell_pattern(
    grid: Grid, random: np.random.Generator, cell: float, stretch: float
) -> FloatArray:
    """Closed cells: 1 in their middles, 0 at their edges, shape (columns, columns). [1]

    Cells are those of points nearest to irregular middles, a bent and disturbed hexagonal lattice;
    the pattern is 1 - (d₁/d₂)² of the distances to the nearest two.
    """
    rows = max(round(grid.size / (cell * np.sqrt(0.75))), 2)
    columns = max(round(grid.size / (cell * stretch)), 1)
    j, i = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    east = (i + 0.5 * (j % 2)) / columns + 0.28 * random.standard_normal(i.shape) / columns
    north = j / rows + 0.28 * random.standard_normal(i.shape) / rows
    middles = np.stack([east.ravel() * columns, north.ravel() * rows * np.sqrt(0.75)], axis=1)
    period = np.array([columns, rows * np.sqrt(0.75)])
    tree = cKDTree(np.mod(middles, period), boxsize=period)
    bend = [0.35 * power_law_field(grid, random, slope=-2.5, longest=3.0 * cell) for _ in range(2)]
    places = (np.arange(grid.columns) + 0.5) / grid.columns
    x = places[:, None] * period[0] + bend[0] * 0.5
    y = places[None, :] * period[1] + bend[1] * 0.5
    points = np.mod(np.stack(np.broadcast_arrays(x, y), axis=-1), period)
    near, _ = tree.query(points, k=2)
    return np.asarray(1.0 - (near[..., 0] / np.maximum(near[..., 1], 1e-9)) ** 2)

"""``Nest``: a larger box round a box of finer cells, whose light enters at its sides."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.solver.boxes.beam import BeamCells
from airlight.solver.boxes.directions import SIGNS, BoxDirections, harmonics
from airlight.solver.boxes.grid import BoxGrid
from airlight.solver.boxes.problem import four_wide, in_pairs
from airlight.solver.boxes.solution import BoxSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


class Nest(NamedTuple):
    """Larger box round a box.

    Attributes
    ----------
    around : BoxSolution
        Its light, at the same wavelengths.
    field : CloudField
        Its clouds, which dim the beam before and inside the smaller box.
    """

    around: BoxSolution
    field: CloudField

    def beam_cells(self, ground: float, curvature: float) -> BeamCells:
        """Cells of the clouds that the beam crosses."""
        field = self.field
        below = int(ground < field.base)
        cells = field.extinction.transpose(2, 1, 0)
        clear = np.zeros((below, *cells.shape[1:]), np.float32)
        edges = field.base + field.spacing[2] * np.arange(len(cells) + 1)
        return BeamCells(
            np.ascontiguousarray(np.concatenate([clear, cells])),
            np.concatenate([[ground] * below, edges]),
            (field.west, field.south),
            (float(field.spacing[0]), float(field.spacing[1])),
            field.beyond == "periodic",
            below,
            field.interpolated,
            curvature,
        )

    def sides(
        self, field: CloudField, grid: BoxGrid, ways: BoxDirections, some: slice
    ) -> tuple[Float32Array, Float32Array]:
        """Light that enters a box at its sides, see ``BoxIteration``. [sr⁻¹]

        Parameters
        ----------
        field, grid : CloudField, BoxGrid
            The smaller box, and its cells.
        ways : BoxDirections
            Directions of light.
        some : slice
            Wavelengths.
        """
        corner, levels = (field.west, field.south), len(grid.extinction)
        *places, altitudes = _middles(field, grid)
        functions = harmonics(ways.vectors, self.around.degree)  # (2, 4, n, terms)
        found = []
        for axis in range(2):
            across = places[1 - axis]
            light = np.zeros((*functions.shape[:2], levels, across.size, functions.shape[2], 4))
            for end in range(2):
                face = corner[axis] + end * field.sides[axis]
                x, y = (face, across) if axis == 0 else (across, face)
                faces = [np.asarray(one) for one in np.broadcast_arrays(x, y)]
                moments = self._moments(faces, altitudes)[..., some]
                entering = [n for n, signs in enumerate(SIGNS) if signs[axis] == 1 - 2 * end]
                seen = np.einsum("hodt,kitw->hokidw", functions[:, entering], moments)
                light[:, entering] = four_wide(np.maximum(seen, 0.0))
            found.append(in_pairs(light.astype(np.float32)))
        return found[0], found[1]

    def start(self, field: CloudField, grid: BoxGrid, some: slice) -> Float32Array:
        """Moments in the cells of a box, of the larger one, shape (levels, ny, nx, terms, 4). [1]

        Parameters
        ----------
        field, grid, some :
            Arguments of ``sides``.
        """
        x, y, altitudes = _middles(field, grid)
        found = [
            four_wide(self._moments([x, np.full(x.size, north)], altitudes)[..., some])
            for north in y
        ]
        return np.stack(found, axis=1)

    def _moments(self, places: Sequence[FloatArray], altitudes: FloatArray) -> FloatArray:
        """Moments of the larger box, linear between its cells, shape (levels, n, terms, w)."""
        around = self.around
        field, middles = around.field, 0.5 * (around.levels[1:] + around.levels[:-1])
        up = np.interp(altitudes, middles, np.arange(middles.size))
        k = np.clip(up.astype(int), 0, max(middles.size - 2, 0))
        above = np.minimum(k + 1, middles.size - 1)
        share = (up - k).astype(np.float32)[:, None, None, None]
        between = []
        for axis, corner in enumerate((field.west, field.south)):
            cell = (places[axis] - corner) / field.spacing[axis] - 0.5
            count, low = field.extinction.shape[axis], np.floor(cell).astype(int)
            part = (cell - low).astype(np.float32)
            if field.beyond == "periodic":
                ends = low % count, (low + 1) % count
            else:
                ends = np.clip(low, 0, count - 1), np.clip(low + 1, 0, count - 1)
            between.append(((ends[0], 1.0 - part), (ends[1], part)))
        columns = sum(
            (p * q)[:, None, None, None] * around.moments[i, j]
            for i, p in between[0]
            for j, q in between[1]
        )
        columns = np.asarray(columns).swapaxes(0, 1)
        return np.asarray((1.0 - share) * columns[k] + share * columns[above])


def _middles(field: CloudField, grid: BoxGrid) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Coordinates of the middles of the columns and rows of a box, and of its levels. [m]"""
    _, ny, nx = grid.extinction.shape
    x = np.asarray(field.west + (np.arange(nx) + 0.5) * grid.widths[0])
    y = np.asarray(field.south + (np.arange(ny) + 0.5) * grid.widths[1])
    return x, y, np.asarray(0.5 * (grid.edges[1:] + grid.edges[:-1]))

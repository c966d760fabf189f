"""Blocks of the cells of a box: constant changes of them, the coarse grid of ``linear``."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import HALF_LANES
from airlight.solver.boxes.cell_balance import FaceCoefficients, in_chunks

Float32Array = NDArray[np.float32]
FloatArray = NDArray[np.float64]

#: Addition to the diagonal of the balance of blocks, over its largest element. [1]
_REGULAR: Final = 1e-5
#: Number of blocks of cells aimed at.
_BLOCKS: Final = 700


class BlockCells(NamedTuple):
    """Cells and the blocks to which they belong.

    Attributes
    ----------
    x, y, z : array of int
        Block of each column, row and level.
    net : array, shape (levels, ny, nx, 4)
        Loss less gain of cells in uniform light. [m⁻¹]
    """

    x: NDArray[np.int64]
    y: NDArray[np.int64]
    z: NDArray[np.int64]
    net: Float32Array


@inlined
def _subtract(gain, change, out):
    """Subtract a gain (nx, 4) times changes from a row of losses less gains."""
    for x in range(out.shape[0]):
        for w in range(HALF_LANES):
            out[x, w] -= gain[x, w] * change[x, w]


@inlined
def _fill_left(k, y, coefficients, per_z, cells, coarse, given, work, out):
    """Fill a row of ``out`` with what changes of blocks leave of losses less gains. [m⁻¹]

    Neighbours in one block gain from each other what both lose: only faces of blocks count.
    """
    diagonal, (low_x, low_y, low_z), (high_x, high_y, high_z) = coefficients
    levels, ny, nx, _ = diagonal.shape
    at_x, at_y, at_z, net = cells
    row, n = out[k, y], at_z[k]
    here = coarse[n, at_y[y]]
    for x in range(nx):
        for w in range(HALF_LANES):
            row[x, w] = given[k, y, x, w] - net[k, y, x, w] * here[at_x[x], w]
    for x in range(nx):
        east = x + 1 if x + 1 < nx else 0
        if at_x[east] != at_x[x]:
            for w in range(HALF_LANES):
                step = here[at_x[x], w] - here[at_x[east], w]
                row[x, w] -= high_x[k, y, x, w] * step
                row[east, w] += low_x[k, y, x, w] * step
    south, north = (y - 1 if y > 0 else ny - 1), (y + 1 if y + 1 < ny else 0)
    for side in range(4):
        if side < 2:
            other = south if side == 0 else north
            same = at_y[other] == at_y[y]
            beyond = coarse[n, at_y[other]]
        else:
            other = min(max(k + 2 * side - 5, 0), levels - 1)
            same = at_z[other] == n
            beyond = coarse[at_z[other], at_y[y]]
        if same:
            continue
        factor = per_z if side >= 2 else np.float32(1.0)
        for x in range(nx):
            for w in range(HALF_LANES):
                work[x, w] = factor * (here[at_x[x], w] - beyond[at_x[x], w])
        if side == 0:
            _subtract(low_y[k, south], work, row)
        elif side == 1:
            _subtract(high_y[k, y], work, row)
        elif side == 2:
            _subtract(low_z[k - 1, y], work, row)
        else:
            _subtract(high_z[k, y], work, row)


@compiled_loop
def precondition_rows(first, last, coefficients, thickness, factors, cells, coarse, given, out):
    """Changes of the cells of some rows: those of blocks, and of columns without neighbours.

    Parameters
    ----------
    factors : array, shape (levels, ny, nx, 4)
        See ``factorise``. [m]
    cells : BlockCells
    coarse : array of float32
        Changes of blocks, shape (..., 4).
    given, out : array, shape (levels, ny, nx, 4)
        Loss less gain to be balanced [m⁻¹]; receives the changes.
    """
    _, (_, _, low_z), (_, _, high_z) = coefficients
    levels, _, nx, _ = given.shape
    work = np.empty((nx, HALF_LANES), np.float32)
    for y in range(first, last):
        for k in range(levels):
            per_z = np.float32(1.0) / thickness[k]
            _fill_left(k, y, coefficients, per_z, cells, coarse, given, work, out)
            before = max(k - 1, 0)
            if k > 0:
                for x in range(nx):
                    for w in range(HALF_LANES):
                        out[k, y, x, w] += per_z * low_z[before, y, x, w] * out[before, y, x, w]
            for x in range(nx):
                for w in range(HALF_LANES):
                    out[k, y, x, w] *= factors[k, y, x, w]
        for k in range(levels - 2, -1, -1):
            per_z = np.float32(1.0) / thickness[k]
            blocks = coarse[cells.z[k + 1], cells.y[y]]
            for x in range(nx):
                for w in range(HALF_LANES):
                    beyond = out[k + 1, y, x, w]
                    out[k, y, x, w] += per_z * high_z[k, y, x, w] * factors[k, y, x, w] * beyond
                    out[k + 1, y, x, w] = beyond + blocks[cells.x[x], w]
        for x in range(nx):
            for w in range(HALF_LANES):
                out[0, y, x, w] += coarse[0, cells.y[y], cells.x[x], w]


@compiled_loop
def block_sums(first, last, values, thickness, size, out):
    """Sums over the cells of blocks of some levels of blocks, weighted by depth."""
    levels, ny, nx, _ = values.shape
    for n in range(first, last):
        out[n] = 0.0
        for k in range(n * size, min((n + 1) * size, levels)):
            for y in range(ny):
                for i in range(out.shape[2]):
                    for x in range(i * size, min((i + 1) * size, nx)):
                        for w in range(HALF_LANES):
                            out[n, y // size, i, w] += thickness[k] * values[k, y, x, w]


class Blocks:
    """Balance of blocks of cells.

    Parameters
    ----------
    coefficients : FaceCoefficients
    thickness : array, shape (levels,)
        Depth of the levels. [m]
    net : array, shape (levels, ny, nx, 4)
        Loss less gain of cells in uniform light. [m⁻¹]
    """

    def __init__(
        self, coefficients: FaceCoefficients, thickness: Float32Array, net: Float32Array
    ) -> None:
        from scipy.sparse import coo_matrix
        from scipy.sparse.linalg import splu

        shape = net.shape[:3]
        axes = sum(count > 1 for count in shape)
        size = int(np.ceil((np.prod(shape) / _BLOCKS) ** (1.0 / max(axes, 1))))
        self.starts = [np.arange(0, count, size) for count in shape]
        z, y, x = (np.arange(count) // size for count in shape)
        self.cells = BlockCells(x, y, z, net)
        self.size, self.thickness = size, thickness
        self.shape = tuple(start.size for start in self.starts)
        index = np.arange(np.prod(self.shape)).reshape(self.shape)
        diagonal = self.summed(net)
        rows, columns, gains = [], [], []
        for axis in range(3):
            if self.shape[axis] == 1:
                continue
            ends = np.append(self.starts[axis][1:], shape[axis]) - 1
            here, beyond = index, np.roll(index, -1, axis=axis)
            component = 2 - axis
            scaled = axis > 0  # gains in z are those of currents
            for array, target, source in (
                (coefficients.from_low[component], beyond, here),
                (coefficients.from_high[component], here, beyond),
            ):
                part = self._across(array, axis, ends, scaled)
                if axis == 0:  # nothing passes through the top
                    part[-1] = 0.0
                rows.append(target.ravel())
                columns.append(source.ravel())
                gains.append(part.reshape(-1, part.shape[-1]))
                np.add.at(diagonal.reshape(-1, 4), target.ravel(), gains[-1])
        # A preconditioner may be inexact; blocks that lose nothing would make it singular.
        scale = np.abs(diagonal).max(axis=(0, 1, 2))
        diagonal += _REGULAR * np.where(scale > 0.0, scale, 1.0)
        rows.append(index.ravel())
        columns.append(index.ravel())
        at = np.concatenate(rows), np.concatenate(columns)
        self.solvers: list[Any] = []
        for w in range(net.shape[-1]):
            values = np.concatenate([*(-one[:, w] for one in gains), diagonal[..., w].ravel()])
            matrix = coo_matrix((values, at), shape=(index.size, index.size))
            self.solvers.append(splu(matrix.tocsc()))

    def _across(
        self, array: Float32Array, axis: int, ends: NDArray[np.int64], scaled: bool
    ) -> FloatArray:
        """Gains through the last faces of blocks along an axis, summed over the blocks' faces."""
        taken = array.take(ends, axis=axis)
        if scaled:
            taken = taken * self.thickness[:, None, None, None]
        for other in range(3):
            if other != axis:
                taken = np.add.reduceat(taken, self.starts[other], axis=other)
        return np.asarray(taken, np.float64)

    def summed(self, values: Float32Array) -> FloatArray:
        """Sums over the cells of blocks, weighted by depth, shape (..., 4)."""
        found = np.empty((*self.shape, values.shape[-1]))
        in_chunks(
            lambda a, b: block_sums(a, b, values, self.thickness, self.size, found),
            len(found),
            values.size // HALF_LANES,
        )
        return found

    def solve(self, values: Float32Array) -> Float32Array:
        """Changes of blocks that balance given losses, shape (..., 4)."""
        given = self.summed(values)
        found = np.stack(
            [one.solve(given[..., w].ravel()) for w, one in enumerate(self.solvers)], axis=-1
        )
        return np.ascontiguousarray(found.reshape(given.shape), np.float32)

"""Solution of the balance of a box's cells: BiCGStab with two grids.

The preconditioner solves for constant changes of blocks of cells, then eliminates columns of cells
without their neighbours.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import HALF_LANES
from airlight.kernel.threads import run_blocks, thread_count

Float32Array = NDArray[np.float32]
FloatArray = NDArray[np.float64]

#: Largest number of steps, and its tolerance. [1]
_STEPS, _TOLERANCE = 30, 0.3
#: Number of cells up to which other threads cost more time than they save.
_FEW_CELLS: Final = 40_000
#: Addition to the diagonal of the balance of blocks, over its largest element. [1]
_REGULAR: Final = 1e-5
#: Number of blocks of cells aimed at.
_BLOCKS: Final = 700


class FaceCoefficients(NamedTuple):
    """Coefficients of the balance of cells, shapes (levels, ny, nx, 4). [m⁻¹]

    Attributes
    ----------
    diagonal : array
        Loss of a cell.
    from_low, from_high : tuple of three arrays
        Gain of the higher cell at the upper face of a cell along x, y and z, and of the cell
        itself, from the other.
    """

    diagonal: Float32Array
    from_low: tuple[Float32Array, Float32Array, Float32Array]
    from_high: tuple[Float32Array, Float32Array, Float32Array]


@inlined
def _balance_level(k, coefficients, thickness, phi, out):
    """Loss less gain of the cells of a level. [m⁻¹]"""
    diagonal, (low_x, low_y, low_z), (high_x, high_y, high_z) = coefficients
    levels, ny, nx, _ = diagonal.shape
    per_z = np.float32(1.0) / thickness[k]
    for y in range(ny):
        south, north = (y - 1 if y > 0 else ny - 1), (y + 1 if y + 1 < ny else 0)
        for x in range(nx):
            for w in range(HALF_LANES):
                out[k, y, x, w] = (
                    diagonal[k, y, x, w] * phi[k, y, x, w]
                    - low_y[k, south, x, w] * phi[k, south, x, w]
                    - high_y[k, y, x, w] * phi[k, north, x, w]
                )
        for x in range(nx):
            west, east = (x - 1 if x > 0 else nx - 1), (x + 1 if x + 1 < nx else 0)
            for w in range(HALF_LANES):
                out[k, y, x, w] -= (
                    low_x[k, y, west, w] * phi[k, y, west, w]
                    + high_x[k, y, x, w] * phi[k, y, east, w]
                )
        if k > 0:
            for x in range(nx):
                for w in range(HALF_LANES):
                    out[k, y, x, w] -= per_z * low_z[k - 1, y, x, w] * phi[k - 1, y, x, w]
        if k + 1 < levels:
            for x in range(nx):
                for w in range(HALF_LANES):
                    out[k, y, x, w] -= per_z * high_z[k, y, x, w] * phi[k + 1, y, x, w]


@compiled_loop
def balance(first, last, coefficients, thickness, phi, out):
    """Loss less gain of the cells of some levels. [m⁻¹]"""
    for k in range(first, last):
        _balance_level(k, coefficients, thickness, phi, out)


@inlined
def _factorise_row(y, coefficients, thickness, factors):
    """Elimination of the columns of a row: reciprocal pivots in ``factors``. [m]"""
    diagonal, (_, _, low_z), (_, _, high_z) = coefficients
    levels, _, nx, _ = diagonal.shape
    for k in range(levels):
        per_z = np.float32(1.0) / thickness[k]
        for x in range(nx):
            for w in range(HALF_LANES):
                pivot = diagonal[k, y, x, w]
                if k > 0:
                    below = np.float32(1.0) / thickness[k - 1]
                    pivot -= (
                        per_z
                        * low_z[k - 1, y, x, w]
                        * below
                        * high_z[k - 1, y, x, w]
                        * factors[k - 1, y, x, w]
                    )
                factors[k, y, x, w] = np.float32(1.0) / max(pivot, np.float32(1e-30))


@compiled_loop
def factorise(first, last, coefficients, thickness, factors):
    """Elimination of the columns of some rows: reciprocal pivots in ``factors``. [m]"""
    for y in range(first, last):
        _factorise_row(y, coefficients, thickness, factors)


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


def in_chunks(loop: Callable[[int, int], object], count: int, cells: int) -> None:
    """Run ``loop(first, last)`` for parts of ``count`` rows or levels, on each core if many.

    Parameters
    ----------
    cells : int
        Number of all cells.
    """
    parts = min(thread_count(), count) if cells > _FEW_CELLS else 1
    ends = [count * part // parts for part in range(parts + 1)]
    run_blocks(lambda part: loop(ends[part], ends[part + 1]), parts)


@compiled_loop
def _products(first, last, a, b, out):
    """Sums of products over some levels by wavelength, shape (levels, 4)."""
    for k in range(first, last):
        out[k] = 0.0
        for y in range(a.shape[1]):
            part = np.zeros(HALF_LANES, np.float32)
            for x in range(a.shape[2]):
                for w in range(HALF_LANES):
                    part[w] += a[k, y, x, w] * b[k, y, x, w]
            for w in range(HALF_LANES):
                out[k, w] += part[w]


@compiled_loop
def _add_multiples(first, last, out, factors, a, b):
    """Add multiples of two arrays to a third one in some levels."""
    for k in range(first, last):
        for y in range(out.shape[1]):
            for x in range(out.shape[2]):
                for w in range(HALF_LANES):
                    out[k, y, x, w] += factors[0, w] * a[k, y, x, w] + factors[1, w] * b[k, y, x, w]


def _dot(a: Float32Array, b: Float32Array) -> FloatArray:
    """Sum of products over the cells, shape (4,)."""
    out = np.empty((len(a), a.shape[-1]))
    in_chunks(lambda first, last: _products(first, last, a, b, out), len(a), a.size // 4)
    return np.asarray(out.sum(axis=0))


def _add(out: Float32Array, p: FloatArray, a: Float32Array, q: FloatArray, b: Float32Array) -> None:
    """Add p a + q b to ``out``."""
    factors = np.stack([p, q]).astype(np.float32)
    in_chunks(
        lambda first, last: _add_multiples(first, last, out, factors, a, b), len(out), out.size // 4
    )


def _ratio(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.divide(a, b, out=np.zeros_like(a), where=np.abs(b) > 1e-300)


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
        self.cells = BlockCells(*(np.arange(count) // size for count in shape[::-1]), net)
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


def solve_linear(
    coefficients: FaceCoefficients,
    thickness: Float32Array,
    source: Float32Array,
    phi: Float32Array,
) -> Float32Array:
    """Mean radiances of balanced cells, from a guess.

    Source: van der Vorst (1992), SIAM J. Sci. Stat. Comput. 13, 631 (BiCGStab).

    Parameters
    ----------
    coefficients : FaceCoefficients
    thickness : array, shape (levels,)
        Depth of the levels. [m]
    source : array, shape (levels, ny, nx, 4)
        Gain from the beam, the ground and outside. [m⁻¹]
    phi : array, shape (levels, ny, nx, 4)
        Guess of the mean radiance times 4π. [1]
    """
    levels, ny = phi.shape[:2]
    size = phi.size // 4
    factors = np.empty_like(phi)
    in_chunks(lambda a, b: factorise(a, b, coefficients, thickness, factors), ny, size)

    def apply(vector: Float32Array) -> Float32Array:
        out = np.empty_like(vector)
        in_chunks(
            lambda a, b: balance(a, b, coefficients, thickness, vector, out), levels, phi.size // 4
        )
        return out

    blocks = Blocks(coefficients, thickness, apply(np.ones_like(phi)))
    one, zero = np.ones(phi.shape[-1]), np.zeros(phi.shape[-1])

    def precondition(vector: Float32Array) -> Float32Array:
        coarse = blocks.solve(vector)
        out = np.empty_like(vector)
        in_chunks(
            lambda a, b: precondition_rows(
                a, b, coefficients, thickness, factors, blocks.cells, coarse, vector, out
            ),
            ny,
            size,
        )
        return out

    residual = source - apply(phi)
    goal = _TOLERANCE * np.sqrt(np.maximum(_dot(residual, residual), 1e-60))
    goal = np.maximum(goal, 1e-6 * np.sqrt(_dot(source, source)))
    shadow, phi = residual.copy(), phi.copy()
    along, through = np.zeros_like(phi), np.zeros_like(phi)
    rho = alpha = omega = one
    for _ in range(_STEPS):
        if np.all(np.sqrt(_dot(residual, residual)) <= goal):
            break
        before, rho = rho, _dot(shadow, residual)
        beta = _ratio(rho, before) * _ratio(alpha, omega)
        along *= beta.astype(np.float32)
        _add(along, one, residual, -beta * omega, through)
        ready = precondition(along)
        through = apply(ready)
        alpha = _ratio(rho, _dot(shadow, through))
        _add(residual, -alpha, through, zero, through)
        smooth = precondition(residual)
        rough = apply(smooth)
        omega = _ratio(_dot(rough, residual), _dot(rough, rough))
        _add(phi, alpha, ready, omega, smooth)
        _add(residual, -omega, rough, zero, rough)
    return phi

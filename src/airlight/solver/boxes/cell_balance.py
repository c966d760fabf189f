"""Balance of the cells of a box: coefficients of faces, and loss less gain of all cells."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import HALF_LANES
from airlight.kernel.threads import run_blocks, thread_count

Float32Array = NDArray[np.float32]

#: Number of cells up to which other threads cost more time than they save.
_FEW_CELLS: Final = 40_000


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

"""Gaussian elimination for eight wavelengths at once: one matrix per lane.

Without pivoting, which matrices 1 - K with a small K do not need. Lanes make small systems fast,
and the result does not depend on the threads of a BLAS.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, load, splat, store

Float32Array = NDArray[np.float32]

#: Block size: rows eliminated together, so that each pivot row is read once for all of them.
ROWS: Final = 8


@compiled_loop
def factorise(matrix, size):
    """LU factorisation in place.

    Parameters
    ----------
    matrix : array, shape (size·size·8,)
        Matrix by rows; the eight lanes of an element are adjacent. Overwritten. [1]
    size : int
        Number of rows.
    """
    for first in range(0, size, ROWS):
        last = min(first + ROWS, size)
        for k in range(last - 1):
            above = k * size * LANES
            pivot = 1.0 / load(matrix, above + k * LANES)
            for i in range(max(first, k + 1), last):
                row = i * size * LANES
                factor = load(matrix, row + k * LANES) * pivot
                store(matrix, row + k * LANES, factor)
                for j in range((k + 1) * LANES, size * LANES, LANES):
                    store(matrix, row + j, load(matrix, row + j) - factor * load(matrix, above + j))


@compiled_loop
def substitute(factors, size, values, columns):
    """Forward and back substitution in place.

    Parameters
    ----------
    factors : array, shape (size·size·8,)
        Triangular factors from ``factorise``. [1]
    size : int
        Number of rows.
    values : array, shape (size·columns·8,)
        Right-hand sides by rows, overwritten by the solutions.
    columns : int
        Number of right-hand sides.
    """
    width = columns * LANES
    for i in range(size):
        for k in range(i):
            factor = load(factors, (i * size + k) * LANES)
            for j in range(0, width, LANES):
                entry = i * width + j
                store(values, entry, load(values, entry) - factor * load(values, k * width + j))
    for back in range(size):
        i = size - 1 - back
        for k in range(i + 1, size):
            factor = load(factors, (i * size + k) * LANES)
            for j in range(0, width, LANES):
                entry = i * width + j
                store(values, entry, load(values, entry) - factor * load(values, k * width + j))
        scale = splat(1.0) / load(factors, (i * size + i) * LANES)
        for j in range(0, width, LANES):
            store(values, i * width + j, load(values, i * width + j) * scale)

"""Gaussian elimination for eight wavelengths at once: one matrix per lane.

Without pivoting, which matrices 1 - K with a small K do not need.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import lane_view, splat

Float32Array = NDArray[np.float32]

#: Block size: rows eliminated together, so that each pivot row is read once for all of them.
ROWS: Final = 8


@compiled_loop
def factorise(matrix, size):
    """LU factorisation in place.

    Parameters
    ----------
    matrix : array, shape (size·size, 8)
        Matrix by rows; the eight lanes of an element are adjacent. Overwritten. [1]
    size : int
        Number of rows.
    """
    element = lane_view(matrix)
    for first in range(0, size, ROWS):
        last = min(first + ROWS, size)
        for k in range(last - 1):
            above = k * size
            pivot = 1.0 / element[above + k]
            for i in range(max(first, k + 1), last):
                row = i * size
                factor = element[row + k] * pivot
                element[row + k] = factor
                for j in range(k + 1, size):
                    element[row + j] -= factor * element[above + j]


@compiled_loop
def substitute(factors, size, values, columns):
    """Forward and back substitution in place.

    Parameters
    ----------
    factors : array, shape (size·size, 8)
        Triangular factors from ``factorise``. [1]
    values : array, shape (size·columns, 8)
        Right-hand sides by rows, overwritten by the solutions.
    columns : int
        Number of right-hand sides.
    """
    element, value = lane_view(factors), lane_view(values)
    for i in range(size):
        for k in range(i):
            factor = element[i * size + k]
            for j in range(columns):
                value[i * columns + j] -= factor * value[k * columns + j]
    for back in range(size):
        i = size - 1 - back
        for k in range(i + 1, size):
            factor = element[i * size + k]
            for j in range(columns):
                value[i * columns + j] -= factor * value[k * columns + j]
        scale = splat(1.0) / element[i * size + i]
        for j in range(columns):
            value[i * columns + j] *= scale

"""Fewer rows of a table, with the error of what is interpolated between them."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
#: Function of nodes, values at them, and the points of interpolation.
Interpolation = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]

#: Number of rows from which a tolerance is doubled.
MOST_ROWS: Final = 200


def linear(nodes: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """Linear interpolation."""
    return np.asarray(np.interp(at, nodes, values))


def monotone(nodes: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """Monotone cubic, as ``physics.optics.tabulated_profile`` has between positive densities."""
    from airlight.physics.cubic_curves import cubic_curve, monotone_slopes

    if nodes.size < 3:
        return linear(nodes, values, at)
    return np.asarray(cubic_curve(nodes, values, monotone_slopes(nodes, values), at))


def tabulated_between(nodes: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """Densities as ``physics.optics.tabulated_profile`` has them, next to zeros too."""
    from airlight.physics.optics.density_profile import DensitySegments
    from airlight.physics.optics.tabulated_profile import tabulated

    start = nodes[0]
    row = tabulated(nodes - start, values, float(nodes[-1] - start))
    return np.asarray(DensitySegments.from_rows([row]).at(at - start)[0])


def thinned(
    nodes: FloatArray,
    values: FloatArray,
    tolerance: float,
    interpolation: Interpolation = linear,
    most: int = MOST_ROWS,
) -> tuple[NDArray[np.intp], float]:
    """Rows that are kept, so that all others are interpolated within a tolerance.

    The worst row of each interval is added until none is worse than the tolerance; a tolerance that
    takes more than ``most`` rows is doubled.

    Parameters
    ----------
    nodes : array, shape (n,)
        Ascending coordinates.
    values : array, shape (n,)
        Values there, or their logarithms.
    tolerance : float
        Largest difference of an interpolated value.
    interpolation : callable
        How values are interpolated.
    most : int
        Largest number of rows.

    Returns
    -------
    rows : array of int
        Indices of the kept rows, ascending; the first and the last are kept.
    error : float
        Largest difference at the others.

    Examples
    --------
    >>> rows, error = thinned(np.arange(5.0), np.array([0.0, 1.0, 2.0, 1.0, 0.0]), 0.1)
    >>> rows.tolist(), error
    ([0, 2, 4], 0.0)
    """
    while True:
        kept = np.array([0, nodes.size - 1])
        while True:
            fitted = interpolation(nodes[kept], values[kept], nodes)
            errors = np.abs(fitted - values)
            errors[kept] = 0.0
            if errors.max() <= tolerance:
                return kept, float(errors.max())
            if kept.size >= most:
                break
            worst = [
                low + int(errors[low:high].argmax())
                for low, high in itertools.pairwise(kept.tolist())
            ]
            kept = np.union1d(kept, [k for k in worst if errors[k] > tolerance])
        tolerance *= 2.0

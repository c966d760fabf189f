"""Change of a sweep, and the error that remains after it."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Largest ratio of successive changes from which the remaining error is estimated. [1]
_SLOWEST: Final = 0.9


def remaining_error(earlier: float, change: float) -> float:
    """Error after a change of a series whose changes fall by a constant ratio, ρ/(1 - ρ) of it.

    Parameters
    ----------
    earlier, change : float
        Last changes; the error is at least the last. [1]

    Examples
    --------
    >>> [round(remaining_error(*one), 9) for one in ((0.25, 0.2), (0.2, 0.02))]
    [0.8, 0.02]
    """
    ratio = min(change / max(earlier, 1e-30), _SLOWEST)
    return max(change, change * ratio / (1.0 - ratio))


def change_of(before: Float32Array, after: Float32Array) -> FloatArray:
    """Root mean square of the change over that of the values, shape (4,). [1]"""
    axes = (0, 1, 2)
    squares = np.square(after - before).sum(axis=axes, dtype=np.float64)
    size = np.square(after).sum(axis=axes, dtype=np.float64)
    return np.asarray(np.sqrt(squares / np.maximum(size, 1e-30)))

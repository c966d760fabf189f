"""Anderson's acceleration of a fixed-point iteration.

For X ← G(X) the next guess is the combination of the last few G(X_i) whose residuals
G(X_i) - X_i combine to the smallest one. Clear air needs little help (the change falls to a third
each order); in thick air, where it falls by a few per cent, this is what makes the iteration end.
Source: D. G. Anderson (1965), J. ACM 12, 547; type II of Walker & Ni (2011), SIAM J. Numer. Anal.
49, 1715.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def mixing_weights(residuals: FloatArray) -> FloatArray:
    """The combination of residuals that is smallest, with weights that add up to 1.

    Parameters
    ----------
    residuals : array, shape (steps, n)
        The latest last.

    Returns
    -------
    array, shape (steps,)
        The weights; (0, …, 0, 1), plain iteration, where they cannot be told.

    Examples
    --------
    >>> mixing_weights(np.array([[1.0, 0.0], [-1.0, 0.0]])).round(6).tolist()
    [0.5, 0.5]
    """
    steps = residuals.shape[0]
    plain = np.zeros(steps)
    plain[-1] = 1.0
    if steps < 2:
        return plain
    changes = np.diff(residuals, axis=0)
    # Normal equations with a whisper of ridge: the changes become parallel near the end.
    normal = changes @ changes.T
    normal[np.diag_indices_from(normal)] *= 1.0 + 1e-10
    try:
        mix = np.linalg.solve(normal, changes @ residuals[-1])
    except np.linalg.LinAlgError:
        return plain
    if not np.isfinite(mix).all():
        return plain
    weights = plain
    weights[1:] -= mix
    weights[:-1] += mix
    return weights

"""Anderson acceleration of a fixed-point iteration.

For X ← G(X) the next guess is the linear combination of recent iterates G(X_i) whose residuals
G(X_i) - X_i combine to the smallest norm. Without it an optically thin atmosphere converges by a
factor of three per order, an optically thick one by a few per cent. Source: D. G. Anderson (1965),
J. ACM 12, 547; type II of Walker & Ni (2011), SIAM J. Numer. Anal. 49, 1715.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop

FloatArray = NDArray[np.float64]

#: Relative regularisation of the diagonal: the changes become parallel near convergence.
RIDGE: Final = 1.0 + 1e-10
#: Larger weights, or weights that are not finite, indicate singular equations.
_LARGEST: Final = 1e30


@compiled_loop
def combine(products, steps, weights):
    """Anderson weights: minimal norm of the combined residual, sum of weights 1.

    Parameters
    ----------
    products : array, shape ((steps - 1)·steps,)
        One row for each change from one residual to the next: its products with all changes, then
        with the last residual. Overwritten.
    weights : array, shape (steps,)
        Receives the weights, the latest last; (0, …, 0, 1), plain iteration, where they are
        undetermined.
    """
    unknowns = steps - 1
    for i in range(steps):
        weights[i] = 0.0
    weights[unknowns] = 1.0
    for k in range(unknowns):
        products[k * steps + k] *= RIDGE
    for k in range(unknowns):
        best = k
        for i in range(k + 1, unknowns):
            if abs(products[i * steps + k]) > abs(products[best * steps + k]):
                best = i
        for j in range(steps):
            swapped = products[k * steps + j]
            products[k * steps + j] = products[best * steps + j]
            products[best * steps + j] = swapped
        for i in range(k + 1, unknowns):
            factor = products[i * steps + k] / products[k * steps + k]
            for j in range(k, steps):
                products[i * steps + j] -= factor * products[k * steps + j]
    # From the last row up, each solution replaces its row's right-hand side.
    sound = True
    for back in range(unknowns):
        k = unknowns - 1 - back
        total = products[k * steps + unknowns]
        for j in range(k + 1, unknowns):
            total -= products[k * steps + j] * products[j * steps + unknowns]
        solved = total / products[k * steps + k]
        products[k * steps + unknowns] = solved
        if not abs(solved) < _LARGEST:
            sound = False
    if sound:
        for k in range(unknowns):
            weights[k + 1] -= products[k * steps + unknowns]
            weights[k] += products[k * steps + unknowns]


def mixing_weights(residuals: FloatArray) -> FloatArray:
    """Anderson weights: minimal norm of the combined residual, sum of weights 1.

    Parameters
    ----------
    residuals : array, shape (steps, n)
        Residuals, the latest last.

    Returns
    -------
    array, shape (steps,)
        Weights; (0, …, 0, 1), plain iteration, where they are undetermined.

    Examples
    --------
    >>> mixing_weights(np.array([[1.0, 0.0], [-1.0, 0.0]])).round(6).tolist()
    [0.5, 0.5]
    """
    steps = residuals.shape[0]
    weights = np.ones(steps)
    changes = np.diff(residuals, axis=0)
    products = np.hstack([changes @ changes.T, (changes @ residuals[-1])[:, None]])
    combine(products.reshape(-1), steps, weights)
    return weights

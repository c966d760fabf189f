"""Gauss-Legendre rules on the unit interval, with their running integrals."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Rule:
    """Gauss-Legendre rule on [0, 1].

    Attributes
    ----------
    nodes : array, shape (n,)
        Nodes, ascending, inside (0, 1). [1]
    weights : array, shape (n,)
        Weights, of sum 1. [1]
    running : array, shape (n, n)
        Integrals: ``running[k] @ f(nodes)`` is the integral of f from 0 to ``nodes[k]``, exact for
        polynomials of degree n - 1. [1]
    """

    nodes: FloatArray
    weights: FloatArray
    running: FloatArray

    def as_tuple(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Nodes, weights and running integrals, as arguments of compiled loops."""
        return self.nodes, self.weights, self.running


@lru_cache(maxsize=64)
def gauss_legendre(count: int) -> Rule:
    """Gauss-Legendre rule with ``count`` nodes on [0, 1].

    Parameters
    ----------
    count : int
        Number of nodes, 1 to 200.

    Returns
    -------
    Rule
        Nodes, weights and running integrals; the arrays are read-only.

    Examples
    --------
    >>> rule = gauss_legendre(3)
    >>> f"{float(rule.weights @ rule.nodes**5):.12f}"  # 1/6
    '0.166666666667'
    """
    x, w = legendre.leggauss(count)
    degrees = np.arange(count)
    # f = sum c_l P_l with c_l = (2l+1)/2 sum_j w_j P_l(x_j) f_j, and
    # int_{-1}^{x} P_l = (P_{l+1}(x) - P_{l-1}(x)) / (2l+1), for l = 0 it is x + 1.
    basis = legendre.legvander(x, count)
    integrals = np.empty((count, count))
    integrals[:, 0] = x + 1.0
    for degree in range(1, count):
        integrals[:, degree] = (basis[:, degree + 1] - basis[:, degree - 1]) / (2 * degree + 1)
    analysis = (degrees[:, None] + 0.5) * w * basis[:, :count].T
    rule = Rule((x + 1.0) / 2.0, w / 2.0, integrals @ analysis / 2.0)
    for array in (rule.nodes, rule.weights, rule.running):
        array.setflags(write=False)
    return rule

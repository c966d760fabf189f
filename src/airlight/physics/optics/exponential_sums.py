"""Sums of exponentials: the k-distribution of a transmittance averaged over a band.

Beer's law holds for no mean over lines, but a mean is a sum of exponentials, each of which obeys
it: Wiscombe & Evans (1977), Exponential-sum fitting of radiative transmission functions, J. Comput.
Phys. 24, 416; Lacis & Oinas (1991), J. Geophys. Res. 96, 9027.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: Multiples of the amount at which a sum is fitted. [1]
MULTIPLES: Final = np.geomspace(0.1, 60.0, 48)
#: Largest error of a fitted transmittance T, over T + 0.02. [1]
TOLERANCE: Final = 0.003
#: Largest number of terms.
MOST_TERMS: Final = 8
#: Ratios of neighbouring rates that are tried, and their smallest and largest. [1]
_RATIOS: Final = (8.0, 6.0, 4.5, 3.5, 2.7, 2.2, 1.8)
_SHIFTS: Final = (0.0, 0.25, 0.5, 0.75)
_SLOWEST, _FASTEST = 1e-4, 300.0
#: Weight of the sum of the weights, which is 1. [1]
_STRICT: Final = 1e3


class ExponentialSum(NamedTuple):
    """Transmittance T(m) = Σ weights exp(-rates m) of m times an amount.

    Attributes
    ----------
    weights : array, shape (nt,)
        Weights, whose sum is 1. [1]
    rates : array, shape (nt,)
        Optical depths of the amount, ascending. [1]
    """

    weights: FloatArray
    rates: FloatArray

    def at(self, multiples: FloatArray) -> FloatArray:
        """Transmittance of multiples of the amount, shape (...). [1]"""
        return np.asarray(np.exp(-np.multiply.outer(multiples, self.rates)) @ self.weights)


#: Sum of an amount that absorbs nothing.
NOTHING: Final = ExponentialSum(np.ones(1), np.zeros(1))


def exponential_sum(transmittance: FloatArray) -> ExponentialSum:
    """Sum of the fewest exponentials found, at most 8, that meets a transmittance.

    Weights are the non-negative least-squares solution for rates in geometric progression, of the
    largest ratio that suffices for ``TOLERANCE``, or of that with the smallest error; a single rate
    is tried first.

    Parameters
    ----------
    transmittance : array, shape (48,)
        Transmittance of ``MULTIPLES`` of an amount. [1]

    Examples
    --------
    >>> grey = exponential_sum(np.exp(-0.3 * MULTIPLES))
    >>> grey.weights.tolist(), grey.rates.round(9).tolist()
    ([1.0], [0.3])
    >>> strong = np.exp(-np.sqrt(MULTIPLES))  # lines that saturate
    >>> found = exponential_sum(strong)
    >>> found.rates.size <= 9, bool(np.abs(found.at(MULTIPLES) - strong).max() < 0.003)
    (True, True)
    """
    depth = -np.log(np.maximum(transmittance, 1e-300))
    middle = int(np.argmin(np.abs(depth - 1.0))) if depth[-1] > 1.0 else depth.size - 1
    single = ExponentialSum(np.ones(1), np.array([depth[middle] / MULTIPLES[middle]]))
    if _error(single, transmittance) <= TOLERANCE:
        return single
    tries = [single]
    for ratio in _RATIOS:
        found = [_fitted(transmittance, ratio, shift) for shift in _SHIFTS]
        tries += [one for one in found if one.rates.size <= MOST_TERMS]
        near = [one for one in tries if _error(one, transmittance) <= TOLERANCE]
        if near:
            return min(near, key=lambda one: one.rates.size)
    return min(tries, key=lambda one: _error(one, transmittance))


def _fitted(transmittance: FloatArray, ratio: float, shift: float) -> ExponentialSum:
    """Sum with rates in geometric progression, without those of weight 0."""
    from scipy.optimize import nnls

    count = int(np.log(_FASTEST / _SLOWEST) / np.log(ratio)) + 1
    rates = np.concatenate([[0.0], _SLOWEST * ratio ** (np.arange(count) + shift)])
    scale = 1.0 / (transmittance + 0.02)
    rows = np.exp(-np.multiply.outer(MULTIPLES, rates)) * scale[:, None]
    whole = np.concatenate([rows, np.full((1, rates.size), _STRICT)])
    weights, _ = nnls(whole, np.append(transmittance * scale, _STRICT))
    kept = weights > 1e-6
    return ExponentialSum(weights[kept] / weights[kept].sum(), rates[kept])


def _error(one: ExponentialSum, transmittance: FloatArray) -> float:
    """Largest error of a sum at ``MULTIPLES``, as ``TOLERANCE`` counts it. [1]"""
    return float((np.abs(one.at(MULTIPLES) - transmittance) / (transmittance + 0.02)).max())


def divided(total: ExponentialSum, parts: list[ExponentialSum]) -> FloatArray:
    """Rates of a sum divided among gases whose lines overlap at random, shape (parts, nt). [1]

    Each product of the gases' own terms belongs to the nearest rate of the sum, and its terms share
    that rate in proportion (resorting and rebinning; Amundsen et al. 2017, A&A 598, A97).

    Parameters
    ----------
    total : ExponentialSum
        Sum fitted to the product of the gases' transmittances.
    parts : list of ExponentialSum
        Sums of the gases.

    Examples
    --------
    >>> one = ExponentialSum(np.ones(1), np.array([0.1]))
    >>> two = ExponentialSum(np.array([0.5, 0.5]), np.array([0.1, 0.7]))
    >>> both = ExponentialSum(np.array([0.5, 0.5]), np.array([0.2, 0.8]))
    >>> divided(both, [one, two]).round(3).tolist()
    [[0.1, 0.1], [0.1, 0.7]]
    """
    grids = np.meshgrid(*(one.rates for one in parts), indexing="ij")
    rates = np.stack([one.ravel() for one in grids])
    weights = np.ones(rates.shape[1])
    for grid in np.meshgrid(*(one.weights for one in parts), indexing="ij"):
        weights = weights * grid.ravel()
    whole = rates.sum(axis=0)
    apart = np.abs(np.log((whole + 1e-9)[:, None] / (total.rates + 1e-9)))
    nearest = apart.argmin(axis=1)
    mean = rates @ weights
    shared = np.empty((len(parts), total.rates.size))
    for k in range(total.rates.size):
        own = nearest == k
        amounts = rates[:, own] @ weights[own]
        amounts = amounts if amounts.sum() > 0.0 else mean
        shared[:, k] = total.rates[k] * amounts / max(float(amounts.sum()), 1e-300)
    return shared

"""Interpolation between key frames."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
#: ``law(at, values, where)``: keys (k,), values (k, m), query points (n,) to values (n, m).
Law: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]


def linear(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
    """Linear interpolation, constant outside.

    Examples
    --------
    >>> linear(np.array([0.0, 1.0]), np.array([[2.0], [4.0]]), np.array([0.25])).item()
    2.5
    """
    return np.stack([np.interp(where, at, column) for column in values.T], axis=-1)


def smooth(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
    r"""Monotone piecewise cubic interpolation with zero slope at both ends.

    The slope at an inner key is the weighted harmonic mean of the adjacent secants :math:`d`, or 0
    where their signs differ,

    .. math:: \frac{w_1 + w_2}{w_1 / d_{k-1} + w_2 / d_k}, \quad
              w_1 = 2 h_k + h_{k-1}, \quad w_2 = h_k + 2 h_{k-1},

    so that the interpolant does not overshoot.

    References
    ----------
    Fritsch & Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300. doi:10.1137/0905021

    Examples
    --------
    >>> keys, values = np.array([0.0, 1.0]), np.array([[0.0], [1.0]])
    >>> smooth(keys, values, np.array([0.0, 0.25, 0.5])).ravel()  # 3 t² - 2 t³
    array([0.     , 0.15625, 0.5    ])
    """
    from scipy.interpolate import CubicHermiteSpline

    within = np.clip(where, at[0], at[-1])
    return np.asarray(CubicHermiteSpline(at, values, _slopes(at, values, ends=0.0))(within))


def _slopes(at: FloatArray, values: FloatArray, ends: float) -> FloatArray:
    """Slopes at the keys, shape (k, m)."""
    h = np.diff(at)[:, None]
    d = np.diff(values, axis=0) / h
    slopes = np.full(values.shape, ends)
    first, second = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    same = d[:-1] * d[1:] > 0.0
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        mean = (first + second) / (first / d[:-1] + second / d[1:])
    slopes[1:-1] = np.where(same, mean, 0.0)
    return slopes


def _of_logarithms(law: Law) -> Law:
    def run(at: FloatArray, values: FloatArray, where: FloatArray) -> FloatArray:
        return np.exp(law(at, np.log(values), where))

    run.__doc__ = f"Equal factors in equal times: ``{law.__name__}`` of the logarithm."
    return run


#: Laws by name.
LAWS: Final[dict[str, Law]] = {
    "linear": linear,
    "smooth": smooth,
    "exponential": _of_logarithms(linear),
    "smooth-exponential": _of_logarithms(smooth),
}
#: Laws that take only values above 0.
LOGARITHMIC: Final = ("exponential", "smooth-exponential")

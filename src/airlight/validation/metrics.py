"""Error metrics of two sets of numbers."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class ErrorSummary:
    """Summary of errors.

    Attributes
    ----------
    count : int
        Number of values compared.
    median, high, largest : float
        Median, 95 % quantile and largest of the absolute errors; NaN without values.
    """

    count: int
    median: float
    high: float
    largest: float


def relative_errors(got: ArrayLike, expected: ArrayLike) -> FloatArray:
    """Signed relative errors; 0 where both values are 0, inf where only the expected one is. [1]

    Examples
    --------
    >>> relative_errors([1.1, 0.0, 2.0], [1.0, 0.0, 0.0]).round(12).tolist()
    [0.1, 0.0, inf]
    """
    a, b = np.broadcast_arrays(np.asarray(got, float), np.asarray(expected, float))
    difference = a - b
    out = np.where(difference == 0.0, 0.0, np.copysign(np.inf, difference))
    out[np.isnan(difference)] = np.nan
    np.divide(difference, np.abs(b), out=out, where=b != 0.0)
    return out


def summarise(errors: ArrayLike, counted: ArrayLike | None = None) -> ErrorSummary:
    """Count, median, 95 % quantile and largest of the absolute errors.

    Parameters
    ----------
    errors : array, shape (...)
        Errors, signed or not.
    counted : array of bool, shape (...), optional
        Mask of the values; default: all.

    Examples
    --------
    >>> summarise([-0.1, 0.2, 0.3, 9.0], [True, True, True, False])
    ErrorSummary(count=3, median=0.2, high=0.29, largest=0.3)
    """
    sizes = np.abs(np.asarray(errors, float))
    sizes = sizes.ravel() if counted is None else sizes[np.asarray(counted, bool)]
    if sizes.size == 0:
        return ErrorSummary(0, float("nan"), float("nan"), float("nan"))
    high = float(np.quantile(sizes, 0.95))
    return ErrorSummary(sizes.size, float(np.median(sizes)), high, float(sizes.max()))


def beyond_noise(
    got: ArrayLike, expected: ArrayLike, standard_error: ArrayLike, errors: float = 3.0
) -> FloatArray:
    """Relative errors, 0 where within some standard errors of the reference. [1]

    Parameters
    ----------
    got, expected, standard_error : array, shapes that broadcast to (...)
        Values in the same unit.
    errors : float
        Number of standard errors.

    Examples
    --------
    >>> beyond_noise([1.02, 1.04], 1.0, 0.01).round(12).tolist()
    [0.0, 0.04]
    """
    relative = relative_errors(got, expected)
    difference = np.abs(np.asarray(got, float) - np.asarray(expected, float))
    return np.where(difference <= errors * np.asarray(standard_error, float), 0.0, relative)


def in_standard_errors(
    got: ArrayLike, expected: ArrayLike, standard_error: ArrayLike
) -> FloatArray:
    """Signed differences over the standard error; 0 where both are 0. [1]"""
    difference = np.asarray(got, float) - np.asarray(expected, float)
    noise = np.broadcast_to(np.asarray(standard_error, float), difference.shape)
    out = np.where(difference == 0.0, 0.0, np.copysign(np.inf, difference))
    np.divide(difference, noise, out=out, where=noise > 0.0)
    return out


def largest_by_chance(count: int) -> float:
    """Median of the largest of ``count`` Gaussian random numbers.

    Parameters
    ----------
    count : int
        Number of values, at least 1.

    Returns
    -------
    float
        Median in standard errors.

    Examples
    --------
    >>> [round(largest_by_chance(n), 2) for n in (1, 100, 30000)]
    [0.67, 2.7, 4.23]
    """
    inside = 0.5 ** (1.0 / count)
    return NormalDist().inv_cdf(0.5 + 0.5 * inside)


def log_ratio_rms(got: ArrayLike, expected: ArrayLike, weights: ArrayLike | None = None) -> float:
    r"""Root mean square of the logarithm of a ratio.

    .. math:: \sqrt{\frac{\sum_i w_i \ln^2(a_i / b_i)}{\sum_i w_i}}

    Parameters
    ----------
    got, expected : array, shapes that broadcast to (...)
        Values above 0.
    weights : array, shape (...), optional
        Weights such as solid angles; default: equal.

    Returns
    -------
    float
        Root mean square; 0.1 is about 10 %. [1]

    Examples
    --------
    >>> f"{log_ratio_rms([2.0, 0.5], 1.0):.4f}"  # ln 2, whichever way
    '0.6931'
    """
    squares = np.square(np.log(np.asarray(got, float) / np.asarray(expected, float)))
    if weights is None:
        return float(np.sqrt(squares.mean()))
    w = np.broadcast_to(np.asarray(weights, float), squares.shape)
    return float(np.sqrt((w * squares).sum() / w.sum()))

"""Phase function tabulated over angles, interpolated linearly in its logarithm."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.kernel import compiled_loop

FloatArray = npt.NDArray[np.float64]

#: Smallest value interpolated in the logarithm; smaller values are interpolated linearly. [sr⁻¹]
SMALLEST_LOGARITHMIC: Final = 1e-30
#: Largest width of the pieces in integrals over a table. [deg]
_WIDEST_PIECE: Final = 1.0
#: Gauss-Legendre points per piece: Legendre polynomials up to degree 300 are smooth on it.
_POINTS: Final = 6


def interpolated(angles: FloatArray, rows: FloatArray, at: npt.ArrayLike) -> FloatArray:
    """Interpolated phase functions.

    Parameters
    ----------
    angles : array, shape (na,)
        Angles of the table, ascending from 0 to 180. [deg]
    rows : array, shape (nr, na)
        Tabulated values. [sr⁻¹]
    at : array, shape (...)
        Angles of interpolation. [deg]

    Returns
    -------
    array, shape (..., nr)
        Values. [sr⁻¹]

    Examples
    --------
    >>> interpolated(np.array([0.0, 180.0]), np.array([[1.0, 0.01]]), 90.0).round(12).tolist()
    [0.1]
    """
    angle = np.asarray(at, dtype=np.float64)
    columns = np.ascontiguousarray(rows.T)
    positive = columns > SMALLEST_LOGARITHMIC
    logarithms = np.log(np.where(positive, columns, 1.0))
    values = np.empty((angle.size, len(rows)))
    _interpolate(angles, columns, logarithms, positive, angle.ravel(), values)
    return values.reshape(*angle.shape, len(rows))


@compiled_loop
def _interpolate(
    angles: FloatArray,
    columns: FloatArray,
    logarithms: FloatArray,
    positive: npt.NDArray[np.bool_],
    at: FloatArray,
    out: FloatArray,
) -> None:
    for i in range(at.shape[0]):
        low = 0
        high = angles.shape[0] - 1
        while high - low > 1:
            middle = (low + high) // 2
            if angles[middle] <= at[i]:
                low = middle
            else:
                high = middle
        fraction = (at[i] - angles[low]) / (angles[high] - angles[low])
        for j in range(columns.shape[1]):
            if positive[low, j] and positive[high, j]:
                step = logarithms[high, j] - logarithms[low, j]
                out[i, j] = math.exp(logarithms[low, j] + fraction * step)
            else:
                step = columns[high, j] - columns[low, j]
                out[i, j] = columns[low, j] + fraction * step


def moments(angles: FloatArray, rows: FloatArray, degree: int) -> FloatArray:
    """Legendre moments of the tabulated functions, integrated interval by interval.

    Parameters
    ----------
    angles, rows
        Table, as for ``interpolated``. [deg], [sr⁻¹]
    degree : int
        Largest l, at most 300.

    Returns
    -------
    array, shape (nr, degree + 1)
        Moments g_l as defined in ``optics.legendre``; g_0 is the integral over the sphere. [1]

    Examples
    --------
    >>> moments(np.array([0.0, 180.0]), np.full((1, 2), 0.25 / np.pi), 1).round(12).tolist()
    [[1.0, 0.0]]
    """
    pieces = np.maximum(1, np.ceil(np.diff(angles) / _WIDEST_PIECE)).astype(int)
    edges = np.concatenate(
        [np.linspace(a, b, n + 1)[:-1] for a, b, n in zip(angles, angles[1:], pieces, strict=False)]
        + [angles[-1:]]
    )
    x, w = np.polynomial.legendre.leggauss(_POINTS)
    half = 0.5 * np.diff(edges)
    theta = ((edges[:-1] + half)[:, None] + half[:, None] * x).ravel()
    radians = np.radians(theta)
    weights = np.radians(half[:, None] * w).ravel() * 2.0 * np.pi * np.sin(radians)
    weighted = (weights[:, None] * interpolated(angles, rows, theta)).T
    mu = np.cos(radians)
    result = np.empty((len(rows), degree + 1))
    before, current = np.ones_like(mu), mu
    for l in range(degree + 1):
        result[:, l] = weighted @ before
        before, current = current, ((2 * l + 3) * mu * current - (l + 1) * before) / (l + 2)
    return result

"""A phase function known at angles: its logarithm is linear in the angle between them."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

#: Values below this are joined by straight lines, as zeros are. [sr⁻¹]
SMALLEST_LOGARITHMIC: Final = 1e-30
#: Pieces that the integrals over a table are taken in are no wider than this. [deg]
_WIDEST_PIECE: Final = 1.0
#: Gauss-Legendre points of a piece: Legendre polynomials up to degree 300 are smooth on it.
_POINTS: Final = 6


def interpolated(angles: FloatArray, rows: FloatArray, at: npt.ArrayLike) -> FloatArray:
    """The tabulated functions at any angles.

    Parameters
    ----------
    angles : array, shape (na,)
        Ascending from 0 to 180. [deg]
    rows : array, shape (nr, na)
        Values. [sr⁻¹]
    at : array, shape (...)
        Angles. [deg]

    Returns
    -------
    array, shape (..., nr)
        [sr⁻¹]

    Examples
    --------
    >>> interpolated(np.array([0.0, 180.0]), np.array([[1.0, 0.01]]), 90.0).round(12).tolist()
    [0.1]
    """
    angle = np.asarray(at, dtype=np.float64)
    lower = np.clip(np.searchsorted(angles, angle, side="right") - 1, 0, len(angles) - 2)
    share = ((angle - angles[lower]) / np.diff(angles)[lower])[..., None]
    columns = np.ascontiguousarray(rows.T)
    positive = (rows > SMALLEST_LOGARITHMIC).T
    logarithms = np.log(np.where(positive, columns, 1.0))
    below, above = logarithms[lower], logarithms[lower + 1]
    values = np.exp(below + share * (above - below))
    straight = ~(positive[:-1] & positive[1:])
    if straight.any():
        low, high = columns[lower], columns[lower + 1]
        values = np.where(straight[lower], low + share * (high - low), values)
    return np.asarray(values)


def moments(angles: FloatArray, rows: FloatArray, degree: int) -> FloatArray:
    """Legendre moments of the tabulated functions, integrated interval by interval.

    Parameters
    ----------
    angles, rows
        As for ``interpolated``. [deg], [sr⁻¹]
    degree : int
        The last l, at most 300.

    Returns
    -------
    array, shape (nr, degree + 1)
        g_l as ``optics.legendre`` defines them; g_0 is the integral over the sphere. [1]

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

"""Cubic interpolation: Hermite, monotone (PCHIP), not-a-knot spline, Catmull-Rom.

Results equal SciPy's ``PchipInterpolator`` and ``CubicSpline``, whose import takes as long as
rendering a picture.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.kernel import compiled_loop, kernel

FloatArray = NDArray[np.float64]


def cubic_curve(x: FloatArray, y: FloatArray, slopes: FloatArray, at: ArrayLike) -> FloatArray:
    """Cubic Hermite interpolation.

    Parameters
    ----------
    x : array, shape (n,)
        Points, strictly ascending, at least two.
    y, slopes : array, shape (n, k...)
        Values and derivatives at ``x``.
    at : array, shape (m...)
        Points of evaluation; outside, the outermost cubic is extrapolated.

    Returns
    -------
    array, shape (m..., k...)

    Examples
    --------
    >>> x = np.array([0.0, 1.0, 3.0])
    >>> cubic_curve(x, x**3, 3.0 * x**2, [0.5, 2.0])
    array([0.125, 8.   ])
    """
    at = np.asarray(at, dtype=np.float64)
    k = np.clip(np.searchsorted(x, at, side="right") - 1, 0, x.size - 2)
    trailing = (..., *(None,) * (y.ndim - 1))
    step = (x[k + 1] - x[k])[trailing]
    t = (at - x[k])[trailing] / step
    rise = y[k + 1] - y[k]
    # As an excess over the chord, so that a straight line is exact to the last digit.
    bend = (slopes[k] * step - rise) * (1.0 - t) - (slopes[k + 1] * step - rise) * t
    return np.asarray(y[k] + t * (rise + (1.0 - t) * bend))


def monotone_slopes(x: FloatArray, y: FloatArray) -> FloatArray:
    """Slopes of monotone cubic interpolation (PCHIP).

    At inner points 0 at an extremum, otherwise the weighted harmonic mean of the slopes of both
    chords; at the ends from three points, limited to preserve the shape.

    Parameters
    ----------
    x : array, shape (n,)
        Points, strictly ascending, at least two.
    y : array, shape (n,)

    Returns
    -------
    array, shape (n,)

    References
    ----------
    Fritsch & Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300, eq. 5, with Brodlie's weights,
    doi:10.1137/0905021; the ends: Moler (2004), Numerical Computing with MATLAB, ch. 3.6.

    Examples
    --------
    >>> monotone_slopes(np.arange(4.0), np.array([0.0, 1.0, 1.0, 2.0]))
    array([1.5, 0. , 0. , 1.5])
    """
    step = np.diff(x)
    chord = np.diff(y) / step
    if x.size == 2:
        return np.repeat(chord, 2)
    slopes = np.zeros(x.size)
    before, after = chord[:-1], chord[1:]
    same = before * after > 0.0
    first = (2.0 * step[1:] + step[:-1])[same]
    second = (step[1:] + 2.0 * step[:-1])[same]
    slopes[1:-1][same] = (first + second) / (first / before[same] + second / after[same])
    slopes[0] = _end_slope(step[0], step[1], chord[0], chord[1])
    slopes[-1] = _end_slope(step[-1], step[-2], chord[-1], chord[-2])
    return slopes


def _end_slope(step: float, next_step: float, chord: float, next_chord: float) -> float:
    """Slope at an end from three points, with the sign of the outermost chord or 0."""
    slope = ((2.0 * step + next_step) * chord - step * next_chord) / (step + next_step)
    if np.sign(slope) != np.sign(chord):
        return 0.0
    if np.sign(chord) != np.sign(next_chord) and abs(slope) > 3.0 * abs(chord):
        return 3.0 * chord
    return slope


def spline_slopes(x: FloatArray, y: FloatArray, first: float | None = None) -> FloatArray:
    """Slopes of the not-a-knot cubic spline.

    The two outermost intervals at either end share one cubic; three points give the parabola, two
    the straight line.

    Parameters
    ----------
    x : array, shape (n,)
        Points, strictly ascending, at least two.
    y : array, shape (n, ...)
    first : float, optional
        Slope at the first point, instead of the condition there; at least four points.

    Returns
    -------
    array, shape (n, ...)

    References
    ----------
    de Boor (1978), A Practical Guide to Splines, ch. IV, eqs. 8 and 12.

    Examples
    --------
    >>> x = np.array([1.0, 2.0, 4.0, 5.0])
    >>> spline_slopes(x, x**3).round(12)  # a cubic is its own spline: 3x²
    array([ 3., 12., 48., 75.])
    """
    step = np.diff(x)
    trailing = (..., *(None,) * (y.ndim - 1))
    chord = np.diff(y, axis=0) / step[trailing]
    if x.size == 2:
        return np.repeat(chord, 2, axis=0)
    if x.size == 3:
        middle = (step[1] * chord[0] + step[0] * chord[1]) / (step[0] + step[1])
        return np.stack([2.0 * chord[0] - middle, middle, 2.0 * chord[1] - middle])
    below, middle, above = np.zeros(x.size), np.empty(x.size), np.zeros(x.size)
    rhs = np.empty_like(chord, shape=y.shape)
    below[1:-1], middle[1:-1], above[1:-1] = step[1:], 2.0 * (step[:-1] + step[1:]), step[:-1]
    low, high = step[:-1][trailing], step[1:][trailing]
    rhs[1:-1] = 3.0 * (high * chord[:-1] + low * chord[1:])
    (middle[0], above[0]), rhs[0] = _no_knot(step[0], step[1], chord[0], chord[1])
    (middle[-1], below[-1]), rhs[-1] = _no_knot(step[-1], step[-2], chord[-1], chord[-2])
    if first is not None:
        middle[0], above[0], rhs[0] = 1.0, 0.0, first
    slopes = np.array(rhs, np.float64, order="C").reshape(x.size, -1)
    _solve_tridiagonal(below, middle, above, slopes)
    return slopes.reshape(y.shape)


@compiled_loop
def _solve_tridiagonal(below, middle, above, rhs):
    """Solution of a tridiagonal system by elimination, in place; pivots are positive."""
    for k in range(1, middle.size):
        factor = below[k] / middle[k - 1]
        middle[k] -= factor * above[k - 1]
        for c in range(rhs.shape[1]):
            rhs[k, c] -= factor * rhs[k - 1, c]
    for k in range(middle.size - 1, -1, -1):
        for c in range(rhs.shape[1]):
            if k + 1 < middle.size:
                rhs[k, c] -= above[k] * rhs[k + 1, c]
            rhs[k, c] /= middle[k]


def _no_knot(
    step: float, next_step: float, chord: FloatArray, next_chord: FloatArray
) -> tuple[tuple[float, float], FloatArray]:
    """Not-a-knot condition at an end: one cubic over the two outermost intervals."""
    both = step + next_step
    right = ((step + 2.0 * both) * next_step * chord + step**2 * next_chord) / both
    return (next_step, both), np.asarray(right)


@kernel
def catmull_rom(node, t):
    """Catmull-Rom weight of one of four evenly spaced points. [1]

    Parameters
    ----------
    node : int
        Index of the point, 0 to 3.
    t : float
        Fraction of the distance from point 1 to point 2. [1]

    References
    ----------
    Catmull & Rom (1974).

    Examples
    --------
    >>> [catmull_rom(node, 0.5) for node in range(4)]
    [-0.0625, 0.5625, 0.5625, -0.0625]
    """
    if node == 0:
        return 0.5 * t * (-1.0 + t * (2.0 - t))
    if node == 1:
        return 1.0 + 0.5 * t * t * (3.0 * t - 5.0)
    if node == 2:
        return 0.5 * t * (1.0 + t * (4.0 - 3.0 * t))
    return 0.5 * t * t * (t - 1.0)

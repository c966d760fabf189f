"""Cubic curves through points are SciPy's, and keep what they promise."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.physics.cubic_curves import cubic_curve, monotone_slopes, spline_slopes

#: Rises, a turn, a level stretch, and a fall; unequal steps.
X = np.array([0.0, 1.0, 1.5, 4.0, 5.0, 9.0, 9.5])
Y = np.array([1.0, 2.0, 2.5, 2.5, 0.0, -3.0, 7.0])
AT = np.linspace(0.0, 9.5, 400)


@pytest.mark.parametrize("count", [2, 3, 4, 7])
def test_monotone_curve_is_scipys(count: int) -> None:
    # A second method; what is left is rounding.
    from scipy.interpolate import PchipInterpolator

    x, y = X[:count], Y[:count]
    theirs = PchipInterpolator(x, y)
    slopes, at = monotone_slopes(x, y), np.linspace(x[0], x[-1], 300)
    assert_allclose(slopes, theirs.derivative()(x), rtol=0, atol=1e-13)
    assert_allclose(cubic_curve(x, y, slopes, at), theirs(at), atol=1e-13)


def test_ends_of_the_monotone_curve_are_scipys_whatever_the_shape() -> None:
    # A second method, whose shapes reach both cuts of the end's slope (34 and 74 of 400 ends).
    from scipy.interpolate import PchipInterpolator

    rng = np.random.default_rng(7)
    for _ in range(200):
        x, y = np.cumsum(rng.uniform(0.1, 3.0, 5)), rng.normal(size=5)
        expected = PchipInterpolator(x, y).derivative()(x)
        assert_allclose(monotone_slopes(x, y), expected, rtol=1e-11, atol=1e-12)


def test_monotone_curve_stays_between_its_points() -> None:
    # The promise of the method, between every two neighbours.
    curve = cubic_curve(X, Y, monotone_slopes(X, Y), AT)
    k = np.clip(np.searchsorted(X, AT, side="right") - 1, 0, X.size - 2)
    assert np.all(curve >= np.minimum(Y[k], Y[k + 1]) - 1e-14)
    assert np.all(curve <= np.maximum(Y[k], Y[k + 1]) + 1e-14)


@pytest.mark.parametrize("count", [2, 3, 4, 5, 7])
def test_spline_is_scipys(count: int) -> None:
    # A second method; two columns at once, and the cubics of the ends continued.
    from scipy.interpolate import CubicSpline

    x, y = X[:count], np.stack([Y, np.cos(X)], axis=1)[:count]
    at = np.linspace(x[0] - 0.1, x[-1] + 0.1, 300)
    assert_allclose(
        cubic_curve(x, y, spline_slopes(x, y), at), CubicSpline(x, y)(at), rtol=1e-12, atol=1e-12
    )


def test_curves_meet_their_points_and_straight_lines_exactly() -> None:
    # By definition; on a straight line nothing is left to round away but the line itself.
    for slopes in (monotone_slopes(X, Y), spline_slopes(X, Y)):
        assert_array_equal(cubic_curve(X, Y, slopes, X[:-1]), Y[:-1])
        assert_allclose(cubic_curve(X, Y, slopes, X), Y, rtol=0, atol=1e-14)
    line = 2.0 * X
    assert_array_equal(cubic_curve(X, line, monotone_slopes(X, line), AT), 2.0 * AT)

"""The notes' trapezoids: weights, convergence, and the error of thirty steps."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.special import lpmv

from airlight.solver.direct.trapezoid import graded, sphere, uniform, weights_1d, weights_2d


def test_rectangle_rule_equals_two_nested_rules() -> None:
    # A sum over products is a product of sums: the notes' warning about nesting does not hold.
    rng = np.random.default_rng(1)
    values = rng.random((8, 13))
    nested = weights_1d(7) @ (values @ weights_1d(12))
    assert_allclose((weights_2d(7, 12) * values).sum(), nested, rtol=1e-14)
    assert_array_equal(4 * weights_2d(3, 3)[0], [1, 2, 2, 1])


@pytest.mark.parametrize(("steps", "excess"), [(30, 0.57), (50, 0.22), (100, 0.057), (500, 0.002)])
def test_equal_steps_overestimate_the_haze(steps: int, excess: float) -> None:
    # The known excess of equal steps over 100 km for a scale height of 1.2 km, to half a digit.
    rule = uniform(steps)
    depth = rule.weights @ np.exp(-rule.nodes * 100.0 / 1.2) * 100.0 / 1.2
    assert_allclose(depth - 1.0, excess, atol=0.5e-3 if excess < 0.1 else 0.5e-2)


def test_graded_steps_gain_sixteen_times_more_by_halving() -> None:
    # The substitution's slope vanishes at both ends with the second power: order 4 at least.
    exact = (1.0 - np.exp(-8.0)) / 8.0
    errors = [abs(graded(n).weights @ np.exp(-8.0 * graded(n).nodes) - exact) for n in (12, 24)]
    assert errors[1] < errors[0] / 16.0
    assert errors[1] < 2e-6


@pytest.mark.parametrize("rule", [uniform(200), graded(40)])
def test_running_integrals_reach_every_node(rule) -> None:
    # The integral of exp(-3x) is known up to every node.
    got = rule.running @ np.exp(-3.0 * rule.nodes)
    assert_allclose(got, (1.0 - np.exp(-3.0 * rule.nodes)) / 3.0, atol=1e-5)


@pytest.mark.parametrize("cut", [0.5, 1.2, 1.7])
def test_sphere_is_orthogonal_to_harmonics(cut: float) -> None:
    # Harmonics of degree 1 and more integrate to 0, the constant to 4π, wherever the cut lies.
    zenith, azimuth, weights = sphere(20, 24, (0.0, cut, np.pi), grade=True)
    assert_allclose(weights.sum(), 4.0 * np.pi, rtol=1e-7)
    for degree in range(1, 7):
        for order in range(degree + 1):
            harmonic = lpmv(order, degree, np.cos(zenith))[:, None] * np.cos(order * azimuth)
            scale = np.sqrt((weights * harmonic**2).sum() * 4.0 * np.pi)
            assert abs((weights * harmonic).sum()) < 1e-4 * scale


def test_equal_steps_on_the_sphere_err_by_the_sine_at_the_poles() -> None:
    # Trapezoid of sin over (0, π) with n steps is 2 (π/2n) cot(π/2n): 0.57 % short for 12.
    _, _, weights = sphere(12, 24, (0.0, np.pi), grade=False)
    assert_allclose(
        weights.sum() / (4.0 * np.pi), (np.pi / 24.0) / np.tan(np.pi / 24.0), rtol=1e-12
    )

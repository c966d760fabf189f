"""Noise on a lattice: of mean 0, smooth, periodic, without a direction."""

from __future__ import annotations

import math

import numpy as np
from numpy.testing import assert_allclose, assert_array_less

from airlight.geometry.gradient_noise import (
    PERIOD,
    PLANE_DEVIATION,
    SLOPE_DEVIATION,
    corner_slope,
    gradient_noise,
    plane_noise,
    sloping_gradient_noise,
    sloping_noise,
    smooth_noise,
)
from airlight.geometry.vectors import Vec3


def value_at(i: int, j: int, k: int) -> float:
    """Value of a lattice point by its definition, in whole numbers."""
    return shuffle(shuffle(shuffle(i) + j) + k) / 144.0 - 1.0


def shuffle(n: int) -> int:
    return (34 * n + 1) * n % 289


def test_the_mean_is_zero() -> None:
    # The permutation takes every value equally often: over all lattice points of a plane the mean
    # vanishes to 1e-3; the noise between them is a weighted mean.
    values = [value_at(i, j, 7) for i in range(PERIOD) for j in range(PERIOD)]
    assert abs(np.mean(values)) < 5e-3
    assert max(values) <= 1.0
    assert min(values) >= -1.0
    assert_allclose(np.std(values), 1.0 / math.sqrt(3.0), rtol=0.02)  # a uniform distribution


def test_noise_is_that_of_the_lattice_at_its_points_and_smooth_between() -> None:
    # The definition; the slope of the weights is at most 15/8, of values that differ by 2 at most.
    assert_allclose(smooth_noise(3.0, 250.0, 255.0), value_at(3, 250, 255), atol=1e-12)
    random = np.random.default_rng(1)
    for x, y, z in random.uniform(0.0, PERIOD, (200, 3)):
        step = smooth_noise(x + 1e-4, y, z) - smooth_noise(x, y, z)
        assert abs(step) <= 1.0001e-4 * 2.0 * 15.0 / 8.0


def test_noise_repeats_after_its_period() -> None:
    for x, y, z in np.random.default_rng(2).uniform(0.0, PERIOD, (50, 3)):
        for noise in (smooth_noise, gradient_noise):
            wanted = noise(x, y, z)
            assert_allclose(noise(x - PERIOD, y + PERIOD, z), wanted, atol=1e-9)


def test_slopes_of_noise_are_its_differences() -> None:
    # A second method: central differences, of second order.
    random = np.random.default_rng(3)
    for x, y, z in random.uniform(0.0, PERIOD, (50, 3)):
        way = random.normal(size=3)
        value, slope = sloping_noise(x, y, z, Vec3(*way))
        assert_allclose(value, smooth_noise(x, y, z), atol=1e-12)
        ends = [smooth_noise(*(np.array([x, y, z]) + s * way)) for s in (-1e-5, 1e-5)]
        assert_allclose(slope, (ends[1] - ends[0]) / 2e-5, atol=1e-6)
        _value, slope_x, slope_y = plane_noise(x, y)
        ends = [plane_noise(x + s, y)[0] for s in (-1e-5, 1e-5)]
        assert_allclose(slope_x, (ends[1] - ends[0]) / 2e-5, atol=1e-6)
        ends = [plane_noise(x, y + s)[0] for s in (-1e-5, 1e-5)]
        assert_allclose(slope_y, (ends[1] - ends[0]) / 2e-5, atol=1e-6)


def test_noise_of_a_plane_has_its_deviations() -> None:
    found = [plane_noise(x, y) for x, y in np.random.default_rng(4).uniform(0, PERIOD, (20000, 2))]
    assert_allclose(
        np.std(found, axis=0), (PLANE_DEVIATION, SLOPE_DEVIATION, SLOPE_DEVIATION), rtol=0.03
    )


def test_gradient_noise_vanishes_at_points_and_is_a_slope_beside_them() -> None:
    # The definition: beside a point nothing but its own slope, which is odd.
    random = np.random.default_rng(7)
    for x, y, z in random.integers(0, PERIOD, (50, 3)).astype(float):
        assert gradient_noise(x, y, z) == 0.0
        step = random.uniform(-1e-4, 1e-4, 3)
        ahead, back = (gradient_noise(x + s * step[0], y + s * step[1], z + s * step[2])
                       for s in (1.0, -1.0))  # fmt: skip
        assert_allclose(ahead, -back, atol=1e-9)


def test_slopes_of_gradient_noise_have_no_direction() -> None:
    # Isotropy: along each axis and diagonal the squared change over a tenth of a cell is the same,
    # to 3 standard errors and what 49 directions leave; of neighbouring points it is independent.
    random = np.random.default_rng(8)
    places = random.uniform(0.0, PERIOD, (4000, 3))
    ways = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]], float)
    ways *= 0.1 / np.linalg.norm(ways, axis=1, keepdims=True)
    here = np.array([gradient_noise(*one) for one in places])
    steps = [np.array([gradient_noise(*one) for one in places + way]) - here for way in ways]
    changes = [np.mean(step**2) for step in steps]
    assert_allclose(changes / np.mean(changes), 1.0, atol=0.15)
    # and they balance: the mean over directions vanishes, to a sixth of one's size
    corners = [corner_slope(float(c), 0.0, *way) for c in range(289) for way in np.eye(3)]
    means = np.reshape(corners, (289, 3)).mean(axis=0)
    assert_array_less(np.abs(means), 0.04)


def test_sloping_gradient_noise_is_gradient_noise_and_its_derivative() -> None:
    # The central difference over 2e-5 cells errs by 1e-9 of the third derivative, below 1e3.
    random = np.random.default_rng(11)
    for place in random.uniform(0.0, PERIOD, (200, 3)):
        way, step = random.normal(size=3), 1e-5
        value, slope = sloping_gradient_noise(*place, Vec3(*way))
        assert_allclose(value, gradient_noise(*place), atol=1e-12)
        ahead, back = (gradient_noise(*(place + sign * step * way)) for sign in (1.0, -1.0))
        assert_allclose(slope, (ahead - back) / (2.0 * step), atol=1e-6)

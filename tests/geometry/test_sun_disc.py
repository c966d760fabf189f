"""The visible part of a disc, against integrals over the disc."""

from __future__ import annotations

from math import pi, sin, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from airlight.geometry.sun_disc import mean_cosine, visible_fraction, visible_spread
from airlight.kernel import vectorized

RADIUS = 0.004675
ELEVATIONS = RADIUS * np.array([-0.999, -0.7, -0.3, 0.0, 0.2, 0.5, 0.9, 0.999])


@pytest.mark.parametrize("elevation", ELEVATIONS)
def test_visible_fraction_is_the_area_of_the_part_above_the_horizon(elevation: float) -> None:
    # Second method: strips of a unit disc, 2 sqrt(1-u²) wide, from -x to 1.
    area, _ = quad(lambda u: 2.0 * sqrt(1.0 - u * u), -elevation / RADIUS, 1.0, epsabs=1e-12)
    assert_allclose(visible_fraction(elevation, RADIUS), area / pi, rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("elevation", ELEVATIONS)
def test_mean_cosine_is_the_mean_over_the_disc(elevation: float) -> None:
    # Second method: strips again, each with the sine of its own elevation, 0 below the horizon.
    # What the closed form leaves out is the difference of sine and angle, 1e-5 of the disc.
    light, _ = quad(
        lambda u: 2.0 * sqrt(1.0 - u * u) * sin(elevation + RADIUS * u),
        max(-elevation / RADIUS, -1.0), 1.0, epsabs=1e-13,
    )  # fmt: skip
    got = mean_cosine(elevation, sin(elevation), RADIUS)
    assert_allclose(got, light / pi, rtol=0, atol=2e-5 * RADIUS)


@pytest.mark.parametrize("elevation", [*ELEVATIONS, 2.0 * RADIUS])
def test_visible_spread_is_mean_and_deviation_over_the_visible_part(elevation: float) -> None:
    # Second method: moments of the strips above the horizon.
    lowest = max(-elevation / RADIUS, -1.0)
    area, first, second = (
        quad(lambda u, n=n: u**n * 2.0 * sqrt(1.0 - u * u), lowest, 1.0, epsabs=1e-12)[0]
        for n in range(3)
    )
    mean, square = first / area, second / area
    got = visible_spread(elevation, RADIUS)
    assert_allclose(got[0], elevation + RADIUS * mean, rtol=1e-7, atol=1e-7 * RADIUS)
    assert_allclose(got[1], RADIUS * sqrt(square - mean * mean), rtol=1e-4)


def test_both_end_smoothly_at_the_edges_of_the_disc() -> None:
    # All or nothing outside, and no step at the edge (the segment's area grows from 0 as x^1.5).
    near = RADIUS * (1.0 - 1e-9)
    assert_allclose(visible_fraction(near, RADIUS), 1.0, atol=1e-9)
    assert_allclose(visible_fraction(-near, RADIUS), 0.0, atol=1e-9)
    assert visible_fraction(RADIUS, RADIUS) == 1.0
    assert visible_fraction(-RADIUS, RADIUS) == 0.0
    assert_allclose(mean_cosine(near, sin(near), RADIUS), sin(near), rtol=1e-8)
    assert_allclose(mean_cosine(-near, sin(-near), RADIUS), 0.0, atol=1e-12)
    assert mean_cosine(-0.5, sin(-0.5), RADIUS) == 0.0


def test_a_point_star_is_there_or_not() -> None:
    assert [visible_fraction(e, 0.0) for e in (-1e-12, 1e-12)] == [0.0, 1.0]
    assert [mean_cosine(e, e, 0.0) for e in (-0.5, 0.5)] == [0.0, 0.5]


def test_a_smooth_step_is_wrong_by_four_parts_in_a_hundred() -> None:
    # Section 1 of the physics text: a smoothstep over the disc errs by up to 0.039.
    x = np.linspace(-1.0, 1.0, 20001)
    t = 0.5 * (x + 1.0)
    difference = vectorized(visible_fraction)(x * RADIUS, RADIUS) - t * t * (3.0 - 2.0 * t)
    assert_allclose(np.abs(difference).max(), 0.039, atol=5e-4)

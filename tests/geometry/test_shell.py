"""Distances and horizons of a sphere, against vectors in extended precision."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.shell import (
    distance_to_bottom,
    distance_to_top,
    horizon_cosine,
    meets_ground,
    radius_along,
)
from airlight.kernel import vectorized

#: Ground and top of Earth, Mars and Titan. [m]
SHELLS = [(6360e3, 6460e3), (3389.5e3, 3509.5e3), (2575e3, 3175e3)]


def radius_by_vectors(r: np.ndarray, mu: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """|r z + d v| in extended precision."""
    r, mu, distance = (np.asarray(x, np.longdouble) for x in (r, mu, distance))
    along = r + distance * mu
    across = distance * np.sqrt((1 - mu) * (1 + mu))
    return np.sqrt(along * along + across * across)


@pytest.mark.parametrize(("bottom", "top"), SHELLS)
def test_distances_end_on_the_spheres(bottom: float, top: float) -> None:
    # Second method: the vector to the end of the ray has the length of the sphere's radius.
    rng = np.random.default_rng(2)
    r = bottom + (top - bottom) * rng.random(20_000) ** 3
    mu = rng.uniform(-1.0, 1.0, r.size)
    down = vectorized(meets_ground)(r, mu, bottom)
    ends = np.where(
        down, vectorized(distance_to_bottom)(r, mu, bottom), vectorized(distance_to_top)(r, mu, top)
    )
    reached = radius_by_vectors(r, mu, ends)
    # A grazing ray turns an error of 1e-16 R into one of 1e-8 of the distance, not of the radius.
    assert_allclose((reached - np.where(down, bottom, top)).astype(float), 0.0, atol=1e-6)
    assert (ends >= 0.0).all()


def test_radius_along_is_the_length_of_the_vector() -> None:
    rng = np.random.default_rng(3)
    r = rng.uniform(6360e3, 6460e3, 10_000)
    mu, distance = rng.uniform(-1, 1, r.size), rng.uniform(0, 1e6, r.size)
    got = vectorized(radius_along)(r, mu, distance)
    assert_allclose(got, radius_by_vectors(r, mu, distance).astype(float), rtol=1e-15, atol=0)


@pytest.mark.parametrize("height", [1e-3, 1.7, 100.0, 10e3, 400e3])
def test_the_horizon_dips_as_the_tangent_says(height: float) -> None:
    # The tangent from height h is √(h(2R+h)) long: its cosine over r. Written as products, 1 mm
    # above the ground keeps all digits that R + h itself has.
    bottom = 6360e3
    r = bottom + height
    expected = -sqrt((r - bottom) * (2.0 * bottom + (r - bottom))) / r
    assert_allclose(horizon_cosine(r, bottom), expected, rtol=1e-14)


def test_rays_just_below_the_horizon_meet_the_ground_and_just_above_miss_it() -> None:
    bottom = 6360e3
    r = bottom + np.array([0.1, 10.0, 1e3, 1e5])
    horizon = vectorized(horizon_cosine)(r, bottom)
    meets = vectorized(meets_ground)
    assert_array_equal(meets(r, horizon - 1e-12, bottom), True)
    assert_array_equal(meets(r, horizon + 1e-12, bottom), False)
    # Standing on the ground, a level ray leaves and any lower one does not.
    assert not meets_ground(bottom, 0.0, bottom)
    assert meets_ground(bottom, -1e-15, bottom)
    assert distance_to_bottom(bottom, -0.5, bottom) == 0.0

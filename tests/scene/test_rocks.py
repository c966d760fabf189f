"""Rocks: their share of the ground, means of reflectance and of sunlight, and limits of size."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.scene.ground_detail import WHOLE_PERIOD
from airlight.scene.rocks import FINEST, LATTICES, SHARE, WIDEST, rock_area, rocks, rocks_met

CELL = 0.317


def seen(count: int, zenith: float, pixel: float = 0.02, bare: float = 1.0) -> np.ndarray:
    """Rocks at random places from above, shape (count, 3)."""
    random = np.random.default_rng(1)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        place, turn = Vec3(*random.uniform(size=3)), random.uniform(0.0, 2.0 * math.pi)
        sine = math.sin(zenith)
        sun = Vec3(sine * math.cos(turn), sine * math.sin(turn), math.cos(zenith))
        found.append(rocks(place, whole, Vec3(1.0, 0.0, 1e6), sun, pixel, pixel, CELL, bare))
    return np.array(found)


@pytest.mark.parametrize("degrees", [0.0, 40.0, 65.0])
def test_mean_reflectance_and_mean_sunlight_remain(degrees: float) -> None:
    # To three standard errors of 10 000 places and the 0.5 % to which the light that is lost was
    # fitted.
    tone, ground, light = seen(10_000, math.radians(degrees)).T
    assert_allclose(tone.mean(), 1.0, atol=3.0 * tone.std() / 100.0)
    product = tone * (ground + light)
    assert_allclose(product.mean(), 1.0, atol=0.005 + 3.0 * product.std() / 100.0)


def test_rocks_cover_the_published_share_of_the_ground() -> None:
    # Golombek & Rapp (1997), figure 3: 7 % at Viking 1, and the share falls to a fifth at half a
    # metre; exp(-3.96 x 0.4) = 0.205. All sizes of the lattices, to 3 standard errors.
    assert_allclose(rock_area(0.4, 1e9), 0.205 * SHARE, rtol=0.01)
    light = seen(10_000, 0.0)[:, 2]
    covered = np.mean(light > 0.0)
    scale = CELL
    wanted = rock_area(scale * WIDEST / 4.0, scale * WIDEST * 4.0 ** (LATTICES - 1))
    assert 0.5 * FINEST < scale < 2.0 * FINEST
    assert_allclose(covered, wanted, atol=0.1 * wanted + 3.0 * math.sqrt(wanted / 10_000.0))


def test_no_rocks_are_shown_that_are_smaller_than_a_pixel_or_on_green_ground() -> None:
    assert np.all(seen(50, 0.5, pixel=WIDEST * 4.0 ** (LATTICES - 1)) == (1.0, 1.0, 0.0))
    assert np.all(seen(50, 0.5, bare=0.0) == (1.0, 1.0, 0.0))


def test_rocks_hide_more_of_a_line_that_is_flat_and_are_brighter_towards_the_star() -> None:
    # Limits: seen from above, a rock of each cell hides at most its area; the flatter a line, the
    # more rocks it meets; faces that look away from a low star are dark.
    random = np.random.default_rng(5)
    hidden, faces = [], []
    for climb in (1e6, 0.5, 0.12):
        span, found = min(0.33 / climb, 3.5), []
        for x, y in random.uniform(0.0, 200.0, (2000, 2)):
            sun = Vec3(0.9, 0.0, 0.4359)
            found.append(rocks_met(x, y, Vec3(1.0, 0.0, climb), span, 0.01, 0.4, sun))
        hidden.append(np.mean(found, axis=0)[0])
    assert hidden[0] < 0.4 * math.pi / 4.0 * WIDEST**2
    assert hidden[0] < hidden[1] < hidden[2] <= 1.0
    for side in (0.9, -0.9):
        sun = Vec3(side, 0.0, 0.4359)
        met = [
            rocks_met(x, y, Vec3(1.0, 0.0, 0.12), 2.75, 0.01, 0.4, sun)
            for x, y in random.uniform(0.0, 200.0, (1000, 2))
        ]
        faces.append(np.sum(met, axis=0)[1] / np.sum(met, axis=0)[0])
    assert faces[0] > 3.0 * faces[1]

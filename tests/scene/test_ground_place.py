"""The end of a bent line of sight on the ground, and the map read there."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.scene.ground_place import latitude_longitude, map_color, map_level, moved_on
from airlight.scene.map_levels import level_place
from airlight.scene.surface_map import SurfaceMap, from_pixels

BOTTOM = 6360e3


@pytest.mark.parametrize("angle", [0.0, 1e-4, 0.02])
@pytest.mark.parametrize("zenith", [91.0, 120.0, 179.0])
def test_a_bent_line_ends_further_round_the_planet(zenith: float, angle: float) -> None:
    # Geometry: in the plane of the line the end turns about the centre by the angle.
    slant = math.radians(180.0 - zenith)
    up, away = np.linalg.qr(np.random.default_rng(6).normal(size=(3, 2)))[0].T
    end = BOTTOM * up
    line = math.sin(slant) * away - math.cos(slant) * up
    moved = np.array(moved_on(Vec3(*end), Vec3(*line), math.cos(slant), angle, BOTTOM))
    wanted = BOTTOM * (math.cos(angle) * up + math.sin(angle) * away)
    assert_allclose(moved, wanted, rtol=0.0, atol=1e-6)  # rounding of lengths of 6e6 m


def test_latitude_and_longitude_undo_the_sphere() -> None:
    # The definition of geocentric coordinates; poles and date line too.
    for latitude in np.radians([-90.0, -89.99, -30.0, 0.0, 45.0, 90.0]):
        for longitude in np.radians([-179.0, -90.0, 0.0, 60.0, 180.0]):
            level = BOTTOM * math.cos(latitude)
            across = level * math.cos(longitude), level * math.sin(longitude)
            seen = latitude_longitude(Vec3(*across, BOTTOM * math.sin(latitude)))
            assert_allclose(seen[0], latitude, rtol=0.0, atol=1e-14)
            if abs(latitude) < 1.57:
                assert_allclose(seen[1], longitude, rtol=0.0, atol=1e-14)


@pytest.fixture
def ground() -> SurfaceMap:
    pixels = np.random.default_rng(4).integers(0, 256, (32, 64, 3)).astype(np.uint8)
    water = np.random.default_rng(7).integers(0, 256, (32, 64)).astype(np.uint8)
    return from_pixels("noise", pixels, water)


def read(ground: SurfaceMap, latitude: float, longitude: float, level: float) -> np.ndarray:
    """Colour of a map at angles in radians."""
    color = np.empty(4)
    map_color(
        ground.flat, ground.rows, ground.columns, len(ground.levels), latitude, longitude, level,
        color, 0,
    )  # fmt: skip
    return color


@pytest.mark.parametrize(("rows", "columns"), [(32, 64), (27, 54), (5, 9)])
def test_a_level_s_place_is_behind_those_before_it(rows: int, columns: int) -> None:
    # The definition, summed over the levels as they are made.
    pixels = np.zeros((rows, columns, 3), np.uint8)
    start = 0
    for index, level in enumerate(from_pixels("black", pixels).levels):
        assert level_place(rows, columns, index) == (start, *level.shape[:2])
        start += level.shape[0] * level.shape[1]


def test_the_map_of_whole_levels_is_the_map_s_own_sample(ground: SurfaceMap) -> None:
    # A second implementation, by whole arrays; it weighs in single precision.
    random = np.random.default_rng(5)
    for level in range(len(ground.levels)):
        for latitude, longitude in random.uniform([-90.0, -180.0], [90.0, 180.0], (50, 2)):
            color = read(ground, math.radians(latitude), math.radians(longitude), float(level))
            wanted = ground.sample(latitude, longitude, level)
            assert_allclose(color, wanted, rtol=0.0, atol=2e-6)


def test_between_two_levels_the_map_is_between_their_colours(ground: SurfaceMap) -> None:
    # Linear between them; beyond the first and the last it stays.
    last = len(ground.levels) - 1.0

    def at(level: float) -> np.ndarray:
        return read(ground, 0.3, 1.0, level)

    assert_allclose(at(1.25), 0.75 * at(1.0) + 0.25 * at(2.0), rtol=1e-12)
    assert_allclose(at(-3.0), at(0.0), rtol=0.0, atol=0.0)
    assert_allclose(at(last + 5.0), at(last), rtol=0.0, atol=0.0)


def test_the_level_is_that_of_the_footprint(ground: SurfaceMap) -> None:
    # The map's own, from the pixel's angle seen from the centre; both are for a view straight down.
    for reach in np.geomspace(1e5, 1e8, 30):
        wanted = ground.level(1e-3 * reach / BOTTOM)
        level = map_level(1e-3, reach, 1.0, BOTTOM, 32)
        assert_allclose(min(max(level, 0.0), len(ground.levels) - 1.0), wanted, atol=1e-12)
    # A quarter of the cosine: an ellipse four times as long, twice as large in the mean.
    assert_allclose(
        map_level(1e-3, 1e7, 0.2, BOTTOM, 32) - map_level(1e-3, 1e7, 0.8, BOTTOM, 32), 1.0
    )

"""Rocks: their share of the ground, means of reflectance and of sunlight, and limits of size."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.scene.ground_detail import WHOLE_PERIOD
from airlight.scene.rocks import (
    DARK,
    FINEST,
    FLAT,
    LATTICES,
    STEEPER,
    WIDEST,
    rock_area,
    rocks,
    rocks_met,
)

CELL = 0.317
#: Share of the ground below rocks at Viking 1.
SHARE = 0.07


def seen(
    count: int,
    zenith: float,
    pixel: float = 0.02,
    bare: float = 1.0,
    ascent: float = 1e6,
    azimuth: float = 0.0,
) -> np.ndarray:
    """Rocks at random places, by default from above, shape (count, 3); azimuth from the star's."""
    random = np.random.default_rng(1)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        place, turn = Vec3(*random.uniform(size=3)), random.uniform(0.0, 2.0 * math.pi)
        sine = math.sin(zenith)
        sun = Vec3(sine * math.cos(turn), sine * math.sin(turn), math.cos(zenith))
        ray = Vec3(math.cos(turn + azimuth), math.sin(turn + azimuth), ascent)
        found.append(rocks(place, whole, ray, sun, pixel, pixel, CELL, bare, SHARE)[:3])
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
    assert_allclose(rock_area(0.4, 1e9, SHARE), 0.205 * SHARE, rtol=0.01)
    light = seen(10_000, 0.0)[:, 2]
    covered = np.mean(light > 0.0)
    scale = CELL
    wanted = rock_area(scale * WIDEST / 4.0, scale * WIDEST * 4.0 ** (LATTICES - 1), SHARE)
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


def stones(random: np.random.Generator, side: float) -> np.ndarray:
    """Half ellipsoids at random places of a square: middle, radius and height [m], shape (n, 4)."""
    narrow, wide = WIDEST * CELL / 4.0, WIDEST * CELL * 4.0 ** (LATTICES - 1)
    diameters = np.geomspace(narrow, wide, 400)
    middles = np.sqrt(diameters[1:] * diameters[:-1])
    areas = [rock_area(a, b, SHARE) for a, b in itertools.pairwise(diameters)]
    numbers = random.poisson(np.array(areas) / (math.pi / 4.0 * middles**2) * side**2)
    radius = 0.5 * np.repeat(middles, numbers)
    height = radius * random.uniform(FLAT, FLAT + STEEPER, radius.size)
    return np.column_stack([*random.uniform(0.0, side, (2, radius.size)), radius, height])


def first_met(start: np.ndarray, way: np.ndarray, found: np.ndarray) -> tuple[float, int]:
    """Distance to the first half ellipsoid on a line above the ground, infinite if none; which."""
    size = found[:, [2, 2, 3]]
    from_middle = start / size
    from_middle[:, :2] -= found[:, :2] / size[:, :2]
    ray = way / size
    square, middle = (ray**2).sum(1), (from_middle * ray).sum(1)
    root = middle**2 - square * ((from_middle**2).sum(1) - 1.0)
    distance = (-middle - np.sqrt(np.maximum(root, 0.0))) / square
    distance = np.where((root > 0.0) & (distance > 1e-9), distance, np.inf)
    nearest = int(np.argmin(distance))
    return float(distance[nearest]), nearest


def traced(
    random: np.random.Generator, found: np.ndarray, side: float, ray: np.ndarray, sun: np.ndarray
) -> float:
    """Light of a line of sight to the ground, over that of level ground without rocks."""
    place = np.array([*random.uniform(0.4 * side, 0.6 * side, 2), 0.0])
    start = place + ray * (2.0 / ray[2])
    distance, which = first_met(start, -ray, found)
    share = 1.0
    if distance < 2.0 / ray[2] - 1e-9:
        place = start - distance * ray
        normal = place - np.array([*found[which, :2], 0.0])
        normal /= found[which, [2, 2, 3]] ** 2
        share = DARK * max(normal @ sun, 0.0) / np.linalg.norm(normal) / sun[2]
    return share if share > 0.0 and first_met(place, sun, found)[0] == np.inf else 0.0


@pytest.mark.parametrize(
    ("ascent", "azimuth", "zenith"), [(12.0, 0.0, 70.0), (12.0, 90.0, 40.0), (12.0, 180.0, 40.0)]
)
def test_light_of_rocks_seen_at_an_angle_is_that_of_ellipsoids(
    ascent: float, azimuth: float, zenith: float
) -> None:
    # A second method: lines through half ellipsoids at random places, with the same sizes, smooth
    # and with shadows of rocks on rocks. To three standard errors and 3 %: outlines and faces are
    # ragged here, and the cells' rocks do not touch.
    high, turn, low = (math.radians(x) for x in (ascent, azimuth, zenith))
    side, random = 40.0, np.random.default_rng(2)
    sun = np.array([math.sin(low), 0.0, math.cos(low)])
    flat = math.cos(high)
    ray = np.array([flat * math.cos(turn), flat * math.sin(turn), math.sin(high)])
    lines = []
    for _ in range(4):
        field = stones(random, side)
        for way in (ray, np.array([0.0, 0.0, 1.0])):
            lines.append([traced(random, field, side, way, sun) for _ in range(400)])
    slant, above = np.array(lines[::2]), np.array(lines[1::2])
    tone, ground, light = seen(4000, low, ascent=math.tan(high), azimuth=turn).T
    own = tone * (ground + light)
    error = math.hypot(slant.std(), above.std()) / 40.0 + own.std() / 63.0
    assert_allclose(own.mean(), slant.mean() / above.mean(), atol=0.03 + 3.0 * error)


def test_rocks_brighten_the_ground_with_the_star_behind_the_observer() -> None:
    # Opposition: no shadow is seen, and faces that are steeper than the ground are lit more. Rocks
    # hide a tenth of the line, have three quarters of the ground's reflectance, and are at most
    # tan(70°) = 2.7 times as brightly lit.
    tone, ground, light = seen(4000, math.radians(70.0), ascent=math.tan(math.radians(20.0))).T
    own = tone * (ground + light)
    assert own.mean() - 3.0 * own.std() / 63.0 > 1.0
    assert own.mean() < 1.2

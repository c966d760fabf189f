"""Rocks: their share of the ground, means of reflectance and of sunlight, and limits of size."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.render.pixels.land import STONES
from airlight.scene.ground_detail import WHOLE_PERIOD
from airlight.scene.rocks import (
    DUSTED,
    DUSTY_FROM,
    DUSTY_TO,
    FACES,
    FARTHER,
    FINEST,
    FLAT,
    GROUND,
    LATTICES,
    LEAN,
    LEANING,
    NEAREST,
    SHOULDER,
    SIDES,
    STEEPER,
    STEP,
    TILT,
    TURN_X,
    UPPER,
    UPPER_LEAN,
    WIDEST,
    WORN,
    rock_area,
    rock_met,
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
    """``Rocks`` at random places, by default from above, shape (count, 6).

    Their azimuth is that from the star's.
    """
    random = np.random.default_rng(1)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        place, turn = Vec3(*random.uniform(size=3)), random.uniform(0.0, 2.0 * math.pi)
        sine = math.sin(zenith)
        sun = Vec3(sine * math.cos(turn), sine * math.sin(turn), math.cos(zenith))
        ray = Vec3(math.cos(turn + azimuth), math.sin(turn + azimuth), ascent)
        found.append(rocks(place, whole, ray, sun, 1.0, pixel, pixel, CELL, bare, SHARE, STONES))
    return np.array(found)


@pytest.mark.parametrize("degrees", [0.0, 40.0, 65.0, 75.0])
def test_mean_reflectance_and_mean_light_remain(degrees: float) -> None:
    # To three standard errors of 10 000 places and the 0.5 % to which the light that is lost was
    # fitted.
    tone, hue, ground, light, sky, _ = seen(10_000, math.radians(degrees)).T
    assert_allclose(tone.mean(), 1.0, atol=3.0 * tone.std() / 100.0)
    assert_allclose(hue.mean(), 0.0, atol=3.0 * hue.std() / 100.0)
    for product in (tone * (ground + light), tone * sky):
        assert_allclose(product.mean(), 1.0, atol=0.005 + 3.0 * product.std() / 100.0)


def test_rocks_cover_the_published_share_of_the_ground() -> None:
    # Golombek & Rapp (1997), figure 3: 7 % at Viking 1, and the share falls to a fifth at half a
    # metre; exp(-3.96 x 0.4) = 0.205. All sizes of the lattices, to 3 standard errors.
    assert_allclose(rock_area(0.4, 1e9, SHARE), 0.205 * SHARE, rtol=0.01)
    light = seen(10_000, 0.0)[:, 3]
    covered = np.mean(light > 0.0)
    scale = CELL / STEP**2
    wanted = rock_area(scale * WIDEST / 4.0, scale * WIDEST * 4.0 ** (LATTICES - 1), SHARE)
    assert 0.5 * FINEST < scale < 2.0 * FINEST
    assert_allclose(covered, wanted, atol=0.1 * wanted + 3.0 * math.sqrt(wanted / 10_000.0))


def test_no_rocks_are_shown_that_are_smaller_than_a_pixel_or_on_green_ground() -> None:
    none = (1.0, 0.0, 1.0, 0.0, 1.0, 1.0)
    assert np.all(seen(50, 0.5, pixel=WIDEST * 4.0 ** (LATTICES - 3)) == none)
    assert np.all(seen(50, 0.5, bare=0.0) == none)


def test_rocks_lie_within_their_radius_and_height() -> None:
    # Random lines: a rock's cell is visited where they cross it below its height.
    random = np.random.default_rng(4)
    for first, second, turn in random.uniform(size=(4000, 3)):
        way = Vec3(math.cos(2.0 * math.pi * turn), math.sin(2.0 * math.pi * turn), 1e-3)
        beside = rock_met(-1.001 * way.y, 1.001 * way.x, way, first, second, 1e-6)
        over = rock_met(-3.0 * way.x, -3.0 * way.y, Vec3(way.x, way.y, 0.51), first, second, 1e-6)
        assert beside.part == over.part == 0.0
        assert rock_met(0.0, 0.0, way, first, second, 1e-6).part == 1.0


def test_rocks_hide_more_of_a_line_that_is_flat_and_are_brighter_towards_the_star() -> None:
    # Limits: seen from above, a rock of each cell hides at most its area; the flatter a line, the
    # more rocks it meets; faces that look away from a low star are dark.
    random = np.random.default_rng(5)
    hidden, faces = [], []
    for climb in (1e6, 0.5, 0.12):
        span, found = min(0.33 / climb, 3.5), []
        for x, y in random.uniform(0.0, 200.0, (2000, 2)):
            sun = Vec3(0.9, 0.0, 0.4359)
            found.append(rocks_met(x, y, Vec3(1.0, 0.0, climb), span, 0.01, 0.4, sun, 0.0, 0.0))
        hidden.append(np.mean(found, axis=0)[0])
    assert hidden[0] < 0.4 * math.pi / 4.0 * WIDEST**2
    assert hidden[0] < hidden[1] < hidden[2] <= 1.0
    for side in (0.9, -0.9):
        sun = Vec3(side, 0.0, 0.4359)
        met = [
            rocks_met(x, y, Vec3(1.0, 0.0, 0.12), 2.75, 0.01, 0.4, sun, 0.0, 0.0)
            for x, y in random.uniform(0.0, 200.0, (1000, 2))
        ]
        faces.append(np.sum(met, axis=0)[1] / np.sum(met, axis=0)[0])
    assert faces[0] > 3.0 * faces[1]


def stones(random: np.random.Generator, side: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Convex rocks at random places of a square.

    Returns
    -------
    found, faces, offsets : array, shapes (n, 4), (n, m, 3), (n, m)
        Middle, radius and height [m]; faces of rocks of radius and height 1, n x ≤ d.
    """
    narrow, wide = WIDEST * CELL / 64.0, WIDEST * CELL * 4.0 ** (LATTICES - 3)
    diameters = np.geomspace(narrow, wide, 400)
    middles = np.sqrt(diameters[1:] * diameters[:-1])
    areas = [rock_area(a, b, SHARE) for a, b in itertools.pairwise(diameters)]
    # the base has 1.774 of the square of the radius
    numbers = random.poisson(np.array(areas) / (1.774 / 4.0 * middles**2) * side**2)
    radius = 0.5 * np.repeat(middles, numbers)
    height = radius * random.uniform(FLAT, FLAT + STEEPER, radius.size)
    found = np.column_stack([*random.uniform(0.0, side, (2, radius.size)), radius, height])
    first, second = random.uniform(size=(2, radius.size, 1))
    which = np.arange(FACES)
    angle = np.arccos(first) + which * math.acos(TURN_X)
    offsets = NEAREST + FARTHER * ((5.0 * second + 0.618034 * which) % 1.0)
    steep = (11.0 * second + 3.0 * first + 0.754878 * which) % 1.0
    low = which < SIDES
    lean = np.where(low, LEAN + LEANING * steep**2, UPPER + UPPER_LEAN * steep)
    offsets += np.where(low, 0.0, SHOULDER * lean)
    faces = np.stack([np.cos(angle), np.sin(angle), lean], axis=2)
    top = np.stack([TILT * (first - 0.5), TILT * (second - 0.5), np.ones_like(first)], axis=2)
    below = np.broadcast_to([0.0, 0.0, -1.0], top.shape)
    faces = np.concatenate([faces, top, below], axis=1)
    return found, faces, np.column_stack([offsets, 0.75 + 0.25 * second, np.zeros_like(first)])


def first_met(
    start: np.ndarray, way: np.ndarray, field: tuple[np.ndarray, np.ndarray, np.ndarray]
) -> tuple[float, int, int]:
    """Distance to the first rock on a line, infinite if none; which, and which face."""
    found, faces, offsets = field
    apart = found[:, :2] - start[:2]
    beside = np.abs(apart[:, 0] * way[1] - apart[:, 1] * way[0]) / max(math.hypot(*way[:2]), 1e-9)
    near = beside < found[:, 2]
    if math.hypot(*way[:2]) < 1e-9:
        near = np.hypot(*apart.T) < found[:, 2]
    if not near.any():
        return math.inf, 0, 0
    size = found[near][:, [2, 2, 3]]
    place = start / size
    place[:, :2] -= found[near][:, :2] / size[:, :2]
    outwards = np.einsum("nmk,nk->nm", faces[near], way / size)
    met = (offsets[near] - np.einsum("nmk,nk->nm", faces[near], place)) / outwards
    entered = np.where(outwards < 0.0, met, -np.inf)
    left = np.where(outwards > 0.0, met, np.inf).min(axis=1)
    distance = entered.max(axis=1)
    distance[(distance > left) | (distance < 1e-9)] = np.inf
    nearest = int(np.argmin(distance))
    return (
        float(distance[nearest]),
        int(np.flatnonzero(near)[nearest]),
        int(entered[nearest].argmax()),
    )


def traced(
    random: np.random.Generator,
    field: tuple[np.ndarray, np.ndarray, np.ndarray],
    side: float,
    ray: np.ndarray,
    sun: np.ndarray,
) -> float:
    """Light of a line of sight to the ground, over that of level ground without rocks."""
    place = np.array([*random.uniform(0.4 * side, 0.6 * side, 2), 0.0])
    start = place + ray * (4.0 / ray[2])
    distance, which, face = first_met(start, -ray, field)
    share, reflected = 1.0, 0.0
    if distance < 4.0 / ray[2] - 1e-9:
        place = start - distance * ray
        size = field[0][which, [2, 2, 3]]
        normal = (
            field[1][which, face] + WORN * (place - np.array([*field[0][which, :2], 0.0])) / size
        )
        normal *= size[0] / size
        normal /= np.linalg.norm(normal)
        dust = np.clip((normal[2] - DUSTY_FROM) / (DUSTY_TO - DUSTY_FROM), 0.0, 1.0)
        stone = STONES + (1.0 - STONES) * (dust - DUSTED)
        share = stone * max(normal @ sun, 0.0) / sun[2]
        reflected = stone * GROUND * 0.5 * (1.0 - normal[2])
    lit = share > 0.0 and first_met(place, sun, field)[0] == np.inf
    return reflected + (share if lit else 0.0)


@pytest.mark.parametrize(
    ("ascent", "azimuth", "zenith"), [(12.0, 0.0, 70.0), (12.0, 90.0, 40.0), (12.0, 180.0, 40.0)]
)
def test_light_of_rocks_seen_at_an_angle_is_that_of_convex_rocks(
    ascent: float, azimuth: float, zenith: float
) -> None:
    # A second method: lines through rocks at random places, with the same sizes and faces, smooth
    # and with shadows of rocks on rocks. To three standard errors and 3 %: here faces have pits,
    # and rocks of cells do not touch.
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
    tone, _, ground, light, _, _ = seen(4000, low, ascent=math.tan(high), azimuth=turn).T
    own = tone * (ground + light)
    error = math.hypot(slant.std(), above.std()) / 40.0 + own.std() / 63.0
    assert_allclose(own.mean(), slant.mean() / above.mean(), atol=0.03 + 3.0 * error)


def test_rocks_brighten_the_ground_with_the_star_behind_the_observer() -> None:
    # Opposition: no shadow is seen, and faces that are steeper than the ground are lit more. Rocks
    # hide a tenth of the line, have three quarters of the ground's reflectance, and are at most
    # tan(70°) = 2.7 times as brightly lit.
    tone, _, ground, light, _, _ = seen(
        4000, math.radians(70.0), ascent=math.tan(math.radians(20.0))
    ).T
    own = tone * (ground + light)
    assert own.mean() - 3.0 * own.std() / 63.0 > 1.0
    assert own.mean() < 1.2

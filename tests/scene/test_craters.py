"""Craters: number by diameter, profile, shadows, mean sunlight, and limits of size."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.gradient_noise import PERIOD, shuffled
from airlight.geometry.vectors import Vec3
from airlight.scene.crater_shapes import (
    DEPTH,
    EJECTA,
    RIM,
    Crater,
    crater_slope,
    level_floor,
    shadowed,
    sunk,
)
from airlight.scene.craters import COARSEST, LATTICES, NARROWEST, WIDEST, crater_of, craters
from airlight.scene.ground_detail import WHOLE_PERIOD

#: Finest cell of the Moon. [m]
CELL = 0.0813
#: Craters wider than D per D² on the maria.
MARIA = 0.079
UP = Vec3(0.0, 0.0, 1.0)


def cells(lattice: int, columns: int, rows: int, share: float) -> list[Crater]:
    """Craters of a lattice, as ``craters`` finds them."""
    found = []
    for i in range(columns):
        column = shuffled(i + 20.0 * lattice)
        for j in range(rows):
            number = shuffled(column + j)
            if number < 289.0 * share:
                first = shuffled(number + column)
                second = shuffled(first + number)
                found.append(crater_of(column, number, first, second, share))
    return found


def test_numbers_of_craters_fall_as_the_square_of_their_diameter() -> None:
    # The law itself, over one lattice of 65 536 cells: N(>D) D² from the narrowest D to the widest,
    # less those wider than the widest; to three standard errors.
    share = MARIA * 3.0 / WIDEST**2
    diameters = 2.0 * np.array([one.radius for one in cells(3, PERIOD, PERIOD, share)])
    for least in (0.301, 0.36, 0.45, 0.55):
        wanted = PERIOD**2 * MARIA * (least**-2 - WIDEST**-2)
        assert abs(np.sum(diameters > least) - wanted) < 3.0 * np.sqrt(wanted) + 0.01 * wanted
    assert diameters.max() <= WIDEST


def test_a_fresh_crater_is_as_deep_as_its_diameter_says() -> None:
    # The integral of the slope: depth and rim of Pike (1977), 0.196 and 0.036 diameters.
    inside, outside = np.linspace(0.0, 1.0, 4001)[:-1], np.linspace(1.0, EJECTA, 4001)
    up = 0.5 * np.mean([crater_slope(one, 1.0, 0.0) for one in inside])
    assert_allclose(up, DEPTH + RIM, rtol=1e-3)
    assert_allclose(DEPTH + RIM, 0.196, rtol=1e-9)
    down = 0.5 * (EJECTA - 1.0) * np.mean([crater_slope(one, 1.0, 0.0) for one in outside])
    assert -RIM < down < -0.4 * RIM  # ejecta end before they have thinned out
    whole = np.linspace(0.0, EJECTA, 4001)
    old = [crater_slope(one, 0.01, 0.0) for one in whole]
    assert_allclose(0.5 * EJECTA * np.mean(old), 0.01 * DEPTH, rtol=0.03)
    assert min(old) > -1e-3  # without a rim


def test_wide_craters_are_as_shallow_as_those_of_the_moon() -> None:
    # Pike (1977): depths of complex craters are 1.044 D^0.301 in kilometres; one profile for all
    # meets them within a quarter up to 40 km. Their floors are level, but for the peak.
    inside = np.linspace(0.0, 1.0, 4001)[:-1]
    for diameter in (25.0, 40.0):
        level = level_floor(1e3 * diameter)
        deep = 0.5 * np.mean([crater_slope(one, 1.0, level) for one in inside if one > 0.2])
        assert_allclose(0.8 * deep, 1.044 * diameter**0.301 / diameter, rtol=0.25)
        assert crater_slope(0.4, 1.0, level) == 0.0
        assert crater_slope(0.1, 1.0, level) < -0.3
    assert level_floor(5e3) == 0.0


def bowl(square: np.ndarray | float) -> np.ndarray | float:
    """Height of a fresh bowl by the square of the distance from its centre. [radius]"""
    return 2.0 * (DEPTH + RIM) * (np.minimum(square, 1.0) - 1.0)


@pytest.mark.parametrize("tangent", [1.5, 2.7, 5.0])
def test_the_shadow_in_a_bowl_is_that_of_a_marched_ray(tangent: float) -> None:
    # A second method: 2000 steps towards the star, along which the ground is compared.
    random, step, wrong = np.random.default_rng(4), np.linspace(0.0, 2.2, 2000), 0
    for _ in range(200):
        x, y = random.uniform(-0.7, 0.7, 2)
        heights = bowl(x * x + y * y) + step / tangent
        met = np.any(bowl((x + step) ** 2 + y * y) > heights + 1e-9)
        share = shadowed(tangent * x, x * x + y * y, 1.0, 0.0, tangent, 0.0)
        wrong += abs(share - met) > 0.5
    assert wrong <= 2  # at the edge, a step wide
    assert shadowed(0.0, 0.0, 0.2, 0.0, tangent, 0.0) == 0.0  # an old one has none


def test_a_line_of_sight_meets_the_bowl_behind_its_rim() -> None:
    # The equation itself: descended by h, the line is on the parabola.
    for x, flat in ((-0.9, 1.0), (-0.9, 15.0), (0.3, 4.0), (0.0, 0.0)):
        h = sunk(flat * x, flat * flat, x * x + 0.04, 1.0)
        assert_allclose(bowl((x + flat * h) ** 2 + 0.04), -h, rtol=1e-9)
    # at a grazing angle only the far wall is seen
    assert -0.9 + 15.0 * sunk(15.0 * -0.9, 225.0, 0.81, 1.0) > 0.5


def test_most_craters_are_old_and_few_are_fresh() -> None:
    # Depths over those of fresh ones: 0.3 to 0.6 in the median (Stopar et al. 2017).
    fresh = np.array([one.fresh for one in cells(5, PERIOD, 100, 0.6)])
    depth = fresh * (fresh + (1.0 - fresh) * DEPTH / (DEPTH + RIM))
    assert 0.15 < np.median(depth) < 0.6
    assert 0.05 < np.mean(fresh > 0.7) < 0.2


def cratered(
    count: int,
    footprint: float,
    way: Vec3,
    up: Vec3 = UP,
    high: float = 1.0,
    weathered: bool = False,
) -> np.ndarray:
    """Light and tones at random places seen from above, shape (2, count)."""
    random = np.random.default_rng(2)
    return np.array(
        [
            craters(
                Vec3(*random.uniform(size=3)),
                Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3))),
                up, way, footprint, CELL, MARIA, high, Vec3(0.0, 0.0, 0.0), weathered,
            )
            for _ in range(count)
        ]
    ).T  # fmt: skip


@pytest.mark.parametrize("way", [Vec3(1.0, 0.0, 0.0), Vec3(1.6, -2.2, 0.0)])
def test_craters_do_not_change_mean_sunlight(way: Vec3) -> None:
    # What the rim's circle receives falls on the bowl, in its shadow nothing: the mean is 1 to
    # three standard errors, and half a per cent by flanks that would get less than no light.
    light, tone = cratered(20_000, 30.0, way)
    # ejecta brighten the ground before it is taken off; 289 values err by 3 %
    assert abs(tone.mean()) < 0.003 + 3.0 * tone.std() / np.sqrt(tone.size)
    assert tone.std() > 0.01
    assert abs(light.mean() - 1.0) < 0.005 + 3.0 * light.std() / np.sqrt(light.size)
    assert light.std() > 0.05
    assert light.min() >= 0.0


def test_craters_that_wind_fills_keep_mean_light_and_reflectance() -> None:
    # Floors are as often dark as bright; slopes balance: 0 and 1 to three standard errors, and to a
    # hundredth of the contrast of floors for 289 values.
    light, tone = cratered(20_000, 3000.0, Vec3(1.6, -2.2, 0.0), weathered=True)
    assert abs(light.mean() - 1.0) < 0.005 + 3.0 * light.std() / np.sqrt(light.size)
    assert abs(tone.mean()) < 0.002 + 3.0 * tone.std() / np.sqrt(tone.size)
    assert tone.std() > 0.005
    assert np.isfinite(light).all()


def test_highlands_have_more_wide_craters_than_maria() -> None:
    # The law: those of kilometres are fewer by the ratio of diameters at which equilibrium ends.
    way = Vec3(2.0, 0.0, 0.0)
    mare, highlands = (cratered(10_000, 3000.0, way, high=one)[0].std() for one in (0.0, 1.0))
    assert highlands > 1.5 * mare


def test_craters_on_the_corner_of_the_cube_are_round() -> None:
    # Isotropy along the ground: light along two horizontal directions has one spread, within 5 %,
    # where the face of the cube is inclined by 55°.
    up = Vec3(3.0**-0.5, 3.0**-0.5, 3.0**-0.5)
    one, _ = cratered(10_000, 30.0, Vec3(2.0**-0.5, -(2.0**-0.5), 0.0), up)
    other, _ = cratered(10_000, 30.0, Vec3(6.0**-0.5, 6.0**-0.5, -2.0 * 6.0**-0.5), up)
    assert_allclose(one.std(), other.std(), rtol=0.05)


def test_pixels_as_wide_as_craters_see_none() -> None:
    light, tone = cratered(50, 0.51 / NARROWEST * WIDEST * COARSEST, Vec3(1.0, 0.0, 0.0))
    assert_array_equal(light, 1.0)
    assert_array_equal(tone, 0.0)
    assert 0.3 < WIDEST * COARSEST * 0.5 ** (LATTICES - 1) * CELL < 1.0

"""Craters: their number by diameter, profile, mean sunlight, and limits of size."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.gradient_noise import PERIOD
from airlight.geometry.vectors import Vec3
from airlight.scene.craters import (
    COARSEST,
    DEPTH,
    EJECTA,
    LATTICES,
    RIM,
    STEEPEST,
    WIDEST,
    crater_of,
    crater_slope,
    craters,
)
from airlight.scene.ground_detail import WHOLE_PERIOD

#: Finest cell of the Moon. [m]
CELL = 0.0813
#: Craters wider than D per D² on the maria.
MARIA = 0.079
UP = Vec3(0.0, 0.0, 1.0)


def test_numbers_of_craters_fall_as_the_square_of_their_diameter() -> None:
    # The law itself, over one lattice of 65 536 cells: N(>D) D² from the narrowest D to the widest,
    # less those wider than the widest; to three standard errors.
    share = MARIA * 3.0 / WIDEST**2
    found = [
        crater_of(float(i), float(j), 3, share).radius for i in range(PERIOD) for j in range(PERIOD)
    ]
    diameters = 2.0 * np.array(found)
    for least in (0.301, 0.36, 0.45, 0.55):
        wanted = PERIOD**2 * MARIA * (least**-2 - WIDEST**-2)
        assert abs(np.sum(diameters > least) - wanted) < 3.0 * np.sqrt(wanted) + 0.01 * wanted
    assert diameters.max() <= WIDEST


def test_a_fresh_crater_is_as_deep_as_its_diameter_says() -> None:
    # The integral of the slope: depth and rim of Pike (1977), 0.196 and 0.036 diameters.
    inside, outside = np.linspace(0.0, 1.0, 4001)[:-1], np.linspace(1.0, EJECTA, 4001)
    up = 0.5 * np.mean([crater_slope(one, 1.0) for one in inside])
    assert_allclose(up, DEPTH + RIM, rtol=1e-3)
    assert_allclose(DEPTH + RIM, 0.196, rtol=1e-9)
    down = 0.5 * (EJECTA - 1.0) * np.mean([crater_slope(one, 1.0) for one in outside])
    assert -RIM < down < -0.4 * RIM  # ejecta end before they have thinned out
    whole = np.linspace(0.0, EJECTA, 4001)
    old = [crater_slope(one, 0.01) for one in whole]
    assert_allclose(0.5 * EJECTA * np.mean(old), 0.01 * DEPTH, rtol=0.03)
    assert min(old) > -1e-3  # without a rim


def cratered(count: int, footprint: float, way: Vec3, up: Vec3 = UP) -> np.ndarray:
    """Ascents and tones at random places, shape (2, count)."""
    random = np.random.default_rng(2)
    return np.array(
        [
            craters(
                Vec3(*random.uniform(size=3)),
                Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3))),
                up, way, footprint, CELL, MARIA,
            )
            for _ in range(count)
        ]
    ).T  # fmt: skip


@pytest.mark.parametrize("way", [Vec3(1.0, 0.0, 0.0), Vec3(0.6, -0.8, 0.0)])
def test_craters_do_not_change_mean_sunlight(way: Vec3) -> None:
    # Opposite walls: the mean slope is 0 to three standard errors, and no slope is so steep that
    # its light would be cut off.
    found, tone = cratered(20_000, 30.0, way)
    # ejecta brighten the ground by 0.1 in the mean before it is taken off; 289 values err by 3 %
    assert abs(tone.mean()) < 0.003 + 3.0 * tone.std() / np.sqrt(tone.size)
    assert tone.std() > 0.01
    assert abs(found.mean()) < 3.0 * found.std() / np.sqrt(found.size)
    assert found.std() > 0.03
    assert np.abs(found).max() < STEEPEST


def test_craters_on_the_corner_of_the_cube_are_round() -> None:
    # Isotropy along the ground: slopes along two horizontal directions have one spread, within 5 %,
    # where the face of the cube is inclined by 55°.
    up = Vec3(3.0**-0.5, 3.0**-0.5, 3.0**-0.5)
    one, _ = cratered(10_000, 30.0, Vec3(2.0**-0.5, -(2.0**-0.5), 0.0), up)
    other, _ = cratered(10_000, 30.0, Vec3(6.0**-0.5, 6.0**-0.5, -2.0 * 6.0**-0.5), up)
    assert_allclose(one.std(), other.std(), rtol=0.05)


def test_pixels_as_wide_as_craters_see_none() -> None:
    assert np.all(cratered(50, 0.26 * WIDEST * COARSEST, Vec3(1.0, 0.0, 0.0)) == 0.0)
    assert 0.3 < WIDEST * COARSEST * 0.5 ** (LATTICES - 1) * CELL < 1.0

"""Rolling ground: heights, slopes and steepness."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.scene.rolling_ground import COARSEST, Rolling, rolling, rolling_height

#: Finest cell of the Moon. [m]
CELL = 0.0542
START = Vec3(0.0, 0.0, 0.0)
WAY = Vec3(0.6, 0.0, 0.8)


def found(count: int, footprint: float, high: float) -> list[Rolling]:
    """Rolling ground at random places of the Moon."""
    places = np.random.default_rng(3).uniform(0.0, 64.0 * COARSEST, (count, 3))
    return [rolling(Vec3(*one), footprint, START, WAY, high, CELL) for one in places]


def test_slopes_are_those_of_the_heights() -> None:
    # A second method: the difference of heights of two places. One octave is shown, whose slopes
    # leave nothing out, and without ridges.
    footprint, step = 0.4 * COARSEST, 1e-4 * COARSEST
    for x, y, z in np.random.default_rng(5).uniform(0.0, 9.0 * COARSEST, (50, 3)):
        ahead = Vec3(x + 0.6 * step, y, z + 0.8 * step)
        here = rolling(Vec3(x, y, z), footprint, START, WAY, 1.0, CELL)
        there = rolling(ahead, footprint, START, WAY, 1.0, CELL)
        assert_allclose(here.ascent, (there.height - here.height) / step, atol=2e-5)


def test_the_limb_has_the_heights_that_are_shaded() -> None:
    # Both are the same octaves; a place far above leaves fine ones out.
    for x, y, z in np.random.default_rng(5).uniform(0.0, 9.0 * COARSEST, (50, 3)):
        place = Vec3(x, y, z)
        shaded = rolling(place, 500.0, START, WAY, 1.0, CELL).height
        assert_allclose(rolling_height(place, 500.0, -1e9, 1.0, CELL), shaded, rtol=1e-9)
        assert rolling_height(place, 500.0, 1e9, 1.0, CELL) < 1e6


def test_highlands_are_as_steep_as_those_of_the_moon() -> None:
    # Median slopes are 7.5° in highlands and 2.0° on maria, craters included (Rosenburg et al.
    # 2011); along one direction two thirds of that. Heights are those of 1 to 3 km over 100 km.
    for high, least, most in ((1.0, 2.0, 6.0), (0.0, 0.4, 2.0)):
        ground = found(4000, 500.0, high)
        slope = np.degrees(np.arctan([one.ascent for one in ground]))
        assert least < np.median(np.abs(slope)) < most
        assert abs(slope.mean()) < 3.0 * slope.std() / np.sqrt(slope.size)
    heights = CELL * np.array([one.height for one in found(4000, 500.0, 1.0)])
    assert 300.0 < heights.std() < 1500.0
    assert abs(heights.mean()) < 3.0 * heights.std() / np.sqrt(heights.size)


def test_pixels_wider_than_cells_see_level_ground() -> None:
    assert found(20, COARSEST, 1.0) == [Rolling(0.0, 0.0, 0.0, 0.0, 0.0)] * 20

"""Hills and woods: means of height, slope and reflectance; what hides what."""

from __future__ import annotations

import math

import numpy as np
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.render.pixels.land import COVER
from airlight.render.pixels.skyline import GROUND, STEEPEST, TOP, leafiness, snowiness
from airlight.scene.ground_detail import WHOLE_PERIOD, finest_cell
from airlight.scene.hills import COARSEST, CREST, CROWNS, OCTAVES, TREES, canopy, hills, woods

CELL = finest_cell(6371e3, 2700)
AROUND = Vec3(1.0, 0.0, 0.0)


def places(count: int, footprint: float, distance: float = 1e12) -> np.ndarray:
    """Height, ascent, tone and woods at random places, shape (count, 4)."""
    random = np.random.default_rng(2)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        part = Vec3(*random.uniform(size=3))
        hill = hills(part, footprint, distance, whole, AROUND, True, CELL, 0.7, -1.0)
        found.append((*hill, woods(part, footprint, whole, hill.tone)))
    return np.array(found)


def test_slopes_and_tones_have_the_mean_zero_and_woods_their_share() -> None:
    # So that mean sunlight and mean reflectance remain: to 3 standard errors of 3000 places.
    for footprint in (20.0, 2000.0):
        found = places(3000, footprint)
        errors = found.std(axis=0) / math.sqrt(3000.0)
        assert np.all(np.abs(found.mean(axis=0)[1:3]) < 3.0 * errors[1:3])
        assert abs(found[:, 3].mean() - COVER) < 3.0 * errors[3]


def test_the_ascent_is_the_derivative_of_the_height() -> None:
    # A second method: differences over a thousandth of the cells, of relief of one octave, but for
    # its crests, which are rounded.
    random = np.random.default_rng(3)
    step, checked = 1e-3 * COARSEST, 0
    footprint = 0.31 * COARSEST  # the coarsest octave alone
    for _ in range(60):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        back, here, ahead = (
            hills(Vec3(x, 0.0, 0.0), footprint, 1e12, whole, AROUND, True, CELL, 0.7, -1.0)
            for x in (-step, 0.0, step)
        )
        if abs(here.tone) > 2.0 * CREST:
            wanted = (ahead.height - back.height) / (2.0 * step * CELL)
            assert_allclose(here.ascent, wanted, atol=1e-4 / (COARSEST * CELL))
            checked += 1
    assert checked > 30


def test_hills_that_are_not_asked_for_are_lower() -> None:
    random = np.random.default_rng(6)
    for least in random.uniform(-0.1, 0.6, 200):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        places = (AROUND, 1.0, 1e12, whole, AROUND, False, CELL, 0.7)
        whole_height, height = hills(*places, -1.0).height, hills(*places, least).height
        assert height == whole_height or max(height, whole_height) < least


def test_a_low_observer_stands_on_level_ground() -> None:
    # No octave begins within half a cell, and what he sees of all has a largest angle.
    finest = COARSEST * 0.5 ** (OCTAVES - 1)
    assert np.all(places(20, 1.0, 0.49 * finest)[:, :3] == 0.0)
    for distance in (1e3, 1e4, 1e5, 1e6):
        heights = places(400, 1.0, distance)[:, 0]
        assert heights.max() < min(TOP, STEEPEST * distance) < 10.0 * TOP
    assert GROUND <= 0.0


def trees(count: int, footprint: float = 1.0) -> np.ndarray:
    """``Canopy`` at random places of a wood."""
    random = np.random.default_rng(4)
    return np.array(
        [
            canopy(
                Vec3(*random.uniform(size=3)),
                footprint,
                Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3))),
                1.0,
                Vec3(0.6, 0.0, -0.8),
            )
            for _ in range(count)
        ]
    )


def test_trees_are_higher_than_shrubs_and_lower_than_towers() -> None:
    heights = CELL * trees(500)[:, 0]
    assert 3.0 < heights.min() < CELL * TREES < heights.max() < 28.0


def test_crowns_keep_the_mean_light_of_woods() -> None:
    # Both sides of a crown, and the constant that was fitted to gaps: three standard errors.
    _, ascent, tone = trees(20_000).T
    assert abs(ascent.mean()) < 3.0 * ascent.std() / 20_000**0.5
    assert abs(tone.mean() - 1.0) < 3.0 * tone.std() / 20_000**0.5
    assert tone.std() > 0.1
    assert np.abs(ascent).max() < 0.45


def test_crowns_below_a_pixel_are_not_seen() -> None:
    assert np.all(trees(20, CROWNS)[:, 1:] == [0.0, 1.0])


def test_classes_of_land_by_colours_of_the_map() -> None:
    # Texels of the packaged map: Bavaria, the Arabian desert, Greenland.
    bavaria, desert, ice = (0.037, 0.049, 0.02), (0.286, 0.219, 0.128), (0.913, 0.896, 0.922)
    snow = [snowiness(color[0], color[2]) for color in (bavaria, desert, ice)]
    assert snow == [0.0, 0.0, 1.0]
    leaves = [
        leafiness(color[0], color[1], part)
        for color, part in zip((bavaria, desert, ice), snow, strict=True)
    ]
    assert leaves == [1.0, 0.0, 0.0]

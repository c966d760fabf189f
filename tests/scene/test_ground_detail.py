"""Detail of the ground: smooth, of mean 0, anchored to the planet, no finer than the picture."""

from __future__ import annotations

import math

import numpy as np
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.image.encoding import srgb_encode
from airlight.scene.ground_detail import (
    DISPLACED_FALL,
    EDGED,
    OCTAVES,
    SHOAL,
    STEP,
    GroundNoise,
    edged,
    finest_cell,
    ground_detail,
    lattice_origin,
    sharper_share,
    shoal,
)
from airlight.scene.map_grain import grain_of
from airlight.scene.observer import planet_frame

BOTTOM = 6371e3
CELL = finest_cell(BOTTOM, 2700)


def detail(place: np.ndarray, below: np.ndarray, footprint: float) -> float:
    """Detail at a place for an observer above another; both are points on the ground. [m]"""
    origins = [lattice_origin(x, BOTTOM, CELL) for x in below / BOTTOM]
    wholes, parts = zip(*origins, strict=True)
    at = Vec3(*(place - below))
    return float(ground_detail(at, footprint, CELL, Vec3(*wholes), Vec3(*parts)).north)


def noise_at(place: np.ndarray, footprint: float) -> GroundNoise:
    """Noise beside a point of the ground. [m]"""
    origins = [
        lattice_origin(x, BOTTOM, CELL)
        for x in BOTTOM * planet_frame(20.0, 5.0, 0.0)[:, 2] / BOTTOM
    ]
    wholes, parts = zip(*origins, strict=True)
    return ground_detail(Vec3(*place), footprint, CELL, Vec3(*wholes), Vec3(*parts))


def test_the_ground_stays_where_it_is_when_the_observer_moves() -> None:
    # Two observers see the same stone: the sum from either origin is one place of the lattice.
    random = np.random.default_rng(3)
    for _ in range(40):
        latitude, longitude = random.uniform([-80.0, -180.0], [80.0, 180.0])
        here = BOTTOM * planet_frame(latitude, longitude, 0.0)[:, 2]
        there = BOTTOM * planet_frame(latitude + 1e-4, longitude - 1e-4, 0.0)[:, 2]
        place = here + random.uniform(-5.0, 5.0, 3)
        assert_allclose(detail(place, there, 0.01), detail(place, here, 0.01), atol=1e-6)


def test_nothing_is_finer_than_two_pixels() -> None:
    # Cells of the coarsest size span STEP**(OCTAVES - 1) of the finest.
    here = BOTTOM * planet_frame(30.0, 40.0, 0.0)[:, 2]
    coarsest = CELL * STEP ** (OCTAVES - 1)
    assert detail(here, here, 0.51 * coarsest) == 0.0
    assert detail(here, here, 0.4 * coarsest) != 0.0
    assert_allclose(coarsest, math.pi * BOTTOM / 2700.0, rtol=1e-12)  # a texel


def test_octaves_fall_from_a_deviation_of_one() -> None:
    # Independent octaves whose deviations fall by f: the sum of their squares is 1/(1 - f²). Places
    # lie 40 km and more apart, in other cells of all sizes.
    random = np.random.default_rng(4)
    here = BOTTOM * planet_frame(-10.0, 100.0, 0.0)[:, 2]
    values = [detail(here + 4e5 * step, here, 0.01) for step in random.normal(size=(4000, 3))]
    assert_allclose(np.mean(values), 0.0, atol=0.08)
    assert_allclose(np.std(values), math.sqrt(1.0 / (1.0 - DISPLACED_FALL**2)), rtol=0.08)


def test_a_sharper_coast_keeps_the_share_of_water() -> None:
    # Symmetry about a half: over a straight coast, between texels of land and of water, the mean is
    # that of the interpolated share.
    shares = (np.arange(1000) + 0.5) / 1000.0
    for width in (1 / 64, 0.1, 0.7, 1.0):
        assert_allclose(np.mean([sharper_share(x, width) for x in shares]), 0.5, atol=1e-9)
    assert sharper_share(0.49, 1 / 64) == 0.0
    assert [sharper_share(x, 1 / 64) for x in (0.0, 1.0)] == [0.0, 1.0]


def test_edges_between_texels_keep_the_mean_and_the_order() -> None:
    # Odd about the mean of the extremes: over a straight edge, where values rise evenly, their mean
    # remains. A quarter of the way, the fade of Perlin, 6 x⁵ - 15 x⁴ + 10 x³, is 0.1035 and then
    # 0.00935: pixels far smaller than a texel have a share EDGED of it.
    values = 0.2 + 0.6 * (np.arange(1000) + 0.5) / 1000.0
    for width in (1 / 256, 0.5, 1.0):
        sharp = np.array([edged(x, 0.2, 0.8, width) for x in values])
        assert_allclose(np.mean(sharp), 0.5, atol=1e-9)
        assert np.all(np.diff(sharp) > 0.0)
    assert edged(0.35, 0.2, 0.8, 1.0) == 0.35
    assert_allclose(edged(0.35, 0.2, 0.8, 0.0), 0.35 + 0.6 * EDGED * (0.00935 - 0.25), atol=1e-4)
    for outside in (0.2, 0.8, 0.9):
        assert_allclose(edged(outside, 0.2, 0.8, 0.0), outside, atol=1e-12)


def test_shallow_water_has_a_third_of_its_width() -> None:
    # The integral of (1 - x)² from 0 to 1, along a coast at which the share rises by 1 in a texel.
    shares = 0.5 + (np.arange(1000) + 0.5) / 2000.0
    assert_allclose(np.sum([shoal(x) for x in shares]) / 2000.0, SHOAL / 3.0, rtol=1e-4)


def test_the_grain_continues_the_contrast_of_a_map() -> None:
    # Squares of four texels whose deviations are 1/16 and 1/8 of their means: each octave has half
    # of the coarser one; of the first the map keeps half. Eight bits of sRGB: to 5 %.
    def level(rows: int, contrast: float) -> np.ndarray:
        signs = np.where(np.add.outer(np.arange(rows), np.arange(2 * rows)) % 2, 1.0, -1.0)
        texels = np.zeros((rows, 2 * rows, 4), np.uint8)
        values = np.multiply.outer(1.0 + contrast * signs, [0.6, 0.4, 0.3])
        texels[..., :3] = np.rint(255.0 * srgb_encode(values))
        return texels

    levels = [level(192, 1 / 16), level(96, 0.0), level(48, 1 / 8), level(24, 0.0), level(12, 0.0)]
    grain = grain_of(levels)
    assert_allclose(grain.fall, 0.5, rtol=0.05)
    assert_allclose(grain.contrast, 1 / 32, rtol=0.06)

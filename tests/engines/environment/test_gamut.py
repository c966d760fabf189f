"""Colours without negatives keep their luminance."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.engines.environment.gamut import bring_into_gamut, grey_of, without_negatives


def test_luminance_stays_and_no_channel_is_negative() -> None:
    generator = np.random.default_rng(2)
    rgb = generator.normal(0.5, 0.6, (2000, 3))
    moved, change = without_negatives(rgb)
    lit = grey_of(rgb) > 0.0
    # three ones have luminance 1 to the seven decimals of the matrix
    assert_allclose(grey_of(moved)[lit], grey_of(rgb)[lit], rtol=1e-6)
    assert moved.min() >= 0.0
    assert_array_equal(moved[~lit & (rgb.min(axis=1) < 0.0)], 0.0)
    assert change.share == np.mean(rgb.min(axis=1) < 0.0)


def test_colours_inside_are_untouched() -> None:
    rgb = np.random.default_rng(3).uniform(0.0, 2.0, (4, 5, 3))
    moved, change = without_negatives(rgb)
    assert_array_equal(moved, rgb)
    assert (change.share, change.largest) == (0.0, 0.0)


def test_the_largest_change_is_of_a_channel_over_luminance() -> None:
    rgb = np.array([[1.0, 1.0, 1.0], [1.0, 1.0, -0.5]])
    moved, change = without_negatives(rgb)
    grey = grey_of(rgb[1])
    assert_allclose(change.largest, np.abs(moved[1] - rgb[1]).max() / grey, rtol=1e-12)


def test_a_picture_is_mapped_where_it_stands_as_all_at_once() -> None:
    rgb = np.random.default_rng(4).normal(0.5, 0.6, (700, 600, 3)).astype(np.float32)
    wanted, change = without_negatives(rgb)
    found = bring_into_gamut(rgb)
    assert_allclose(rgb, wanted.astype(np.float32), rtol=0.0)
    assert_allclose([found.share, found.largest], [change.share, change.largest], rtol=1e-9)

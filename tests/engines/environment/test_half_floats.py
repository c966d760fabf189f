"""Scales of maps in half floats: nothing infinite, nothing lost."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.engines.environment.files import half_scale
from airlight.image.exr import LARGEST_HALF


@pytest.mark.parametrize("peak", [1e-8, 1.0, 65504.0, 65505.0, 2.4e6, 1e30])
def test_the_brightest_texel_is_finite_at_a_power_of_two(peak: float) -> None:
    rgb = np.full((4, 8, 3), 1e-3 * peak)
    rgb[0, 0] = peak
    scale = half_scale(rgb)
    assert np.isfinite(np.float16(peak * scale))
    assert np.log2(scale) == np.round(np.log2(scale))
    if peak > LARGEST_HALF:  # and uses the range
        assert peak * scale > 0.49 * LARGEST_HALF


def test_a_night_is_raised_and_a_day_is_left() -> None:
    night = np.full((4, 8, 3), 3e-7)
    assert half_scale(night) * 3e-7 >= 2.0**-10
    assert half_scale(np.full((4, 8, 3), 12.0)) == 1.0


def test_a_moon_in_the_night_limits_how_far_it_is_raised() -> None:
    night = np.full((4, 8, 3), 1e-6)
    night[0, 0] = 1e3
    assert half_scale(night) * 1e3 <= LARGEST_HALF


def test_darkness_has_scale_one() -> None:
    assert half_scale(np.zeros((2, 4, 3))) == 1.0


def test_a_night_without_any_light_is_not_raised_without_end() -> None:
    assert half_scale(np.full((2, 4, 3), 1e-14)) == 2.0**24

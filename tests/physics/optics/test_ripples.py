"""Means over ripples: light is neither lost nor gained, and what is resolved stays."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.physics.optics.phase_table import moments
from airlight.physics.optics.ripples import ripple_means

RIPPLE = 0.6
EVEN = np.linspace(0.0, 180.0, 801)
SOLID = np.full_like(EVEN, 0.25 / np.pi)


def rippled(angles: np.ndarray) -> np.ndarray:
    return 0.25 / np.pi * (1.0 + 0.9 * np.cos(2.0 * np.pi * angles / RIPPLE))


def test_coarse_samples_of_ripples_keep_their_light() -> None:
    # The law: a ripple adds nothing in the mean; straight logarithms lose 15 %.
    before = moments(EVEN, rippled(EVEN)[None], 0)[0, 0]
    means = ripple_means(EVEN, rippled(EVEN)[None], RIPPLE)
    assert before < 0.9
    assert_allclose(moments(EVEN, means, 0), 1.0, rtol=2e-3)
    assert_allclose(means[0, 10:-10], SOLID[10:-10], rtol=5e-3)


def test_resolved_ripples_stay() -> None:
    # By definition: twelve angles a ripple resolve it.
    fine = np.linspace(0.0, 180.0, 4001)
    rows = rippled(fine)[None]
    assert_array_equal(ripple_means(fine, rows, RIPPLE), rows)
    mixed = np.concatenate([fine[fine < 20.0], EVEN[EVEN >= 20.0]])
    means = ripple_means(mixed, rippled(mixed)[None], RIPPLE)
    assert_allclose(means[0, mixed < 19.0], rippled(mixed[mixed < 19.0]), rtol=1e-12)
    assert_allclose(means[0, (mixed > 22.0) & (mixed < 175.0)], 0.25 / np.pi, rtol=1e-2)


def test_smooth_light_stays_smooth() -> None:
    # A window of three ripples, 1.8°, changes a curve by half its second moment, 0.053 square
    # degrees, times its second derivative: 2e-5 of cos θ.
    smooth = (2.0 + np.cos(np.radians(EVEN)))[None]
    assert_allclose(ripple_means(EVEN, smooth, RIPPLE)[0, 10:-10], smooth[0, 10:-10], rtol=1e-4)

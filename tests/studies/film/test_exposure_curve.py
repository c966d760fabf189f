"""Exposure over a film: smooth where the light is smooth, and without a jump where it jumps."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.studies.film.exposure_curve import ExposureCurve, metered_numbers
from airlight.studies.film.plan import FilmPlan


def test_light_that_fades_evenly_is_followed_exactly() -> None:
    # neither the means nor the curve bend a straight line
    numbers = [0, 10, 20, 30, 40]
    curve = ExposureCurve(numbers, [0.1 * n - 5.0 for n in numbers])
    found = [curve.at(n) for n in range(41)]
    assert_allclose(found, 0.1 * np.arange(41) - 5.0, atol=1e-6)


def test_a_step_of_the_light_becomes_a_ramp() -> None:
    # the weights 1, 4, 6, 4, 1 leave at most 6/16 of a step between two metered frames, and a
    # monotone cubic is at most three times as steep as its chord
    curve = ExposureCurve(range(0, 201, 10), [0.0] * 10 + [8.0] * 11)
    found = np.array([curve.at(n) for n in range(201)])
    assert np.diff(found).max() <= 3.0 * 8.0 * 6.0 / 16.0 / 10.0 + 1e-6
    assert np.all(np.diff(found) >= -1e-6)
    assert_allclose(found[[0, -1]], [0.0, 8.0], atol=1e-6)


@given(st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=12))
def test_no_frame_jumps(metered: list[float]) -> None:
    # the change from frame to frame is bounded by the slope of a monotone cubic
    curve = ExposureCurve(range(0, 12 * len(metered), 12), metered)
    found = np.array([curve.at(n) for n in range(12 * len(metered) - 11)])
    steepest = 3.0 * (max(metered) - min(metered) + 1e-6) / 12.0
    assert np.abs(np.diff(found)).max() <= steepest


def test_metered_frames_hold_both_ends_and_are_three_a_second() -> None:
    numbers = metered_numbers(FilmPlan(frames=91, rate=30.0))
    assert numbers == list(range(0, 91, 10))
    assert metered_numbers(FilmPlan(frames=1)) == [0]
    assert metered_numbers(FilmPlan(frames=2)) == [0, 1]
    assert metered_numbers(FilmPlan(frames=4)) == [0, 1, 2, 3]
    assert metered_numbers(FilmPlan(frames=13, rate=30.0)) == list(range(0, 13, 2))
    uneven = metered_numbers(FilmPlan(frames=37, rate=24.0))
    assert (uneven[0], uneven[-1]) == (0, 36)
    assert max(np.diff(uneven)) - min(np.diff(uneven)) <= 1

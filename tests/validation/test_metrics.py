"""Error metrics against values computed by hand."""

from __future__ import annotations

from math import exp, log, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.validation.metrics import (
    beyond_noise,
    in_standard_errors,
    largest_by_chance,
    log_ratio_rms,
    relative_errors,
    summarise,
)


def test_summary_of_five_errors_is_the_one_by_hand():
    # Sizes 1..5 %: the middle one, and 95 % of the way: 4 + 0.8 (linear between order statistics).
    found = summarise([-0.05, 0.01, 0.03, -0.02, 0.04])
    assert_allclose([found.median, found.high, found.largest], [0.03, 0.048, 0.05], rtol=1e-12)
    assert found.count == 5


def test_what_does_not_count_is_left_out_and_nothing_is_no_number():
    found = summarise([0.5, 0.1], [False, True])
    assert (found.count, found.largest) == (1, 0.1)
    assert np.isnan(summarise([], []).largest)


def test_relative_errors_keep_their_sign_and_know_zero():
    # By definition; a light where none should be is infinitely wrong, and NaN stays NaN.
    found = relative_errors([0.9, 2.2, 0.0, 1e-9, np.nan], [1.0, 2.0, 0.0, 0.0, 1.0])
    assert_allclose(found, [-0.1, 0.1, 0.0, np.inf, np.nan], rtol=1e-12)


def test_noise_of_three_standard_errors_explains_a_difference_and_no_more():
    got, known, deviation = [1.029, 1.031, 0.96], [1.0, 1.0, 1.0], [0.01, 0.01, 0.01]
    assert_allclose(beyond_noise(got, known, deviation), [0.0, 0.031, -0.04], rtol=1e-12)
    assert_allclose(in_standard_errors(got, known, deviation), [2.9, 3.1, -4.0], rtol=1e-12)


def test_without_noise_any_difference_is_infinitely_many_standard_errors():
    assert_array_equal(in_standard_errors([1.0, 2.0, 0.5], 1.0, 0.0), [0.0, np.inf, -np.inf])


def test_log_ratio_weighs_too_bright_like_too_dark():
    # ln(e) and ln(1/e) both squared are 1; weights 3:1 of ln² = 4 and 0 give 3·4/4.
    assert_allclose(log_ratio_rms([exp(1.0), exp(-1.0)], 1.0), 1.0, rtol=1e-12)
    assert_allclose(log_ratio_rms([exp(2.0), 1.0], 1.0, [3.0, 1.0]), sqrt(3.0), rtol=1e-12)
    assert_allclose(log_ratio_rms(2.0, 1.0), log(2.0), rtol=1e-12)


@pytest.mark.parametrize("count", [1, 50, 2000])
def test_largest_of_pure_noise_is_beyond_its_bound_half_the_time(count):
    # By trial: 4000 draws of the largest of ``count`` values; the share has an error of 0.8 %.
    rng = np.random.default_rng(3)
    draws = np.array([np.abs(rng.standard_normal(count)).max() for _ in range(4000)])
    assert_allclose((draws > largest_by_chance(count)).mean(), 0.5, atol=0.03)

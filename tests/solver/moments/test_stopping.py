"""Convergence of orders of scattering: series of known sums."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ConvergenceError
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.javascript import JAVASCRIPT
from airlight.render.gpu.emit.shader_types import F32, I32, LocalArray
from airlight.solver.moments.acceleration import combine, mixing_weights
from airlight.solver.moments.convergence import change_at, count_at, geometric_tail
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.stopping import Iteration, Stopping

THIN, THICK = np.zeros(2), np.ones(2)
SWEEPS = Stopping.of_sweeps(settings_for("preview"))
PASSES = Stopping.of_passes(settings_for("preview"))


def light(values):
    """Mean radiances of two radii, one sun and two wavelengths: bright, and a given value."""
    return np.array([[[1.0, 1.0]], [[values, values]]], np.float32)


def follow(iteration, ratio, orders):
    """Sums of the first orders of a geometric series, equal at both radii."""
    total = 0.0
    for order in range(orders):
        before, total = total, total + ratio**order
        iteration.update(np.full((2, 1, 2), before), np.full((2, 1, 2), total))
    return total


@pytest.mark.parametrize("ratio", [0.35, 0.5, 0.7])
def test_what_is_to_come_of_a_geometric_series_is_told(ratio):
    # After n orders all further ones add ratio^n/(1 - ratio), relative to the sum so far.
    iteration = Iteration(SWEEPS, THIN, 2)
    total = follow(iteration, ratio, 16)
    expected = ratio**16 / (1.0 - ratio) / total
    # The changes are relative to sums that still grow: by 0.5 % at the slowest.
    assert_allclose(iteration.remaining_error, expected, rtol=0.02)


def test_it_goes_on_until_the_tolerance_is_met():
    # Of halves, 1 % is met when 2^(1 - n) / 2 falls below it: after eight orders.
    iteration = Iteration(SWEEPS, THIN, 2)
    assert iteration.unfinished()
    follow(iteration, 0.5, 6)
    assert iteration.unfinished()
    assert 0.0 < iteration.progress < 1.0
    iteration = Iteration(SWEEPS, THIN, 2)
    follow(iteration, 0.5, 8)
    assert not iteration.unfinished()
    assert iteration.progress == 1.0


def test_one_order_never_suffices():
    # A first guess that is already the answer looks the same as one that makes no progress.
    iteration = Iteration(SWEEPS, THIN, 2)
    iteration.update(light(0.5), light(0.5))
    assert iteration.remaining_error.max() == 0.0
    assert iteration.unfinished()
    iteration.update(light(0.5), light(0.5))
    assert not iteration.unfinished()


def test_giving_up_says_what_was_still_to_come():
    # Light that oscillates never converges.
    iteration = Iteration(PASSES, THIN, 2)
    for order in range(PASSES.most_sweeps):
        assert iteration.unfinished()
        iteration.update(light(0.5 + order % 2), light(0.5 + (order + 1) % 2))
    with pytest.raises(ConvergenceError, match=f"after {PASSES.most_sweeps} sweeps"):
        iteration.unfinished()


def test_lanes_without_a_wavelength_do_not_count():
    # The second lane changes by half, but it has no wavelength.
    iteration = Iteration(SWEEPS, THIN, 1)
    for _ in range(3):
        iteration.update(np.ones((1, 1, 2)) * [1.0, 0.5], np.ones((1, 1, 2)))
    assert iteration.remaining_error.shape == (1,)
    assert not iteration.unfinished()
    assert_allclose(iteration.weights()[:, 1], [0.0, 0.0, 1.0])


def test_the_night_of_thick_air_counts_less_for_sweeps_than_for_passes():
    # A node 1e-4 as bright changes by a tenth: in thin air that counts fully; in thick air by its
    # light over 0.05 of the brightest, 1/500, for sweeps, and the fourth root of it for passes.
    def remaining_error(stopping, thick):
        iteration = Iteration(stopping, thick, 2)
        iteration.update(light(0.9e-4), light(1e-4))
        return float(iteration.remaining_error.max())

    thin = remaining_error(SWEEPS, THIN)
    assert_allclose(thin, 0.1, rtol=1e-5)
    assert_allclose(remaining_error(PASSES, THIN), thin)
    assert_allclose(remaining_error(SWEEPS, THICK), thin / 500.0, rtol=1e-5)
    assert_allclose(remaining_error(PASSES, THICK), thin / 500.0**0.25, rtol=1e-5)
    assert PASSES.tolerance_in(THICK) < SWEEPS.tolerance_in(THICK) == SWEEPS.tolerance


def test_mixed_residuals_are_as_small_as_least_squares_make_them():
    # The same by NumPy's least squares over the changes, for residuals in any direction.
    residuals = np.random.default_rng(7).normal(size=(5, 40))
    changes = np.diff(residuals, axis=0)
    best = np.linalg.lstsq(changes.T, residuals[-1], rcond=None)[0]
    weights = mixing_weights(residuals)
    assert_allclose(weights.sum(), 1.0, rtol=1e-12)
    assert_allclose(weights @ residuals, residuals[-1] - best @ changes, atol=1e-8)


def test_a_page_can_run_the_rule():
    # The formulas of one node and one wavelength are in the subset that is emitted as JavaScript.
    emitter = Emitter(JAVASCRIPT)
    for function in (change_at, count_at, geometric_tail):
        emitter.add(function, F32, F32, F32)
    emitter.add(combine, LocalArray(6 * 7), I32, LocalArray(7))
    text = emitter.functions_text()
    for name in ("change_at", "count_at", "geometric_tail", "combine"):
        assert f"function {name}(" in text


def test_residuals_that_stand_still_are_not_mixed():
    # No combination of equal residuals is smaller: the equations are singular.
    assert_allclose(mixing_weights(np.ones((4, 6))), [0.0, 0.0, 0.0, 1.0])

"""Next iterate after a sweep, and its residual, by plain array operations."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.solver.moments.convergence import LEAST
from airlight.solver.moments.harmonics import POLARISED
from airlight.solver.moments.iterate import POLARISED_OVER_RELAXATION
from airlight.solver.moments.iterate_update import (
    add_first_order,
    convergence_quantities,
    next_iterate,
)

SHAPE = (4, 5, 6 + POLARISED, 8)


def light(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    field = rng.uniform(0.5, 1.0, SHAPE).astype(np.float32)
    return field, rng.uniform(0.5, 1.0, (4, 5, 8)).astype(np.float32)


def test_the_residual_is_sweep_plus_first_order_less_the_light_before() -> None:
    rng = np.random.default_rng(1)
    swept, first, before, residual = light(rng), light(rng), light(rng), light(rng)
    wanted = [one + other for one, other in zip(swept, first, strict=True)]
    add_first_order(swept, first, before, residual)
    for got, sums, total, old in zip(residual, swept, wanted, before, strict=True):
        assert_array_equal(sums, total)
        assert_array_equal(got, total - old)


@pytest.mark.parametrize("synthetic", [True, False])
def test_next_iterate_is_the_light_plus_the_weighted_residual(synthetic: bool) -> None:
    # the formulas of the docstring over whole arrays, single precision apart
    rng = np.random.default_rng(2)
    old, residual, accelerated, swept = light(rng), light(rng), light(rng), light(rng)
    swept[0][1, 2, 0, 3] = 100.0  # far above the iterate: there the sweep is kept
    swept[1][2, 3, 4] = 100.0
    weight = rng.uniform(0.0, 1.0, (4, 5, 8)).astype(np.float32)
    relaxation = 0.5
    got = next_iterate(
        old,
        residual,
        accelerated if synthetic else None,
        swept,
        weight,
        POLARISED_OVER_RELAXATION,
        relaxation,
    )
    weights = weight[:, :, None] if synthetic else np.float32(0.0)
    change = residual[0] + weights * (accelerated[0] - residual[0])
    if synthetic:
        change[:, :, -POLARISED:] *= POLARISED_OVER_RELAXATION[:, None]
    field = old[0] + relaxation * change
    dark = field[:, :, :1] <= LEAST * swept[0][:, :, :1]
    assert dark.sum() == 1
    assert_allclose(got[0], np.where(dark, swept[0], field), rtol=3e-7)
    change = residual[1] + (weight if synthetic else 0.0) * (accelerated[1] - residual[1])
    sky = old[1] + relaxation * change
    assert_allclose(got[1], np.where(sky <= LEAST * swept[1], swept[1], sky), rtol=3e-7)


def test_mean_radiance_and_each_polarised_moment_measure_convergence() -> None:
    # their changes, all over the mean radiance
    rng = np.random.default_rng(3)
    before, after = light(rng)[0], light(rng)[0]
    earlier, mean = (
        one.reshape(4, 5, 1 + POLARISED, 8) for one in convergence_quantities(before, after)
    )
    assert_array_equal(mean, np.repeat(after[:, :, :1], 1 + POLARISED, axis=2))
    which = [0, *range(-POLARISED, 0)]
    assert_allclose(mean - earlier, (after - before)[:, :, which], rtol=0, atol=2e-7)

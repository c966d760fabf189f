"""What is done to the light after a sweep, by plain array operations."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.solvers.moments.completing import image, steering, sum_orders
from airlight.solvers.moments.convergence import LEAST
from airlight.solvers.moments.harmonics import POLARISED
from airlight.solvers.moments.iterate import FURTHER

SHAPE = (4, 5, 6 + POLARISED, 8)


def light(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    field = rng.uniform(0.5, 1.0, SHAPE).astype(np.float32)
    return field, rng.uniform(0.5, 1.0, (4, 5, 8)).astype(np.float32)


def test_a_sweep_gets_the_first_order_and_loses_the_light_before() -> None:
    rng = np.random.default_rng(1)
    swept, first, before, more = light(rng), light(rng), light(rng), light(rng)
    wanted = [one + other for one, other in zip(swept, first, strict=True)]
    sum_orders(swept, first, before, more)
    for got, sums, total, old in zip(more, swept, wanted, before, strict=True):
        assert_array_equal(sums, total)
        assert_array_equal(got, total - old)


@pytest.mark.parametrize("completed", [True, False])
def test_an_image_is_the_light_and_its_trusted_change(completed: bool) -> None:
    # the formulas of the docstring over whole arrays, single precision apart
    rng = np.random.default_rng(2)
    old, more, every, swept = light(rng), light(rng), light(rng), light(rng)
    swept[0][1, 2, 0, 3] = 100.0  # far above the image: there the sweep is kept
    swept[1][2, 3, 4] = 100.0
    trusted = rng.uniform(0.0, 1.0, (4, 5, 8)).astype(np.float32)
    step = 0.5
    got = image(old, more, every if completed else None, swept, trusted, FURTHER, step)
    shares = trusted[:, :, None] if completed else np.float32(0.0)
    change = more[0] + shares * (every[0] - more[0])
    if completed:
        change[:, :, -POLARISED:] *= FURTHER[:, None]
    field = old[0] + step * change
    dark = field[:, :, :1] <= LEAST * swept[0][:, :, :1]
    assert dark.sum() == 1
    assert_allclose(got[0], np.where(dark, swept[0], field), rtol=3e-7)
    sky = old[1] + step * (more[1] + (trusted if completed else 0.0) * (every[1] - more[1]))
    assert_allclose(got[1], np.where(sky <= LEAST * swept[1], swept[1], sky), rtol=3e-7)


def test_mean_radiance_and_each_polarised_moment_steer() -> None:
    # their changes, all over the mean radiance
    rng = np.random.default_rng(3)
    before, after = light(rng)[0], light(rng)[0]
    earlier, mean = (one.reshape(4, 5, 1 + POLARISED, 8) for one in steering(before, after))
    assert_array_equal(mean, np.repeat(after[:, :, :1], 1 + POLARISED, axis=2))
    which = [0, *range(-POLARISED, 0)]
    assert_allclose(mean - earlier, (after - before)[:, :, which], rtol=0, atol=2e-7)

"""Detail of the ground on a device, in single precision."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from airlight.scene.ground_detail import PERIOD, finest_cell, ground_detail, smooth_noise

CELL = np.float32(finest_cell(6371e3, 2700))


def test_noise_is_that_of_the_processor(on_gpu: Callable[..., Any]) -> None:
    # Places of up to 256 cells are accurate to 2e-5 in single precision, at a slope of 4 at most.
    places = np.random.default_rng(1).uniform(-3.0, PERIOD, (3, 500)).astype(np.float32)
    wanted = [smooth_noise(*map(float, place)) for place in places.T]
    assert_allclose(on_gpu(smooth_noise, *places), wanted, atol=2e-4)


def test_detail_near_the_observer_is_that_of_the_processor(on_gpu: Callable[..., Any]) -> None:
    # Up to a thousand of the finest cells away, where pixels are as large as they are.
    random = np.random.default_rng(2)
    away = 10.0 ** random.uniform(-1.0, 2.0, 500)
    steps = (random.normal(size=(3, 500)) * away).astype(np.float32)
    footprint = (1e-3 * away).astype(np.float32)
    wholes = np.floor(random.uniform(0.0, 4194304.0, (3, 500))).astype(np.float32)
    parts = random.uniform(0.0, 1.0, (3, 500)).astype(np.float32)
    cell = np.full(500, CELL)
    given = [*steps, footprint, cell, *wholes, *parts]
    wanted = [ground_detail(*map(float, values)) for values in zip(*given, strict=True)]
    assert_allclose(on_gpu(ground_detail, *given), wanted, atol=2e-3)

"""Rows of the synthetic operator, by plain array operations."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.kernel.lanes import LANES
from airlight.solver.moments.levels import finer_weights
from airlight.solver.moments.synthetic_operator import gather_levels, project_radii

ANGLES, RADII, PAIRS = 5, 7, 9


@pytest.mark.parametrize("parts", [2, 3])
def test_weights_at_levels_go_to_the_radii_that_these_are_interpolated_from(parts: int) -> None:
    # Second method: the matrix product in double precision.
    rng = np.random.default_rng(1)
    cubics = finer_weights(RADII, parts)
    weights = rng.uniform(0.5, 1.0, (ANGLES, len(cubics), PAIRS, LANES)).astype(np.float32)
    out = np.ones((ANGLES, RADII, PAIRS, LANES), np.float32)  # to which the weights are added
    gather_levels(cubics.astype(np.float32), weights, out)
    wanted = 1.0 + np.einsum("fr,afkw->arkw", cubics, weights)
    assert_allclose(out, wanted, rtol=1e-6)


@pytest.mark.parametrize(("first", "width"), [(0, 4), (4, 3), (7, 2)])
def test_rays_are_projected_onto_quantities_of_their_radius(first: int, width: int) -> None:
    # Second method: the matrix product in double precision. The last column stays as it is.
    rng = np.random.default_rng(2)
    weights = rng.uniform(0.5, 1.0, (ANGLES, RADII, PAIRS, LANES)).astype(np.float32)
    projections = rng.uniform(-1.0, 1.0, (width, ANGLES))
    out = np.full((width, RADII * width + 1, LANES), 3.0, np.float32)
    project_radii(projections, weights, first, width, out)
    wanted = np.einsum("qa,arkw->qrkw", projections, weights[:, :, first : first + width])
    assert_allclose(out[:, :-1], wanted.reshape(width, -1, LANES), atol=2e-6)
    assert_array_equal(out[:, -1], np.float32(3.0))

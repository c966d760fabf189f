"""A projection by its number is the one by its name."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.projected import projected_ray, projected_rays


@pytest.mark.parametrize("which", range(len(PROJECTIONS)), ids=list(PROJECTIONS))
def test_a_projection_s_number_is_its_place(which: int) -> None:
    # The projection's own formula, uncompiled, and the grid of pixels: to rounding.
    projection = list(PROJECTIONS.values())[which]
    shaped = {"equirectangular": (8, 4), "cubemap": (24, 4), "octahedral": (6, 6)}
    width, height = shaped.get(projection.name, (7, 5))
    fov = math.radians(projection.field_of_view)
    x, y = np.arange(width) + 0.5, np.arange(height) + 0.5
    wanted = projected_rays(projection.name, x, y, width, height, fov)
    for row in range(height):
        for column in range(width):
            seen = projected_ray(which, x[column], y[row], width, height, fov)
            assert_allclose(seen, wanted[row, column], rtol=0.0, atol=1e-14)
            own = projection.ray.py_func(x[column], y[row], width, height, fov)
            assert_allclose(seen, own, rtol=0.0, atol=1e-14)


def test_no_pixel_on_the_rim_of_a_fisheye_is_lost_to_rounding() -> None:
    # 3-4-5: points on the rim itself belong to the circle, the next ones outside do not.
    x, y = np.array([0.0, 1.0, 5.0]), np.array([5.0, 2.0, 0.0])
    seen = projected_rays("fisheye", x, y, 10, 10, math.pi)
    lit = np.any(seen != 0.0, axis=-1)
    assert_array_equal(lit, [[True, True, True], [False, True, True], [False, False, True]])

"""Values of texels: linear functions are left alone, convex ones lose their bias."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.engines.baking.texel_values import balanced, fill_angles


def test_a_linear_function_is_left_as_it_is() -> None:
    # Its second difference is 0.
    r, s = np.meshgrid(np.arange(1.0, 7.0), np.arange(1.0, 6.0), indexing="ij")
    values = (2.0 * r + 3.0 * s)[:, None, :, None, None]
    assert_allclose(balanced(values), values, rtol=1e-14)


def test_a_parabola_has_no_mean_error_between_texels() -> None:
    # ∫ over a cell of the linear interpolation less x²: each axis alone, at inner texels.
    x = np.arange(12.0) + 5.0
    t = (np.arange(1000) + 0.5) / 1000.0
    for axis in (0, 2):
        values = np.moveaxis((x**2)[:, None, None, None, None], 0, axis)
        made = balanced(values).ravel()
        for k in range(1, 10):
            between = made[k] * (1.0 - t) + made[k + 1] * t
            assert_allclose((between - (x[k] + t) ** 2).mean(), 0.0, atol=1e-6)


def test_an_edge_of_the_light_does_not_become_negative() -> None:
    values = np.zeros((8, 1, 8, 1, 1))
    values[5:] = 1.0
    made = balanced(values)
    assert made.min() >= 0.0
    assert_allclose(made[:4], 0.0, atol=0)
    assert made.max() <= 1.2


def test_impossible_angles_follow_the_shape_at_the_next_lower_sun() -> None:
    # One view, two suns: the upper has the angle ν = 0 alone; light falls as 2 + ν at both.
    angles = np.linspace(-1.0, 1.0, 9)
    nu = np.stack([angles, np.zeros(9)])[None, None]
    light = (2.0 + angles)[:, None]
    relative = np.stack([light, np.full((9, 1), 3.0 * 2.0)])[None, None]
    filled = fill_angles(relative, nu)
    assert_allclose(filled[0, 0, 0], light, rtol=1e-14)
    assert_allclose(filled[0, 0, 1], 3.0 * light, rtol=1e-14)

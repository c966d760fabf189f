"""Clouds under the suns of their own places."""

import numpy as np

from airlight.render.clouds.local_sun import LocalSun, same_everywhere


def test_light_is_over_that_of_the_sun_of_the_box():
    light = np.array([[[1.0]], [[3.0]], [[4.0]]])
    local = LocalSun(np.array([0.0, 0.5, 1.0]), light, np.array([8.0, 2.0, 1.0]))
    sines = np.array([0.0, 0.25, 0.5, 1.0])
    np.testing.assert_allclose(local.light_over(sines, 0.5)[:, 0, 0], [1 / 3, 2 / 3, 1.0, 4 / 3])
    np.testing.assert_allclose(local.depth_over(sines, 0.5), [4.0, 2.0, 1.0, 0.5])


def test_light_that_only_follows_the_irradiance_is_the_same_everywhere():
    local = same_everywhere(3, 2)
    np.testing.assert_array_equal(local.light_over(np.array([-1.0, 0.3]), 0.2), np.ones((2, 3, 2)))
    np.testing.assert_array_equal(local.depth_over(np.array([-1.0, 0.3]), 0.2), [1.0, 1.0])

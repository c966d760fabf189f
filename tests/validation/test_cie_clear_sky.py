"""The CIE clear sky: its table, and what follows from its formula."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.validation.cie import (
    angle_to_sun,
    gradation,
    indicatrix,
    relative_luminance,
)

VIEWS = np.array([-85.0, -60.0, -30.0, 0.0, 30.0, 60.0, 75.0, 85.0])
TABLE = {
    30.0: [1.086, 0.519, 0.493, 1.0, 3.852, 1.726, 1.622, 1.733],
    50.0: [2.229, 0.940, 0.665, 1.0, 2.976, 6.874, 5.650, 5.482],
    60.0: [2.977, 1.236, 0.775, 1.0, 2.579, 13.479, 10.489, 9.738],
    70.0: [3.746, 1.568, 0.904, 1.0, 2.227, 10.297, 19.247, 17.196],
    80.0: [4.407, 1.895, 1.043, 1.0, 1.915, 7.732, 21.814, 29.960],
}


@pytest.mark.parametrize("sun", TABLE)
def test_principal_plane_meets_the_table(sun):
    # The reference text's golden numbers for type 12: half the last digit printed.
    azimuth = np.where(VIEWS < 0.0, 180.0, 0.0)
    assert_allclose(relative_luminance(sun, np.abs(VIEWS), azimuth), TABLE[sun], rtol=0, atol=5e-4)


def test_zenith_is_one_whatever_the_azimuth():
    # The formula divides by itself there.
    assert_allclose(relative_luminance(47.0, 0.0, [0.0, 33.0, 180.0]), 1.0, rtol=1e-14)


def test_both_factors_are_normalised_where_the_standard_says():
    # φ(90°) = 1, because e^{b/0} = 0; f(90°) = 1.
    assert_allclose(gradation(0.0), 1.0, atol=0)
    assert_allclose(indicatrix(np.pi / 2), 1.0, rtol=1e-15)


def test_angle_to_the_sun_is_exact_at_the_sun_and_opposite():
    # Spherical trigonometry: 0 at the sun itself, 90° + 60° over the zenith on the other side.
    assert_allclose(np.degrees(angle_to_sun(60.0, 60.0, 0.0)), 0.0, atol=2e-6)
    assert_allclose(np.degrees(angle_to_sun(60.0, 90.0, 180.0)), 150.0, rtol=1e-12)

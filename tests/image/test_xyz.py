"""The colour spaces against the definition of sRGB."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.image.xyz import chromaticity, luminance, rgb_to_xyz, xyz_to_rgb


def test_primaries_and_white_have_the_chromaticities_of_srgb():
    # IEC 61966-2-1 and ITU-R BT.709; the matrix has seven decimals, the white four.
    primaries = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
    printed = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]]
    assert_allclose(chromaticity(rgb_to_xyz(primaries)), printed, rtol=0, atol=6e-5)


def test_luminance_has_the_coefficients_of_bt_709():
    # ITU-R BT.709 prints 0.2126, 0.7152, 0.0722; with the white of this matrix, given to five
    # decimals, Lindbloom prints these.
    assert_allclose(luminance(np.eye(3)), [0.2126729, 0.7151522, 0.0721750], rtol=0, atol=1e-7)
    assert_allclose(luminance(np.eye(3)), [0.2126, 0.7152, 0.0722], rtol=0, atol=1e-4)


def test_the_two_directions_undo_each_other():
    colors = np.random.default_rng(0).normal(size=(50, 3))
    assert_allclose(rgb_to_xyz(xyz_to_rgb(colors)), colors, rtol=1e-12, atol=1e-14)


def test_float32_stays_float32():
    colors = np.ones((2, 3), dtype=np.float32)
    for function in (xyz_to_rgb, rgb_to_xyz, luminance, chromaticity):
        assert function(colors).dtype == np.float32
        assert function(colors.astype(np.float64)).dtype == np.float64
        assert function([[1, 1, 1]]).dtype == np.float64


def test_black_has_a_chromaticity_that_is_a_number():
    assert_array_equal(chromaticity([0.0, 0.0, 0.0]), [0.0, 0.0])

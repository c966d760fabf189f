"""Interpolation of positive spectra: exact for power laws, straight next to zeros."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.physics.spectra.power_law import power_law


def test_a_power_law_is_interpolated_exactly() -> None:
    # An exact limit: any exponent, rows in any order, between any two of them.
    rows = np.array([700.0, 400.0, 1000.0, 550.0])
    at = np.linspace(400.0, 1000.0, 61)
    for exponent in (-4.0, -1.14, 0.0, 3.0):
        assert_allclose(power_law(at, rows, 2.0 * rows**exponent), 2.0 * at**exponent, rtol=1e-12)


def test_the_optical_depth_between_two_bands_is_angstroms() -> None:
    # Ångström's law with the exponent of the two: 0.31 (550/440)^-1.144 = 0.240
    exponent = -np.log(0.19 / 0.31) / np.log(675.0 / 440.0)
    expected = 0.31 * (550.0 / 440.0) ** -exponent
    assert_allclose(power_law(550.0, [440.0, 675.0], [0.31, 0.19]), expected, rtol=1e-12)
    assert_allclose(expected, 0.240, rtol=0, atol=5e-4)


def test_next_to_a_zero_or_a_negative_value_it_is_straight() -> None:
    # By definition: no power law has a zero; intervals without one keep theirs.
    rows, values = [400.0, 500.0, 600.0, 864.0], [0.0, 1.0, 4.0, -2.0]
    assert_allclose(power_law([450.0, 732.0], rows, values), [0.5, 1.0], rtol=1e-12)
    assert_allclose(power_law(np.sqrt(500.0 * 600.0), rows, values), 2.0, rtol=1e-12)


def test_rows_keep_their_digits_and_ends_are_held() -> None:
    # By definition; solutions are kept under the digits of a medium.
    rows, values = [440.0, 550.0, 680.0], [0.31, 0.254, 0.19]
    assert_array_equal(power_law(rows, rows, values), values)
    assert_array_equal(power_law([430.0, 700.0], rows, values), [0.31, 0.19])
    assert_array_equal(power_law([100.0, 550.0], [550.0], [3.0]), [3.0, 3.0])

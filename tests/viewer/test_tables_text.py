"""Tables as text."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.viewer.tables_text import as_text, from_text


def test_every_number_comes_back_bit_by_bit() -> None:
    # a round trip, over all exponents and with both zeros
    bits = np.random.default_rng(1).integers(0, 2**32, 5000, np.uint32)
    values = np.concatenate([bits.view(np.float32), np.array([0.0, -0.0, np.inf], np.float32)])
    assert_array_equal(from_text(as_text(values)).view(np.uint32), values.view(np.uint32))


def test_fewer_digits_err_by_half_of_the_last_and_are_shorter() -> None:
    # rounding to nearest: 2^-15 for 14 digits behind the first
    values = np.random.default_rng(2).lognormal(0.0, 8.0, 4000).astype(np.float32)
    short = as_text(values, 14)
    assert_allclose(from_text(short), values, rtol=2.0**-15)
    assert np.abs(from_text(short) / values - 1.0).max() > 2.0**-16
    assert len(short) < 0.75 * len(as_text(values))

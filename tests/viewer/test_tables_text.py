"""Encoding of tables as text."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.viewer.browser.tables_text import as_text, from_text, rounded


@pytest.mark.parametrize("stride", [1, 4, 7, 9000])
def test_every_number_comes_back_bit_by_bit(stride: int) -> None:
    # a round trip, over all exponents and signs and with both zeros
    bits = np.random.default_rng(1).integers(0, 2**32, 5000, np.uint32)
    values = np.concatenate([bits.view(np.float32), np.array([0.0, -0.0, np.inf], np.float32)])
    assert_array_equal(from_text(as_text(values, stride)).view(np.uint32), values.view(np.uint32))


def test_neighbours_and_fewer_digits_make_it_shorter() -> None:
    # eight smooth curves interleaved: each number is close to that eight before it
    x = np.linspace(0.0, 1.0, 1000)[:, None]
    values = np.exp(-3.0 * x * np.arange(1, 9)).astype(np.float32)
    assert len(as_text(values, 8)) < 0.8 * len(as_text(values))
    short = rounded(values, 12)
    assert_allclose(short, values, rtol=2.0**-13)  # half the last binary digit
    assert np.abs(short / values - 1.0).max() > 2.0**-14
    assert len(as_text(short, 8)) < 0.7 * len(as_text(values, 8))

"""Tables as text."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from airlight.viewer.tables_text import as_text, from_text


def test_every_number_comes_back_bit_by_bit() -> None:
    # a round trip, over all exponents and with both zeros
    bits = np.random.default_rng(1).integers(0, 2**32, 5000, np.uint32)
    values = np.concatenate([bits.view(np.float32), np.array([0.0, -0.0, np.inf], np.float32)])
    assert_array_equal(from_text(as_text(values)).view(np.uint32), values.view(np.uint32))

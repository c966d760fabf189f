"""Lines of sight have arrays of one type, for which marches are compiled once."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from airlight.solver.lines_of_sight import LinesOfSight


def test_arrays_are_contiguous_and_writable_whatever_is_given() -> None:
    # a strided or read-only array has another type for the compiler
    given = np.arange(24.0).reshape(4, 6)
    constant = np.broadcast_to(3.0, 4)
    lines = LinesOfSight(*given.T[:3], constant, given[:, 4], given[:, 5] > 12.0)
    for array in vars(lines).values():
        assert array.flags.c_contiguous
        assert array.flags.writeable
    assert_array_equal(lines.mu_s, given[:, 2])
    assert_array_equal(lines.nu, constant)

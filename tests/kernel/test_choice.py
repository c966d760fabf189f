"""A chosen kernel gives the results of the kernels it was made of."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from airlight.kernel import compiled_loop, kernel
from airlight.kernel.choice import chosen_kernel


@kernel
def summed(x, y):
    return x + y, x


@kernel
def swapped(x, y):
    return y, x


@kernel
def zero(x, y):
    return 0.0, 0.0


either = chosen_kernel("either", [summed, swapped, zero], __name__)


@compiled_loop
def through_all(x, y, out):
    for which in range(out.shape[0]):
        out[which, 0], out[which, 1] = either(which, x, y)


def test_each_number_has_its_kernel_and_the_last_answers_beyond() -> None:
    # 2 + 3, exchanged, zero; from Python and from a compiled loop.
    assert [either(which, 2.0, 3.0) for which in range(3)] == [(5.0, 2.0), (3.0, 2.0), (0.0, 0.0)]
    out = np.empty((4, 2))
    through_all(2.0, 3.0, out)
    assert_array_equal(out, [[5.0, 2.0], [3.0, 2.0], [0.0, 0.0], [0.0, 0.0]])

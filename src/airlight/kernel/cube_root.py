"""Cube root of a positive number, six times as fast as a power."""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.kernel import kernel

#: Bits of a number of double precision whose exponent is two thirds of the bias: what a third of
#: the bits of any number lack of those of its cube root, with the least largest error, 3.5 %.
_BITS: Final = 0x2A9F7893782DA1CE


@kernel
def cube_root(x):
    """Cube root; 0 for negative numbers.

    An initial value from the exponent is refined by two Halley steps to a relative error of 2e-14,
    for numbers from 1e-90 to 1e90. Shaders and JavaScript use built-in functions.

    Examples
    --------
    >>> f"{cube_root(27.0):.12f}"
    '3.000000000000'
    >>> cube_root(-1.0)
    0.0
    """
    if not x > 0.0:
        return 0.0
    root = np.int64(np.float64(x).view(np.int64) // 3 + _BITS).view(np.float64)
    cube = root * root * root
    root = root * (cube + 2.0 * x) / (2.0 * cube + x)
    cube = root * root * root
    return root * (cube + 2.0 * x) / (2.0 * cube + x)

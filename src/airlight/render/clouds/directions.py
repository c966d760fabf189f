"""Real spherical harmonics of one direction, as in the solver of boxes."""

from __future__ import annotations

from math import factorial, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined

FloatArray = NDArray[np.float64]


def harmonic_norms(degree: int) -> FloatArray:
    """Factors of P_l^m cos mφ, shape (degree + 1, degree + 1). [1]"""
    out = np.zeros((degree + 1, degree + 1))
    for l in range(degree + 1):
        for m in range(l + 1):
            norm = (2 * l + 1) / (4 * pi) * factorial(l - m) / factorial(l + m)
            out[l, m] = sqrt(norm) * (sqrt(2.0) if m else 1.0)
    return out


@inlined
def fill_harmonics(x, y, z, norms, out):
    """Harmonics Y_lm of a unit vector, index l² + l + m, into ``out``. [1]

    Parameters
    ----------
    x, y, z : float
        Components to the east, to the north and upwards. [1]
    norms : array
        Result of ``harmonic_norms``.
    out : array, shape (terms,)
        Receives the values.
    """
    degree = norms.shape[0] - 1
    real, imaginary, first = 1.0, 0.0, 1.0
    for m in range(degree + 1):
        before, value = 0.0, first
        for l in range(m, degree + 1):
            if l > m:
                following = ((2 * l - 1) * z * value - (l + m - 1) * before) / (l - m)
                before, value = value, following
            scale = norms[l, m] * value
            out[l * l + l + m] = scale * real
            if m > 0:
                out[l * l + l - m] = scale * imaginary
        first *= 2 * m + 1
        real, imaginary = real * x - imaginary * y, real * y + imaginary * x

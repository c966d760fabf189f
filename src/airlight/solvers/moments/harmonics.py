"""Real spherical harmonics about the zenith, even in azimuth.

Y_lm(mu, phi) = K_lm P_l^m(mu) cos(m phi), orthonormal on the sphere, without the Condon-Shortley
sign. The light of a sphere's air is symmetric about the plane of zenith and star, so the sine
terms vanish and degree N has (N + 1)(N + 2)/2 coefficients; (l, m) stands at l(l + 1)/2 + m.
"""

from __future__ import annotations

from math import factorial, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop


def coefficient_count(degree: int) -> int:
    """How many coefficients an expansion to a degree has: (N + 1)(N + 2)/2."""
    return (degree + 1) * (degree + 2) // 2


def normalisation(degree: int) -> NDArray[np.float64]:
    """K_lm of the orthonormal harmonics.

    Parameters
    ----------
    degree : int
        N, at most 80.

    Returns
    -------
    array, shape ((N + 1)(N + 2)/2,)
        sqrt((2l + 1)/(4π) · (l - m)!/(l + m)!), times sqrt(2) for m > 0. [1]
    """
    return np.array(
        [
            sqrt((2 * l + 1) / (4 * pi) * factorial(l - m) / factorial(l + m))
            * (sqrt(2) if m else 1.0)
            for l in range(degree + 1)
            for m in range(l + 1)
        ]
    )


@compiled_loop
def legendre_functions(mu, constants, out):
    """K_lm P_l^m(mu) for all l, m up to the degree that ``constants`` has.

    Parameters
    ----------
    mu : float
        Cosine of the zenith angle. [1]
    constants : array, shape (k,)
        From ``normalisation``.
    out : array, shape (k,)
        Receives the values. [1]
    """
    degree = 0
    while (degree + 1) * (degree + 2) // 2 < constants.size:
        degree += 1
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    diagonal = 1.0
    for m in range(degree + 1):
        if m > 0:
            diagonal *= (2 * m - 1) * sine
        before = 0.0
        value = diagonal
        for l in range(m, degree + 1):
            if l > m:
                following = ((2 * l - 1) * mu * value - (l + m - 1) * before) / (l - m)
                before = value
                value = following
            index = l * (l + 1) // 2 + m
            out[index] = constants[index] * value

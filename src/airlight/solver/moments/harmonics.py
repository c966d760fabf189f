"""Real spherical harmonics about the zenith, even in azimuth.

Y_lm(mu, phi) = K_lm P_l^m(mu) cos(m phi), orthonormal on the sphere, without the Condon-Shortley
sign. Radiance in a spherical atmosphere is symmetric about the plane of zenith and star, so the
sine terms vanish and degree N has (N + 1)(N + 2)/2 coefficients; (l, m) has index l(l + 1)/2 + m.
"""

from __future__ import annotations

from math import factorial, pi, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined, kernel

FloatArray = NDArray[np.float64]

#: Norms of the harmonics of spin 2: of m = 0, and of m = 1 and 2. [1]
_ZEROTH: Final = sqrt(15.0 / (32.0 * pi))
_FIRST: Final = sqrt(5.0 / (8.0 * pi))


#: Number of polarised moments E_20, E_21, E_22, B_21 and B_22, which follow those of the radiance,
#: and of azimuthal components Q_0, Q_1, Q_2, U_1 and U_2.
POLARISED: Final = 5
#: Number of even moments E. The odd B_20 is 0.
EVEN: Final = 3
#: Number of expansion coefficients of Q and U, of ``PhaseFunction.polarising_moments``.
ELEMENTS: Final = 4


def coefficient_count(degree: int) -> int:
    """Number of coefficients of an expansion to a degree: (N + 1)(N + 2)/2."""
    return (degree + 1) * (degree + 2) // 2


def moment_count(degree: int) -> int:
    """Number of moments of a node, polarised ones included."""
    return coefficient_count(degree) + POLARISED


def normalisation(degree: int) -> NDArray[np.float64]:
    """Normalisation K_lm of the orthonormal harmonics.

    Parameters
    ----------
    degree : int
        Highest degree N, at most 80.

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


class Harmonics(NamedTuple):
    """Coefficients of division-free recurrences for K_lm P_l^m(mu).

    Attributes
    ----------
    degree : int
        Highest degree N.
    start : array, shape (N + 1,)
        K_mm P_m^m over (sin θ)^m. [1]
    ahead, back : array, shape (k,)
        With p_l for K_lm P_l^m: p_l = ahead·mu·p_{l-1} - back·p_{l-2}. [1]
    """

    degree: int
    start: FloatArray
    ahead: FloatArray
    back: FloatArray


def harmonics(degree: int) -> Harmonics:
    """Recurrences up to a degree; P_{l-2} represents 0 where l - 2 < m."""
    constants = normalisation(degree)
    count = coefficient_count(degree)
    start, ahead, back = np.empty(degree + 1), np.zeros(count), np.zeros(count)
    double_factorial = 1.0
    for m in range(degree + 1):
        if m > 0:
            double_factorial *= 2 * m - 1
        start[m] = constants[m * (m + 1) // 2 + m] * double_factorial
        for l in range(m + 1, degree + 1):
            k = l * (l + 1) // 2 + m
            ahead[k] = (2 * l - 1) / (l - m) * constants[k] / constants[(l - 1) * l // 2 + m]
            if l > m + 1:
                second = constants[(l - 2) * (l - 1) // 2 + m]
                back[k] = (l + m - 1) / (l - m) * constants[k] / second
    return Harmonics(degree, start, ahead, back)


@kernel
def climbed(ahead, back, mu, value, before):
    """Recurrence in degree: K_lm P_l^m(mu) from degrees l - 1 and l - 2. [1]"""
    return ahead * mu * value - back * before


@inlined
def legendre_functions(mu, terms, out):
    """Compute K_lm P_l^m(mu) for all l, m.

    Parameters
    ----------
    mu : float
        Cosine of the zenith angle. [1]
    terms : Harmonics
        Recurrences; they fix the degree.
    out : array, shape (k,)
        Receives the values, (l, m) at l(l + 1)/2 + m. [1]
    """
    degree, start, ahead, back = terms
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    power = 1.0
    for m in range(degree + 1):
        before = 0.0
        value = start[m] * power
        index = m * (m + 1) // 2 + m
        out[index] = value
        for l in range(m + 1, degree + 1):
            index += l
            following = climbed(ahead[index], back[index], mu, value, before)
            before = value
            value = following
            out[index] = value
        power *= sine


@inlined
def legendre_function(mu, l, m, start, ahead, back):
    """K_lm P_l^m(mu) of a single l and m; the arrays are those of ``Harmonics``. [1]"""
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    value = start[m]
    order = 0
    while order < m:
        value = value * sine
        order += 1
    before = 0.0
    index = m * (m + 1) // 2 + m
    for step in range(m + 1, l + 1):
        index = index + step
        following = climbed(ahead[index], back[index], mu, value, before)
        before = value
        value = following
    return value


@kernel
def degree_of(index):
    """Degree l of the coefficient with index l(l + 1)/2 + m.

    Examples
    --------
    >>> [degree_of(index) for index in range(7)]
    [0, 1, 1, 2, 2, 2, 3]
    """
    # Roots below an integer differ from it by at least 1/(l + 1).
    return int(0.5 * (sqrt(8.0 * index + 1.0) - 1.0) + 1e-3)


@inlined
def directed_functions(mu, cosine, terms, out):
    """Compute K_lm P_l^m(mu) cos mφ for all l, m.

    Parameters
    ----------
    cosine : float
        Cosine of the azimuth, cos φ. [1]
    """
    degree, start, ahead, back = terms
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    power = 1.0
    earlier, multiple = cosine, 1.0  # cos (m - 1)φ and cos mφ
    for m in range(degree + 1):
        before = 0.0
        value = start[m] * power * multiple
        index = m * (m + 1) // 2 + m
        out[index] = value
        for l in range(m + 1, degree + 1):
            index += l
            following = ahead[index] * mu * value - back[index] * before
            before = value
            value = following
            out[index] = value
        power *= sine
        earlier, multiple = multiple, 2.0 * cosine * multiple - earlier


@inlined
def polarised_functions(mu):
    r"""Spin-2 harmonics of degree 2, for Q and U along a line of sight.

    With even moments E_2m and odd moments B_2m

    .. math:: Q = \sum_m (E_{2m} A_m + B_{2m} B_m) \cos m\phi, \quad
              U = \sum_m (E_{2m} B_m + B_{2m} A_m) \sin m\phi, \quad
              E_{2m} = \int (Q A_m \cos m\phi + U B_m \sin m\phi)\, d\omega, \quad
              B_{2m} = \int (Q B_m \cos m\phi + U A_m \sin m\phi)\, d\omega .

    Parameters
    ----------
    mu : float
        Cosine of the line's zenith angle. [1]

    Returns
    -------
    a0, a1, a2, b1, b2 : float
        A_0, A_1, A_2, B_1, B_2; B_0 is 0. [1]

    References
    ----------
    Hu & White (1997), New Astronomy 2, 323, table 1, as real functions in the frame of
    ``solver.stokes_frame``.
    """
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    return (
        _ZEROTH * sine * sine,
        0.0 - _FIRST * sine * mu,
        0.5 * _FIRST * (1.0 + mu * mu),
        _FIRST * sine,
        0.0 - _FIRST * mu,
    )


@inlined
def polarised_function(mu, m):
    """A_m and B_m of one order m, 0 to 2, from ``polarised_functions``. [1]"""
    a0, a1, a2, b1, b2 = polarised_functions(mu)
    even, odd = a0, 0.0
    if m == 1:
        even, odd = a1, b1
    if m == 2:
        even, odd = a2, b2
    return even, odd

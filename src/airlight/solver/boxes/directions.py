r"""Directions of light in a box, by octant, and real spherical harmonics about the vertical.

.. math:: Y_{lm} = K_{lm} P_l^{|m|}(\cos\theta) \times \begin{cases} \cos m\varphi & m \ge 0 \\
          \sin |m|\varphi & m < 0 \end{cases}

is orthonormal on the sphere, without the Condon-Shortley sign; z is up, x east and y north. (l, m)
has index l² + l + m.
"""

from __future__ import annotations

from math import factorial, pi, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre

FloatArray = NDArray[np.float64]

#: Directions of an octant are a multiple of this; others have weight 0.
TOGETHER: Final = 4
#: Signs of x and y in the four octants of a hemisphere.
SIGNS: Final = ((1, 1), (-1, 1), (1, -1), (-1, -1))


def term_count(degree: int) -> int:
    """Number of harmonics up to a degree. [1]"""
    return (degree + 1) ** 2


def degrees(degree: int) -> NDArray[np.int64]:
    """Degree l of each harmonic, shape (terms,)."""
    return np.repeat(np.arange(degree + 1), 2 * np.arange(degree + 1) + 1)


def parities(degree: int) -> NDArray[np.int64]:
    """Class of each harmonic, shape (terms,): 1 if odd in x, plus 2 if odd in y."""
    l = degrees(degree)
    m = np.arange(l.size) - l * (l + 1)
    odd_y = m < 0
    return np.asarray((np.abs(m) + odd_y) % 2 + 2 * odd_y)


def harmonics(directions: FloatArray, degree: int) -> FloatArray:
    """Real spherical harmonics of unit vectors.

    Parameters
    ----------
    directions : array, shape (..., 3)
        Unit vectors: east, north, up. [1]
    degree : int
        Highest degree.

    Returns
    -------
    array, shape (..., terms)
        Values. [1]

    Examples
    --------
    >>> up = harmonics(np.array([0.0, 0.0, 1.0]), 1)
    >>> np.round(up * np.sqrt(4.0 * np.pi), 12).tolist()  # 1, and √3 cos θ
    [1.0, 0.0, 1.732050807569, 0.0]
    """
    x, y, z = np.moveaxis(np.asarray(directions, np.float64), -1, 0)
    out = np.empty((*x.shape, term_count(degree)))
    along = x + 1j * y  # (sin θ)^m (cos mφ + i sin mφ) is its m-th power
    power = np.ones_like(along)
    for m in range(degree + 1):
        before, value = np.zeros_like(z), np.full_like(z, _double_factorial(2 * m - 1))
        for l in range(m, degree + 1):
            if l > m:
                # P_l^m over (sin θ)^m
                following = ((2 * l - 1) * z * value - (l + m - 1) * before) / (l - m)
                before, value = value, following
            norm = sqrt((2 * l + 1) / (4 * pi) * factorial(l - m) / factorial(l + m))
            norm *= sqrt(2) if m else 1.0
            out[..., l * l + l + m] = norm * value * power.real
            if m:
                out[..., l * l + l - m] = norm * value * power.imag
        power = power * along
    return out


def _double_factorial(odd: int) -> float:
    return float(np.prod(np.arange(odd, 0, -2))) if odd > 0 else 1.0


class BoxDirections(NamedTuple):
    """Directions in which light propagates.

    Attributes
    ----------
    vectors : array, shape (2, 4, n, 3)
        Unit vectors, downwards and upwards, by octant; see ``SIGNS``. [1]
    weights : array, shape (2, 4, n)
        Solid angles. [sr]
    """

    vectors: FloatArray
    weights: FloatArray


def directions(zenith_angles: int, azimuths: int) -> BoxDirections:
    """Gauss rule in the cosine of each hemisphere, and even azimuths off the axes.

    Parameters
    ----------
    zenith_angles, azimuths : int
        See ``BoxSettings``.
    """
    rule = gauss_legendre(zenith_angles)
    quarter = azimuths // 4
    phi = (np.arange(quarter) + 0.5) * (2.0 * pi / azimuths)
    mu, angle = (one.ravel() for one in np.meshgrid(rule.nodes, phi, indexing="ij"))
    solid = np.repeat(rule.weights, quarter) * (2.0 * pi / azimuths)
    padding = -mu.size % TOGETHER
    mu, angle = np.append(mu, mu[:1].repeat(padding)), np.append(angle, angle[:1].repeat(padding))
    solid = np.append(solid, np.zeros(padding))
    sine = np.sqrt(1.0 - mu**2)
    first = np.stack([sine * np.cos(angle), sine * np.sin(angle), mu], axis=-1)
    signs = np.array([[(x, y, z) for x, y in SIGNS] for z in (-1, 1)], float)
    vectors = signs[:, :, None, :] * first
    return BoxDirections(vectors, np.broadcast_to(solid, vectors.shape[:3]).copy())

"""Legendre moments of phase functions."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Final

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

#: Number of halvings of quadrature panels in u = sin(θ/2) towards 0 and 1: the innermost panel is
#: 0.0005° wide.
_HALVINGS: Final = 18
#: Smallest number of Gauss-Legendre points of a panel.
_POINTS: Final = 20


@cache
def _quadrature(degree: int) -> tuple[FloatArray, FloatArray]:
    """Nodes nu and weights over [-1, 1], graded towards both ends.

    In u = sin(θ/2), nu = 1 - 2u² and dnu = -4u du; panels resolve forward and backward peaks down
    to the width of the innermost one.
    """
    halves = 0.5 ** np.arange(1, _HALVINGS + 1)
    edges = np.unique(np.concatenate([[0.0, 1.0], halves, 1.0 - halves]))
    x, w = np.polynomial.legendre.leggauss(_POINTS + degree // 2)
    half_widths = 0.5 * np.diff(edges)
    u = (0.5 * (edges[:-1] + edges[1:]))[:, None] + half_widths[:, None] * x
    weights = half_widths[:, None] * w * 4.0 * u
    return (1.0 - 2.0 * u * u).ravel(), weights.ravel()


def legendre_moments(phase: Callable[[FloatArray], FloatArray], degree: int) -> FloatArray:
    r"""Legendre moments of a phase function.

    .. math:: g_l = 2\pi \int_{-1}^{1} p(\nu)\, P_l(\nu)\, d\nu, \qquad
              p(\nu) = \sum_l \frac{2l+1}{4\pi}\, g_l P_l(\nu)

    Parameters
    ----------
    phase : callable
        Phase function of an array of cosines, shape (n,) to (..., n). [sr⁻¹]
    degree : int
        Largest l.

    Returns
    -------
    array, shape (..., degree + 1)
        Moments; g_0 is the integral over the sphere, g_1 the mean cosine times it. [1]

    Notes
    -----
    Henyey-Greenstein moments are accurate to 1e-12 up to ``|g|`` = 0.999.

    Examples
    --------
    >>> from airlight.physics.optics.phase_functions import henyey_greenstein
    >>> from airlight.kernel import vectorized
    >>> lobe = vectorized(henyey_greenstein)
    >>> legendre_moments(lambda nu: lobe(nu, 0.5), 3).round(12).tolist()  # g^l
    [1.0, 0.5, 0.25, 0.125]
    """
    nu, weights = _quadrature(degree)
    weighted = 2.0 * np.pi * weights * np.asarray(phase(nu), dtype=np.float64)
    moments = np.empty((*weighted.shape[:-1], degree + 1))
    before, current = np.ones_like(nu), nu
    for l in range(degree + 1):
        moments[..., l] = weighted @ before
        before, current = current, ((2 * l + 3) * nu * current - (l + 1) * before) / (l + 2)
    return moments


def phase_integral(phase: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Integral of a phase function over the sphere; 1 if it is normalised.

    Parameters
    ----------
    phase : callable
        Phase function of an array of cosines, shape (n,) to (..., n). [sr⁻¹]

    Returns
    -------
    array, shape (...)
        Integral over the sphere. [1]
    """
    return legendre_moments(phase, 0)[..., 0]

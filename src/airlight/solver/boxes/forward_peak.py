r"""Correction of first-order scattering for multiple scattering by the delta-M forward peak.

Delta-M scaling transmits the fraction f of scattering as if it were not scattered. In first order
it is seen under the angles of the phase function p, attenuated by the scaled optical depth (TMS).
Along a path of scattering depth :math:`x = \varpi f \tau` it is scattered again by the peak, whose
Legendre moments are :math:`p_l = \chi_l / f`, and 1 up to the degree of the source. In the
approximation of small angles, the source's phase function becomes

.. math:: e^{-x} p + (1 - e^{-x}) (1 - f) p' + f \frac{e^{-x}}{x}
          \sum_l \frac{2l + 1}{4\pi} \left(e^{x p_l} - 1 - x p_l\right) P_l,

where :math:`p'` is the scaled one, for paths that lead straight on, and to first order in all
others. It takes the place of the IMS correction of Nakajima & Tanaka (1988), J. Quant. Spectrosc.
Radiat. Transfer 40, 51, which is its term of second order.
"""

from __future__ import annotations

from math import pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_optics import CloudOptics

FloatArray = NDArray[np.float64]

#: Highest degree of the peak's moments, which enter by their squares.
_DEGREE: Final = 300
#: Intervals of the scattering angle θ, even in θ^(2/3).
ANGLES: Final = 360
#: Values of √x, at which a table is linear.
ROOTS: Final = 33
#: Largest √x; light is negligible there.
LARGEST_ROOT: Final = 5.0


def peak_depth(optics: CloudOptics, degree: int) -> FloatArray:
    """Scattering depth ϖfκ of the forward peak per extinction at 550 nm, shape (w,). [1]

    Parameters
    ----------
    degree : int
        Highest degree of the source.
    """
    truncated = np.clip(_moments(optics, degree + 1)[:, -1], 0.0, 1.0)
    return np.asarray(optics.extinction * optics.albedo * truncated)


def peak_table(optics: CloudOptics, degree: int) -> FloatArray:
    """Phase function of the source without the term of p, over angle and √x.

    Parameters
    ----------
    degree : int
        Highest degree of the source.

    Returns
    -------
    array, shape (ANGLES + 1, ROOTS, w)
        Phase function. [sr⁻¹]
    """
    moments = _moments(optics, _DEGREE)
    truncated = np.clip(moments[:, degree + 1], 1e-12, 1.0)
    peak = moments / truncated[:, None]
    peak[:, : degree + 1] = 1.0
    scaled = np.zeros_like(moments)
    scaled[:, : degree + 1] = moments[:, : degree + 1] - truncated[:, None]
    factor = (2 * np.arange(_DEGREE + 1) + 1) / (4.0 * pi)
    x = np.linspace(0.0, LARGEST_ROOT, ROOTS)[1:, None, None] ** 2
    again = np.exp(x * (peak - 1.0)) - np.exp(-x) * (1.0 + x * peak)
    terms = (1.0 - np.exp(-x)) * scaled + truncated[:, None] * again / x
    angles = pi * np.linspace(0.0, 1.0, ANGLES + 1) ** 1.5
    functions = np.polynomial.legendre.legvander(np.cos(angles), _DEGREE)
    table = np.zeros((ANGLES + 1, ROOTS, truncated.size))
    table[:, 1:] = np.einsum("al,xwl->axw", functions * factor, terms)
    return table


def _moments(optics: CloudOptics, degree: int) -> FloatArray:
    found = np.asarray(optics.phase.moments(optics.wavelengths, degree), np.float64)
    return found / found[:, :1]

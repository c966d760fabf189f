r"""Spectral limb darkening of stars.

Radiance is a polynomial in the cosine μ of the angle of emergence, normalised to mean 1 over the
disc, so that the irradiance is unchanged:

.. math:: \frac{L(\mu)}{\bar L} = \sum_{k=0}^{5} a_k \mu^k, \qquad
          \int_0^1 2\mu \sum_k a_k \mu^k \, d\mu = \sum_k \frac{2 a_k}{k + 2} = 1
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.polynomial import laguerre, legendre
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.physics.constants import BOLTZMANN, PLANCK, SPEED_OF_LIGHT
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: Number of coefficients.
COEFFICIENTS: Final = 6
#: Coefficients of a uniform disc.
UNIFORM: Final = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
#: Wavelength ranges of Neckel (2005), table 2: first and last [µm], and for each power of μ the
#: factors of 1, 1/λ and 1/λ⁵. In each range they sum to 1, 0 and 0, as L(1) is normalised to 1.
_NECKEL: Final = (
    (0.300, 0.37298, (
        (0.35601, -0.085217, 0.0), (1.11529, 0.085217, -0.001871), (-0.67237, 0.0, 0.003589),
        (0.18696, 0.0, -0.002415), (0.00038, 0.0, 0.000897), (0.01373, 0.0, -0.000200))),
    (0.385, 0.42257, (
        (0.09900, 0.010643, 0.0), (1.96884, -0.010643, -0.009166), (-2.80511, 0.0, 0.024873),
        (3.32780, 0.0, -0.029317), (-2.17878, 0.0, 0.018273), (0.58825, 0.0, -0.004663))),
    (0.42257, 1.100, (
        (0.75267, -0.265577, 0.0), (0.93874, 0.265577, -0.004095), (-1.89287, 0.0, 0.012582),
        (2.42234, 0.0, -0.017117), (-1.71150, 0.0, 0.011977), (0.49062, 0.0, -0.003347))),
)  # fmt: skip
#: Smallest temperature of the law: a polynomial does not fit the steeper ones of cooler stars. [K]
_COOLEST: Final = 2000.0
#: Numbers of quadrature points over depth and over emergence angle.
_DEPTHS: Final = 40
_COSINES: Final = 24


def solar_darkening(wavelengths: ArrayLike) -> FloatArray:
    """Limb darkening of the sun.

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths; outside 300 to 1100 nm clamped to that range. [nm]

    Returns
    -------
    array, shape (nl, 6)
        Coefficients by powers of the cosine of emergence, of mean 1. [1]

    Notes
    -----
    Between 373 and 385 nm, where lines crowd and no law is given, coefficients are interpolated.
    The laws of the continuum meet with a step at 422.57 nm, below 1 % of the radiance.

    References
    ----------
    Neckel (2005), Solar Physics 229, 13, doi:10.1007/s11207-005-4081-z, table 2; fitted to Neckel
    & Labs (1994), Solar Physics 153, 91.

    Examples
    --------
    >>> law = solar_darkening([440.0, 680.0])
    >>> (law[:, 0] / law.sum(axis=1)).round(3)  # the rim over the centre: darker in blue
    array([0.149, 0.362])
    """
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
    microns = np.clip(nm * 1e-3, 0.300, 1.100)
    knots = [end for first, last, _ in _NECKEL for end in (first, last)]
    out = np.empty((microns.size, COEFFICIENTS))
    for k, at in enumerate(microns):
        piece = int(np.searchsorted(knots, at, side="right")) - 1
        if piece % 2 == 0 or at >= knots[-1]:
            out[k] = _neckel(at, min(piece, len(knots) - 2) // 2)
        else:
            low, high = knots[piece], knots[piece + 1]
            fraction = (at - low) / (high - low) if high > low else 1.0
            ends = _neckel(low, piece // 2), _neckel(high, piece // 2 + 1)
            out[k] = (1.0 - fraction) * ends[0] + fraction * ends[1]
    return _of_mean_one(out)


def black_body_darkening(wavelengths: ArrayLike, temperature: float) -> FloatArray:
    r"""Limb darkening of a grey atmosphere, by effective temperature.

    The source function is that of a black body at Eddington's temperature,

    .. math:: T^4(\tau) = \tfrac34 T_e^4 \left(\tau + \tfrac23\right), \qquad
              L(\mu) = \int_0^\infty B_\lambda(T(\tau)) e^{-\tau/\mu} \, \frac{d\tau}{\mu}

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    temperature : float
        Effective temperature, clamped to at least 2000. [K]

    Returns
    -------
    array, shape (nl, 6)
        Coefficients by powers of the cosine of emergence, of mean 1. [1]

    Notes
    -----
    For the sun it agrees with the measured law within 5 % of the radiance between the disc's centre
    and 0.98 of its radius, from 450 to 800 nm.

    References
    ----------
    Mihalas (1978), Stellar Atmospheres, 2nd edition, eqs. 3-39 and 2-51.

    Examples
    --------
    >>> law = black_body_darkening([550.0], 3000.0)  # a red dwarf: strong
    >>> (law[:, 0] / law.sum(axis=1)).round(2)
    array([0.1])
    """
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
    if not 0.0 < temperature < np.inf:
        raise ParameterError("temperature", temperature, "above 0 K, finite")
    temperature = max(temperature, _COOLEST)
    depths, weights = laguerre.laggauss(_DEPTHS)
    nodes, mass = legendre.leggauss(_COSINES)
    cosines = 0.5 * (nodes + 1.0)
    # L(μ) = ∫ B(T(μ x)) e^-x dx, relative to the radiance at the effective temperature.
    hotter = (0.75 * (cosines[:, None] * depths + 2.0 / 3.0)) ** 0.25
    x = (PLANCK * SPEED_OF_LIGHT / (BOLTZMANN * temperature * 1e-9) / nm)[:, None, None]
    emerging = (np.exp(x - x / hotter) * np.expm1(-x) / np.expm1(-x / hotter)) @ weights
    powers = cosines[:, None] ** np.arange(COEFFICIENTS)
    mass = np.sqrt(mass * cosines)
    fitted = np.linalg.lstsq(mass[:, None] * powers, (mass * emerging).T, rcond=None)[0]
    return _of_mean_one(np.asarray(fitted.T, np.float64))


def _neckel(microns: float, piece: int) -> FloatArray:
    factors = np.array(_NECKEL[piece][2])
    return np.asarray(factors @ np.array([1.0, 1.0 / microns, microns**-5]))


def _of_mean_one(coefficients: FloatArray) -> FloatArray:
    mean = coefficients @ (2.0 / (np.arange(COEFFICIENTS) + 2.0))
    return np.asarray(coefficients / mean[:, None])

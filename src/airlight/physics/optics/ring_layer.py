r"""Flat layer of many large particles, which scatter sunlight once: planetary rings.

Chandrasekhar (1960), Radiative Transfer, sections 30 and 47, for a layer far thicker than its
particles:

.. math:: \frac{L}{E} = \varpi p(\nu) \frac{\mu_0}{\mu + \mu_0}
          \left[1 - e^{-\tau (1/\mu + 1/\mu_0)}\right]

on the lit side, and on the other side

.. math:: \frac{L}{E} = \varpi p(\nu) \frac{\mu_0}{\mu - \mu_0}
          \left[e^{-\tau/\mu} - e^{-\tau/\mu_0}\right]

with the irradiance E on a plane that faces the star. In the ring literature I/F = π L/E, and
P = 4π p.
Light that is scattered twice or more is left out: 10 to 20 % of that of the B ring at albedo 0.6,
because its particles scatter backward.
"""

from __future__ import annotations

from math import acos, exp, pi

import numpy as np

from airlight.kernel import kernel
from airlight.physics.optics.phase_functions import henyey_greenstein


def power_law_norm(exponent: float) -> float:
    """Factor C that normalises the phase function C (π - α)ⁿ. [sr⁻¹ rad⁻ⁿ]

    Parameters
    ----------
    exponent : float
        Exponent n. [1]

    Examples
    --------
    >>> f"{4 * pi * power_law_norm(3.092):.3f}"  # 0.153: Dones et al. (1993), recalled
    '0.153'
    """
    nodes, weights = np.polynomial.legendre.leggauss(64)
    angle = 0.5 * pi * (1.0 + nodes)
    return 1.0 / float(pi * pi * np.sum(weights * angle**exponent * np.sin(angle)))


@kernel
def power_law(nu, exponent, norm):
    """Phase function C (π - α)ⁿ of large particles, with the phase angle α. [sr⁻¹]

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle π - α. [1]
    exponent, norm : float
        Exponent n [1], and C from ``power_law_norm`` [sr⁻¹ rad⁻ⁿ].

    References
    ----------
    Dones, Cuzzi & Showalter (1993), Voyager photometry of Saturn's A ring, Icarus 105, 184.
    """
    angle = acos(min(max(nu, -1.0), 1.0))
    value = norm
    if exponent > 0.0:
        value = norm * max(angle, 1e-6) ** exponent
    return value


@kernel
def ring_phase(nu, exponent, norm, dust, asymmetry):
    """Phase function of a ring of large particles and dust. [sr⁻¹]

    Parameters
    ----------
    nu, exponent, norm :
        Arguments of ``power_law``.
    dust, asymmetry : float
        Fraction of the scattering by dust, and its asymmetry. [1]
    """
    return (1.0 - dust) * power_law(nu, exponent, norm) + dust * henyey_greenstein(nu, asymmetry)


@kernel
def mean_attenuation(x):
    """Mean of e^(-t) for t from 0 to x: (1 - e^(-x))/x. [1]

    Examples
    --------
    >>> mean_attenuation(0.0), round(mean_attenuation(2.0), 6)
    (1.0, 0.432332)
    """
    value = 1.0 - 0.5 * x
    if abs(x) > 1e-3:
        value = (1.0 - exp(-x)) / x
    return value


@kernel
def single_scattering_layer(depth, mu, mu_s):
    """Radiance of a layer over irradiance, albedo and phase function. [1]

    Parameters
    ----------
    depth : float
        Normal optical depth τ. [1]
    mu, mu_s : float
        Cosines of the angles between the normal and the directions towards observer and star, with
        their signs: equal signs for the lit side. [1]

    Examples
    --------
    >>> round(single_scattering_layer(100.0, 0.5, 0.25), 9)
    0.333333333
    >>> round(single_scattering_layer(1.0, 1.0, -1.0), 9)
    0.367879441
    """
    leaving, arriving = max(abs(mu), 1e-6), max(abs(mu_s), 1e-6)
    inner, outer = depth / leaving, depth / arriving
    if mu * mu_s > 0.0:
        value = inner * mean_attenuation(inner + outer)
    else:
        # symmetric in both, so that neither exponential overflows
        low, high = min(inner, outer), max(inner, outer)
        value = inner * exp(-low) * mean_attenuation(high - low)
    return value

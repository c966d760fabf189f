"""Reflection by the smooth surface of a dielectric (Fresnel 1823).

Born & Wolf (1999), "Principles of Optics", 7th edition, section 1.5.2. The amplitudes are what a
Mueller matrix is made of: its elements are (r_s² + r_p²)/2, (r_s² - r_p²)/2 and r_s r_p.
"""

from __future__ import annotations

from math import sqrt

from airlight.kernel import kernel


@kernel
def fresnel_amplitudes(n, cosine):
    """Amplitude of reflected light per amplitude of incident light, from outside.

    r_s = (cos i - n cos t)/(cos i + n cos t), r_p = (n cos i - cos t)/(n cos i + cos t), and
    sin i = n sin t; Born & Wolf eq. 1.5.21 with their sign of r_p.

    Parameters
    ----------
    n : float
        Refractive index of the dielectric relative to the medium of the light, at least 1. [1]
    cosine : float
        Cosine of the angle of incidence, 0 to 1. [1]

    Returns
    -------
    r_s, r_p : float
        Amplitudes for s polarisation (perpendicular to the plane of incidence) and for p. [1]

    Examples
    --------
    >>> fresnel_amplitudes(1.5, 1.0)  # glass, straight on: 4 % of the light
    (-0.2, 0.2)
    """
    # n cos t, without the angle.
    bent = sqrt((n - 1.0) * (n + 1.0) + cosine * cosine)
    return (cosine - bent) / (cosine + bent), (n * n * cosine - bent) / (n * n * cosine + bent)


@kernel
def fresnel_reflectances(n, cosine):
    """Fresnel reflectances of a dielectric for s and p polarisation.

    Parameters
    ----------
    n, cosine : float
        Arguments of ``fresnel_amplitudes``. [1]

    Returns
    -------
    R_s, R_p : float
        Reflectances; their mean is that of unpolarised light. [1]

    Examples
    --------
    >>> round(fresnel_reflectances(1.5, 1.0)[0], 12)
    0.04
    """
    r_s, r_p = fresnel_amplitudes(n, cosine)
    return r_s * r_s, r_p * r_p

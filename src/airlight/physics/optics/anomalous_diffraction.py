"""Anomalous diffraction: extinction and absorption by soft spheres in closed form."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.kernel import kernel, vectorized
from airlight.physics.optics.size_distribution import SizeNodes

FloatArray = npt.NDArray[np.float64]

#: Phase shifts and absorption paths below this use the series, as the closed form cancels there.
SERIES_BELOW: Final = 0.05


@kernel
def absorption_efficiency(path: float) -> float:
    r"""Absorption efficiency of a sphere in anomalous diffraction. [1]

    .. math:: Q_{abs} = 1 + \frac{2e^{-w}}{w} + \frac{2(e^{-w} - 1)}{w^2}

    Below w = 0.05 its series, 2w/3 - w²/4 + w³/15 - w⁴/72 + w⁵/420, to 3e-11 of its value.

    Parameters
    ----------
    path : float
        Optical depth along the diameter, w = 8πrk/λ. [1]

    References
    ----------
    van de Hulst (1957), Light Scattering by Small Particles, §11.23.

    Examples
    --------
    >>> f"{absorption_efficiency(1e6):.5f}"  # all incident light
    '1.00000'
    """
    w = path
    if w < SERIES_BELOW:
        return w * (
            2.0 / 3.0
            - w * (0.25 - w * (1.0 / 15.0 - w * (1.0 / 72.0 - w * (1.0 / 420.0 - w / 2880.0))))
        )
    return 1.0 + 2.0 * math.exp(-w) / w + 2.0 * math.expm1(-w) / (w * w)


@kernel
def extinction_efficiency(phase_shift: float, damping: float) -> float:
    r"""Extinction efficiency of a sphere in anomalous diffraction. [1]

    .. math:: Q_{ext} = 2 - 4e^{-\rho\tan\beta}\frac{\cos\beta}{\rho}\sin(\rho-\beta)
              - 4e^{-\rho\tan\beta}\left(\frac{\cos\beta}{\rho}\right)^2\cos(\rho-2\beta)
              + 4\left(\frac{\cos\beta}{\rho}\right)^2\cos 2\beta

    It is 4 Re K(iρ + ρ tanβ) with K(z) = 1/2 + e^{-z}/z + (e^{-z} - 1)/z²; below ``|z|`` = 0.05 the
    series of K is used, z/3 - z²/8 + z³/30 - z⁴/144 + z⁵/840 - …

    Parameters
    ----------
    phase_shift : float
        Phase shift ρ = 4πr(m-1)/λ. [1]
    damping : float
        Half the optical depth along the diameter, ρ tan β = 4πrk/λ, 0 or more. [1]

    References
    ----------
    van de Hulst (1957), Light Scattering by Small Particles, §11.22; Costa et al., the OpenSpace
    paper, eq. 19.

    Examples
    --------
    >>> f"{extinction_efficiency(4.08, 0.0):.2f}"  # the first maximum
    '3.17'
    """
    rho = phase_shift
    if rho * rho + damping * damping < SERIES_BELOW * SERIES_BELOW:
        # Powers of z = damping + i rho.
        total, factor, re, im = 0.0, 1.0, 1.0, 0.0
        for n in range(1, 8):
            re, im = re * damping - im * rho, re * rho + im * damping
            factor = -factor / n
            total -= re * factor / (n + 2.0)
        return 4.0 * total
    beta = math.atan2(damping, rho)
    reciprocal = 1.0 / math.sqrt(rho * rho + damping * damping)  # cos(beta) / rho
    wave = math.sin(rho - beta) + reciprocal * math.cos(rho - 2.0 * beta)
    return 2.0 - 4.0 * reciprocal * (math.exp(-damping) * wave - reciprocal * math.cos(2.0 * beta))


def efficiencies(
    radii: npt.ArrayLike, wavelength: float, index: complex
) -> tuple[FloatArray, FloatArray]:
    """Extinction and scattering efficiencies of spheres in anomalous diffraction.

    Parameters
    ----------
    radii : array, shape (...)
        Radii of the spheres. [m]
    wavelength : float
        Wavelength of the light. [nm]
    index : complex
        Refractive index m + ik, k 0 or more. [1]

    Returns
    -------
    extinction, scattering : array, shape (...)
        Efficiencies; their difference is the absorption efficiency. [1]

    Notes
    -----
    Valid for m near 1 and spheres larger than the wavelength; for the dust of Mars (m = 1.52,
    1.6 µm) its extinction is 9 to 13 % below the exact one.

    Examples
    --------
    >>> extinction, scattering = efficiencies(1.6e-6, 550.0, 1.52 + 0.006j)
    >>> f"{extinction:.3f} {scattering / extinction:.3f}"
    '1.977 0.874'
    """
    size = 4.0 * np.pi * np.asarray(radii, dtype=np.float64) / (1e-9 * wavelength)
    extinction = vectorized(extinction_efficiency)(size * (index.real - 1.0), size * index.imag)
    absorption = vectorized(absorption_efficiency)(2.0 * size * index.imag)
    return np.asarray(extinction), np.asarray(extinction - absorption)


def cross_sections(sizes: SizeNodes, wavelength: float, index: complex) -> tuple[float, float]:
    """Mean extinction and scattering cross-sections per particle.

    Parameters
    ----------
    sizes : SizeNodes
        Sizes from ``physics.optics.size_distribution``.
    wavelength : float
        Wavelength of the light. [nm]
    index : complex
        Refractive index m + ik. [1]

    Returns
    -------
    extinction, scattering : float
        Cross-sections Σ N(r) πr² Q(r); eq. 18 of the OpenSpace paper, per particle. [m²]
    """
    areas = np.pi * sizes.radii**2 * sizes.weights
    extinction, scattering = efficiencies(sizes.radii, wavelength, index)
    return float(areas @ extinction), float(areas @ scattering)

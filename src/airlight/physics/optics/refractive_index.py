"""Refractivity n - 1 of air and carbon dioxide, at the reference state of each measurement.

Other gases are in ``element_refractivity`` and ``compound_refractivity``.
"""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]

#: Temperature of the fit for air. [K]
AIR_TEMPERATURE: Final = 288.15
#: Temperature of the fit for carbon dioxide. [K]
CO2_TEMPERATURE: Final = 273.15
#: Pressure of both fits. [Pa]
STANDARD_PRESSURE: Final = 101_325.0
#: Wavelength ranges of the fits. [nm]
AIR_RANGE: Final = (230.0, 1690.0)
CO2_RANGE: Final = (180.7, 2500.0)


def inverse_square_um(wavelengths: npt.ArrayLike, fitted: tuple[float, float]) -> FloatArray:
    """Squares σ² = 1/λ² for vacuum wavelengths, after a check of the fitted range. [µm⁻²]"""
    nm = values_in(wavelengths, "nm", "wavelengths")
    outside = ~((nm >= fitted[0]) & (nm <= fitted[1]))
    if outside.any():
        first = float(nm[outside].flat[0])
        raise ParameterError("wavelengths", first, f"{fitted[0]:g} to {fitted[1]:g} nm")
    return np.asarray((1e3 / nm) ** 2)


def air_refractivity_peck1972(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of dry air at 15 °C and 101 325 Pa.

    .. math:: n - 1 = 10^{-8} \left(\frac{5791817}{238.0185 - \sigma^2}
              + \frac{167909}{57.362 - \sigma^2}\right), \quad \sigma = 1/\lambda

    Parameters
    ----------
    wavelengths : array, shape (...)
        Vacuum wavelength, 230 to 1690. [nm]

    Returns
    -------
    array, shape (...)
        n - 1. [1]

    Raises
    ------
    ParameterError
        If a wavelength is outside that range.

    References
    ----------
    Peck & Reeder (1972), JOSA 62, 958, eq. 2. doi:10.1364/JOSA.62.000958

    Examples
    --------
    >>> f"{1e8 * air_refractivity_peck1972(644.02492):.3f}"  # Table III: 27638.092
    '27638.092'
    """
    s2 = inverse_square_um(wavelengths, AIR_RANGE)
    return np.asarray(1e-8 * (5_791_817.0 / (238.0185 - s2) + 167_909.0 / (57.362 - s2)))


def co2_refractivity_bideau_mehu1973(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of carbon dioxide at 0 °C and 101 325 Pa.

    .. math:: n - 1 = \frac{0.0699100}{166.175 - \sigma^2} + \frac{0.00144720}{79.609 - \sigma^2}
              + \frac{6.42941\cdot10^{-5}}{56.3064 - \sigma^2}
              + \frac{5.21306\cdot10^{-5}}{46.0196 - \sigma^2}
              + \frac{1.46847\cdot10^{-6}}{0.0584738 - \sigma^2}

    Measured to 1694.5 nm; the last term is the band at 4.3 µm, by which it is 3 % lower at 2500 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Vacuum wavelength, 180.7 to 2500. [nm]

    Returns
    -------
    array, shape (...)
        n - 1. [1]

    Raises
    ------
    ParameterError
        If a wavelength is outside that range.

    References
    ----------
    Bideau-Mehu, Guern, Abjean & Johannin-Gilles (1973), Optics Communications 9, 432.
    doi:10.1016/0030-4018(73)90289-7

    Examples
    --------
    >>> f"{co2_refractivity_bideau_mehu1973(550.0):.8f}"
    '0.00045019'
    """
    s2 = inverse_square_um(wavelengths, CO2_RANGE)
    return np.asarray(
        6.99100e-2 / (166.175 - s2)
        + 1.44720e-3 / (79.609 - s2)
        + 6.42941e-5 / (56.3064 - s2)
        + 5.21306e-5 / (46.0196 - s2)
        + 1.46847e-6 / (0.0584738 - s2)
    )

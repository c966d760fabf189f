"""Extraterrestrial solar spectrum."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.spectra.tables import read_spectrum


def solar_irradiance(wavelengths: ArrayLike) -> NDArray[np.float64]:
    """Extraterrestrial solar spectral irradiance at 1 au.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 270 to 1010; linear between whole nanometres, constant beyond 280 and 1000.
        [nm]

    Returns
    -------
    array, shape (...)
        [W m⁻² nm⁻¹]

    Raises
    ------
    ParameterError
        If a wavelength lies outside that range.

    References
    ----------
    ASTM G173-03 (2020), Standard Tables for Reference Solar Spectral Irradiances.

    Examples
    --------
    >>> solar_irradiance([500.0, 800.0])
    array([1.916 , 1.1248])
    """
    return read_spectrum("astm-g173").at(wavelengths)

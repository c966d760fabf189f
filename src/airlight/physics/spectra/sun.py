"""Extraterrestrial solar spectrum."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.spectra.tables import read_spectrum

#: Spectra of the sun, with their sources.
SPECTRA: Final = {"astm-g173": "ASTM G-173", "sao2010": "Chance & Kurucz (2010)"}


def solar_irradiance(wavelengths: ArrayLike, spectrum: str = "astm-g173") -> NDArray[np.float64]:
    """Extraterrestrial solar spectral irradiance at 1 au.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, linear between rows, constant up to 10 nm beyond the ends. [nm]
    spectrum : str
        Name of ``SPECTRA``: ``"astm-g173"``, 280 to 4000 nm, rows every nanometre to 1700 nm and
        every 5 nm beyond; ``"sao2010"``, 201 to 1000.5 nm, means over every half nanometre, of
        which the broad level differs by up to 2.4 % from 300 nm on, and by 12 % below.

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

    Chance & Kurucz (2010), JQSRT 111, 1289. doi:10.1016/j.jqsrt.2010.01.036

    Examples
    --------
    >>> solar_irradiance([500.0, 800.0, 2000.0])
    array([1.916  , 1.1248 , 0.11673])
    """
    return read_spectrum(spectrum).at(wavelengths)

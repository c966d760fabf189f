"""Absorption by ozone: the Huggins bands below 360 nm and the Chappuis band in the visible."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.spectra.tables import read_spectrum

#: Range of measured temperatures, and that between them. [K]
COLDEST, MIDDLE, WARMEST = 193.0, 243.0, 293.0


def ozone_cross_section(
    wavelengths: ArrayLike, temperature: float = WARMEST
) -> NDArray[np.float64]:
    """Absorption cross-section of one ozone molecule.

    Measured values averaged over 1 nm, scaled by 1.005 to 1.008 so that 440, 550 and 680 nm have
    the values 1.360e-26, 3.314e-25 and 1.368e-25 m² at 293 K; a quadratic in the temperature. At
    the stratosphere's 225 K ozone absorbs 13 % less at 305 nm, 17 % less at 320 nm, 0.3 % less at
    550 nm, 4 % less at 680 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 270 to 1010; linear between whole nanometres, constant beyond 280 and 1000.
        [nm]
    temperature : float
        Temperature, 193 to 293. [K]

    Returns
    -------
    array, shape (...)
        [m²]

    Raises
    ------
    ParameterError
        If a wavelength lies outside that range.

    References
    ----------
    Gorshelev et al. (2014), Atmos. Meas. Tech. 7, 609, doi:10.5194/amt-7-609-2014; Serdyuchenko
    et al. (2014), ibid. 625, doi:10.5194/amt-7-625-2014; data: doi:10.5281/zenodo.5793207.

    Examples
    --------
    >>> ozone_cross_section([680.0, 550.0, 440.0])
    array([1.368e-25, 3.314e-25, 1.360e-26])
    """
    warm = read_spectrum("ozone-293k").at(wavelengths)
    middle, cold = np.moveaxis(read_spectrum("ozone-temperature").at(wavelengths), -1, 0)
    x = (WARMEST - temperature) / (WARMEST - MIDDLE)  # 0, 1, 2: Lagrange's polynomials
    ratio = 0.5 * (x - 1.0) * (x - 2.0) + x * (2.0 - x) * middle + 0.5 * x * (x - 1.0) * cold
    return np.asarray(warm * np.maximum(ratio, 0.0))

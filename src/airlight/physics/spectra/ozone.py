"""Absorption by ozone: the Huggins bands below 360 nm and the Chappuis band in the visible."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.spectra.tables import read_spectrum


def ozone_cross_section(wavelengths: ArrayLike) -> NDArray[np.float64]:
    """Absorption cross-section of one ozone molecule at 293 K.

    Measured values averaged over 1 nm, scaled by 1.005 to 1.008 so that 440, 550 and 680 nm have
    the values 1.360e-26, 3.314e-25 and 1.368e-25 m². The dependence on temperature is neglected:
    at the stratosphere's 223 K the Chappuis band is lower by 0.5 % at 550 nm, 4 % at 680 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 270 to 1010; linear between whole nanometres, constant beyond 280 and 1000.
        [nm]

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
    return read_spectrum("ozone-293k").at(wavelengths)

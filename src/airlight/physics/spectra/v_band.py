"""Passband V of the Johnson-Cousins system, and the sun's magnitude in it.

* Bessell (1990), UBVRI passbands, PASP 102, 1181, Table 2: the passband. It weights energy; what
  counts photons has it over the wavelength (Maíz Apellániz 2006, AJ 131, 1184, appendix A).
* Willmer (2018), The absolute magnitude of the sun in several filters, ApJS 236, 47: 4.81 at 10 pc,
  31.57 mag less at 1 au.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.spectra.sun import solar_irradiance
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: V of the sun at 1 au. [mag]
SOLAR_V: Final = -26.76
#: Ends of the passband. [nm]
V_RANGE: Final = (470.0, 700.0)
#: Square arcseconds of a steradian.
_SQUARE_ARCSECONDS: Final = np.degrees(3600.0) ** 2
#: Passband at steps of 10 nm, for energy. [1]
_PASSBAND: Final = np.fromstring(
    "0.000 0.030 0.163 0.458 0.780 0.967 1.000 0.973 0.898 0.792 0.684 0.574 0.461 "
    "0.359 0.270 0.197 0.135 0.081 0.045 0.025 0.017 0.013 0.009 0.000",
    sep=" ",
)


def v_passband(wavelengths: ArrayLike) -> FloatArray:
    """Passband of V for energy; 0 outside 470 to 700 nm. [1]

    Examples
    --------
    >>> v_passband([530.0, 535.0, 710.0])
    array([1.    , 0.9865, 0.    ])
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    known = np.linspace(*V_RANGE, _PASSBAND.size)
    return np.asarray(np.interp(nm, known, _PASSBAND, left=0.0, right=0.0))


def v_magnitude(radiance: ArrayLike) -> FloatArray:
    """V per square arcsecond of a radiance integrated over the passband. [mag arcsec⁻²]

    Parameters
    ----------
    radiance : array, shape (...)
        Integral of passband times radiance, 0 or more; the magnitude of 0 is infinite.
        [W m⁻² sr⁻¹]

    Examples
    --------
    >>> nm = np.arange(470.0, 701.0)
    >>> irradiance = np.trapezoid(v_passband(nm) * solar_irradiance(nm), nm)
    >>> f"{v_magnitude(irradiance / 6.794e-5):.2f}"  # the sun's disc: -26.76 over 6.794e-5 sr
    '-10.61'
    """
    nm = np.arange(V_RANGE[0], V_RANGE[1] + 0.5)
    sun = np.trapezoid(v_passband(nm) * solar_irradiance(nm), nm)
    with np.errstate(divide="ignore"):
        return np.asarray(
            SOLAR_V - 2.5 * np.log10(np.asarray(radiance) / (sun * _SQUARE_ARCSECONDS))
        )

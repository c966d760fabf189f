"""Action spectra, by which irradiance is weighted for skin, plants and eyes."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.physics.constants import AVOGADRO, LUMINOUS_EFFICACY, PLANCK, SPEED_OF_LIGHT
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: UV index per erythemal irradiance. [m² W⁻¹] World Health Organization (2002), Global Solar UV
#: Index: A Practical Guide, section 2.
UV_INDEX_SCALE: Final = 40.0


def erythema(wavelengths: ArrayLike) -> FloatArray:
    r"""Erythema reference action spectrum of the CIE.

    .. math:: s = 1 \;(250 \le \lambda \le 298), \quad
              10^{0.094 (298 - \lambda)} \;(\lambda \le 328), \quad
              10^{0.015 (140 - \lambda)} \;(\lambda \le 400)

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths; 0 outside 250 to 400. [nm]

    Returns
    -------
    array, shape (...)
        Relative effectiveness. [1]

    References
    ----------
    ISO/CIE 17166:2019, Erythema reference action spectrum and standard erythema dose; its spectrum
    of 1998 has 139 for 140 (McKinlay & Diffey 1987).

    Examples
    --------
    >>> erythema([290.0, 298.0, 320.0, 328.0, 401.0]).round(5)
    array([1.     , 1.     , 0.00855, 0.00151, 0.     ])
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    short = 10.0 ** (0.094 * (298.0 - np.clip(nm, 298.0, 328.0)))
    weight = np.where(nm <= 328.0, short, 10.0 ** (0.015 * (140.0 - nm)))
    return np.where((nm >= 250.0) & (nm <= 400.0), weight, 0.0)


def luminous_efficacy(wavelengths: ArrayLike) -> FloatArray:
    """Luminous efficacy of the photopic eye, 683 ȳ of CIE 1931; 0 outside 360 to 830 nm. [lm W⁻¹]

    Examples
    --------
    >>> luminous_efficacy([555.0, 900.0])
    array([683.,   0.])
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    seen = cie_1931()
    curve = np.interp(nm, seen.wavelengths, seen.values[:, 1], left=0.0, right=0.0)
    return LUMINOUS_EFFICACY * curve


def photons(wavelengths: ArrayLike) -> FloatArray:
    r"""Photons of light per its energy, :math:`\lambda/(h c N_A)`. [µmol J⁻¹]

    Examples
    --------
    >>> photons([550.0]).round(3)
    array([4.598])
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    return np.asarray(1e6 * nm * 1e-9 / (PLANCK * SPEED_OF_LIGHT * AVOGADRO))


def photosynthetic(wavelengths: ArrayLike) -> FloatArray:
    """1 in photosynthetically active light, 400 to 700 nm, else 0 (McCree 1972). [1]

    References
    ----------
    McCree (1972), Agric. Meteorol. 10, 443. doi:10.1016/0002-1571(72)90045-3
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    return np.where((nm >= 400.0) & (nm <= 700.0), 1.0, 0.0)

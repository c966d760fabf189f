"""Refractivity n - 1 of methane, water vapour, carbon monoxide and others, as measured.

All formulas are functions of σ = 1/λ in µm⁻¹. Each refuses wavelengths outside the limits that its
docstring gives; where these are wider than the measurement, it cites what supports them. Carbon
dioxide is in ``refractive_index``.
"""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.refractive_index import inverse_square_um

FloatArray = npt.NDArray[np.float64]

#: Wavelengths at which each formula is used. [nm]
CH4_RANGE: Final = (264.0, 1000.0)
H2O_RANGE: Final = (300.0, 1700.0)
CO_RANGE: Final = (168.0, 1000.0)
N2O_RANGE: Final = (307.0, 1000.0)
NH3_RANGE: Final = (300.0, 1000.0)
SO2_RANGE: Final = (350.0, 1700.0)


def ch4_refractivity_he2021(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of methane at 15 °C and 101 325 Pa.

    .. math:: 10^8 (n - 1) = 3603.09 + \frac{4.40362\cdot10^6}{117.41 - \sigma^2}

    Fitted from 264 to 671 nm. Beyond, up to 1000 nm, only 0.9 % of the value is dispersion, so
    that the position of the pole matters little. The formula of Sneep & Ubachs (2005) gives a 14 %
    larger refractivity, with a cross-section 18 % above the one that they measured themselves.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 264 to 1000. [nm]

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
    He, Fang, Shoshanim, Brown & Rudich (2021), Atmos. Chem. Phys. 21, 14927.
    doi:10.5194/acp-21-14927-2021

    Examples
    --------
    >>> f"{ch4_refractivity_he2021(589.3):.3e}"
    '4.205e-04'
    """
    s2 = inverse_square_um(wavelengths, CH4_RANGE)
    return np.asarray(1e-8 * (3603.09 + 4.40362e6 / (117.41 - s2)))


def h2o_refractivity_ciddor1996(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of water vapour at 20 °C and 1333 Pa.

    .. math:: 10^8 (n - 1) = 1.022\,(295.235 + 2.6422\,\sigma^2 - 0.032380\,\sigma^4
              + 0.004028\,\sigma^6)

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 300 to 1700. [nm]

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
    Ciddor (1996), Applied Optics 35, 1566, eq. 3. doi:10.1364/AO.35.001566

    Examples
    --------
    >>> f"{h2o_refractivity_ciddor1996(589.3):.3e}"
    '3.093e-06'
    """
    s2 = inverse_square_um(wavelengths, H2O_RANGE)
    series = 295.235 + 2.6422 * s2 - 0.032380 * s2**2 + 0.004028 * s2**3
    return np.asarray(1e-8 * 1.022 * series)


def co_refractivity_sneep2005(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of carbon monoxide at 15 °C and 101 325 Pa.

    .. math:: 10^8 (n - 1) = 22851 + \frac{456000}{51.018 - \sigma^2}

    Fitted from 168 to 288 nm (Smith, Huber & Parkinson 1976), where its dispersion is strongest; at
    589 nm it is 1 % above the 3.38e-4 (0 °C) of Kaye & Laby.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 168 to 1000. [nm]

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
    Sneep & Ubachs (2005), JQSRT 92, 293. doi:10.1016/j.jqsrt.2004.07.025;
    data: Smith, Huber & Parkinson (1976), Physical Review A 13, 199.

    Examples
    --------
    >>> f"{co_refractivity_sneep2005(589.3):.3e}"
    '3.232e-04'
    """
    s2 = inverse_square_um(wavelengths, CO_RANGE)
    return np.asarray(1e-8 * (22851.0 + 456_000.0 / (7.1427**2 - s2)))


def n2o_refractivity_he2021(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of nitrous oxide at 15 °C and 101 325 Pa.

    .. math:: 10^8 (n - 1) = 22095 + \frac{1.66291\cdot10^6}{67.5226 - \sigma^2}

    Fitted from 307 to 725 nm, and used up to 1000 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 307 to 1000. [nm]

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
    He, Fang, Shoshanim, Brown & Rudich (2021), Atmos. Chem. Phys. 21, 14927.
    doi:10.5194/acp-21-14927-2021

    Examples
    --------
    >>> f"{n2o_refractivity_he2021(589.3):.3e}"
    '4.782e-04'
    """
    s2 = inverse_square_um(wavelengths, N2O_RANGE)
    return np.asarray(1e-8 * (22095.0 + 1.66291e6 / (67.5226 - s2)))


def nh3_refractivity_cuthbertson1914(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of ammonia at 0 °C and 101 325 Pa.

    .. math:: n - 1 = \frac{0.032953}{90.392 - \sigma^2}

    Fitted from 480 to 671 nm; from 300 to 1000 nm it is within 0.9 % of the polarisability of
    Hohm (1993), Molecular Physics 78, 929.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 300 to 1000. [nm]

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
    Cuthbertson & Cuthbertson (1914), Philosophical Transactions A 213, 1.
    doi:10.1098/rsta.1914.0001

    Examples
    --------
    >>> f"{nh3_refractivity_cuthbertson1914(589.3):.3e}"
    '3.766e-04'
    """
    s2 = inverse_square_um(wavelengths, NH3_RANGE)
    return np.asarray(0.032953 / (90.392 - s2))


def so2_refractivity_static(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of sulphur dioxide at 0 °C and 101 325 Pa, without dispersion.

    .. math:: n - 1 = 2\pi N \alpha, \quad \alpha = 3.72\cdot10^{-30}\,\text{m}^3

    From the static polarisability: the dispersion, which grows towards the absorption bands below
    340 nm, is neglected, which makes the cross-section too small, by some ten per cent in the
    visible. Where the gas is 150 ppm of an atmosphere of carbon dioxide that is 3e-5 of the
    scattering.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 350 to 1700. [nm]

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
    Miller, Atomic and molecular polarizabilities, in CRC Handbook of Chemistry and Physics,
    Lide (ed.), section 10.

    Examples
    --------
    >>> f"{so2_refractivity_static(550.0):.3e}"
    '6.280e-04'
    """
    s2 = inverse_square_um(wavelengths, SO2_RANGE)
    return np.full(np.shape(s2), 2.0 * np.pi * 2.686780111e25 * 3.72e-30)

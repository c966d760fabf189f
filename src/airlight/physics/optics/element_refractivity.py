"""Refractivity n - 1 of nitrogen, oxygen, argon, hydrogen and helium at the state of measurement.

All formulas are functions of σ = 1/λ in µm⁻¹. Each refuses wavelengths outside the limits that its
docstring gives; where these are wider than the measurement, it cites what supports them.
"""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics.refractive_index import inverse_square_um

FloatArray = npt.NDArray[np.float64]

#: Wavelengths at which each formula is used. [nm]
N2_RANGE: Final = (254.0, 2500.0)
O2_RANGE: Final = (221.0, 2500.0)
AR_RANGE: Final = (140.4, 2500.0)
H2_RANGE: Final = (168.0, 1694.5)
HE_RANGE: Final = (275.0, 2058.6)


def n2_refractivity_bates1984(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of nitrogen at 0 °C and 101 325 Pa.

    .. math:: 10^8 (n - 1) = 6855.200 + \frac{3243157}{144 - \sigma^2}
              \quad (\lambda \ge 468\,\text{nm}), \qquad
              5989.242 + \frac{3363266.3}{144 - \sigma^2} \quad \text{below}

    The first is Peck & Khanna's fit, the second Bates's for the ultraviolet. Where they meet the
    second is lower by 1.5e-4 of the value. Measured to 2058.7 nm; it falls by 0.04 % to 2500 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 254 to 2500. [nm]

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
    Peck & Khanna (1966), JOSA 56, 1059. doi:10.1364/JOSA.56.001059;
    Bates (1984), Planetary and Space Science 32, 785. doi:10.1016/0032-0633(84)90102-8

    Examples
    --------
    >>> f"{n2_refractivity_bates1984(632.99):.5e}"
    '2.97744e-04'
    """
    s2 = inverse_square_um(wavelengths, N2_RANGE)
    visible = 6855.200 + 3_243_157.0 / (144.0 - s2)
    ultraviolet = 5989.242 + 3_363_266.3 / (144.0 - s2)
    return np.asarray(1e-8 * np.where(s2 > (1e3 / 468.0) ** 2, ultraviolet, visible))


def o2_refractivity_bates1984(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of oxygen at 0 °C and 101 325 Pa.

    .. math:: 10^8 (n - 1) = A + \frac{B}{40.9 - \sigma^2}

    with (A, B) = (22120.4, 203187.6) up to 288 nm, (20564.8, 248089.9) up to 546 nm and
    (21351.1, 218567.0) beyond. Bates gives it up to 1000 nm. From 400 to 550 nm it is within 0.12 %
    of the measurement of Zhang, Lu & Wang (2008), doi:10.1364/AO.47.003143, at 1000 nm 0.5 % and at
    1800 nm 0.7 % above it; it falls by 0.07 % from there to 2500 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 221 to 2500. [nm]

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
    Bates (1984), Planetary and Space Science 32, 785. doi:10.1016/0032-0633(84)90102-8

    Examples
    --------
    >>> f"{o2_refractivity_bates1984(589.3):.3e}"
    '2.710e-04'
    """
    s2 = inverse_square_um(wavelengths, O2_RANGE)
    far = 22120.4 + 203_187.6 / (40.9 - s2)
    near = 20564.8 + 248_089.9 / (40.9 - s2)
    visible = 21351.1 + 218_567.0 / (40.9 - s2)
    shorter = np.where(s2 > (1e3 / 288.0) ** 2, far, near)
    return np.asarray(1e-8 * np.where(s2 > (1e3 / 546.0) ** 2, shorter, visible))


def ar_refractivity_peck1964(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of argon at 0 °C and 101 325 Pa.

    .. math:: n - 1 = 6.7867\cdot10^{-5} + \frac{0.030182943}{144 - \sigma^2}
              \quad (\lambda \ge 468\,\text{nm}), \qquad
              \frac{2.50141\cdot10^{-3}}{91.012 - \sigma^2}
              + \frac{5.00283\cdot10^{-4}}{87.892 - \sigma^2}
              + \frac{5.22343\cdot10^{-2}}{214.02 - \sigma^2} \quad \text{below}

    The two differ by 4e-5 of the value where they meet. Measured to 2058.7 nm; it falls by 0.04 %
    to 2500 nm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 140.4 to 2500. [nm]

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
    Peck & Fisher (1964), JOSA 54, 1362. doi:10.1364/JOSA.54.001362; below 468 nm Bideau-Mehu,
    Guern, Abjean & Johannin-Gilles (1981), JQSRT 25, 395. doi:10.1016/0022-4073(81)90057-1

    Examples
    --------
    >>> f"{ar_refractivity_peck1964(550.0):.4e}"
    '2.8240e-04'
    """
    s2 = inverse_square_um(wavelengths, AR_RANGE)
    visible = 6.7867e-5 + 0.030182943 / (144.0 - s2)
    ultraviolet = (
        2.50141e-3 / (91.012 - s2) + 5.00283e-4 / (87.892 - s2) + 5.22343e-2 / (214.02 - s2)
    )
    return np.asarray(np.where(s2 > (1e3 / 468.0) ** 2, ultraviolet, visible))


def h2_refractivity_peck1977(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of hydrogen at 0 °C and 101 325 Pa.

    .. math:: n - 1 = \frac{0.0148956}{180.7 - \sigma^2} + \frac{0.0049037}{92.0 - \sigma^2}

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 168 to 1694.5. [nm]

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
    Peck & Huang (1977), JOSA 67, 1550. doi:10.1364/JOSA.67.001550

    Examples
    --------
    >>> f"{h2_refractivity_peck1977(546.227):.4e}"
    '1.3931e-04'
    """
    s2 = inverse_square_um(wavelengths, H2_RANGE)
    return np.asarray(0.0148956 / (180.7 - s2) + 0.0049037 / (92.0 - s2))


def he_refractivity_mansfield1969(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""Refractivity of helium at 0 °C and 101 325 Pa.

    .. math:: n - 1 = \frac{0.01470091}{423.98 - \sigma^2}

    Fitted from 480 to 2058.6 nm; down to 275 nm it stays within 0.2 % of Cuthbertson & Cuthbertson
    (1936).

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths, 275 to 2058.6. [nm]

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
    Mansfield & Peck (1969), JOSA 59, 199. doi:10.1364/JOSA.59.000199

    Examples
    --------
    >>> f"{he_refractivity_mansfield1969(508.582):.3e}"
    '3.499e-05'
    """
    s2 = inverse_square_um(wavelengths, HE_RANGE)
    return np.asarray(0.01470091 / (423.98 - s2))

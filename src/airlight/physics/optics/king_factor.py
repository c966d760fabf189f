"""King factors: the additional scattering by anisotropic molecules."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]

#: Dry air by volume: N₂, O₂, Ar. [%] Bodhaine et al. (1999), eq. 23.
_N2_PERCENT: Final = 78.084
_O2_PERCENT: Final = 20.946
_AR_PERCENT: Final = 0.934
#: Carbon dioxide in dry air at 360 ppm. [%] Bodhaine et al. (1999), section 3.
_CO2_PERCENT: Final = 0.036
#: King factor of carbon dioxide in air, held constant. [1] Bates (1984).
_CO2_IN_AIR: Final = 1.15
#: Wavenumber of one hartree, the atomic unit of energy. [cm⁻¹] CODATA 2018.
_HARTREE_WAVENUMBER: Final = 219_474.631_363_20


def king_factor_n2_bates1984(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""King factor of nitrogen, 1.034 + 3.17e-4/λ² with λ in µm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Bates (1984), Planetary and Space Science 32, 785. doi:10.1016/0032-0633(84)90102-8

    Examples
    --------
    >>> f"{king_factor_n2_bates1984(550.0):.4f}"
    '1.0350'
    """
    um2 = (values_in(wavelengths, "nm", "wavelengths") * 1e-3) ** 2
    return np.asarray(1.034 + 3.17e-4 / um2)


def king_factor_o2_bates1984(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""King factor of oxygen, 1.096 + 1.385e-3/λ² + 1.448e-4/λ⁴ with λ in µm.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Bates (1984), Planetary and Space Science 32, 785. doi:10.1016/0032-0633(84)90102-8

    Examples
    --------
    >>> f"{king_factor_o2_bates1984(550.0):.4f}"
    '1.1022'
    """
    um2 = (values_in(wavelengths, "nm", "wavelengths") * 1e-3) ** 2
    return np.asarray(1.096 + 1.385e-3 / um2 + 1.448e-4 / um2**2)


def king_factor_air_bates1984(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""King factor of dry air, the mean of its gases weighted by volume.

    .. math:: F_{N_2} = 1.034 + \frac{3.17\cdot10^{-4}}{\lambda^2}, \quad
              F_{O_2} = 1.096 + \frac{1.385\cdot10^{-3}}{\lambda^2}
                        + \frac{1.448\cdot10^{-4}}{\lambda^4}, \quad
              F_{Ar} = 1, \quad F_{CO_2} = 1.15 \quad (\lambda\ \text{in µm})

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Bates (1984), Planetary and Space Science 32, 785. doi:10.1016/0032-0633(84)90102-8;
    in the form of Bodhaine et al. (1999), JTECH 16, 1854, eqs. 5, 6 and 23.
    doi:10.1175/1520-0426(1999)016<1854:ORODC>2.0.CO;2

    Examples
    --------
    >>> f"{king_factor_air_bates1984(550.0):.3f}"  # Bates's Table 1 at 550 nm: 1.049
    '1.049'
    """
    nitrogen = king_factor_n2_bates1984(wavelengths)
    oxygen = king_factor_o2_bates1984(wavelengths)
    total = _N2_PERCENT + _O2_PERCENT + _AR_PERCENT + _CO2_PERCENT
    return np.asarray(
        (_N2_PERCENT * nitrogen + _O2_PERCENT * oxygen + _AR_PERCENT + _CO2_PERCENT * _CO2_IN_AIR)
        / total
    )


def king_factor_co2_alms1975(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""King factor of carbon dioxide.

    .. math:: F = 1.1364 + 25.3\cdot10^{-12}\,\tilde\nu^2 \quad (\tilde\nu\ \text{in cm}^{-1})

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Alms, Burnham & Flygare (1975), Journal of Chemical Physics 63, 3321. doi:10.1063/1.431821;
    in the form of Sneep & Ubachs (2005), JQSRT 92, 293. doi:10.1016/j.jqsrt.2004.07.025

    Examples
    --------
    >>> f"{king_factor_co2_alms1975(550.0):.4f}"
    '1.1448'
    """
    wavenumber = 1e7 / values_in(wavelengths, "nm", "wavelengths")
    return np.asarray(1.1364 + 25.3e-12 * wavenumber**2)


def king_factor_n2o_alms1975(wavelengths: npt.ArrayLike) -> FloatArray:
    r"""King factor of nitrous oxide, from the depolarisation ρ of polarised light.

    .. math:: F = \frac{3 + 6\rho}{3 - 4\rho}, \quad
              \rho = 0.0577 + 11.8\cdot10^{-12}\,\tilde\nu^2 \quad (\tilde\nu\ \text{in cm}^{-1})

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Alms, Burnham & Flygare (1975), Journal of Chemical Physics 63, 3321. doi:10.1063/1.431821;
    in the form of Sneep & Ubachs (2005), JQSRT 92, 293. doi:10.1016/j.jqsrt.2004.07.025

    Examples
    --------
    >>> f"{king_factor_n2o_alms1975(550.0):.3f}"
    '1.224'
    """
    wavenumber = 1e7 / values_in(wavelengths, "nm", "wavelengths")
    rho = 0.0577 + 11.8e-12 * wavenumber**2
    return np.asarray((3.0 + 6.0 * rho) / (3.0 - 4.0 * rho))


def king_factor_h2_hohm1993(wavelengths: npt.ArrayLike) -> FloatArray:
    """King factor of hydrogen, from its polarisability parallel and perpendicular to the axis.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Hohm (1993), Molecular Physics 78, 929.

    Examples
    --------
    >>> f"{king_factor_h2_hohm1993(550.0):.4f}"
    '1.0324'
    """
    return _of_two_oscillators(wavelengths, (1.62632, 0.23940245), (1.40105, 0.29486069))


def king_factor_nh3_hohm1993(wavelengths: npt.ArrayLike) -> FloatArray:
    """King factor of ammonia, from its polarisability parallel and perpendicular to the axis.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]

    Returns
    -------
    array, shape (...)
        King factor. [1]

    References
    ----------
    Hohm (1993), Molecular Physics 78, 929.

    Examples
    --------
    >>> f"{king_factor_nh3_hohm1993(550.0):.4f}"
    '1.0050'
    """
    return _of_two_oscillators(wavelengths, (1.28964, 0.08454599), (10.84943, 0.76338846))


def _of_two_oscillators(
    wavelengths: npt.ArrayLike, along: tuple[float, float], across: tuple[float, float]
) -> FloatArray:
    """F = 1 + 2(Δα/3α)² of a molecule with oscillators (f, ω₀²) along and across its axis.

    α = f/(ω₀² - ω²), all in atomic units.
    """
    frequency = 1e7 / values_in(wavelengths, "nm", "wavelengths") / _HARTREE_WAVENUMBER
    parallel, normal = (strength / (pole - frequency**2) for strength, pole in (along, across))
    mean = (parallel + 2.0 * normal) / 3.0
    return np.asarray(1.0 + 2.0 * ((parallel - normal) / (3.0 * mean)) ** 2)

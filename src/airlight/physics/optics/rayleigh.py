"""Rayleigh scattering by gases: cross-section, King factor, number density and scale height."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from airlight.physics.constants import AVOGADRO, BOLTZMANN, GAS_CONSTANT
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]


def cross_section(
    wavelengths: npt.ArrayLike,
    refractivity: npt.ArrayLike,
    number_density: npt.ArrayLike,
    king_factor: npt.ArrayLike = 1.0,
) -> FloatArray:
    r"""Rayleigh scattering cross-section of a molecule.

    .. math:: \sigma = \frac{24\pi^3 (n^2-1)^2}{\lambda^4 N^2 (n^2+2)^2}\, F

    The refractivity and the number density must belong to the same temperature and pressure;
    the cross-section itself then depends on neither. OpenSpace's form,
    8π³(n²-1)²/(3N²λ⁴)·F, is the limit n → 1.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths in vacuum. [nm]
    refractivity : array, shape (...)
        Refractivity n - 1. [1]
    number_density : array, shape (...)
        Number density of the gas at the state of the refractivity. [m⁻³]
    king_factor : array, shape (...)
        King factor F. [1]

    Returns
    -------
    array, shape (...)
        Cross-section. [m²]

    References
    ----------
    Bucholtz (1995), Applied Optics 34, 2765, eq. 1. doi:10.1364/AO.34.002765

    Examples
    --------
    >>> sigma = cross_section(550.0, 2.7782e-4, 2.5469e25, 1.0488)
    >>> f"{sigma:.2e}"  # Bucholtz, Table 1 at 0.55 µm: 4.513e-31 m² for 15 °C
    '4.51e-31'
    """
    excess = np.asarray(refractivity, dtype=np.float64)
    squared_excess = excess * (2.0 + excess)
    metres = values_in(wavelengths, "nm", "wavelengths") * 1e-9
    density = np.asarray(number_density, dtype=np.float64)
    ratio = squared_excess / (metres**2 * density * (squared_excess + 3.0))
    return np.asarray(24.0 * np.pi**3 * ratio**2 * np.asarray(king_factor, dtype=np.float64))


def depolarisation_from_king_factor(king_factor: npt.ArrayLike) -> FloatArray:
    r"""Depolarisation factor of a gas of King factor F.

    .. math:: \delta = \frac{6(F-1)}{3+7F} \quad\text{from}\quad F = \frac{6+3\delta}{6-7\delta}

    Parameters
    ----------
    king_factor : array, shape (...)
        King factor F, at least 1. [1]

    Returns
    -------
    array, shape (...)
        Depolarisation factor δ for unpolarised light. [1]

    Examples
    --------
    >>> f"{depolarisation_from_king_factor(king_factor_from_depolarisation(0.035)):.12f}"
    '0.035000000000'
    """
    factor = np.asarray(king_factor, dtype=np.float64)
    return np.asarray(6.0 * (factor - 1.0) / (3.0 + 7.0 * factor))


def king_factor_from_depolarisation(depolarisation: npt.ArrayLike) -> FloatArray:
    r"""King factor of a gas of depolarisation factor δ: (6+3δ)/(6-7δ).

    Parameters
    ----------
    depolarisation : array, shape (...)
        Depolarisation factor δ for unpolarised light, 0 to 0.5; the formula is singular at 6/7. [1]

    Returns
    -------
    array, shape (...)
        King factor F. [1]

    Examples
    --------
    >>> f"{king_factor_from_depolarisation(0.035):.4f}"
    '1.0608'
    """
    delta = np.asarray(depolarisation, dtype=np.float64)
    return np.asarray((6.0 + 3.0 * delta) / (6.0 - 7.0 * delta))


def number_density(temperature: float, pressure: float) -> float:
    """Number density of an ideal gas, p/(k_B T).

    Parameters
    ----------
    temperature : float
        Temperature. [K]
    pressure : float
        Pressure. [Pa]

    Returns
    -------
    float
        Number density. [m⁻³]

    Examples
    --------
    >>> f"{number_density(273.15, 101325.0):.6e}"  # the Loschmidt constant, CODATA 2018
    '2.686780e+25'
    """
    return pressure / (BOLTZMANN * temperature)


def number_density_from_mass(mass_density: float, molar_mass: float) -> float:
    """Number density of a gas from its mass density, N_A ρ/M.

    Parameters
    ----------
    mass_density : float
        Mass per volume. [kg m⁻³]
    molar_mass : float
        Mass of a mole. [kg mol⁻¹]

    Returns
    -------
    float
        Number density. [m⁻³]

    Examples
    --------
    >>> f"{number_density_from_mass(1.225, 28.9644e-3):.3e}"  # U.S. Standard Atmosphere: 2.547e25
    '2.547e+25'
    """
    return AVOGADRO * mass_density / molar_mass


def scale_height(temperature: float, molar_mass: float, gravity: float) -> float:
    """Scale height of an isothermal gas, R T/(M g).

    Parameters
    ----------
    temperature : float
        Temperature. [K]
    molar_mass : float
        Mass of a mole. [kg mol⁻¹]
    gravity : float
        Gravitational acceleration. [m s⁻²]

    Returns
    -------
    float
        Height over which the density falls by a factor e. [m]

    Examples
    --------
    >>> f"{scale_height(288.15, 28.9644e-3, 9.80665):.0f}"  # U.S. Standard Atmosphere: 8434.5 m
    '8435'
    """
    return GAS_CONSTANT * temperature / (molar_mass * gravity)

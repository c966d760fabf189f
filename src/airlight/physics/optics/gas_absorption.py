"""Absorption: Dobson units, an ozone profile, and particles in the Rayleigh limit."""

from __future__ import annotations

from functools import cache
from importlib import resources

import numpy as np
import numpy.typing as npt

from airlight.physics.constants import DOBSON_UNIT
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]


def column_from_dobson(dobson: float) -> float:
    """Column number density from Dobson units.

    Parameters
    ----------
    dobson : float
        Column, in 10 µm of gas at 0 °C and 101 325 Pa. [DU]

    Returns
    -------
    float
        Molecules per area. [m⁻²]

    Examples
    --------
    >>> f"{column_from_dobson(1.0):.4e}"
    '2.6868e+20'
    """
    return dobson * DOBSON_UNIT


def dobson_from_column(column: float) -> float:
    """Dobson units from column number density [m⁻²]. [DU]"""
    return column / DOBSON_UNIT


@cache
def ozone_profile_afgl1986() -> tuple[FloatArray, FloatArray]:
    """Ozone profile of the AFGL U.S. Standard atmosphere.

    Returns
    -------
    altitudes : array, shape (14,)
        Altitudes above the ground. [m]
    number_densities : array, shape (14,)
        Molecules per volume. [m⁻³]

    References
    ----------
    Anderson et al. (1986), AFGL Atmospheric Constituent Profiles (0-120 km), AFGL-TR-86-0110,
    Table 1f.

    Examples
    --------
    >>> altitudes, densities = ozone_profile_afgl1986()
    >>> float(altitudes[densities.argmax()]), float(densities.max())
    (22000.0, 4.9e+18)
    """
    file = resources.files("airlight.physics.optics") / "data" / "ozone-afgl1986-us-standard.csv"
    rows = [
        line.split(",")
        for line in file.read_text(encoding="utf-8").splitlines()
        if line and not line.startswith("#") and line[0].isdigit()
    ]
    table = np.array(rows, dtype=np.float64)
    table.flags.writeable = False
    return table[:, 0], table[:, 1]


def reference_coefficient(
    column: float, vertical_column: float, cross_sections: npt.ArrayLike
) -> FloatArray:
    """Absorption coefficient at relative density 1, from the total column of a gas.

    Parameters
    ----------
    column : float
        Molecules per area. [m⁻²]
    vertical_column : float
        Integral ∫ relative density dh over the shell. [m]
    cross_sections : array, shape (...)
        Absorption cross-sections. [m²]

    Returns
    -------
    array, shape (...)
        Absorption coefficients. [m⁻¹]

    Examples
    --------
    >>> f"{reference_coefficient(345 * DOBSON_UNIT, 15000.0, 3.314e-25):.3e}"  # 550 nm, AP2's tent
    '2.048e-06'
    """
    return np.asarray(column / vertical_column * np.asarray(cross_sections, dtype=np.float64))


def small_particle_absorption(
    wavelengths: npt.ArrayLike,
    radius: float,
    number_density: float,
    real: npt.ArrayLike,
    imaginary: npt.ArrayLike,
) -> FloatArray:
    r"""Absorption coefficient of particles in the Rayleigh limit.

    .. math:: \beta = \frac{8\pi^2 r^3 N}{\lambda}\,
              \mathrm{Im}\,\frac{m^2-1}{m^2+2}, \quad m = n + ik

    This is the limit of exact Mie absorption at small x = 2πr/λ: at m = 1.5 + 0.1i it is 0.6 % too
    small at x = 0.1, 5 % at x = 0.3 and 27 % at x = 1.

    Parameters
    ----------
    wavelengths : array, shape (...)
        Wavelengths. [nm]
    radius : float
        Radius r. [m]
    number_density : float
        Number density N. [m⁻³]
    real, imaginary : array, shape (...)
        Refractive index n and k, neither negative. [1]

    Returns
    -------
    array, shape (...)
        Coefficient, not negative. [m⁻¹]

    References
    ----------
    Costa et al., the OpenSpace paper, eq. 12; Bohren & Huffman (1983), Absorption and Scattering
    of Light by Small Particles, eq. 5.11.

    Examples
    --------
    >>> f"{small_particle_absorption(550.0, 1e-8, 1e9, 1.5, 0.1):.3e}"
    '7.151e-09'
    """
    square = (np.asarray(real, dtype=np.float64) + 1j * np.asarray(imaginary)) ** 2
    metres = values_in(wavelengths, "nm", "wavelengths") * 1e-9
    factor = ((square - 1.0) / (square + 2.0)).imag
    return np.asarray(8.0 * np.pi**2 * radius**3 * number_density / metres * factor)

"""Spectral values: a constant, or values at wavelengths.

Between wavelengths positive spectra (coefficients, optical depths, cross-sections, irradiances,
refractivities, imaginary parts of an index) follow power laws; albedos, asymmetries, weights,
ratios and real parts are linear.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator, ValidationInfo

from airlight.errors import ParameterError
from airlight.physics.spectra.power_law import power_law
from airlight.physics.units import values_in
from airlight.planets.parameters import all_between, finite, inside, numbers, parameters

FloatArray = npt.NDArray[np.float64]
#: Smallest and largest wavelength of data. [nm]
Limits = tuple[float, float]

#: Distance beyond its wavelengths over which an end value is used. [nm]
BEYOND: Final = 10.0
#: Limits of a value given for all wavelengths. [nm]
EVERYWHERE: Final[Limits] = (0.0, math.inf)
#: Range of wavelengths at which a planet may be sampled or described. [nm]
SHORTEST: Final = 10.0
LONGEST: Final = 1e6
#: Largest number of wavelengths of one list.
MOST_WAVELENGTHS: Final = 10_000


@parameters
class PerWavelength:
    """Values at listed wavelengths, constant up to 10 nm beyond them.

    Parameters
    ----------
    wavelengths : tuple of float
        Wavelengths in any order, without repetitions. [nm]
    values : tuple of float
        Values, one per wavelength.

    Examples
    --------
    >>> dust = PerWavelength(wavelengths=(680.0, 440.0), values=(0.8, 0.4))
    >>> dust.at([440.0, 500.0, 690.0]).tolist()
    [0.4, 0.5, 0.8]
    >>> haze = PerWavelength(wavelengths=(800.0, 400.0), values=(0.1, 0.4))
    >>> haze.at_power_law([400.0, 600.0]).round(4).tolist()
    [0.4, 0.1778]
    """

    wavelengths: Annotated[tuple[float, ...], all_between(SHORTEST, LONGEST, "nm")]
    values: Annotated[tuple[float, ...], all_between(-1e300, 1e300)]

    def __post_init__(self) -> None:
        check_wavelength_list(self.wavelengths)
        if len(self.values) != len(self.wavelengths):
            raise ParameterError(
                "values", self.values, f"one for each of {len(self.wavelengths)} wavelengths"
            )

    @property
    def limits(self) -> Limits:
        """Wavelength range, 10 nm beyond the listed ones. [nm]"""
        return min(self.wavelengths) - BEYOND, max(self.wavelengths) + BEYOND

    def at(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Value at wavelengths within ``limits`` [nm], shape (...); linear between its own."""
        order = np.argsort(self.wavelengths)
        known = np.asarray(self.wavelengths)[order]
        nm = values_in(wavelengths, "nm", "wavelengths")
        return np.asarray(np.interp(nm, known, np.asarray(self.values)[order]))

    def at_power_law(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Value of a positive spectrum at wavelengths within ``limits`` [nm], shape (...).

        See ``physics.spectra.power_law``.
        """
        nm = values_in(wavelengths, "nm", "wavelengths")
        return power_law(nm, self.wavelengths, self.values)

    def at_fourth_power(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Value at any wavelength [nm], shape (...): a power law between its own, λ⁻⁴ beyond."""
        nm = values_in(wavelengths, "nm", "wavelengths")
        factor = np.asarray(self.values) * np.asarray(self.wavelengths) ** 4
        return power_law(nm, self.wavelengths, factor) / nm**4


def check_wavelength_list(wavelengths: tuple[float, ...], field: str = "wavelengths") -> None:
    """Raise an error for a list that is empty, too long or repeats a wavelength."""
    if not 1 <= len(wavelengths) <= MOST_WAVELENGTHS:
        raise ParameterError(field, wavelengths, f"1 to {MOST_WAVELENGTHS} wavelengths")
    if len(set(wavelengths)) != len(wavelengths):
        raise ParameterError(field, wavelengths, "each wavelength once")


#: One number for all wavelengths, or numbers at given wavelengths.
Spectral = float | PerWavelength


def spectral(low: float, high: float, unit: str = "") -> BeforeValidator:
    """Validator of a field: a number or ``PerWavelength``, each value in a range."""

    def check(value: Any, info: ValidationInfo) -> Any:
        return check_spectral(value, info.field_name or "value", low, high, unit)

    return BeforeValidator(check)


def check_spectral(value: Any, field: str, low: float, high: float, unit: str = "") -> Spectral:
    """Validated number or ``PerWavelength``; errors show the value out of range."""
    if isinstance(value, PerWavelength):
        numbers(value.values, field, low, high, unit)
        return value
    return inside(value, field, low, high, unit, above=False, below=False)


def spectral_at(value: Spectral, wavelengths: npt.ArrayLike) -> FloatArray:
    """Linear interpolation to wavelengths [nm], shape (n,)."""
    if isinstance(value, PerWavelength):
        return value.at(wavelengths)
    return np.full(np.shape(wavelengths), finite(value, "value"))


def power_law_at(value: Spectral, wavelengths: npt.ArrayLike) -> FloatArray:
    """Value of a positive spectrum at each wavelength [nm], shape (n,)."""
    if isinstance(value, PerWavelength):
        return value.at_power_law(wavelengths)
    return spectral_at(value, wavelengths)


def spectral_limits(*values: Spectral) -> Limits:
    """Common wavelength range of several values. [nm]"""
    return narrowest(value.limits for value in values if isinstance(value, PerWavelength))


def narrowest(limits: Any) -> Limits:
    """Overlap of several ranges; lowest above highest if there is none. [nm]"""
    low, high = EVERYWHERE
    for one_low, one_high in limits:
        low, high = max(low, one_low), min(high, one_high)
    return low, high


def table_limits(name: str) -> Limits:
    """Wavelength range of a table of ``airlight.physics.spectra``, 10 nm beyond its ends. [nm]"""
    from airlight.physics.spectra.tables import read_spectrum

    wavelengths = read_spectrum(name).wavelengths
    return float(wavelengths[0]) - BEYOND, float(wavelengths[-1]) + BEYOND

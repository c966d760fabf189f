"""What only absorbs, as parameter objects: gases by cross-section, tiny particles by index."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator

from airlight.errors import ParameterError
from airlight.optics.gas_absorption import reference_coefficient, small_particle_absorption
from airlight.planets.matter.matter import Absorber
from airlight.planets.parameters import MISSING, Fraction, between, parameters
from airlight.planets.spectral import (
    Limits,
    Spectral,
    check_spectral,
    narrowest,
    spectral,
    spectral_at,
    spectral_limits,
    table_limits,
)

FloatArray = npt.NDArray[np.float64]

_Column = Annotated[float, between(0.0, 1e33, "/m^2")]
_NumberDensity = Annotated[float, between(0.0, 1e29, "/m^3")]


@parameters
class OzoneAbsorption(Absorber):
    """Absorption by ozone of a given column, however the profile spreads it.

    Parameters
    ----------
    column : float
        Molecules above an area of ground. [m⁻²]
    """

    column: Annotated[float, between(0.0, 1e25, "/m^2")]

    @property
    def limits(self) -> Limits:
        """The wavelengths at which the cross-section is known. [nm]"""
        return table_limits("ozone-293k")

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        vertical_column : float
            ∫ relative density dh over the shell. [m]
        """
        from airlight.spectra.ozone import ozone_cross_section

        return reference_coefficient(self.column, vertical_column, ozone_cross_section(wavelengths))


def _cross_section(value: Any) -> str | Spectral:
    """A number, numbers per wavelength, or the name of a table of areas."""
    if not isinstance(value, str):
        return check_spectral(value, "cross_section", 0.0, 1e-10, "m^2")
    from airlight.spectra.tables import read_spectrum, spectrum_names

    tables = [name for name in spectrum_names() if read_spectrum(name).unit == "m^2"]
    if value not in tables:
        raise ParameterError(
            "cross_section", value, f"a number, or a table of areas: {', '.join(tables)}"
        )
    return value


@parameters
class CrossSectionAbsorption(Absorber):
    """Absorption by molecules of known cross-section, by their column or their density.

    Oxygen of OpenSpace's equations 13 and 14 is this with the number density of air and the
    fraction 0.2095, beside the exponential profile of the air.

    Parameters
    ----------
    cross_section : float, PerWavelength or str
        Of one molecule; the name of a table of ``airlight.spectra`` in m². [m²]
    column : float, optional
        Molecules above an area of ground, which the profile spreads. [m⁻²]
    number_density : float, optional
        Instead of the column: at relative density 1. [m⁻³]
    fraction : float
        Of the number density, that absorbs so, 0 to 1. [1]

    References
    ----------
    Costa et al., the OpenSpace paper, eqs. 13 and 14 (with exp(-h/H), not the printed exp(+h/H)).

    Examples
    --------
    >>> layer = CrossSectionAbsorption(cross_section="ozone-293k", column=9.269e22)
    >>> layer.coefficients([550.0], vertical_column=15000.0).round(9).tolist()
    [2.048e-06]
    """

    cross_section: Annotated[Any, BeforeValidator(_cross_section)]
    column: _Column | None = None
    number_density: _NumberDensity | None = None
    fraction: Fraction = 1.0

    def __post_init__(self) -> None:
        if (self.column is None) == (self.number_density is None):
            given = MISSING if self.column is None else self.column
            raise ParameterError("column", given, "a column or a number_density, one of them")
        if self.column is not None and self.fraction != 1.0:
            raise ParameterError("fraction", self.fraction, "none beside a column")

    @property
    def limits(self) -> Limits:
        """The wavelengths at which the cross-section is known. [nm]"""
        if isinstance(self.cross_section, str):
            return table_limits(self.cross_section)
        return spectral_limits(self.cross_section)

    def cross_sections(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Of one molecule, shape (nl,). [m²]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        """
        if isinstance(self.cross_section, str):
            from airlight.spectra.tables import read_spectrum

            return read_spectrum(self.cross_section).at(wavelengths)
        return spectral_at(self.cross_section, wavelengths)

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        vertical_column : float
            ∫ relative density dh over the shell; not used where a number density is given. [m]
        """
        sigma = self.cross_sections(wavelengths)
        if self.number_density is not None:
            return self.number_density * self.fraction * sigma
        assert self.column is not None
        return reference_coefficient(self.column, vertical_column, sigma)


@parameters
class SmallParticleAbsorption(Absorber):
    """Absorption by particles much smaller than the wavelength, whose scattering is left out.

    Parameters
    ----------
    radius : float
        1e-10 to 1e-5. [m]
    number_density : float
        At relative density 1. [m⁻³]
    real, imaginary : float or PerWavelength
        Refractive index n + ik, k ≥ 0. [1]

    Notes
    -----
    See ``small_particle_absorption`` for how far it holds. Wavelengths shorter than the
    circumference 2πr are refused.
    """

    radius: Annotated[float, between(1e-10, 1e-5, "m")]
    number_density: _NumberDensity
    real: Annotated[Spectral, spectral(0.01, 20.0)]
    imaginary: Annotated[Spectral, spectral(0.0, 20.0)]

    @property
    def limits(self) -> Limits:
        """The wavelengths at which it is known: those above the circumference. [nm]"""
        circumference = 2e9 * np.pi * self.radius
        given = spectral_limits(self.real, self.imaginary)
        return narrowest([(circumference, np.inf), given])

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            [nm]
        vertical_column : float
            Not used: the density is known. [m]
        """
        return small_particle_absorption(
            wavelengths,
            self.radius,
            self.number_density,
            spectral_at(self.real, wavelengths),
            spectral_at(self.imaginary, wavelengths),
        )

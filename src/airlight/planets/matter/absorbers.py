"""Absorbers as parameter objects: gases by cross-section, small particles by refractive index."""

from __future__ import annotations

from functools import cache
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.physics.optics.gas_absorption import reference_coefficient, small_particle_absorption
from airlight.planets.matter.band_absorption import BandAbsorption
from airlight.planets.matter.matter import Absorber
from airlight.planets.matter.particle_index import INDICES
from airlight.planets.matter.state_keys import COLUMN, DENSITY, RADIUS
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import Field, Wavelengths, key
from airlight.planets.schema.tagged_union import Alternatives, NestedTable
from airlight.planets.schema.toml_table import TomlTable, spectral_of, suggestion
from airlight.planets.spectral import (
    Limits,
    PerWavelength,
    Spectral,
    narrowest,
    power_law_at,
    spectral,
    spectral_at,
    spectral_limits,
    table_limits,
)

FloatArray = npt.NDArray[np.float64]


@parameters
class OzoneAbsorption(Absorber):
    """Absorption by ozone of a given column, with any profile.

    Parameters
    ----------
    column : float
        Vertical column of molecules. [m⁻²]
    temperature : float
        Temperature of the cross-section, 193 to 293. [K]
    """

    keyword = "ozone"

    column: float = key(
        COLUMN,
        label="ozone column",
        help="All the ozone above the ground.",
        range=(0.0, 1e25),
        name="ozone",
        note="In DU, atm-cm, mol/m^2 or molecules over an area. Spread over the profile, times"
        " the cross-section.",
    )
    temperature: float = key(
        label="ozone temperature",
        help="Temperature of the cross-section: its mean over the ozone.",
        note="The Earth's ozone has 225 K: 13 % less absorption at 305 nm than at 293 K.",
        unit="K",
        range=(193.0, 293.0),
        mode="advanced",
        default=293.0,
        example="225 K",
    )

    @property
    def limits(self) -> Limits:
        """Wavelength range of the cross-section. [nm]"""
        return table_limits("ozone-293k")

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        vertical_column : float
            Integral ∫ relative density dh over the shell. [m]
        """
        from airlight.physics.spectra.ozone import ozone_cross_section

        sigma = ozone_cross_section(wavelengths, self.temperature)
        return reference_coefficient(self.column, vertical_column, sigma)


def _read_cross_section(table: TomlTable, name: str, wavelengths: Wavelengths) -> Any:
    """Read the name of a table, or the numbers of a file or a list. [m²]"""
    allowed = "a table's name, a path to a CSV file, or such as '1.4e-21 cm^2'"
    value = table.required(name, allowed)
    field = table.name_of(name)
    if not isinstance(value, str):
        return spectral_of(value, "m^2", field, wavelengths)
    from airlight.physics.spectra.tables import spectrum_names

    if value in spectrum_names():
        return value
    if value.endswith(".csv"):
        return _from_file(table, value, field)
    if value[:1].isalpha():
        raise ParameterError(field, value, suggestion(value, spectrum_names()))
    return spectral_of(value, "m^2", field, wavelengths)


def _from_file(table: TomlTable, name: str, field: str) -> PerWavelength:
    from airlight.physics.spectra.tables import read_spectrum_file
    from airlight.physics.units import quantity

    spectrum = read_spectrum_file(table.beside(name))
    unit = quantity(f"1 {spectrum.unit}", "m^2", f"unit of {field}")
    if spectrum.values.ndim != 1:
        raise ParameterError(field, spectrum.columns, "a table with one column of values")
    with table.prefix_errors():
        return PerWavelength(
            wavelengths=tuple(spectrum.wavelengths.tolist()),
            values=tuple((unit * spectrum.values).tolist()),
        )


@cache
def _areas() -> tuple[str, ...]:
    """Names of the cross-section tables in the package."""
    from airlight.physics.spectra.tables import read_spectrum, spectrum_names

    tables = [read_spectrum(name) for name in spectrum_names()]
    return tuple(one.name for one in tables if one.unit == "m^2")


@parameters
class CrossSectionAbsorption(Absorber):
    """Absorption by molecules of given cross-section and column or number density.

    Oxygen in OpenSpace's equations 13 and 14 is this absorber with the number density of air, the
    fraction 0.2095 and the exponential profile of air.

    Parameters
    ----------
    cross_section : float, PerWavelength or str
        Cross-section of one molecule, or the name of a table of ``physics.spectra`` in m². [m²]
    column : float, optional
        Vertical column of molecules. [m⁻²]
    number_density : float, optional
        Number density at relative density 1, instead of the column. [m⁻³]
    fraction : float
        Mole fraction of the absorber, 0 to 1. [1]

    References
    ----------
    Costa et al., the OpenSpace paper, eqs. 13 and 14 (with exp(-h/H), not the printed exp(+h/H)).

    Examples
    --------
    >>> layer = CrossSectionAbsorption(cross_section="ozone-293k", column=9.269e22)
    >>> layer.coefficients([550.0], vertical_column=15000.0).round(9).tolist()
    [2.048e-06]
    """

    keyword = "cross_section"

    cross_section: Any = key(
        label="cross-section",
        help="Absorption cross-section of one molecule.",
        note="One value or a list, the name of a table, or the path to a CSV file.",
        unit="m^2",
        range=(0.0, 1e-10),
        spectral=True,
        read=_read_cross_section,
        shown="cm^2",
        slider=(1e-26, 1e-16),
        scale="log",
        choices=_areas,
    )
    column: float | None = key(COLUMN, default=None)
    number_density: float | None = key(
        DENSITY,
        help="Molecules of the air in a cubic metre, where the profile is 1.",
        note="Instead of the column.",
        range=(0.0, 1e29),
        default=None,
    )
    fraction: float = key(
        label="share",
        help="Mole fraction of the absorber.",
        range=(0.0, 1.0),
        offered=lambda table: "number_density" in table,
        default=1.0,
    )

    def __post_init__(self) -> None:
        if (self.column is None) == (self.number_density is None):
            given = MISSING if self.column is None else self.column
            raise ParameterError("column", given, "either a column or a number_density")
        if self.column is not None and self.fraction != 1.0:
            raise ConflictError("fraction", "cannot be combined with column")

    @property
    def limits(self) -> Limits:
        """Wavelength range of the cross-section. [nm]"""
        if isinstance(self.cross_section, str):
            return table_limits(self.cross_section)
        return spectral_limits(self.cross_section)

    def cross_sections(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Cross-section of one molecule, shape (nl,). [m²]"""
        if isinstance(self.cross_section, str):
            from airlight.physics.spectra.tables import read_spectrum

            return read_spectrum(self.cross_section).at(wavelengths)
        return power_law_at(self.cross_section, wavelengths)

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        sigma = self.cross_sections(wavelengths)
        if self.number_density is not None:
            return self.number_density * self.fraction * sigma
        assert self.column is not None
        return reference_coefficient(self.column, vertical_column, sigma)


@parameters
class SmallParticleAbsorption(Absorber):
    """Absorption by particles much smaller than the wavelength, without their scattering.

    Parameters
    ----------
    radius : float
        Radius, 1e-10 to 1e-5. [m]
    number_density : float
        Number density at relative density 1. [m⁻³]
    real, imaginary : float or PerWavelength
        Refractive index n + ik, k ≥ 0. [1]

    Notes
    -----
    See ``small_particle_absorption`` for the range of validity. Wavelengths shorter than the
    circumference 2πr are refused.
    """

    extra_keys = (
        Field(
            name="index",
            label="refractive index",
            help="Complex refractive index n + ik.",
            kind="table",
            table=INDICES,
            required=True,
        ),
    )

    radius: float = key(
        RADIUS,
        help="Of the particles.",
        range=(1e-10, 1e-5),
        shown="nm",
        slider=(1.0, 100.0),
        example="10 nm",
    )
    number_density: float = key(
        DENSITY,
        help="Particles in a cubic metre.",
        slider=(1e6, 1e18),
        example="1e9 /m^3",
        range=(0.0, 1e29),
    )
    real: Annotated[Spectral, spectral(0.01, 20.0)]
    imaginary: Annotated[Spectral, spectral(0.0, 20.0)]

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Fields, with both parts of the index; see ``TomlModel.read_values``."""
        index = table.table("index", "a table such as { real = 1.5, imaginary = 0.1 }")
        parts = {
            part: index.spectral(part, "1", "1.5", wavelengths) for part in ("real", "imaginary")
        }
        index.finish()
        return super().read_values(table, wavelengths, **parts)

    @property
    def limits(self) -> Limits:
        """Wavelength range, from the circumference of a particle up. [nm]"""
        circumference = 2e9 * np.pi * self.radius
        given = spectral_limits(self.real, self.imaginary)
        return narrowest([(circumference, np.inf), given])

    def coefficients(self, wavelengths: npt.ArrayLike, vertical_column: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        return small_particle_absorption(
            wavelengths,
            self.radius,
            self.number_density,
            spectral_at(self.real, wavelengths),
            power_law_at(self.imaginary, wavelengths),
        )


#: Kinds of ``absorption = { … }``, distinguished by a key.
ABSORBERS: Final[Alternatives[Absorber]] = Alternatives(
    Absorber,
    (
        OzoneAbsorption,
        CrossSectionAbsorption,
        BandAbsorption,
        NestedTable(
            Field(
                name="small_particles",
                label="small particles",
                help="Absorbing particles much smaller than the wavelength.",
                note="Their scattering is neglected: 8π²r³N/λ · Im[(m²-1)/(m²+2)], m = n + ik."
                " 5 % too small at 2πr = 0.3 λ; refused at wavelengths below 2πr.",
                kind="table",
                table=SmallParticleAbsorption,
                prefix="absorption",
                mode="advanced",
                example="a table with radius, number_density and index",
            )
        ),
    ),
)

"""Constituent of the atmosphere: density profile, scattering and absorption."""

from __future__ import annotations

from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.physics.units import values_in
from airlight.planets.matter.coefficients import (
    ABSORPTION,
    COEFFICIENTS,
    OTHER_FORMS,
    SCATTERING,
    read_coefficients,
)
from airlight.planets.matter.gas_mixture import GasMixture
from airlight.planets.matter.matter import Absorber, Matter, Scatterer
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.phases import PHASES, PhaseFunction
from airlight.planets.matter.profiles import PROFILES, Exponential, Profile
from airlight.planets.matter.turbidity import LiteralTurbidity, Turbidity
from airlight.planets.parameters import instance_of, parameters
from airlight.planets.schema.field import Field, FileTable, Wavelengths, always, key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import (
    Limits,
    PerWavelength,
    Spectral,
    narrowest,
    power_law_at,
)

FloatArray = npt.NDArray[np.float64]

#: Kinds of matter of a constituent, by the key of its table.
MATTER: Final[tuple[type[Matter], ...]] = (GasMixture, Particles, Turbidity, LiteralTurbidity)


@parameters
class Constituent(TomlModel):
    """Constituent of the atmosphere.

    Parameters
    ----------
    name : str
        Name of 1 to 60 letters, unique within a planet.
    profile : Exponential, Tent, Layered, Tabulated or Uniform
        Relative density over altitude.
    scattering : float, PerWavelength, GasScattering or RefractiveScattering
        Coefficient at relative density 1, 0 to 1. [m⁻¹]
    absorption : float, PerWavelength or Absorber
        Coefficient at relative density 1, 0 to 1. [m⁻¹]
    phase_function : Rayleigh, CornetteShanks, …, optional
        Required for scattering without a phase function of its own; replaces that of a gas or of
        ``matter``.
    matter : Matter, optional
        Gas mixture or particles, instead of ``scattering``; ``absorption`` is then added to that of
        the matter.
    amount : float
        Factor of scattering and absorption at all wavelengths, 0 to 100; refraction by a
        gas is unchanged. [1]

    Notes
    -----
    Coefficients follow power laws between given wavelengths (``spectra.power_law``), and beyond
    them are constant for 10 nm or, with a ``Rayleigh`` phase function, follow λ⁻⁴.

    Examples
    --------
    >>> from airlight.planets import load_planet, replace
    >>> air = load_planet("mars-rayleigh").constituents[0]
    >>> twice = replace(air, amount=2.0)
    >>> twice.scattering_coefficients([550.0], 1e5) / air.scattering_coefficients([550.0], 1e5)
    array([2.])
    """

    has_wavelengths = True
    extra_keys = (
        *OTHER_FORMS,
        *(
            Field(
                name=kind.keyword,
                label=kind.label,
                help=kind.help,
                kind="table",
                table=kind,
                example=f"a table such as {kind.example}",
            )
            for kind in MATTER
        ),
    )

    name: str = key(
        help="Name of the constituent.",
        note="1 to 60 letters.",
        range=(1.0, 60.0),
        example="a name of its own",
    )
    profile: Profile = key(
        help="Density profile over altitude.",
        note="Optional for a `gas` with a gravity.",
        table=PROFILES,
        example="a table such as { kind = 'exponential', … }",
    )
    scattering: Spectral | Scatterer = key(SCATTERING, default=0.0)
    absorption: Spectral | Absorber = key(ABSORPTION, default=0.0)
    phase_function: PhaseFunction | None = key(
        help="Phase function.",
        note="Required if the constituent scatters and its composition implies none.",
        table=PHASES,
        example="a table such as { kind = 'rayleigh' }",
        default=None,
    )
    amount: float = key(
        help="Factor applied to scattering and absorption at all wavelengths.",
        note="Refraction is not affected.",
        range=(0.0, 100.0),
        slider=(0.1, 10.0),
        scale="log",
        offered=always,
        default=1.0,
    )
    matter: Annotated[Matter, instance_of(Matter)] | None = None

    def __post_init__(self) -> None:
        if self.matter is not None and self.scattering != 0.0:
            raise ConflictError("scattering", "cannot be combined with matter")
        if self.scatters and self._substance is None and self.phase_function is None:
            raise ConflictError("phase_function", "is required: the constituent scatters")

    @classmethod
    def declared(cls, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of its table: profile first, phase function last, as editors show them."""
        keys = {one.name: one for one in super().declared(table)}
        name, profile, wavelengths, phase = (
            keys.pop(one) for one in ("name", "profile", "wavelengths", "phase_function")
        )
        return (name, profile, wavelengths, *keys.values(), phase)

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Values of the table; scattering and absorption from any of their forms."""
        wavelengths = table.wavelengths()
        matter = next((kind for kind in MATTER if kind.keyword in table), None)
        if matter is not None:
            found = _read_matter(matter, table, wavelengths)
            return super().read_values(table, wavelengths, **found)
        values = super().read_values(table, wavelengths)
        return {**values, **read_coefficients(table, wavelengths, values)}

    @property
    def _substance(self) -> Matter | Scatterer | None:
        """Substance with its own scattering and phase function; None if coefficients are given."""
        if self.matter is not None:
            return self.matter
        return self.scattering if isinstance(self.scattering, Scatterer) else None

    @property
    def bends(self) -> bool:
        """Whether it refracts: a gas of known refractivity."""
        return self._substance is not None and self._substance.bends

    @property
    def scatters(self) -> bool:
        """Whether it scatters at any wavelength."""
        if isinstance(self.scattering, PerWavelength):
            return any(value > 0.0 for value in self.scattering.values)
        return self._substance is not None or self.scattering != 0.0

    @property
    def _follows_fourth_power(self) -> bool:
        return self.phase_function is not None and self.phase_function.molecular

    @property
    def limits(self) -> Limits:
        """Wavelength range of all its properties. [nm]"""
        own = (self._substance, self.absorption, self.phase_function)
        limits = [part.limits for part in own if isinstance(part, TomlModel)]
        given = [self.absorption, *([] if self._follows_fourth_power else [self.scattering])]
        listed = [value.limits for value in given if isinstance(value, PerWavelength)]
        return narrowest([*limits, *listed])

    def scattering_coefficients(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        thickness : float
            Thickness of the shell. [m]
        """
        return self.amount * self._scattering(wavelengths, thickness)

    def _scattering(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        if self.matter is not None:
            return self.matter.scattering_coefficients(wavelengths, self._column(thickness))
        if isinstance(self.scattering, Scatterer):
            return self.scattering.coefficients(wavelengths)
        if self._follows_fourth_power and isinstance(self.scattering, PerWavelength):
            return self.scattering.at_fourth_power(wavelengths)
        return power_law_at(self.scattering, wavelengths)

    def absorption_coefficients(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        if isinstance(self.absorption, Absorber):
            total = self.absorption.coefficients(wavelengths, self._column(thickness))
        else:
            total = power_law_at(self.absorption, wavelengths)
        if self.matter is not None:
            column = self._column(thickness)
            total = total + self.matter.absorption_coefficients(wavelengths, column)
        return self.amount * total

    def refractivities(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        """Refractivity n - 1 of a gas at relative density 1, shape (nl,); otherwise 0. [1]"""
        if self._substance is None:
            return np.zeros(np.shape(wavelengths))
        return self._substance.refractivities(wavelengths)

    def _column(self, thickness: float) -> float:
        column = self.profile.column(thickness)
        if not column > 0.0:
            raise ParameterError("profile", self.profile, "a density above 0 in the shell")
        return column

    def phase_values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]

        Zero if it does not scatter.
        """
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        if not self.scatters:
            return np.zeros((*np.shape(nu), len(nm)))
        return self.phase_function_at(nm).values(nu, nm)

    def polarising_values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Element F₁₂ of its phase matrix, shape of nu (...) and (nl,) to (..., nl). [sr⁻¹]

        Zero if it does not scatter or polarise.
        """
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        if not self.scatters:
            return np.zeros((*np.shape(nu), len(nm)))
        return self.phase_function_at(nm).phase_f12(nu, nm)

    def polarising_moments(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Expansion coefficients of the phase matrix, see ``PhaseFunction``, shape (nl, 4). [1]"""
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        if not self.scatters:
            return np.zeros((len(nm), 4))
        return self.phase_function_at(nm).polarising_moments(nm)

    def phase_moments(self, wavelengths: npt.ArrayLike, degree: int) -> FloatArray:
        """Legendre moments of the phase function, shape (nl, degree + 1). [1]

        See ``physics.optics.legendre``; zero if it does not scatter.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        degree : int
            Highest degree l.
        """
        nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
        if not self.scatters:
            return np.zeros((len(nm), degree + 1))
        return self.phase_function_at(nm).moments(nm, degree)

    def phase_function_at(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Explicit phase function, or that of the gas or matter at some wavelengths."""
        if self.phase_function is not None:
            return self.phase_function
        if self._substance is None:
            raise ConflictError("phase_function", "is required: the constituent scatters")
        return self._substance.phase_function(wavelengths)


def _read_matter(kind: type[Matter], table: TomlTable, wavelengths: Wavelengths) -> dict[str, Any]:
    """Matter, which can be combined with absorption only, and the profile that a gas implies."""
    for name in (*(one.keyword for one in MATTER if one is not kind), *COEFFICIENTS):
        if name != "absorption" and name in table:
            raise ConflictError(table.name_of(name), f"cannot be combined with {kind.keyword}")
    inner = table.table(kind.keyword, f"a table such as {kind.example}")
    matter = kind.read(inner, wavelengths)
    if matter.needs_phase and "phase_function" not in table:
        name = table.name_of("phase_function")
        raise ConflictError(name, f"is required for {matter.needs_phase}")
    if "profile" not in table:
        with table.prefix_errors(), inner.prefix_errors():
            height = matter.own_scale_height()
            if height is not None:
                return {"matter": matter, "profile": Exponential(scale_height=height)}
    return {"matter": matter}

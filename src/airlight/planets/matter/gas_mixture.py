"""Gas by its composition and state: scattering, refraction and scale height."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt
from pydantic import BeforeValidator

from airlight.errors import ConflictError, ParameterError
from airlight.physics.optics import lorentz_lorenz, rayleigh
from airlight.physics.optics.molecules import MOLECULES
from airlight.physics.units import values_in
from airlight.planets.matter.gases import density_of_state, rayleigh_of
from airlight.planets.matter.matter import Matter
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.state_keys import (
    DENSITY,
    DEPOLARISATION,
    GRAVITY,
    PRESSURE,
    REFRACTIVITY,
    TEMPERATURE,
)
from airlight.planets.parameters import finite, parameters
from airlight.planets.schema.field import Field, FileTable, Wavelengths, key
from airlight.planets.schema.toml_table import TomlTable, suggestion
from airlight.planets.spectral import (
    Limits,
    PerWavelength,
    Spectral,
    check_spectral,
    narrowest,
    power_law_at,
    spectral_at,
    spectral_limits,
)

FloatArray = npt.NDArray[np.float64]

#: Largest deviation of the sum of the fractions from 1 that is corrected by division.
FRACTION_TOLERANCE: Final = 0.01
#: Largest relative deviation of a given refractivity from the composition's at its given state.
REFRACTIVITY_TOLERANCE: Final = 0.1
#: Depolarisation of a rod, the largest possible. [1]
LARGEST_DEPOLARISATION: Final = 0.5
#: Meaning of temperature and pressure given beside a refractivity.
_MEASURED: Final = "of the state that the refractivity was measured at"


def _composition(value: Any) -> tuple[tuple[str, float], ...]:
    """Pairs of formula and mole fraction, normalised to 1, from a mapping or pairs."""
    try:
        given = dict(value.items() if isinstance(value, Mapping) else value)
    except (TypeError, ValueError):
        raise ParameterError("composition", value, "such as { N2 = 0.79, O2 = 0.21 }") from None
    for name, fraction in given.items():
        if name not in MOLECULES:
            raise ParameterError("composition", name, f"gases among {', '.join(MOLECULES)}")
        field = f"composition.{name}"
        if not 0.0 <= finite(fraction, field, "0 to 1") <= 1.0 + FRACTION_TOLERANCE:
            raise ParameterError(field, fraction, "0 to 1")
    total = sum(float(fraction) for fraction in given.values())
    if not abs(total - 1.0) <= FRACTION_TOLERANCE:
        raise ParameterError("composition", total, "mole fractions whose sum is 1 within 1 %")
    return tuple((name, float(fraction) / total) for name, fraction in given.items() if fraction)


def _depolarisation(value: Any) -> Any:
    """Validated depolarisation factor; the error names the physical limit."""
    try:
        return check_spectral(value, "depolarisation", 0.0, LARGEST_DEPOLARISATION)
    except ParameterError as error:
        allowed = "0 to 0.5, that of a linear molecule"
        raise ParameterError(error.field, error.value, allowed) from None


class _Shares:
    """Table ``composition``, whose keys are the formulas of gases."""

    base = object

    @staticmethod
    def declared(table: FileTable | None = None) -> tuple[Field, ...]:
        """Key of any gas."""
        return (SHARE,)

    @staticmethod
    def read(table: TomlTable, wavelengths: Wavelengths = None) -> tuple[tuple[str, float], ...]:
        """Formula and fraction of each gas; the nearest to a misspelt formula is suggested."""
        fractions = []
        for formula in table.names:
            if formula not in MOLECULES:
                allowed = suggestion(formula, tuple(MOLECULES))
                raise ParameterError(f"a gas of {table.path}", formula, allowed)
            fractions.append((formula, table.number(formula, SHARE.unit, SHARE.example)))
        return tuple(fractions)


#: Key of a gas in the table ``composition``: its formula.
SHARE: Final = Field(
    name="*",
    label="share",
    help="Mole fraction; the other gases are rescaled in proportion.",
    range=(0.0, 1.0),
    example="0.79",
    mode="advanced",
)


@parameters
class GasMixture(Matter):
    r"""Mixture of known gases; its state is that at relative density 1.

    Cross-section of the mixture: :math:`\sum_i x_i \sigma_i`, each gas with its own refractivity
    and King factor. Refractivity by the Lorentz-Lorenz relation: :math:`(n^2-1)/(n^2+2) = \sum_i
    x_i (n_i^2-1)/(n_i^2+2)` at the same number density; adding n - 1 in proportion to the density
    instead errs by 3e-6 of the value for air at 15 °C, by 0.25 % at the ground of Venus. The
    cross-section of the mean refractivity, which is often used, is too small by the spread of the
    refractivities: 0.16 % for air, 26 % for equal parts of hydrogen and helium.

    The phase function has Rayleigh's form with the King factor

    .. math:: F = \frac{\sum_i x_i \sigma_i}{\sum_i x_i \sigma_i / F_i},

    the mean of the King factors weighted by the scattering of isotropic molecules of the same size.
    Weighted by mole fraction, as is often done, it is 0.002 too large for air and 0.046 too small
    for equal parts of hydrogen and carbon dioxide.

    Parameters
    ----------
    composition : mapping of str to float
        Mole fractions by formula, normalised; their sum has to be 1 within 1 %. [1]
    temperature : float, optional
        Temperature; required with a pressure and for the scale height. [K]
    pressure, reference_density : float, optional
        Pressure [Pa] or number density [m⁻³]; both if they agree within 1 %.
    gravity : float, optional
        Gravitational acceleration, for the scale height. [m s⁻²]
    depolarisation : float or PerWavelength, optional
        Depolarisation factor, 0 to 0.5, instead of the gases' King factors. [1]
    refractivity : float or PerWavelength, optional
        n - 1, instead of the gases' own. [1]
    refractivity_temperature, refractivity_pressure : float, optional
        State of the refractivity, if not that of the mixture. [K], [Pa]

    Raises
    ------
    ParameterError
        If a value is out of range, the state is given twice inconsistently or not at all, or a
        refractivity differs by more than 10 % from the composition's at the state given with it.

    References
    ----------
    Eberhard (2010), Correct equations and common approximations for calculating Rayleigh scatter
    in pure gases and mixtures, Applied Optics 49, 1116. doi:10.1364/AO.49.001116

    Examples
    --------
    >>> dry_air = {"N2": 0.78084, "O2": 0.20946, "Ar": 0.00934, "CO2": 0.0004}
    >>> air = GasMixture(
    ...     composition=dry_air, temperature=288.15, pressure=101325.0, gravity=9.80665
    ... )
    >>> f"{1e3 * air.molar_mass:.2f} {air.scale_height:.0f} {air.number_density:.3e}"
    '28.97 8434 2.547e+25'
    """

    keyword = "gas"
    label = "gas"
    help = "A gas by its composition."
    example = "{ composition = { N2 = 0.79, … }, … }"
    bends = True

    composition: Annotated[Any, BeforeValidator(_composition)] = key(
        help="Mole fractions.",
        note="The sum must be 1 within 1 %; the fractions are normalised.",
        kind="table",
        table=_Shares,
        example="a table such as { N2 = 0.79, O2 = 0.21 }",
    )
    temperature: float | None = key(TEMPERATURE, note="Required beside a pressure.", default=None)
    pressure: float | None = key(
        PRESSURE,
        note="It or a number density is required; both if they agree within 1 %.",
        default=None,
    )
    reference_density: float | None = key(DENSITY, name="number_density", default=None)
    gravity: float | None = key(
        GRAVITY,
        help="Gravity, from which the scale height RT/(Mg) follows.",
        note="Required without a `profile`.",
        default=None,
    )
    depolarisation: (
        Annotated[
            Any,
            replace(
                DEPOLARISATION, note="That of a rod is 0.5; instead of the gases' King factors."
            ),
            BeforeValidator(_depolarisation),  # tried from the last: its error has the reason
        ]
        | None
    ) = None
    refractivity: Any | None = key(
        REFRACTIVITY,
        note="Instead of the gases' own. Refused if it is off the composition's by more"
        " than 10 % at its state: n and the number density belong together.",
        default=None,
    )
    refractivity_temperature: float | None = key(
        TEMPERATURE,
        help=f"Temperature {_MEASURED}.",
        default=None,
    )
    refractivity_pressure: float | None = key(PRESSURE, help=f"Pressure {_MEASURED}.", default=None)

    def __post_init__(self) -> None:
        if self.pressure is not None and self.temperature is None:
            raise ConflictError("pressure", "requires temperature")
        if self.number_density > 0.0 and self.refractivity is not None:
            self._check_refractivity(self.refractivity)
        elif (self.refractivity_temperature, self.refractivity_pressure) != (None, None):
            raise ConflictError(
                "refractivity", "is required with refractivity_temperature or refractivity_pressure"
            )
        low, high = self.limits
        if low > high:
            raise ParameterError(
                "composition", self.composition, "gases with a common wavelength range"
            )

    def _check_refractivity(self, refractivity: Spectral) -> None:
        """Raise an error for a refractivity inconsistent with temperature and pressure."""
        low, high = self._gas_limits
        nm = np.array([min(max(550.0, low), high)])
        if isinstance(refractivity, PerWavelength):
            nm = np.array([nm for nm in refractivity.wavelengths if low <= nm <= high])
        given = power_law_at(refractivity, nm)
        expected = self._composed_refractivities(nm, self._density_of_refractivity)
        for value, own in zip(given, expected, strict=True):
            if not abs(value / own - 1.0) <= REFRACTIVITY_TOLERANCE:
                raise ParameterError(
                    "refractivity",
                    float(value),
                    f"{own:.4g} within 10 % at this temperature and pressure; set"
                    " refractivity_temperature and refractivity_pressure for another state",
                )

    @property
    def _density_of_refractivity(self) -> float:
        """Number density of the state of the refractivity. [m⁻³]"""
        temperature, pressure = self.refractivity_temperature, self.refractivity_pressure
        if temperature is None and pressure is None:
            return self.number_density
        if temperature is None or pressure is None:
            names = ["refractivity_temperature", "refractivity_pressure"]
            given, missing = reversed(names) if temperature is None else names
            raise ConflictError(given, f"requires {missing}")
        return rayleigh.number_density(temperature, pressure)

    @property
    def number_density(self) -> float:
        """Number density of molecules at relative density 1. [m⁻³]"""
        temperature = None if self.pressure is None else self.temperature
        return density_of_state(self.reference_density, temperature, self.pressure)

    @property
    def molar_mass(self) -> float:
        """Mean molar mass of the mixture. [kg mol⁻¹]"""
        parts = (fraction * MOLECULES[name].molar_mass for name, fraction in self.composition)
        return math.fsum(parts)

    @property
    def scale_height(self) -> float:
        """Scale height of the isothermal gas, RT/(Mg). [m]"""
        if self.temperature is None:
            raise ConflictError("temperature", "is required for the scale height")
        if self.gravity is None:
            raise ConflictError("gravity", "is required for the scale height")
        return rayleigh.scale_height(self.temperature, self.molar_mass, self.gravity)

    def own_scale_height(self) -> float:
        """Scale height of the default profile. [m]"""
        return self.scale_height

    @property
    def _gas_limits(self) -> Limits:
        return narrowest(MOLECULES[name].limits for name, _ in self.composition)

    @property
    def limits(self) -> Limits:
        """Wavelength range of all gases and given spectra. [nm]"""
        given = (x for x in (self.depolarisation, self.refractivity) if x is not None)
        return narrowest([self._gas_limits, spectral_limits(*given)])

    def _composed_refractivities(self, wavelengths: npt.ArrayLike, density: float) -> FloatArray:
        """Refractivity n - 1 of the composition at a number density [m⁻³], shape (nl,). [1]"""
        nm = values_in(wavelengths, "nm", "wavelengths")
        refraction = np.zeros(nm.shape)
        for name, fraction in self.composition:
            gas = MOLECULES[name]
            own = lorentz_lorenz.refraction_of(gas.refractivities(nm))
            refraction += fraction * own * density / gas.number_density
        return lorentz_lorenz.refractivity_of(refraction)

    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,). [1]"""
        if self.refractivity is None:
            return self._composed_refractivities(wavelengths, self.number_density)
        given = power_law_at(self.refractivity, wavelengths)
        return lorentz_lorenz.refractivity_at(
            given, self._density_of_refractivity, self.number_density
        )

    def _sums(self, wavelengths: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Cross-sections of the composition, and of isotropic molecules of the same size. [m²]"""
        nm = values_in(wavelengths, "nm", "wavelengths")
        total, round_part = np.zeros(nm.shape), np.zeros(nm.shape)
        for name, fraction in self.composition:
            sigma = fraction * MOLECULES[name].cross_sections(nm)
            total += sigma
            round_part += sigma / MOLECULES[name].king_factors(nm)
        return total, round_part

    def king_factors(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Effective King factor of the mixture, shape (nl,). [1]"""
        if self.depolarisation is not None:
            delta = spectral_at(self.depolarisation, wavelengths)
            return rayleigh.king_factor_from_depolarisation(delta)
        total, round_part = self._sums(wavelengths)
        return np.asarray(total / round_part)

    def depolarisations(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Depolarisation factor for unpolarised light, shape (nl,). [1]"""
        return rayleigh.depolarisation_from_king_factor(self.king_factors(wavelengths))

    def cross_sections(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Mean Rayleigh cross-section of the molecules, shape (nl,). [m²]"""
        factors = self.king_factors(wavelengths)
        if self.refractivity is None:
            return np.asarray(self._sums(wavelengths)[1] * factors)
        given = power_law_at(self.refractivity, wavelengths)
        return rayleigh.cross_section(wavelengths, given, self._density_of_refractivity, factors)

    def scattering_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        return self.number_density * self.cross_sections(wavelengths)

    def absorption_coefficients(
        self, wavelengths: npt.ArrayLike, vertical_column: float
    ) -> FloatArray:
        """Zeros, shape (nl,), as absorption is a separate key. [m⁻¹]"""
        return np.zeros(np.shape(wavelengths))

    def phase_function(self, wavelengths: npt.ArrayLike) -> Rayleigh:
        """Phase function at wavelengths [nm], shape (nl,)."""
        return rayleigh_of(self.depolarisations(wavelengths), wavelengths)

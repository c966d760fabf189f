"""Gases as parameter objects: Rayleigh scattering from their state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.physics.optics import king_factor, rayleigh, refractive_index
from airlight.physics.optics.lorentz_lorenz import refractivity_at
from airlight.physics.units import values_in
from airlight.planets.matter.matter import Scatterer
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.state_keys import (
    DENSITY,
    DEPOLARISATION,
    MOLAR_MASS,
    PRESSURE,
    REFRACTIVITY,
    TEMPERATURE,
)
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import Field, Wavelengths, key
from airlight.planets.schema.tagged_union import Alternatives
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import (
    EVERYWHERE,
    Limits,
    PerWavelength,
    Spectral,
    power_law_at,
    spectral_at,
)

FloatArray = npt.NDArray[np.float64]

#: Largest relative difference of a number density from that of the temperature and pressure.
STATE_TOLERANCE: Final = 0.01


class _Gas(NamedTuple):
    """Data of a gas: refractivity at a state, King factor, wavelength range."""

    refractivity: Callable[[npt.ArrayLike], FloatArray]
    temperature: float
    king_factor: Callable[[npt.ArrayLike], FloatArray]
    limits: Limits


GASES: Final = {
    "air": _Gas(
        refractive_index.air_refractivity_peck1972,
        refractive_index.AIR_TEMPERATURE,
        king_factor.king_factor_air_bates1984,
        refractive_index.AIR_RANGE,
    ),
    "co2": _Gas(
        refractive_index.co2_refractivity_bideau_mehu1973,
        refractive_index.CO2_TEMPERATURE,
        king_factor.king_factor_co2_alms1975,
        refractive_index.CO2_RANGE,
    ),
}


def density_of_state(
    density: float | None, temperature: float | None, pressure: float | None
) -> float:
    """Number density, explicit or by the equation of state. [m⁻³]

    Raises an error if missing or inconsistent.

    Parameters
    ----------
    density : float or None
        Number density. [m⁻³]
    temperature, pressure : float or None
        Temperature and pressure, both or neither. [K], [Pa]
    """
    if (temperature is None) != (pressure is None):
        names = ["temperature", "pressure"]
        given, missing = reversed(names) if temperature is None else names
        raise ConflictError(given, f"requires {missing}")
    if temperature is None or pressure is None:
        if density is None:
            raise ParameterError(
                "number_density", MISSING, "a number density, or a temperature and a pressure"
            )
        return density
    implied = rayleigh.number_density(temperature, pressure)
    if density is not None and abs(density / implied - 1.0) > STATE_TOLERANCE:
        raise ParameterError(
            "number_density",
            density,
            f"the same state as temperature and pressure: {implied:.6g} /m^3 within 1 %",
        )
    return implied if density is None else density


def rayleigh_of(depolarisations: FloatArray, wavelengths: npt.ArrayLike) -> Rayleigh:
    """Phase function of molecules with depolarisation factors [1], shape (nl,), per wavelength."""
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
    values = tuple(np.broadcast_to(depolarisations, nm.shape).tolist())
    return Rayleigh(depolarisation=PerWavelength(wavelengths=tuple(nm.tolist()), values=values))


#: Keys required beside a mass density.
_MASS_KEYS: Final = (
    Field(
        name="mass_density",
        help="Mass density of the gas at relative density 1.",
        note="Together with the molar mass, an alternative to the number density.",
        unit="kg/m^3",
        range=(0.0, 1e6),
        open_ends=True,
        example="1.225 kg/m^3",
        slider=(1e-4, 100.0),
        input_range=(1e-12, 1e6),
        scale="log",
    ),
    replace(MOLAR_MASS, name="molar_mass"),
)


class _Molecules(Scatterer):
    """Molecules with a number density, or with a mass density and molar mass."""

    extra_keys = _MASS_KEYS

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Values of the fields; the number density from mass density and molar mass if given."""
        values = super().read_values(table, wavelengths, **known)
        if not any(key.name in table for key in _MASS_KEYS):
            return values
        density, molar_mass = (table.number(key.name, key.unit, key.example) for key in _MASS_KEYS)
        _MASS_KEYS[1].checked(molar_mass, table.name_of("molar_mass"))
        if "number_density" in values:
            name = table.name_of("number_density")
            raise ConflictError(name, "cannot be combined with mass_density")
        _MASS_KEYS[0].checked(density, table.name_of("mass_density"))
        values["number_density"] = rayleigh.number_density_from_mass(density, molar_mass)
        return values


@parameters
class GasScattering(_Molecules):
    """Rayleigh scattering by a known gas.

    Parameters
    ----------
    gas : str
        Name: ``"air"`` (Peck & Reeder 1972, Bates 1984), ``"co2"`` (Bideau-Mehu 1973, Alms 1975).
    number_density : float, optional
        Number density at relative density 1. [m⁻³]
    temperature, pressure : float, optional
        State at relative density 1, instead of the number density. [K], [Pa]

    Examples
    --------
    >>> air = GasScattering(gas="air", temperature=288.15, pressure=101325.0)
    >>> (1e6 * air.coefficients([680.0, 550.0, 440.0])).round(3).tolist()
    [4.848, 11.487, 28.71]
    """

    keyword = "rayleigh"

    gas: str = key(
        name="rayleigh",
        label="gas",
        help="Gas with tabulated refractivity and depolarisation.",
        note="`air`: refractivity of Peck & Reeder (1972), King factor of Bates (1984), 230 to"
        " 1690 nm; `co2`: Bideau-Mehu et al. (1973), Alms et al. (1975), 180.7 to 2500 nm.",
        choices=lambda: tuple(GASES),
    )
    number_density: float | None = key(DENSITY, default=None)
    temperature: float | None = key(TEMPERATURE, default=None)
    pressure: float | None = key(PRESSURE, default=None)

    def __post_init__(self) -> None:
        density_of_state(self.number_density, self.temperature, self.pressure)

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        return GASES[self.gas].limits

    def coefficients(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        gas = GASES[self.gas]
        measured = rayleigh.number_density(gas.temperature, refractive_index.STANDARD_PRESSURE)
        sigma = rayleigh.cross_section(
            wavelengths, gas.refractivity(wavelengths), measured, gas.king_factor(wavelengths)
        )
        return sigma * density_of_state(self.number_density, self.temperature, self.pressure)

    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,). [1]"""
        gas = GASES[self.gas]
        measured = rayleigh.number_density(gas.temperature, refractive_index.STANDARD_PRESSURE)
        density = density_of_state(self.number_density, self.temperature, self.pressure)
        return refractivity_at(gas.refractivity(wavelengths), measured, density)

    def phase_function(self, wavelengths: npt.ArrayLike) -> Rayleigh:
        """Phase function at wavelengths [nm], shape (nl,)."""
        return rayleigh_of(self.depolarisations(wavelengths), wavelengths)

    def depolarisations(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Depolarisation factor, shape (nl,). [1]"""
        factor = GASES[self.gas].king_factor(wavelengths)
        return rayleigh.depolarisation_from_king_factor(factor)


@parameters
class RefractiveScattering(_Molecules):
    """Rayleigh scattering by a gas of given refractivity.

    Parameters
    ----------
    refractivity : float or PerWavelength
        n - 1; a power law between wavelengths and constant beyond, where coefficients follow λ⁻⁴.
        [1]
    number_density : float, optional
        Number density of the refractivity's state. [m⁻³]
    temperature, pressure : float, optional
        State of the refractivity, instead of the number density or equal to it within 1 %. [K],
        [Pa]
    ground_number_density : float, optional
        Number density at relative density 1, if different. [m⁻³]
    king_factor : float or PerWavelength, optional
        King factor, 1 to 2; alternative to the depolarisation. [1]
    depolarisation : float or PerWavelength, optional
        Depolarisation factor, 0 to 0.5. [1]

    Examples
    --------
    >>> air = RefractiveScattering(refractivity=3e-4, number_density=2.545e25)
    >>> (1e6 * air.coefficients([650.0, 510.0, 475.0])).round(1).tolist()
    [6.6, 17.3, 23.0]
    """

    keyword = "refractivity"

    refractivity: Spectral = key(REFRACTIVITY, help="Of any gas, at the state given beside it.")
    number_density: float | None = key(DENSITY, default=None)
    temperature: float | None = key(TEMPERATURE, default=None)
    pressure: float | None = key(PRESSURE, default=None)
    ground_number_density: float | None = key(
        DENSITY,
        label="number density at the ground",
        help="Where the planet's own is another than that of the refractivity.",
        default=None,
    )
    king_factor: Spectral = key(
        label="King factor",
        help="King factor; 1 for isotropic molecules.",
        range=(1.0, 2.0),
        example="1.049",
        slider=(1.0, 1.3),
        default=1.0,
    )
    depolarisation: Spectral = key(DEPOLARISATION, note="Instead of the King factor.", default=0.0)

    def __post_init__(self) -> None:
        density_of_state(self.number_density, self.temperature, self.pressure)
        if self.king_factor != 1.0 and self.depolarisation != 0.0:
            raise ConflictError("king_factor", "cannot be combined with depolarisation")

    @property
    def limits(self) -> Limits:
        """Wavelength range. [nm]"""
        return EVERYWHERE

    @property
    def _densities(self) -> tuple[float, float]:
        """Number density of the refractivity's state, and that at relative density 1. [m⁻³]"""
        measured = density_of_state(self.number_density, self.temperature, self.pressure)
        ground = self.ground_number_density
        return measured, measured if ground is None else ground

    def refractivities(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Refractivity n - 1 at relative density 1, shape (nl,). [1]"""
        given = power_law_at(self.refractivity, wavelengths)
        return refractivity_at(given, *self._densities)

    def _king_factors(self, wavelengths: npt.ArrayLike) -> FloatArray:
        delta = spectral_at(self.depolarisation, wavelengths)
        implied = rayleigh.king_factor_from_depolarisation(delta)
        return implied * spectral_at(self.king_factor, wavelengths)

    def coefficients(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Scattering coefficient at relative density 1, shape (nl,). [m⁻¹]"""
        measured, ground = self._densities
        sigma = rayleigh.cross_section(
            wavelengths,
            power_law_at(self.refractivity, wavelengths),
            measured,
            self._king_factors(wavelengths),
        )
        return sigma * ground

    def phase_function(self, wavelengths: npt.ArrayLike) -> Rayleigh:
        """Phase function at wavelengths [nm], shape (nl,)."""
        return rayleigh_of(self.depolarisations(wavelengths), wavelengths)

    def depolarisations(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Depolarisation factor, shape (nl,). [1]"""
        return rayleigh.depolarisation_from_king_factor(self._king_factors(wavelengths))


#: Kinds of ``scattering = { … }``, distinguished by a key.
SCATTERERS: Final[Alternatives[Scatterer]] = Alternatives(
    Scatterer, (GasScattering, RefractiveScattering)
)

"""Planet: ground, shell of air, star, and the constituents of the air."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.planets.ground_and_star import Ground, Star
from airlight.planets.matter.matter import Absorber, Matter, Scatterer
from airlight.planets.matter.phases import PhaseFunction
from airlight.planets.matter.profiles import Profile
from airlight.planets.parameters import MISSING, instance_of, parameters
from airlight.planets.schema.key import WAVELENGTHS, Key, always
from airlight.planets.schema.record import Record
from airlight.planets.spectral import (
    LONGEST,
    SHORTEST,
    Limits,
    PerWavelength,
    Spectral,
    check_wavelength_list,
    narrowest,
    spectral_at,
)

FloatArray = npt.NDArray[np.float64]

#: Wavelengths of red, green and blue. [nm] Bruneton (2008).
RED_GREEN_BLUE: Final = (680.0, 550.0, 440.0)
#: Largest coefficient: a mean free path of a metre. [m⁻¹]
LARGEST_COEFFICIENT: Final = 1.0
#: Largest number of constituents of a planet.
MOST_CONSTITUENTS: Final = 64


def coefficient_key(label: str, text: str, **more: Any) -> Key:
    """Key of a coefficient at relative density 1."""
    return Key(label=label, help=text, unit="1/m", range=(0.0, LARGEST_COEFFICIENT), shown="/km",
               slider=(1e-7, 1.0), scale="log", spectral=True, per="wavelengths",
               **{"example": "5.802e-6 /m", **more})  # fmt: skip


def _coefficients_alone(constituent: Mapping[str, Any]) -> bool:
    """Whether a missing absorption means none: no other key determines it."""
    others = ("extinction", "single_scattering_albedo", "optical_depth", "absorption")
    return not any(name in constituent for name in others)


@parameters
class Constituent(Record):
    """One constituent of the air.

    Parameters
    ----------
    name : str
        1 to 60 letters; no two constituents of a planet share one.
    profile : Exponential, Tent, Layered, Tabulated or Uniform
        Relative density over altitude.
    scattering : float, PerWavelength, GasScattering or RefractiveScattering
        Coefficient at relative density 1, 0 to 1. [m⁻¹]
    absorption : float, PerWavelength or Absorber
        Coefficient at relative density 1, 0 to 1. [m⁻¹]
    phase_function : Rayleigh, CornetteShanks, …, optional
        Needed if it scatters; replaces the phase function of a gas or of ``matter``.
    matter : Matter, optional
        Substance, a gas mixture or particles; then ``scattering`` is not given, and ``absorption``
        ``absorption`` comes on top of the matter's own.
    amount : float
        Factor of scattering and absorption at all wavelengths, 0 to 100; the bending of light by a
        gas is unchanged. [1]

    Notes
    -----
    Given scattering coefficients beside a ``Rayleigh`` phase function follow λ⁻⁴ between and beyond
    their wavelengths. All other values are linear between them and constant for 10 nm beyond.
    """

    name: Annotated[
        str,
        Key(
            label="name",
            help="What the constituent is called.",
            note="1 to 60 letters.",
            kind="text",
            range=(1.0, 60.0),
            example="a name of its own",
        ),
    ]
    profile: Annotated[
        Profile,
        instance_of(Profile),
        Key(
            label="profile",
            help="How its density changes with altitude.",
            note="Not required of a `gas` with a gravity.",
            kind="table",
            table="profile",
        ),
    ]
    scattering: Annotated[
        Spectral | Scatterer,
        instance_of(int, float, PerWavelength, Scatterer),
        coefficient_key(
            "scattering",
            "How much light it scatters on a kilometre of way, where its profile is 1.",
            table="scattering",
            prefix="scattering",
        ),
    ] = 0.0
    absorption: Annotated[
        Spectral | Absorber,
        instance_of(int, float, PerWavelength, Absorber),
        coefficient_key(
            "absorption",
            "How much light it swallows on a kilometre of way, where its profile is 1.",
            table="absorption",
            prefix="absorption",
            example="0.65e-6 /m",
            offered=_coefficients_alone,
        ),
    ] = 0.0
    phase_function: (
        Annotated[
            PhaseFunction,
            instance_of(PhaseFunction),
            Key(
                label="phase function",
                help="Where the scattered light goes.",
                note="Required of what scatters and has none of its own.",
                kind="table",
                table="phase_function",
            ),
        ]
        | None
    ) = None
    amount: Annotated[
        float,
        Key(
            label="amount",
            help="Factor of what it scatters and absorbs, at all wavelengths.",
            note="A gas bends light as without it.",
            range=(0.0, 100.0),
            slider=(0.1, 10.0),
            scale="log",
            offered=always,
        ),
    ] = 1.0
    matter: Annotated[Matter, instance_of(Matter)] | None = None

    def __post_init__(self) -> None:
        if self.matter is not None and self.scattering != 0.0:
            raise ParameterError("scattering", self.scattering, "none beside matter")
        if self.scatters and self._substance is None and self.phase_function is None:
            raise ParameterError("phase_function", MISSING, "one, since it scatters")

    @property
    def _substance(self) -> Matter | Scatterer | None:
        """Substance with its own scattering and phase function; None if coefficients are given."""
        if self.matter is not None:
            return self.matter
        return self.scattering if isinstance(self.scattering, Scatterer) else None

    @property
    def bends(self) -> bool:
        """Whether it is a gas of known refractivity, so that it bends light."""
        return self._substance is not None and self._substance.bends

    @property
    def scatters(self) -> bool:
        """Whether any light is scattered at any wavelength."""
        if isinstance(self.scattering, PerWavelength):
            return any(value > 0.0 for value in self.scattering.values)
        return self._substance is not None or self.scattering != 0.0

    @property
    def _follows_fourth_power(self) -> bool:
        return self.phase_function is not None and self.phase_function.molecular

    @property
    def limits(self) -> Limits:
        """Wavelengths at which all its properties are known. [nm]"""
        own = (self._substance, self.absorption, self.phase_function)
        limits = [part.limits for part in own if isinstance(part, Record)]
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
            Thickness of the shell, over which an optical depth is spread. [m]
        """
        return self.amount * self._scattering(wavelengths, thickness)

    def _scattering(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        if self.matter is not None:
            return self.matter.scattering_coefficients(wavelengths, self._column(thickness))
        if isinstance(self.scattering, Scatterer):
            return self.scattering.coefficients(wavelengths)
        if self._follows_fourth_power and isinstance(self.scattering, PerWavelength):
            return self.scattering.at_fourth_power(wavelengths)
        return spectral_at(self.scattering, wavelengths)

    def absorption_coefficients(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        """Absorption coefficient at relative density 1, shape (nl,). [m⁻¹]

        Parameters
        ----------
        wavelengths, thickness
            See ``scattering_coefficients``; a column of gas is spread over the shell too.
            [nm], [m]
        """
        if isinstance(self.absorption, Absorber):
            total = self.absorption.coefficients(wavelengths, self._column(thickness))
        else:
            total = spectral_at(self.absorption, wavelengths)
        if self.matter is not None:
            column = self._column(thickness)
            total = total + self.matter.absorption_coefficients(wavelengths, column)
        return self.amount * total

    def refractivities(self, wavelengths: npt.ArrayLike, thickness: float) -> FloatArray:
        """Refractivity n - 1 of a gas at relative density 1, shape (nl,); otherwise 0. [1]

        Parameters
        ----------
        wavelengths, thickness
            See ``scattering_coefficients``. [nm], [m]

        Raises
        ------
        ParameterError
            If the gas is denser than any gas is.
        """
        if self._substance is None:
            return np.zeros(np.shape(wavelengths))
        return self._substance.refractivities(wavelengths)

    def _column(self, thickness: float) -> float:
        column = self.profile.column(thickness)
        if not column > 0.0:
            raise ParameterError(
                "profile", self.profile, "one that is not 0 everywhere in the shell"
            )
        return column

    def phase_values(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Phase function, shape of nu (...) and wavelengths (nl,) to (..., nl). [sr⁻¹]

        Zero where it does not scatter.
        """
        nm = np.atleast_1d(np.asarray(wavelengths, dtype=np.float64))
        if not self.scatters:
            return np.zeros((*np.shape(nu), len(nm)))
        return self.phase_function_at(nm).values(nu, nm)

    def phase_moments(self, wavelengths: npt.ArrayLike, degree: int) -> FloatArray:
        """Legendre moments of the phase function, shape (nl, degree + 1). [1]

        See ``optics.legendre``; all zero where it does not scatter.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        degree : int
            Highest degree l.
        """
        nm = np.atleast_1d(np.asarray(wavelengths, dtype=np.float64))
        if not self.scatters:
            return np.zeros((len(nm), degree + 1))
        return self.phase_function_at(nm).moments(nm, degree)

    def phase_function_at(self, wavelengths: npt.ArrayLike) -> PhaseFunction:
        """Phase function given, or that of the gas or matter, known at these wavelengths.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]

        Raises
        ------
        ParameterError
            If it does not scatter.
        """
        if self.phase_function is not None:
            return self.phase_function
        if self._substance is None:
            raise ParameterError("phase_function", MISSING, "one, if it scatters")
        return self._substance.phase_function(wavelengths)


@parameters
class Planet(Record):
    """Spherical ground under a shell of air, lit by a star.

    Parameters
    ----------
    name : str
        1 to 60 letters.
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the air, from the centre. [m]
    ground : Ground
    star : Star
    constituents : tuple of Constituent
        Constituents, 1 to 64.
    own_wavelengths : tuple of float, optional
        Default wavelengths of the planet. [nm]
    description : str, optional
        Nature and sources of the numbers, in a sentence or two.
    refraction : str, optional
        ``"bouguer"``: the gases bend light; ``"none"``: rays are straight.

    Examples
    --------
    >>> from airlight.planets import load_planet, replace
    >>> planet = load_planet("earth-atmosphere-plus")
    >>> planet.wavelengths
    (680.0, 550.0, 440.0)
    >>> higher = replace(planet, top_radius=6.5e6)
    >>> replace(planet, top_radius=6.3e6)
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: top_radius is 6300000.0; allowed: 6360000.636 to 63600000 m
    """

    name: Annotated[
        str,
        Key(
            label="name",
            help="What the planet is called.",
            note="1 to 60 letters.",
            kind="text",
            range=(1.0, 60.0),
            example="the planet's name",
        ),
    ]
    description: Annotated[
        str,
        Key(
            label="description",
            help="What the numbers are and where they come from.",
            note="A sentence that `airlight planets` shows.",
            kind="text",
            example="a sentence",
            offered=always,
        ),
    ] = ""
    own_wavelengths: (
        Annotated[
            tuple[float, ...],
            dataclasses.replace(
                WAVELENGTHS,
                help="The planet's own wavelengths, used where none are asked for.",
                note="Without them: 680, 550, 440 nm; if the planet is not known there, those of"
                " its first constituent that names any.",
            ),
        ]
        | None
    ) = None
    refraction: Annotated[
        str,
        Key(
            label="refraction",
            help="Whether the gases bend light, so that the star is seen lifted and flattened.",
            note="Refused where light would follow the ground, as on Venus.",
            kind="choice",
            words=lambda: ("none", "bouguer"),
            offered=always,
        ),
    ] = "none"
    bottom_radius: Annotated[
        float,
        Key(
            label="radius of the ground",
            help="Distance of the ground from the planet's centre; the air moves with it.",
            unit="m",
            range=(1e3, 1e12),
            example="6360 km",
            shown="km",
            slider=(10.0, 1e5),
            scale="log",
            within="shell",
        ),
    ]
    top_radius: Annotated[
        float,
        Key(
            label="radius of the top of the air",
            help="Where the air ends, from the centre: up to ten times the ground's radius.",
            unit="m",
            range=(1e3, 1e13),
            example="6460 km",
            shown="km",
            slider=(10.0, 1e5),
            within="shell",
        ),
    ]
    ground: Annotated[
        Ground,
        instance_of(Ground),
        Key(label="ground", help="What lies below.", kind="table", table="ground", required=True),
    ] = Ground()
    star: Annotated[
        Star,
        instance_of(Star),
        Key(label="star", help="What shines.", kind="table", table="star"),
    ]
    constituents: Annotated[
        tuple[Annotated[Constituent, instance_of(Constituent)], ...],
        Key(
            label="constituents",
            help="What the air is made of.",
            note="1 to 64 of them, each with a name of its own.",
            kind="table",
            table="constituent",
        ),
    ]

    def __post_init__(self) -> None:
        least, most = self.bottom_radius * (1.0 + 1e-7), self.bottom_radius * 10.0
        if not least <= self.top_radius <= most:
            raise ParameterError(
                "top_radius",
                self.top_radius,
                f"{least:.10g} to {most:.10g} m",
            )
        if not 1 <= len(self.constituents) <= MOST_CONSTITUENTS:
            raise ParameterError(
                "constituents", len(self.constituents), f"1 to {MOST_CONSTITUENTS} constituents"
            )
        names: set[str] = set()
        for index, constituent in enumerate(self.constituents):
            if constituent.name in names:
                raise ParameterError(
                    f"constituents[{index}].name", constituent.name, "a name of its own"
                )
            names.add(constituent.name)
        if self.wavelength_limits[0] > self.wavelength_limits[1]:
            raise ParameterError(
                "wavelengths",
                self._limits_by_part(),
                "parts that are known at a common wavelength",
            )
        if self.own_wavelengths is not None:
            check_wavelength_list(self.own_wavelengths)
            self.check_wavelengths(self.own_wavelengths)

    @property
    def thickness(self) -> float:
        """Height of the shell. [m]"""
        return self.top_radius - self.bottom_radius

    def _limits_by_part(self) -> dict[str, Limits]:
        parts = {"ground": self.ground.limits, "star": self.star.limits}
        return parts | {one.name: one.limits for one in self.constituents}

    @property
    def wavelength_limits(self) -> Limits:
        """Wavelengths at which every part is known, lowest and highest. [nm]"""
        return narrowest([(SHORTEST, LONGEST), *self._limits_by_part().values()])

    @property
    def wavelengths(self) -> tuple[float, ...]:
        """Own wavelengths of the planet. [nm]

        ``own_wavelengths`` if given; otherwise 680, 550 and 440 if every part is known there;
        otherwise those of the first part that names any.
        """
        if self.own_wavelengths is not None:
            return self.own_wavelengths
        low, high = self.wavelength_limits
        if low <= min(RED_GREEN_BLUE) and max(RED_GREEN_BLUE) <= high:
            return RED_GREEN_BLUE
        for constituent in self.constituents:
            for value in (constituent.scattering, constituent.absorption):
                if isinstance(value, PerWavelength):
                    inside = tuple(nm for nm in value.wavelengths if low <= nm <= high)
                    if inside:
                        return inside
        return (0.5 * (low + high),)

    def check_wavelengths(self, wavelengths: tuple[float, ...]) -> None:
        """Refuse a wavelength at which some part of the planet is not known."""
        low, high = self.wavelength_limits
        for nm in wavelengths:
            if not low <= nm <= high:
                parts = self._limits_by_part().items()
                who = next((name for name, (a, b) in parts if not a <= nm <= b), self.name)
                raise ParameterError("wavelengths", nm, f"{low:g} to {high:g} nm, for {who!r}")

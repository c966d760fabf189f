"""Planet: ground, star, and constituents of the atmosphere."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Annotated, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.world import WORLDS, World, world_named
from airlight.physics.units import values_in
from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.parameters import MISSING, instance_of, parameters
from airlight.planets.schema.field import WAVELENGTHS, Field, always
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.spectral import (
    LONGEST,
    SHORTEST,
    Limits,
    PerWavelength,
    check_wavelength_list,
    narrowest,
)
from airlight.planets.star import Star

if TYPE_CHECKING:
    from datetime import datetime

    from airlight.planets.light_source import LightSource

FloatArray = npt.NDArray[np.float64]

#: Wavelengths of red, green and blue. [nm] Bruneton (2008).
RED_GREEN_BLUE: Final = (680.0, 550.0, 440.0)
#: Largest number of constituents of a planet.
MAX_CONSTITUENTS: Final = 64
#: Smallest thickness of the shell relative to the ground radius, and largest ratio of the radii.
#: [1]
LEAST_THICKNESS: Final = 1e-7
LARGEST_RATIO: Final = 10.0


@parameters
class Planet(TomlModel):
    """Spherical planet with an atmospheric shell, illuminated by a star.

    Parameters
    ----------
    name : str
        Name of 1 to 60 letters.
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the atmosphere. [m]
    constituents : tuple of Constituent
        Constituents, 1 to 64.
    default_wavelengths : tuple of float, optional
        Default wavelengths of the planet. [nm]
    description : str, optional
        Description and sources, in a sentence or two.
    body : str, optional
        Body of the solar system, for the sun by place and time: ``"earth"``, ``"mars"`` or
        ``"titan"``.
    refraction : str, optional
        ``"bouguer"`` for refraction by gases; ``"none"`` for straight rays.

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
        Field(
            label="name",
            help="Name of the planet.",
            note="1 to 60 letters.",
            kind="text",
            range=(1.0, 60.0),
            example="the planet's name",
        ),
    ]
    description: Annotated[
        str,
        Field(
            label="description",
            help="Short description, with the source of the data.",
            note="Listed by `airlight planets`.",
            kind="text",
            example="a sentence",
            offered=always,
        ),
    ] = ""
    default_wavelengths: (
        Annotated[
            tuple[float, ...],
            dataclasses.replace(
                WAVELENGTHS,
                help="Default wavelengths of the planet.",
                note="Without them: 680, 550, 440 nm; if the planet is not known there, those of"
                " its first constituent that names any.",
            ),
        ]
        | None
    ) = None
    body: (
        Annotated[
            str,
            Field(
                label="body",
                help="Body of the solar system, for the sun by place and time.",
                note="For `airlight render --at --time` and `airlight.Scene.at`.",
                kind="choice",
                choices=lambda: tuple(WORLDS),
                mode="advanced",
            ),
        ]
        | None
    ) = None
    refraction: Annotated[
        str,
        Field(
            label="refraction",
            help="Refraction by the gases.",
            note="Rejected where rays would be trapped by super-refraction, as on Venus.",
            kind="choice",
            choices=lambda: ("none", "bouguer"),
            offered=always,
        ),
    ] = "none"
    bottom_radius: Annotated[
        float,
        Field(
            label="radius of the ground",
            help="Radius of the ground; the atmosphere keeps its thickness when it is edited.",
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
        Field(
            label="radius of the top of the atmosphere",
            help="Radius of the top of the atmosphere, up to ten times that of the ground.",
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
        Field(
            label="ground",
            help="Surface of the planet.",
            kind="table",
            table="ground",
            required=True,
        ),
    ] = Ground()
    star: Annotated[
        Star,
        instance_of(Star),
        Field(label="star", help="Star that illuminates the planet.", kind="table", table="star"),
    ]
    constituents: Annotated[
        tuple[Annotated[Constituent, instance_of(Constituent)], ...],
        Field(
            label="constituents",
            help="Constituents of the atmosphere.",
            note="1 to 64 of them, each with a name of its own.",
            kind="table",
            table="constituent",
        ),
    ]

    def __repr__(self) -> str:
        air = ", ".join(one.name for one in self.constituents)
        bent = "; light is bent" if self.refraction != "none" else ""
        return (
            f"<Planet {self.name}: radius {self.bottom_radius * 1e-3:.7g} km under "
            f"{self.thickness * 1e-3:.4g} km of {air}{bent}>"
        )

    def __post_init__(self) -> None:
        least = self.bottom_radius * (1.0 + LEAST_THICKNESS)
        most = self.bottom_radius * LARGEST_RATIO
        if not least <= self.top_radius <= most:
            raise ParameterError(
                "top_radius",
                self.top_radius,
                f"{least:.10g} to {most:.10g} m",
            )
        if not 1 <= len(self.constituents) <= MAX_CONSTITUENTS:
            raise ParameterError(
                "constituents", len(self.constituents), f"1 to {MAX_CONSTITUENTS} constituents"
            )
        if self.body is not None:
            world_named(self.body)
        names: set[str] = set()
        for index, constituent in enumerate(self.constituents):
            if constituent.name in names:
                raise ParameterError(
                    f"constituents[{index}].name", constituent.name, "a unique name"
                )
            names.add(constituent.name)
        if self.wavelength_limits[0] > self.wavelength_limits[1]:
            raise ParameterError(
                "wavelengths",
                self._limits_by_part(),
                "parts with a common wavelength range",
            )
        if self.default_wavelengths is not None:
            check_wavelength_list(self.default_wavelengths)
            self.check_wavelengths(self.default_wavelengths)

    @property
    def thickness(self) -> float:
        """Height of the shell. [m]"""
        return self.top_radius - self.bottom_radius

    def _limits_by_part(self) -> dict[str, Limits]:
        parts = {"ground": self.ground.limits, "star": self.star.limits}
        return parts | {one.name: one.limits for one in self.constituents}

    @property
    def wavelength_limits(self) -> Limits:
        """Wavelength range of all parts. [nm]"""
        return narrowest([(SHORTEST, LONGEST), *self._limits_by_part().values()])

    def lights(self, wavelengths: npt.ArrayLike) -> tuple[LightSource, ...]:
        """Light sources of the planet: the star.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths of the samples. [nm]
        """
        from airlight.planets.light_source import LightSource

        nm = values_in(wavelengths, "nm", "wavelengths")
        star = LightSource(
            name="star",
            angular_radius=math.radians(self.star.angular_radius_degrees),
            wavelengths=nm,
            irradiance=self.star.irradiances(nm),
            spectrum=self.star.irradiances,
            darkening=self.star.darkening,
        )
        return (star,)

    def lit_at(self, time: datetime) -> Planet:
        """Planet with the sun at its distance at a time; itself if the star has no distance.

        Parameters
        ----------
        time : datetime
            Instant with its zone.

        Raises
        ------
        ParameterError
            If the planet has no ``body``, or the time is out of range.

        Examples
        --------
        >>> from datetime import UTC, datetime
        >>> from airlight.planets import load_planet
        >>> near = load_planet("earth").lit_at(datetime(2026, 1, 3, 17, tzinfo=UTC))
        >>> f"{near.star.distance / 149597870700:.4f}"
        '0.9833'
        """
        from airlight.geometry.ephemeris.instant import days_of
        from airlight.geometry.ephemeris.sun_vector import solar_point

        point = solar_point(self.world, days_of(time))
        return dataclasses.replace(self, star=self.star.at_distance(point.distance))

    @property
    def world(self) -> World:
        """Body of the solar system that it represents."""
        if self.body is None:
            raise ParameterError("body", MISSING, f"one of {', '.join(WORLDS)}")
        return world_named(self.body)

    @property
    def wavelengths(self) -> tuple[float, ...]:
        """Default wavelengths of the planet. [nm]

        ``default_wavelengths`` if given; otherwise 680, 550 and 440 nm if in the range of all
        parts; otherwise those of the first part that has a list.
        """
        if self.default_wavelengths is not None:
            return self.default_wavelengths
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
        """Raise an error for a wavelength outside the range of some part."""
        low, high = self.wavelength_limits
        for nm in wavelengths:
            if not low <= nm <= high:
                parts = self._limits_by_part().items()
                who = next((name for name, (a, b) in parts if not a <= nm <= b), self.name)
                raise ParameterError("wavelengths", nm, f"{low:g} to {high:g} nm, for {who!r}")

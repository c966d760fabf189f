"""Planet: ground, star, and constituents of the atmosphere."""

from __future__ import annotations

import contextlib
import dataclasses
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import Collector, ParameterError
from airlight.geometry.ephemeris.world import WORLDS, World, world_named
from airlight.kernel.cache import Cache
from airlight.physics.optics.airglow import airglow_names
from airlight.physics.optics.density_profile import DensitySegments
from airlight.physics.units import values_in
from airlight.planets.clouds import CLOUDS, MAX_CLOUDS, Clouds
from airlight.planets.constituent import Constituent
from airlight.planets.ground import Ground
from airlight.planets.parameters import MISSING, between, instance_of, parameters
from airlight.planets.rings import Ring, check_rings
from airlight.planets.schema.field import (
    WAVELENGTHS,
    Field,
    FileTable,
    Wavelengths,
    always,
    key,
)
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.shell import LARGEST_RATIO, LEAST_THICKNESS, SHELL, Shell
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
#: Number of media that a planet keeps, since reader, solver and pictures request the same.
MEDIA: Final = 2
#: Largest number of constituents of a planet.
MAX_CONSTITUENTS: Final = 64


@parameters
class Planet(TomlModel):
    """Planet with an atmospheric shell, illuminated by a star.

    Parameters
    ----------
    name : str
        Name of 1 to 60 letters.
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the atmosphere, at the equator. [m]
    flattening : float
        Flattening in pictures from outside the air. [1]
    constituents : tuple of Constituent
        Constituents, 1 to 64.
    gases : tuple of Constituent
        Further constituents, counted only in bands, see ``with_gases``.
    clouds : tuple of Clouds
        Three-dimensional clouds, at most 8.
    rings : tuple of Ring
        Rings in the plane of the equator, at most 16, without overlap.
    default_wavelengths : tuple of float, optional
        Default wavelengths of the planet. [nm]
    description : str, optional
        Description and sources, in a sentence or two.
    body : str, optional
        Body of the solar system, for the sun by place and time: ``"earth"``, ``"mars"`` or
        ``"titan"``.
    refraction : str, optional
        ``"bouguer"`` for refraction by gases; ``"none"`` for straight rays.
    airglow : str, optional
        ``"earth"`` for the airglow of the Earth in pictures; ``"none"`` for a dark night.

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

    name: str = key(
        help="Name of the planet.",
        note="1 to 60 letters.",
        range=(1.0, 60.0),
        example="the planet's name",
    )
    description: str = key(
        help="Short description, with the source of the data.",
        note="Listed by `airlight planets`.",
        example="a sentence",
        offered=always,
        default="",
    )
    default_wavelengths: tuple[float, ...] | None = key(
        WAVELENGTHS,
        help="Default wavelengths of the planet.",
        note="Without them: 680, 550, 440 nm; if the planet is not known there, those of"
        " its first constituent that names any.",
        default=None,
    )
    body: str | None = key(
        help="Body of the solar system, for the sun by place and time.",
        note="For `airlight render --at --time` and `airlight.Scene.at`.",
        choices=lambda: tuple(WORLDS),
        mode="advanced",
        default=None,
    )
    refraction: str = key(
        help="Refraction by the gases.",
        note="Rejected where rays would be trapped by super-refraction, as on Venus.",
        choices=lambda: ("none", "bouguer"),
        offered=always,
        default="none",
    )
    airglow: str = key(
        help="Light of the upper atmosphere at night, in pictures.",
        note="`earth`: lines of oxygen at 557.7, 630 and 636 nm and of sodium at 589 nm and a"
        " continuum, in layers around 90 and 250 km; they shine on the ground, and may lie above"
        " the top of the air.",
        choices=lambda: ("none", *airglow_names()),
        offered=always,
        synonyms=("nightglow", "green line", "night sky"),
        default="none",
    )
    flattening: float = key(
        help="Flattening f of the planet, seen from outside its air.",
        note="The polar radius is 1 - f times `bottom_radius`; from within the air it is a sphere."
        " Earth: 0.0033528.",
        range=(0.0, 0.5),
        example="0.098",
        slider=(0.0, 0.2),
        synonyms=("oblateness", "ellipticity"),
        offered=always,
        default=0.0,
    )
    bottom_radius: Annotated[float, between(1e3, 1e12, "m")]
    top_radius: Annotated[float, between(1e3, 1e13, "m")]
    ground: Ground = key(
        help="Surface of the planet.",
        table=Ground,
        example="a table [ground] with an albedo",
        required=True,
        default=Ground(),
    )
    star: Star = key(
        help="Star that illuminates the planet.",
        table=Star,
        example="a table [star] with a spectrum and an angular_radius",
    )
    constituents: tuple[Annotated[Constituent, instance_of(Constituent)], ...] = key(
        help="Constituents of the atmosphere.",
        note="1 to 64 of them, each with a name of its own.",
        table=Constituent,
        example="a list of tables [[constituents]]",
    )
    gases: tuple[Annotated[Constituent, instance_of(Constituent)], ...] = key(
        help="Further constituents, counted only in bands, where a bandwidth is given.",
        note="Otherwise as `constituents`, one of which replaces a gas of its name.",
        table=Constituent,
        example="a list of tables [[gases]]",
        mode="advanced",
        default=(),
    )
    clouds: tuple[Annotated[Clouds, instance_of(Clouds)], ...] = key(
        help="Three-dimensional clouds.",
        note="Up to 8 tables, each with a name or kind of its own.",
        table=CLOUDS,
        example="a list of tables [[clouds]]",
        default=(),
    )
    rings: tuple[Annotated[Ring, instance_of(Ring)], ...] = key(
        help="Rings in the plane of the equator.",
        note="Up to 16 tables; seen in pictures, with their shadow and their light.",
        table=Ring,
        example="a list of tables [[rings]]",
        synonyms=("ring system",),
        default=(),
    )

    @classmethod
    def declared(cls, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of a whole file, the radii in a nested table."""
        own = super().declared(table)
        first = next(i for i, key in enumerate(own) if key.kind == "table")
        return (*own[:first], SHELL, *own[first:])

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Values of the file; without a valid shell, over which depths are spread, no air."""
        found: dict[str, Any] = {"default_wavelengths": None, "constituents": None}
        collector = Collector()
        with collector:
            found["default_wavelengths"] = table.wavelengths()
        with collector:
            SHELL.read_from(table, None)
        with contextlib.suppress(ParameterError):  # unknown keys do not hide errors of the air
            radii = Shell.read_values(table.table(SHELL.name, SHELL.example))
            shell = Shell(**radii)
            table.thickness = shell.top_radius - shell.bottom_radius
            found |= radii
            del found["constituents"]
        with collector:
            found |= super().read_values(table, None, **found)
        collector.raise_all()
        return found

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
            allowed = f"{least:.10g} to {most:.10g} m"
            raise ParameterError("top_radius", self.top_radius, allowed)
        if not 1 <= len(self.constituents) <= MAX_CONSTITUENTS:
            allowed = f"1 to {MAX_CONSTITUENTS} constituents"
            raise ParameterError("constituents", len(self.constituents), allowed)
        if self.body is not None:
            world_named(self.body)
        if len(self.clouds) > MAX_CLOUDS:
            raise ParameterError("clouds", len(self.clouds), f"at most {MAX_CLOUDS} of them")
        for table, names in (
            ("constituents", [one.name for one in self.constituents]),
            ("gases", [one.name for one in self.gases]),
            ("clouds", [one.title for one in self.clouds]),
        ):
            for index, one in enumerate(names):
                if one in names[:index]:
                    raise ParameterError(f"{table}[{index}].name", one, "a unique name")
        check_rings(self.rings, self.top_radius)
        if self.wavelength_limits[0] > self.wavelength_limits[1]:
            allowed = "parts with a common wavelength range"
            raise ParameterError("wavelengths", self._limits_by_part(), allowed)
        if (default := self.default_wavelengths) is not None:
            check_wavelength_list(default)
            self.check_wavelengths(default)

    @cached_property
    def without_clouds(self) -> Planet:
        """The planet without its three-dimensional clouds; itself if it has none."""
        return dataclasses.replace(self, clouds=()) if self.clouds else self

    @cached_property
    def with_gases(self) -> Planet:
        """Planet whose ``gases`` are constituents, unless a constituent has their name."""
        names = {one.name for one in self.constituents}
        further = (one for one in self.gases if one.name not in names)
        return dataclasses.replace(self, constituents=(*self.constituents, *further), gases=())

    @cached_property
    def media(self) -> Cache[bytes, Any]:
        """Media that ``Medium.from_planet`` made last, by their wavelengths."""
        return Cache(MEDIA)

    @cached_property
    def relative_densities(self) -> DensitySegments:
        """Density profiles of the constituents over the shell.

        Raises
        ------
        ParameterError
            If a profile is impossible: the constituent is named.
        """
        rows = []
        for index, one in enumerate(self.constituents):
            try:
                rows.append(one.profile.row(self.thickness))
            except ParameterError as error:
                raise error.named(f"constituents[{index}].profile.{error.field}") from None
        return DensitySegments.from_rows(rows)

    @property
    def thickness(self) -> float:
        """Height of the shell. [m]"""
        return self.top_radius - self.bottom_radius

    def _limits_by_part(self) -> dict[str, Limits]:
        parts = {"ground": self.ground.limits, "star": self.star.limits}
        parts |= {one.name or "rings": one.limits for one in self.rings}
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
        return (self.star.source("star", values_in(wavelengths, "nm", "wavelengths")),)

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

"""Options of the planet: name, ``--set``, ``--ground-albedo``."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from airlight.cli import options
from airlight.cli.console import note, shown_progress
from airlight.cli.option_groups import (
    OptionGroup,
    given_options,
    given_values,
    named_errors,
    option,
)
from airlight.cli.place_options import check_coordinates, latitude_option, longitude_option
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Override a key of the planet's file: ground.albedo=0.3, "
        "dust.profile.scale_height='8 km'; PATH= removes it. May be repeated.",
    ),
]

Clouds = Annotated[
    str | None,
    typer.Option(
        "--clouds",
        metavar="KIND|FILE",
        help="Three-dimensional clouds, instead of those of the planet's file: "
        "{planets.clouds:WORDS}, the path of a NetCDF or Zarr file, several of these with commas "
        "between them, or none. --set clouds.cover=0.4 changes them, or clouds.cirrus.cover=0.4 "
        "those of one kind.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class FileChanges(OptionGroup):
    """Overrides of planet files."""

    set_: Set = None
    clouds: Clouds = None

    @property
    def overrides(self) -> list[str]:
        """Overrides in the form of ``--set``: the clouds, then those given."""
        return with_clouds(self.clouds, self.set_)


@dataclass(frozen=True, kw_only=True)
class PlanetOptions(FileChanges):
    """Planet and overrides of its file."""

    planet: Annotated[
        str, typer.Argument(metavar="PLANET", help="Name of a preset, or path of a TOML file.")
    ]

    def load(self) -> Planet:
        """Planet with its overrides, see ``load``."""
        return load(self.planet, self.overrides)

    def changes(self) -> dict[str, str]:
        """Overrides, as metadata of a file."""
        return {"changes": "; ".join(self.overrides)} if self.overrides else {}


@dataclass(frozen=True, kw_only=True)
class GroundOptions(PlanetOptions):
    """Planet, overrides of its file, and its surface albedo."""

    ground_albedo: str | None = option(
        "Surface albedo used by the solver: 0.3; 440:0.2,550:0.3,680:0.35 by wavelength in nm; or "
        "the name of a table. Default: the planet's map around the observer, or the planet's file "
        "if there is no map.",
        "ALBEDO",
    )
    star_temperature: float | None = option(
        "Temperature of the star, a black body that gives the planet as much energy as its own: "
        "3000K.",
        "KELVIN",
        read=options.temperature,
    )

    def load(self) -> Planet:
        """Planet with its overrides, ``--star-temperature`` and ``--ground-albedo``."""
        planet = super().load()
        if self.star_temperature is not None:
            from airlight.planets import replace

            with named_errors(**{"star.temperature": "--star-temperature"}):
                star = planet.star.of_temperature(self.star_temperature)
            planet = replace(planet, star=star)
        if self.ground_albedo is None:
            return planet
        return with_ground_albedo(planet, self.ground_albedo)

    def changes(self) -> dict[str, str]:
        """Overrides, ``--star-temperature`` and ``--ground-albedo``, as metadata of a file."""
        given = {} if self.ground_albedo is None else {"ground_albedo": self.ground_albedo}
        if self.star_temperature is not None:
            given["star_temperature"] = f"{self.star_temperature:.10g} K"
        return super().changes() | given


@dataclass(frozen=True, kw_only=True)
class LocalGroundOptions(GroundOptions):
    """Planet, overrides of its file, and surface albedo, optionally around an observer."""

    latitude: float | None = latitude_option()
    longitude: float | None = longitude_option()

    def local(self, planet: Planet, altitude: float = 0.0) -> Planet:
        """Planet with the surface albedo around the coordinates; unchanged without them."""
        given = given_options(self, "latitude", "longitude")
        for one in given:
            if self.ground_albedo is not None:
                raise ConflictError(one, "cannot be combined with --ground-albedo")
        check_coordinates(self)
        if not given:
            return planet
        from airlight.scene.local_ground import local_ground

        numbers = given_values(self, "latitude", "longitude")
        with named_errors("latitude", "longitude", "altitude"):
            return local_ground(planet, **numbers, altitude=altitude)


def with_clouds(clouds: str | None, changes: list[str] | None, body: str = "") -> list[str]:
    """Overrides in the form of ``--set``: those of ``--clouds``, then those given.

    Parameters
    ----------
    clouds, changes : optional
        Values of ``--clouds`` and ``--set``.
    body : str
        Name of the planet in a scene.
    """
    chosen = [] if clouds is None else [_clouds_override(clouds)]
    return [*(f"{body}.{one}" if body else one for one in chosen), *(changes or [])]


def _clouds_override(text: str) -> str:
    """Override of ``--clouds``: words of kinds and paths of files, or ``none``."""
    if text == "none":
        return "clouds=[]"
    given = [text] if Path(text).exists() else text.split(",")
    return f"clouds=[{', '.join(_cloud_table(one) for one in given)}]"


def _cloud_table(text: str) -> str:
    """Table ``[[clouds]]`` of a word of a kind, or of the path of a file."""
    from airlight.planets.clouds import WORDS
    from airlight.planets.schema.toml_table import suggestion

    if text in WORDS:
        return f'{{ kind = "{text}" }}'
    path = Path(text)
    if not text or (not path.suffix and not path.exists()):
        words = suggestion(text, WORDS)
        raise ParameterError("--clouds", text, f"{words}, the path of a file, or none alone")
    return f"{{ file = {json.dumps(str(path.absolute()))} }}"


def overrides_of(changes: list[str] | None) -> dict[str, Any]:
    """Overrides of the arguments of ``--set``, by path."""
    from airlight.planets.reading.overrides import FIELD, parsed

    with named_errors(**{FIELD: "--set"}):
        return dict(parsed(change) for change in changes or [])


def load(name: str, changes: list[str] | None = None) -> Planet:
    """Load the planet of a command.

    Parameters
    ----------
    name : str
        Name of a preset, or path of a planet file.
    changes : list of str, optional
        Arguments of ``--set``, each ``PATH=VALUE``; the last one of a path applies.

    Notes
    -----
    Truncated constituents are reported on the standard error stream.
    """
    from airlight.planets import load_planet
    from airlight.planets.reading.overrides import FIELD
    from airlight.planets.truncated_constituents import truncated_constituents

    with named_errors(**{FIELD: "--set"}), shown_progress() as report:
        loaded = load_planet(name, overrides_of(changes), progress=report)
    for line in truncated_constituents(loaded):
        note(line)
    return loaded


def with_ground_albedo(planet: Planet, text: str) -> Planet:
    """Planet with the ground albedo of ``--ground-albedo``; its map is unchanged.

    Parameters
    ----------
    text : str
        Number, pairs of wavelength [nm] and albedo such as ``440:0.2,680:0.3``, or name of a
        reflectance table.
    """
    from airlight.planets import replace
    from airlight.planets.spectral import PerWavelength

    option, allowed = "--ground-albedo", "0 to 1, nm:albedo pairs, or the name of a table"
    albedo: float | str | PerWavelength = text.strip()
    try:
        if ":" in text:
            pairs = [one.split(":") for one in text.split(",")]
            nm, values = zip(*((float(one), float(other)) for one, other in pairs), strict=True)
            albedo = PerWavelength(wavelengths=nm, values=values)
        elif not text.strip()[:1].isalpha():
            albedo = float(text)
        return replace(planet, ground=replace(planet.ground, albedo=albedo, local=None))
    except (ParameterError, ValueError) as error:
        words = error.allowed if isinstance(error, ParameterError) else allowed
        raise ParameterError(option, text, words) from None

"""Options of secondary lights: ``--moon``, ``--second-star``, ``--stars``."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import typer

from airlight.cli import options
from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.cli.place_options import Placed
    from airlight.planets.planet import Planet
    from airlight.scene.light_position import LightPosition
    from airlight.scene.moon_light import MoonLight
    from airlight.scene.star_light import StarLight

#: Default angular radius of a second star. [deg]
_RADIUS = 0.27


@dataclass(frozen=True, kw_only=True)
class LightOptions:
    """Options of secondary lights."""

    moon: Annotated[
        str | None,
        typer.Option(
            metavar="none|Z,AZ[,PHASE]",
            help="Moon as a second light: zenith angle, azimuth from the sun and phase angle (0 "
            "full, 90 half); none to exclude it. Default: by --at and --time.",
        ),
    ] = None
    second_star: Annotated[
        str | None,
        typer.Option(
            metavar="Z,AZ,KELVIN[,RADIUS]",
            help="Second star: zenith angle, azimuth from the first, temperature, and angular "
            "radius (0.27deg), e.g. 80,12,3500K.",
        ),
    ] = None
    stars: Annotated[
        bool,
        typer.Option(
            "--stars",
            help="Stars to magnitude 6.5, by --at and --time or by the position of the sun; "
            "invisible by day.",
        ),
    ] = False

    def check(self, planet: Planet, projection: str) -> None:
        """Raise an error for stars without place and time or for an unsupported planet."""
        if self.stars:
            from airlight.render.star_points import check_stars

            check_stars(planet.body, projection, "--stars")

    def secondary(self, placed: Placed) -> tuple[LightPosition, ...]:
        """Secondary lights from the options, or from place and time."""
        from airlight.scene.moon_light import MoonLight

        lights: list[LightPosition] = []
        if self.moon is None and placed.moon is not None:
            lights.append(MoonLight.seen(placed.moon, placed.sun_azimuth))
        elif self.moon is not None and self.moon.strip().lower() != "none":
            lights.append(_moon(self.moon))
        if self.second_star is not None:
            lights.append(_second_star(self.second_star))
        return tuple(lights)


def _moon(text: str) -> MoonLight:
    from airlight.scene.moon_light import MoonLight

    parts = text.split(",")
    if not 2 <= len(parts) <= 3:
        raise ParameterError("--moon", text, "none, or zenith,azimuth,phase such as 60,40,30")
    angles = [options.angle(part, "--moon") for part in parts]
    with _named("--moon"):
        return MoonLight(zenith=angles[0], azimuth=angles[1], phase=sum(angles[2:]))


def _second_star(text: str) -> StarLight:
    from airlight.scene.star_light import StarLight

    option, parts = "--second-star", text.split(",")
    if not 3 <= len(parts) <= 4:
        allowed = "zenith,azimuth,temperature,radius such as 80,12,3500K,0.3deg"
        raise ParameterError(option, text, allowed)
    zenith, azimuth = (options.angle(part, option) for part in parts[:2])
    kelvin = options.temperature(parts[2], option)
    radius = options.angle(parts[3], option) if len(parts) > 3 else _RADIUS
    with _named(option):
        star = StarLight.black_body(kelvin, radius)
        return StarLight(zenith=zenith, azimuth=azimuth, star=star)


@contextmanager
def _named(option: str) -> Iterator[None]:
    """Context that puts the option's name into errors, and the field into the allowed values."""
    try:
        yield
    except ParameterError as error:
        field = error.field.rpartition(".")[2].replace("_", " ")
        raise ParameterError(option, error.value, f"{field} {error.allowed}") from None

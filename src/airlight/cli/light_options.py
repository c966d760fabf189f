"""Options of secondary lights: ``--moon``, ``--second-star``, ``--stars``."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from airlight.cli import options
from airlight.cli.option_groups import OptionGroup, option
from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.scene import Scene
    from airlight.scene.moon_light import MoonLight
    from airlight.scene.star_light import StarLight

#: Default angular radius of a second star. [deg]
_RADIUS = 0.27


def _moon(text: str, option: str) -> tuple[MoonLight, ...]:
    """Moon of ``--moon``; nothing for ``none``."""
    from airlight.scene.moon_light import MoonLight

    if text.strip().lower() == "none":
        return ()
    parts = text.split(",")
    if not 2 <= len(parts) <= 3:
        raise ParameterError(option, text, "none, or zenith,azimuth,phase such as 60,40,30")
    angles = [options.angle(part, option) for part in parts]
    with _named(option):
        return (MoonLight(zenith=angles[0], azimuth=angles[1], phase=sum(angles[2:])),)


def _second_star(text: str, option: str) -> StarLight:
    """Star of ``--second-star``."""
    from airlight.scene.star_light import StarLight

    parts = text.split(",")
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


@dataclass(frozen=True, kw_only=True)
class LightOptions(OptionGroup):
    """Options of secondary lights."""

    moon: Any = option(
        "Moon as a second light: zenith angle, azimuth from the sun and phase angle (0 full, 90 "
        "half); none to exclude it. Default: by --at and --time.",
        "none|Z,AZ[,PHASE]",
        read=_moon,
    )
    second_star: Any = option(
        "Second star: zenith angle, azimuth from the first, temperature, and angular radius "
        "(0.27deg), e.g. 80,12,3500K.",
        "Z,AZ,KELVIN[,RADIUS]",
        read=_second_star,
    )
    stars: bool = option(
        "Stars to magnitude 6.5, by --at and --time or by the position of the sun; invisible by "
        "day.",
        default=False,
    )

    def check(self, planet: Planet, projection: str) -> None:
        """Raise an error for stars without place and time or for an unsupported planet."""
        if self.stars:
            from airlight.render.star_points import check_stars

            check_stars(planet.body, projection, "--stars")

    def added(self, scene: Scene) -> Scene:
        """Scene with the secondary lights of the options, or with the Moon of its time."""
        lights = scene.secondary_lights if self.moon is None else self.moon
        lights += () if self.second_star is None else (self.second_star,)
        return replace(scene, secondary_lights=lights)

"""Options of the observer and the sun, by angles or by place and time."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

import typer

from airlight.cli import options
from airlight.cli.console import note
from airlight.cli.option_groups import (
    OptionGroup,
    given_options,
    given_values,
    named_errors,
    option,
)
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from datetime import datetime

    from airlight.geometry.ephemeris.sky import Place
    from airlight.planets.planet import Planet
    from airlight.scene import Scene

#: Coordinates of the observer.
latitude_option: Final = partial(
    option, "{scene.scene_fields:LATITUDE}, for the planet's map, e.g. 25deg.", "ANGLE"
)
longitude_option: Final = partial(
    option, "{scene.scene_fields:LONGITUDE}, for the planet's map, e.g. 30deg.", "ANGLE"
)
Zone = Annotated[
    str | None,
    typer.Option(metavar="ZONE", help="Time zone: Europe/Stockholm; or solar, true solar time."),
]

#: Options that ``--at`` and ``--time`` replace.
_ANGLES: Final = ("sun_zenith", "sun_azimuth", "latitude", "longitude")
#: Wavelength at which the visible fraction of an eclipsed sun is given. [nm]
_MIDDLE = 550.0


@dataclass(frozen=True, kw_only=True)
class AngleOptions(OptionGroup):
    """Options of the observer and the sun by angles."""

    altitude: float | None = option("{scene.scene_fields:ALTITUDE}, e.g. 400km (2m).", "LENGTH")
    sun_zenith: float | None = option(
        "{scene.scene_fields:SUN_ZENITH}, e.g. 72deg (60deg).", "ANGLE"
    )
    sun_azimuth: float | None = option(
        "{scene.scene_fields:SUN_AZIMUTH}, e.g. 105deg or ESE (S).", "BEARING"
    )
    latitude: float | None = latitude_option()
    longitude: float | None = longitude_option()

    def numbers(self) -> dict[str, Any]:
        """Values of the given options by name. [m], [deg]

        Examples
        --------
        >>> AngleOptions(altitude="35km", sun_azimuth="SE").numbers()
        {'altitude': 35000.0, 'sun_azimuth': 135.0}
        """
        return given_values(self, *(one.name for one in fields(AngleOptions)))


@dataclass(frozen=True, kw_only=True)
class MomentOptions(OptionGroup):
    """Options of place and time."""

    at: str | None = option(
        "Observer position, with --time: 59.33N,18.07E or 59.33,18.07, or the name of a city, "
        "summit or landing site: 'Dead Sea', Gale; optionally ,35km. Mars and Titan: "
        "planetocentric, east positive.",
        "LAT,LON|NAME[,ALTITUDE]",
    )
    time_: str | None = option(
        "Time, with --at: 2026-06-21T22:10+02:00, …Z, or without a zone with --zone; or an event, "
        "optionally after a date: {geometry.ephemeris.events:WORDS}; or the sun's elevation: "
        "'morning 5deg', 'evening -3deg'.",
        "TIME",
    )
    zone: Zone = None
    season: float | None = option(
        "Solar longitude Ls, 0 at the northern spring equinox; --time is then an event or a true "
        "solar time such as 14:30 (noon), after its date; default date: 2000.",
        "ANGLE",
    )
    sun_distance: Literal["true", "file"] = option(
        "Sun distance with --time: true at that time, or that of the planet's file.",
        "true|file",
        "true",
    )

    @property
    def timed(self) -> bool:
        """Whether observer and sun are given by place and time."""
        return bool(self._time_options())

    def _time_options(self) -> dict[str, Any]:
        return given_options(self, "at", "time_", "zone", "season")


@dataclass(frozen=True, kw_only=True)
class PlaceOptions(MomentOptions, AngleOptions):
    """Options of the observer and the sun, by angles or by place and time."""

    @property
    def altitude_in_at(self) -> bool:
        """Whether ``--at`` has an altitude."""
        from airlight.geometry.ephemeris.place_text import is_named

        if self.at is None:
            return False
        return self.at.count(",") > (0 if is_named(self.at) else 1)

    def scene(self, planet: Planet) -> Scene:
        """Observer and lights by place and time, or by angles with the rest as in ``Scene()``.

        Parameters
        ----------
        planet : Planet
            Planet with its ``body``.
        """
        from airlight.scene import Scene

        if self.timed:
            return self._by_time(planet)
        with named_errors(**{"scene.altitude": "--altitude"}):
            return Scene(**self.numbers())

    def _by_time(self, planet: Planet) -> Scene:
        if self.at is None:
            raise ConflictError(next(iter(self._time_options())), "requires --at")
        for given in given_options(self, *_ANGLES):
            raise ConflictError(given, "cannot be combined with --at and --time")
        if self.time_ is None and self.season is None:
            raise ConflictError("--at", "requires --time or --ls")
        from airlight.scene.scene import STANDING, Scene

        body = planet.world.name  # refused under the name of its key
        latitude, longitude, height = self.position(self.at, body)
        try:
            with named_errors("zone", time="--time", solar_longitude="--ls"):
                return Scene.at(
                    planet,
                    latitude=latitude,
                    longitude=longitude,
                    time=self.time_ or "noon",
                    zone=self.zone,
                    season=self.season,
                    altitude=STANDING if height is None else height,
                )
        except ParameterError as error:
            if error.field != "body":
                raise
            raise ParameterError("--time", self.time_, error.allowed) from None

    def position(self, at: str, body: str | None = None) -> tuple[float, float, float | None]:
        """Latitude, longitude and altitude of ``--at`` and ``--altitude``. [deg], [m]"""
        from airlight.geometry.ephemeris.gazetteer import find_place
        from airlight.geometry.ephemeris.place_text import is_named, read_place

        own = None
        if is_named(at):
            name, _, text = at.partition(",")
            latitude, longitude, own = find_place(name, body, "--at")[1:4]
            above = text.strip() or None
        else:
            latitude, longitude, above = read_place(at, "--at")
        if above is None:
            return latitude, longitude, own if self.altitude is None else self.altitude
        if self.altitude is not None:
            raise ConflictError("--altitude", "cannot be combined with an altitude in --at")
        return latitude, longitude, options.length(above, "--at")

    def lit(self, planet: Planet, scene: Scene) -> Planet:
        """Planet with the sun at its distance at that time, or at that of the file."""
        if scene.time is None or self.sun_distance == "file":
            return planet
        return planet.lit_at(scene.time)

    def line(self, planet: Planet, scene: Scene) -> str:
        """Text line with place, time, sun, moon, and the sun's distance."""
        from airlight.geometry.ephemeris.sky import Place
        from airlight.geometry.ephemeris.sky_line import sky_line
        from airlight.planets.lowered_ground import stands_on_floor
        from airlight.scene.apparent_sun import apparent_altitude

        assert scene.time is not None
        place = Place(
            body=planet.world.name,
            latitude=scene.latitude,
            longitude=scene.longitude,
            altitude=scene.altitude,
        )
        seen = apparent_altitude(*stands_on_floor(planet, scene.altitude), scene.sun_zenith)
        text = sky_line(place, scene.time, seen=seen)
        if place.world.has_moon:
            text += _eclipse(planet, place, scene.time)
        if self.sun_distance == "file":
            return f"{text}  lit as in the planet's file"
        if planet.star.irradiance is not None:
            return f"{text}  lit as in the planet's file, which gives the irradiance"
        return text


def check_coordinates(group: Any) -> None:
    """Raise an error for a latitude without a longitude, or the reverse."""
    given = list(given_options(group, "latitude", "longitude"))
    if len(given) == 1:
        missing = "--longitude" if given == ["--latitude"] else "--latitude"
        raise ConflictError(given[0], f"requires {missing}")


def on_floor(planet: Planet, altitude: float) -> tuple[Planet, float]:
    """Planet lowered to an observer at negative altitude, and the altitude above its ground. [m]"""
    if altitude >= 0.0:
        return planet, altitude
    from airlight.planets.lowered_ground import stands_on_floor

    try:
        lowered, height = stands_on_floor(planet, altitude)
    except ParameterError as error:
        raise error.named("--altitude") from None
    note(
        f"the observer stands on the floor of a basin: the atmosphere is solved for ground at "
        f"{altitude - height:.10g} m everywhere"
    )
    return lowered, height


def _eclipse(planet: Planet, place: Place, time: datetime) -> str:
    """Remark on a solar eclipse, with the visible fraction of the sun's light."""
    from airlight.geometry.disc_overlap import visible_light
    from airlight.geometry.ephemeris.sky import moon_seen, sun_seen

    sun, moon = sun_seen(place, time), moon_seen(place, time)
    apart = math.degrees(2.0 * math.asin(0.5 * math.dist(sun.direction, moon.direction)))
    if sun.altitude < -1.0 or apart >= sun.angular_radius + moon.angular_radius:
        return ""
    darkening = planet.lights([_MIDDLE])[0].darkenings
    part = visible_light(sun.angular_radius, [apart], [moon.angular_radius], darkening=darkening)[0]
    left = f"{100.0 * part:.2g} % of its light is visible"
    if part <= 0.0:
        left = "total; for the sky of totality: airlight render solar-eclipse-2017 --at … --time …"
    return f"  in front of the sun, {apart:.2f}° from its centre: {left}"

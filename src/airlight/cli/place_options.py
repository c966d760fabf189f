"""Options of the observer and the sun, by angles or by place and time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

import typer

from airlight.cli import options
from airlight.cli.console import note
from airlight.cli.option_groups import given_options, named_errors, read_options
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import datetime

    from airlight.geometry.ephemeris.sky import MoonSighting, Place
    from airlight.planets.planet import Planet

Latitude = Annotated[
    str | None,
    typer.Option(metavar="ANGLE", help="Observer latitude, for the planet's map, e.g. 25deg."),
]
Longitude = Annotated[
    str | None,
    typer.Option(
        metavar="ANGLE",
        help="Observer longitude, east positive, for the planet's map, e.g. 30deg.",
    ),
]
Zone = Annotated[
    str | None,
    typer.Option(metavar="ZONE", help="Time zone: Europe/Stockholm; or solar, true solar time."),
]

#: Readers of the options' texts.
_READERS: Final[dict[str, Callable[[str, str], float]]] = {
    "altitude": options.length, "latitude": options.angle, "longitude": options.angle,
    "sun_zenith": options.angle, "sun_azimuth": options.bearing,
}  # fmt: skip
#: Options that ``--at`` and ``--time`` replace.
_ANGLES: Final = ("sun_zenith", "sun_azimuth", "latitude", "longitude")
#: Wavelength at which the visible fraction of an eclipsed sun is given. [nm]
_MIDDLE = 550.0


@dataclass(frozen=True, kw_only=True)
class Placed:
    """Observer and sun of the options.

    Attributes
    ----------
    altitude : float
        Altitude of the observer. [m]
    latitude, longitude : float
        Coordinates of the observer. [deg]
    sun_zenith, sun_azimuth : float
        Zenith angle and compass bearing of the sun. [deg]
    time : datetime or None
        Instant, if given.
    moon : MoonSighting or None
        Moon, if its position is known.
    """

    altitude: float
    latitude: float
    longitude: float
    sun_zenith: float
    sun_azimuth: float
    time: datetime | None = None
    moon: MoonSighting | None = None


@dataclass(frozen=True, kw_only=True)
class AngleOptions:
    """Options of the observer and the sun by angles."""

    altitude: Annotated[
        str | None,
        typer.Option(metavar="LENGTH", help="Observer altitude above ground, e.g. 400km (2m)."),
    ] = None
    sun_zenith: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Sun zenith angle at the observer, e.g. 72deg (60deg)."),
    ] = None
    sun_azimuth: Annotated[
        str | None,
        typer.Option(metavar="BEARING", help="Compass bearing of the sun: 105deg, ESE (S)."),
    ] = None
    latitude: Latitude = None
    longitude: Longitude = None

    def numbers(self) -> dict[str, float]:
        """Values of the given options by name. [m], [deg]

        Examples
        --------
        >>> AngleOptions(altitude="35km", sun_azimuth="SE").numbers()
        {'altitude': 35000.0, 'sun_azimuth': 135.0}
        """
        return read_options(self, _READERS)


@dataclass(frozen=True, kw_only=True)
class PlaceOptions(AngleOptions):
    """Options of the observer and the sun, by angles or by place and time."""

    at: Annotated[
        str | None,
        typer.Option(
            metavar="LAT,LON[,ALTITUDE]",
            help="Observer position, with --time: 59.33N,18.07E or 59.33,18.07; optionally ,35km. "
            "Mars and Titan: planetocentric, east positive.",
        ),
    ] = None
    time_: Annotated[
        str | None,
        typer.Option(
            "--time",
            metavar="TIME",
            help="Time, with --at: 2026-06-21T22:10+02:00, …Z, or without a zone with --zone; or "
            "an event, optionally after a date: {geometry.ephemeris.events:WORDS}.",
        ),
    ] = None
    zone: Zone = None
    season: Annotated[
        str | None,
        typer.Option(
            "--ls",
            metavar="ANGLE",
            help="Solar longitude Ls, 0 at the northern spring equinox; --time is then an event or "
            "a true solar time such as 14:30 (noon), after its date; default date: 2000.",
        ),
    ] = None
    sun_distance: Annotated[
        Literal["true", "file"],
        typer.Option(
            metavar="true|file",
            help="Sun distance with --time: true at that time, or that of the planet's file.",
        ),
    ] = "true"

    @property
    def timed(self) -> bool:
        """Whether observer and sun are given by place and time."""
        return bool(self._time_options())

    @property
    def altitude_in_at(self) -> bool:
        """Whether ``--at`` has an altitude."""
        return self.at is not None and self.at.count(",") > 1

    def _time_options(self) -> dict[str, Any]:
        return given_options(self, "at", "time_", "zone", "season")

    def placed(self, planet: Planet) -> Placed:
        """Observer and sun by place and time, or by angles with defaults of ``Scene()``.

        Parameters
        ----------
        planet : Planet
            Planet with its ``body``.
        """
        if self.timed:
            return self._by_time(planet)
        from airlight.scene import Scene

        given, scene = self.numbers(), Scene()
        return Placed(**{name: given.get(name, getattr(scene, name)) for name in _READERS})

    def _by_time(self, planet: Planet) -> Placed:
        if self.at is None:
            raise ConflictError(next(iter(self._time_options())), "requires --at")
        for option in given_options(self, *_ANGLES):
            raise ConflictError(option, "cannot be combined with --at and --time")
        if self.time_ is None and self.season is None:
            raise ConflictError("--at", "requires --time or --ls")
        from airlight.geometry.ephemeris.place_text import read_place
        from airlight.geometry.ephemeris.sky import Place, moon_seen, sun_seen
        from airlight.geometry.ephemeris.time_text import read_time
        from airlight.scene.scene import STANDING

        latitude, longitude, above = read_place(self.at, "--at")
        if above is not None and self.altitude is not None:
            raise ConflictError("--altitude", "cannot be combined with an altitude in --at")
        height = self.numbers().get("altitude", STANDING)
        if above is not None:
            height = options.length(above, "--at")
        place = Place(
            body=planet.world.name, latitude=latitude, longitude=longitude, altitude=height
        )
        ls = None if self.season is None else options.angle(self.season, "--ls")
        try:
            with named_errors("zone", solar_longitude="--ls"):
                moment = read_time(
                    self.time_ or "noon", place, zone=self.zone, season=ls, field="--time"
                )
        except ParameterError as error:
            if error.field != "body":
                raise
            raise ParameterError("--time", self.time_, error.allowed) from None
        sun = sun_seen(place, moment)
        return Placed(
            altitude=height,
            latitude=latitude,
            longitude=longitude,
            sun_zenith=sun.zenith,
            sun_azimuth=sun.azimuth,
            time=moment,
            moon=moon_seen(place, moment) if place.world.has_moon else None,
        )

    def lit(self, planet: Planet, placed: Placed) -> Planet:
        """Planet with the sun at its distance at that time, or at that of the file."""
        if placed.time is None or self.sun_distance == "file":
            return planet
        return planet.lit_at(placed.time)

    def line(self, planet: Planet, placed: Placed) -> str:
        """Text line with place, time, sun, moon, and the sun's distance."""
        from airlight.geometry.ephemeris.sky import Place
        from airlight.geometry.ephemeris.sky_line import sky_line
        from airlight.planets.lowered_ground import stands_on_floor
        from airlight.scene.apparent_sun import apparent_altitude

        assert placed.time is not None
        place = Place(
            body=planet.world.name,
            latitude=placed.latitude,
            longitude=placed.longitude,
            altitude=placed.altitude,
        )
        seen = apparent_altitude(*stands_on_floor(planet, placed.altitude), placed.sun_zenith)
        text = sky_line(place, placed.time, seen=seen)
        if placed.moon is not None:
            text += _eclipse(planet, place, placed.time, placed.moon)
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


def _eclipse(planet: Planet, place: Place, time: datetime, moon: MoonSighting) -> str:
    """Remark on a solar eclipse, with the visible fraction of the sun's light."""
    from airlight.geometry.disc_overlap import visible_light
    from airlight.geometry.ephemeris.sky import sun_seen

    sun = sun_seen(place, time)
    apart = math.degrees(2.0 * math.asin(0.5 * math.dist(sun.direction, moon.direction)))
    if sun.altitude < -1.0 or apart >= sun.angular_radius + moon.angular_radius:
        return ""
    darkening = planet.lights([_MIDDLE])[0].darkenings
    part = visible_light(sun.angular_radius, [apart], [moon.angular_radius], darkening=darkening)[0]
    left = f"{100.0 * part:.2g} % of its light is visible"
    if part <= 0.0:
        left = "total; for the sky of totality: airlight render solar-eclipse-2017 --at … --time …"
    return f"  in front of the sun, {apart:.2f}° from its centre: {left}"

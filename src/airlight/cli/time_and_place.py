"""Options of place and time: ``--at``, ``--time``, ``--zone``, ``--ls``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from airlight.cli import options
from airlight.cli.console import note
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from datetime import datetime

    from airlight.ephemeris.sky import MoonSighting, Place
    from airlight.planets.planet import Planet

At = Annotated[
    str | None,
    typer.Option(
        "--at",
        metavar="LAT,LON[,ALTITUDE]",
        help="Observer position, with --time: 59.33N,18.07E or 59.33,18.07; optionally ,35km. Mars "
        "and Titan: planetocentric, east positive.",
    ),
]
Time = Annotated[
    str | None,
    typer.Option(
        "--time",
        metavar="TIME",
        help="Time, with --at: 2026-06-21T22:10+02:00, …Z, or without a zone with --zone; or an "
        "event, optionally after a date: {ephemeris.events:WORDS}.",
    ),
]
Zone = Annotated[
    str | None,
    typer.Option(
        metavar="ZONE",
        help="Time zone of --time: Europe/Stockholm; or solar, true solar time.",
    ),
]
Season = Annotated[
    str | None,
    typer.Option(
        "--ls",
        metavar="ANGLE",
        help="Solar longitude Ls, 0 at the northern spring equinox; --time is then an event or a "
        "true solar time such as 14:30 (noon), after its date or after 2000.",
    ),
]
SunDistance = Annotated[
    Literal["true", "file"],
    typer.Option(
        metavar="true|file",
        help="Sun distance with --time: true at that time, or that of the planet's file.",
    ),
]

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
        Coordinates of the point below. [deg]
    sun_zenith, sun_azimuth : float
        Zenith angle and compass bearing of the sun. [deg]
    time : datetime or None
        Instant, where one is given.
    moon : MoonSighting or None
        The Moon, where its place is known.
    """

    altitude: float
    latitude: float
    longitude: float
    sun_zenith: float
    sun_azimuth: float
    time: datetime | None = None
    moon: MoonSighting | None = None


def by_angles(
    sun_zenith: str | None,
    sun_azimuth: str | None,
    latitude: str | None,
    longitude: str | None,
    altitude: str | None,
) -> Placed:
    """Observer and sun by their angles, from the options' texts; the rest as in ``Scene()``.

    Examples
    --------
    >>> by_angles(None, "SE", None, None, "35km")  # doctest: +ELLIPSIS
    Placed(altitude=35000.0, latitude=0.0, longitude=0.0, sun_zenith=60.0, sun_azimuth=135.0, ...)
    """
    from airlight.scene import Scene

    def number(text: str | None, name: str, parse: Callable[[str, str], float]) -> float:
        default: float = getattr(Scene(), name)
        return default if text is None else parse(text, "--" + name.replace("_", "-"))

    return Placed(
        altitude=number(altitude, "altitude", options.length),
        latitude=number(latitude, "latitude", options.angle),
        longitude=number(longitude, "longitude", options.angle),
        sun_zenith=number(sun_zenith, "sun_zenith", options.angle),
        sun_azimuth=number(sun_azimuth, "sun_azimuth", options.bearing),
    )


def given(
    planet: Planet,
    at: str | None,
    time: str | None,
    zone: str | None,
    season: str | None,
    others: Mapping[str, str | None],
    altitude: str | None,
) -> Placed | None:
    """Observer and sun by place and time; None if no option names them.

    Parameters
    ----------
    planet : Planet
        Planet, whose ``body`` says whose sky it is.
    at, time, zone, season : str or None
        Texts of ``--at``, ``--time``, ``--zone`` and ``--ls``.
    others : mapping
        Options that say the same by angles, and their texts.
    altitude : str or None
        Text of ``--altitude``.

    Raises
    ------
    ParameterError
        If an option is missing, contradicts another or cannot be read, or the planet has no body.
    """
    named = {"--at": at, "--time": time, "--zone": zone, "--ls": season}
    if all(text is None for text in named.values()):
        return None
    if at is None:
        option = next(one for one, text in named.items() if text is not None)
        raise ConflictError(option, "requires --at")
    for option, text in others.items():
        if text is not None:
            raise ConflictError(option, "cannot be combined with --at and --time")
    if time is None and season is None:
        raise ConflictError("--at", "requires --time or --ls")
    from airlight.ephemeris.place_text import read_place
    from airlight.ephemeris.sky import Place, moon_seen, sun_seen
    from airlight.ephemeris.time_text import read_time
    from airlight.scene.scene import STANDING

    latitude, longitude, above = read_place(at, "--at")
    if above is not None and altitude is not None:
        raise ConflictError("--altitude", "cannot be combined with an altitude in --at")
    height = STANDING
    if above is not None:
        height = options.length(above, "--at")
    elif altitude is not None:
        height = options.length(altitude, "--altitude")
    place = Place(body=planet.world.name, latitude=latitude, longitude=longitude, altitude=height)
    ls = None if season is None else options.angle(season, "--ls")
    try:
        moment = read_time(time or "noon", place, zone=zone, season=ls, field="--time")
    except ParameterError as error:
        names = {"zone": "--zone", "solar_longitude": "--ls"}
        if error.field == "body":
            raise ParameterError("--time", time, error.allowed) from None
        raise error.named(names.get(error.field, error.field)) from None
    sun = sun_seen(place, moment)
    moon = moon_seen(place, moment) if place.world.has_moon else None
    return Placed(
        altitude=height,
        latitude=latitude,
        longitude=longitude,
        sun_zenith=sun.zenith,
        sun_azimuth=sun.azimuth,
        time=moment,
        moon=moon,
    )


def on_floor(planet: Planet, altitude: float) -> tuple[Planet, float]:
    """Planet whose ground is below an observer at negative altitude, and the altitude above it.

    Raises
    ------
    ParameterError
        If the altitude is below the planet's deepest basin.
    """
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


def lit(planet: Planet, placed: Placed, sun_distance: str) -> Planet:
    """Planet in the light of that time: the sun at its true distance, or at the file's."""
    if placed.time is None or sun_distance == "file":
        return planet
    return planet.lit_at(placed.time)


def line(planet: Planet, placed: Placed, sun_distance: str) -> str:
    """Line with place, time, sun, moon, and the sun's distance."""
    from airlight.ephemeris.sky import Place
    from airlight.ephemeris.sky_line import sky_line
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
    if sun_distance == "file":
        return f"{text}  lit as in the planet's file"
    if planet.star.irradiance is not None:
        return f"{text}  lit as in the planet's file, which gives the irradiance"
    return text


def _eclipse(planet: Planet, place: Place, time: datetime, moon: MoonSighting) -> str:
    """Remark on a solar eclipse, with the visible fraction of the sun's light."""
    from airlight.ephemeris.sky import sun_seen
    from airlight.geometry.disc_overlap import visible_light

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

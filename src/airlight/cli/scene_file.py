"""Scene files on the command line: overrides by options."""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import datetime
from typing import TYPE_CHECKING, Any

import numpy as np

from airlight.cli import options
from airlight.cli.camera_options import CameraOptions
from airlight.cli.option_groups import given_options, given_values, named_errors
from airlight.cli.place_options import PlaceOptions
from airlight.cli.planet_options import overrides_of, with_clouds
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.cli.planet_options import PlanetOptions
    from airlight.scene.system import System

#: Options of a camera that are keys of a scene. [deg]
_ANGLES = ("roll", "polariser")
#: Keys of a camera that determine its direction of view.
_LOOKS = ("look_at", "look_zenith", "look_bearing", "direction")


def load_scene(
    planet: PlanetOptions, place: PlaceOptions | None = None, camera: CameraOptions | None = None
) -> System:
    """Load a scene with the changes of the options.

    Parameters
    ----------
    planet : PlanetOptions
        Preset or scene file, and arguments of ``--set``, which take precedence.
    place : PlaceOptions, optional
        Place of the observer above the scene's body, and time.
    camera : CameraOptions, optional
        Camera; fields that differ from their defaults override those of the scene.
    """
    from airlight.planets.reading.overrides import FIELD
    from airlight.planets.reading.reader import nested_tables
    from airlight.scene.system.reading import changed_system, system_text

    place, camera = place or PlaceOptions(), camera or CameraOptions()
    text, file, folder = system_text(planet.planet)
    tables = nested_tables(text, file)
    body = "" if planet.clouds is None else cloudy_body(tables)
    with named_errors(**{FIELD: "--set"}):
        last = overrides_of(with_clouds(planet.clouds, planet.set_, body))
        changes = _of_place(place, tables)
        system = changed_system(tables, file, folder, {**changes, **last})
        if place.time_ is not None:
            changes["time"] = _moment(place, tables, system).isoformat()
            system = changed_system(tables, file, folder, {**changes, **last})
        changes |= _of_camera(camera, tables, system)
        return changed_system(tables, file, folder, {**changes, **last})


def cloudy_body(tables: Mapping[str, Any]) -> str:
    """Name of the planet that ``--clouds`` is about: below the observer, or the only one.

    Parameters
    ----------
    tables : mapping
        Tables of a scene file.
    """
    planets = [one["name"] for one in tables.get("bodies", []) if "planet" in one]
    below = tables.get("observer", {}).get("body")
    if below in planets:
        return str(below)
    if len(planets) != 1:
        raise ConflictError("--clouds", "requires an observer above a planet, or a single planet")
    return str(planets[0])


def _of_place(given: PlaceOptions, tables: Mapping[str, Any]) -> dict[str, Any]:
    """Overrides of the observer's place."""
    there = list(given_options(given, "at", "latitude", "longitude", "altitude"))
    if not there:
        return {}
    if "body" not in tables.get("observer", {}):
        raise ConflictError(there[0], "requires a scene whose observer is above a body")
    latitude, longitude, altitude = given.latitude, given.longitude, given.altitude
    if given.at is not None:
        for option in there[1:]:
            if option != "--altitude":
                raise ConflictError(option, "cannot be combined with --at")
        latitude, longitude, altitude = given.position(given.at)
    values = {"latitude": latitude, "longitude": longitude, "altitude": altitude}
    return {
        f"observer.{name}": f"{value!r} {'m' if name == 'altitude' else 'deg'}"
        for name, value in values.items()
        if value is not None
    }


def _moment(given: PlaceOptions, tables: Mapping[str, Any], system: System) -> datetime:
    """Overrides of the scene's time."""
    from airlight.geometry.ephemeris.sky import Place
    from airlight.geometry.ephemeris.time_text import read_time

    assert given.time_ is not None
    parts = [*tables.get("bodies", []), *tables.get("lights", [])]
    if not any("ephemeris" in one for one in parts if isinstance(one, dict)):
        raise ConflictError("--time", "requires a scene with an ephemeris")
    observer = system.observer
    planet = None if observer.body is None else system.planets.get(observer.body)
    world = "earth" if planet is None or planet.body is None else planet.world.name
    place = Place(
        body=world,
        latitude=observer.latitude,
        longitude=observer.longitude,
        altitude=observer.altitude,
    )
    with named_errors("zone"):
        return read_time(given.time_, place, zone=given.zone, field="--time")


def _of_camera(given: CameraOptions, tables: Mapping[str, Any], system: System) -> dict[str, Any]:
    """Overrides of the camera."""
    changes: dict[str, Any] = {}
    fov = None if given.fov is None else options.angle(given.fov, "--fov")
    for name, angle in (("field_of_view", fov), *given_values(given, *_ANGLES).items()):
        if angle is not None:
            changes[f"camera.{name}"] = f"{angle!r} deg"
    if given.dehaze is not None:
        changes["camera.dehaze"] = given.dehaze
    for name in given_options(given, "projection").values():
        changes["camera.projection"] = name
    if given.look_at is None:
        return changes
    camera = tables.get("camera", {})
    changes |= {f"camera.{one}": None for one in _LOOKS if one in camera}
    names = [*(one.name for one in system.bodies), *(one.name for one in system.lights if one.star)]
    if given.look_at in names:
        return changes | {"camera.look_at": given.look_at}
    zenith, bearing = _target(given.look_at, names, system)
    aims = {"camera.look_zenith": f"{zenith!r} deg", "camera.look_bearing": f"{bearing!r} deg"}
    return changes | aims


def _target(word: str, names: list[str], system: System) -> tuple[float, float]:
    """Zenith angle and compass bearing of a target other than a body or star. [deg]"""
    from airlight.scene import look_at

    observer = system.observer
    if observer.body is None:
        allowed = f"{', '.join(names)}: the observer is above no body"
        raise ParameterError("--look-at", word, allowed)
    body = system.body(observer.body)
    up = system.eye - body.centre
    up = up / np.linalg.norm(up)
    star = next(one for one in system.lights if one.star is not None)
    towards, north = star.towards(system.eye), system.axes(body)[2]
    east = np.cross(north, up)
    bearing = math.degrees(math.atan2(towards @ east, towards @ np.cross(up, east)))
    try:
        zenith, azimuth = look_at(
            word,
            altitude=observer.altitude,
            sun_zenith=math.degrees(math.acos(float(np.clip(towards @ up, -1.0, 1.0)))),
            bottom_radius=system.radius(body),
            sun_azimuth=bearing,
            planet=system.planets.get(body.name),
        )
    except ParameterError as error:
        allowed = f"{', '.join(names)}, horizon, nadir, zenith, or a bearing such as NE or 315/20"
        raise ParameterError("--look-at", error.value, allowed) from None
    return zenith, math.remainder(azimuth + bearing, 360.0)

"""Scene files on the command line: rendering, and overrides by options."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Any

import numpy as np

from airlight.cli import options
from airlight.cli.progress import shown_progress
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.scene.frame import Frame
    from airlight.system import System

#: Keys of a camera that say where it looks.
_LOOKS = ("look_at", "look_zenith", "look_bearing", "direction")


@dataclass(frozen=True, kw_only=True)
class SceneOptions:
    """Texts of the options of ``airlight render`` that change a scene; None if left out.

    Attributes
    ----------
    at, time, zone, altitude, latitude, longitude :
        Place of the observer above the scene's own body, and time.
    look_at, fov, roll, projection, polariser :
        Camera.
    changes : sequence of str or None
        Arguments of ``--set``, which count last.
    """

    at: str | None = None
    time: str | None = None
    zone: str | None = None
    altitude: str | None = None
    latitude: str | None = None
    longitude: str | None = None
    look_at: str | None = None
    fov: str | None = None
    roll: str | None = None
    projection: str | None = None
    polariser: str | None = None
    changes: list[str] | None = None


def rendered(
    name: str,
    given: SceneOptions,
    size: str | None,
    crop: str | None,
    wavelengths: str | None,
    quality: str,
    samples: int | None,
    *,
    whole: bool,
    cache: bool,
    excluded: Mapping[str, object],
) -> tuple[Frame, tuple[int, int, int, int] | None]:
    """Render a scene, with progress on the standard error stream; and its window.

    Parameters
    ----------
    name : str
        Preset or scene file.
    given : SceneOptions
        Overrides.
    size, crop, wavelengths, quality, samples, cache :
        Options of ``airlight render``.
    whole : bool
        Whether the whole picture is rendered, also of a window.
    excluded : mapping
        Options that are not available for scene files.

    Raises
    ------
    ParameterError
        If one of them is given, or a change is not possible.
    """
    from airlight.paint.render_system import render_system

    for option, value in excluded.items():
        if value:
            raise ConflictError(option, "is not available for scene files")
    system = changed(name, given)
    columns, rows = options.picture_size(size, system.view.projection)
    window = options.crop(crop, columns, rows)
    first = next(iter(system.planets.values()), None)
    nm = None
    if wavelengths is not None:
        if first is None:
            raise ConflictError("--wavelengths", "does not apply to a scene without air")
        nm = options.wavelengths(wavelengths, first)
    with shown_progress() as report:
        frame = render_system(
            system, width=columns, height=rows, wavelengths=nm, quality=quality,
            samples=samples, crop=None if whole else window, cache=cache, progress=report,
        )  # fmt: skip
    return frame, window


def changed(name: str, given: SceneOptions) -> System:
    """Load a scene with the changes of the options.

    Parameters
    ----------
    name : str
        Preset or scene file.
    given : SceneOptions
        Overrides.

    Raises
    ------
    ParameterError
        If an option cannot be read, or this scene has nothing that it could change.
    """
    from airlight.planets.reading.overrides import FIELD, parsed
    from airlight.planets.reading.reader import nested_tables
    from airlight.system.reading import changed_system, system_text

    text, file, folder = system_text(name)
    tables = nested_tables(text, file)
    try:
        last = dict(parsed(one) for one in given.changes or [])
        changes = _of_place(given, tables)
        system = changed_system(tables, file, folder, {**changes, **last})
        if given.time is not None:
            changes["time"] = _moment(given, tables, system).isoformat()
            system = changed_system(tables, file, folder, {**changes, **last})
        changes |= _of_camera(given, tables, system)
        return changed_system(tables, file, folder, {**changes, **last})
    except ParameterError as error:
        if error.field != FIELD:
            raise
        raise error.named("--set") from None


def _of_place(given: SceneOptions, tables: Mapping[str, Any]) -> dict[str, Any]:
    """Changes of the observer's place."""
    named = {"--at": given.at, "--latitude": given.latitude, "--longitude": given.longitude,
             "--altitude": given.altitude}  # fmt: skip
    there = [option for option, text in named.items() if text is not None]
    if not there:
        return {}
    if "body" not in tables.get("observer", {}):
        raise ConflictError(there[0], "requires a scene whose observer is above a body")
    changes: dict[str, Any] = {}
    height = given.altitude
    if given.at is not None:
        from airlight.ephemeris.place_text import read_place

        for option in there[1:]:
            if option != "--altitude":
                raise ConflictError(option, "cannot be combined with --at")
        latitude, longitude, above = read_place(given.at, "--at")
        if above is not None and height is not None:
            raise ConflictError("--altitude", "cannot be combined with an altitude in --at")
        height = above if height is None else height
        changes = {"observer.latitude": f"{latitude!r} deg",
                   "observer.longitude": f"{longitude!r} deg"}  # fmt: skip
    for option, text in (("--latitude", given.latitude), ("--longitude", given.longitude)):
        if text is not None:
            changes[f"observer.{option[2:]}"] = f"{options.angle(text, option)!r} deg"
    if height is not None:
        option = "--at" if given.altitude is None else "--altitude"
        changes["observer.altitude"] = f"{options.length(height, option)!r} m"
    return changes


def _moment(given: SceneOptions, tables: Mapping[str, Any], system: System) -> datetime:
    """Time of the scene."""
    from airlight.ephemeris.sky import Place
    from airlight.ephemeris.time_text import read_time

    assert given.time is not None
    parts = [*tables.get("bodies", []), *tables.get("lights", [])]
    if not any("ephemeris" in one for one in parts if isinstance(one, dict)):
        raise ConflictError("--time", "requires a scene with an ephemeris")
    observer = system.observer
    planet = None if observer.body is None else system.planets.get(observer.body)
    world = "earth" if planet is None or planet.body is None else planet.world.name
    place = Place(
        body=world, latitude=observer.latitude, longitude=observer.longitude,
        altitude=observer.altitude,
    )  # fmt: skip
    try:
        return read_time(given.time, place, zone=given.zone, field="--time")
    except ParameterError as error:
        field = "--zone" if error.field == "zone" else error.field
        raise error.named(field) from None


def _of_camera(
    given: SceneOptions, tables: Mapping[str, Any], system: System
) -> dict[str, Any]:  # fmt: skip
    """Changes of the camera."""
    changes: dict[str, Any] = {}
    for option, key, text in (("--fov", "field_of_view", given.fov), ("--roll", "roll", given.roll),
                              ("--polariser", "polariser", given.polariser)):  # fmt: skip
        if text is not None:
            changes[f"camera.{key}"] = f"{options.angle(text, option)!r} deg"
    if given.projection is not None:
        changes["camera.projection"] = given.projection
    if given.look_at is None:
        return changes
    camera = tables.get("camera", {})
    changes |= {f"camera.{one}": None for one in _LOOKS if one in camera}
    names = [*(one.name for one in system.bodies), *(one.name for one in system.lights if one.star)]
    if given.look_at in names:
        return changes | {"camera.look_at": given.look_at}
    zenith, bearing = _target(given.look_at, names, system)
    return changes | {
        "camera.look_zenith": f"{zenith!r} deg", "camera.look_bearing": f"{bearing!r} deg"
    }  # fmt: skip


def _target(word: str, names: list[str], system: System) -> tuple[float, float]:
    """Zenith angle and compass bearing of a target that is no body and no star. [deg]"""
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

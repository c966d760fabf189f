"""Reader of scene files: TOML to ``System``, with one-line errors."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from airlight.errors import ConflictError, ParameterError
from airlight.geometry.ephemeris.positions import position_of
from airlight.planets.parameters import replace
from airlight.planets.reading.overrides import FIELD, overridden
from airlight.planets.reading.reader import file_text, nested_tables
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.schema.toml_table import TomlTable, suggestion
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.system import System
from airlight.scene.system.viewpoint import SceneObserver, View


@cache
def system_names() -> tuple[str, ...]:
    """Names of the scene presets.

    Examples
    --------
    >>> "earth-moon" in system_names()
    True
    """
    folder = resources.files("airlight.scene.system") / "presets"
    found = [entry.name for entry in folder.iterdir() if entry.name.endswith(".toml")]
    return tuple(sorted(name.removesuffix(".toml") for name in found))


def is_scene_file(name_or_path: str | Path) -> bool:
    """Whether a name or path refers to a scene instead of a planet.

    Parameters
    ----------
    name_or_path : str or Path
        Name of a preset, or path of a TOML file: that of a scene has ``[[bodies]]``.

    Examples
    --------
    >>> is_scene_file("earth-moon"), is_scene_file("earth")
    (True, False)
    """
    if str(name_or_path) in system_names():
        return True
    path = Path(name_or_path)
    if path.suffix != ".toml" or not path.is_file():
        return False
    return "bodies" in nested_tables(file_text(path), str(path))


def load_system(name_or_path: str | Path, changes: Mapping[str, Any] | None = None) -> System:
    """Load a scene by preset name or path.

    Parameters
    ----------
    name_or_path : str or Path
        One of ``system_names()``, or the path to a TOML file; docs/scenes.md describes its keys.
    changes : mapping, optional
        Overrides, from path to value, see ``changed_system``.

    Returns
    -------
    System

    Raises
    ------
    FileError
        If the file does not exist, cannot be read, or is not TOML.
    ParameterError
        If the name is unknown, or the file is invalid: the error names file, field, value and the
        allowed values.

    Examples
    --------
    >>> [body.name for body in load_system("earth-moon").bodies]
    ['earth', 'moon']
    """
    text, file, folder = system_text(name_or_path)
    return changed_system(nested_tables(text, file), file, folder, changes or {})


def changed_system(
    tables: Mapping[str, Any], file: str, folder: Path | None, changes: Mapping[str, Any]
) -> System:
    """Read a scene from the nested tables of a scene file, with overrides.

    Parameters
    ----------
    tables : mapping
        Tables from ``nested_tables``; not modified. A table ``film`` is ignored.
    file : str
        Name in errors.
    folder : Path or None
        Folder that paths in the tables refer to.
    changes : mapping
        From path to value, as in a file: ``observer.altitude``; ``moon.position``, a key of the
        body of that name; or ``earth.ground.albedo``, a path in its planet file. None removes a
        key.
    """
    bodies = tables.get("bodies", [])
    names = [one.get("name") if isinstance(one, dict) else None for one in bodies]
    own: dict[str, Any] = {}
    of_planets: dict[str, dict[str, Any]] = {}
    for path, value in changes.items():
        first, _, rest = path.partition(".")
        if first not in names:
            own[path] = value
        elif rest.partition("[")[0] in fields_of(Body):
            own[f"bodies[{names.index(first)}].{rest}"] = value
        elif "planet" in bodies[names.index(first)]:
            of_planets.setdefault(first, {})[rest] = value
        else:
            raise ParameterError(FIELD, path, f"a key of the body {first}")
    changed = overridden(tables, own) if own else tables
    try:
        return _read(TomlTable(dict(changed), folder=folder), of_planets)
    except ParameterError as error:
        if error.file is not None:
            raise
        raise error.in_file(file) from None


def system_text(name_or_path: str | Path) -> tuple[str, str, Path | None]:
    """Text of a scene file by preset name or path.

    Parameters
    ----------
    name_or_path : str or Path
        Name or path as for ``load_system``.

    Returns
    -------
    (str, str, Path or None)
        Text in TOML, name for error messages, and folder that its paths refer to, None for a
        preset.
    """
    if isinstance(name_or_path, str) and name_or_path in system_names():
        preset = resources.files("airlight.scene.system") / "presets" / f"{name_or_path}.toml"
        return preset.read_text(encoding="utf-8"), f"{name_or_path}.toml", None
    path = Path(name_or_path)
    if path.suffix != ".toml" and not path.exists():
        names = suggestion(str(name_or_path), system_names())
        raise ParameterError("scene", str(name_or_path), f"{names}; or the path to a TOML file")
    return file_text(path), str(path), path.parent


def _read(file: TomlTable, changes: Mapping[str, Mapping[str, Any]]) -> System:
    values: dict[str, Any] = {"folder": file.folder, "changes": changes}
    file.raw("film")
    values["name"] = file.text("name", "a title, such as 'Earth and Moon'")
    values["description"] = file.text("description", "a sentence", "")
    time = _time(file)
    bodies, lights = [], []
    for one in file.tables("bodies", "one or more [[bodies]] tables"):
        bodies.append(_placed_body(Body.read(one, one.wavelengths()), time, one))
    for one in file.tables("lights", "one or more [[lights]] tables"):
        lights.append(_placed_light(Light.read(one), time, one))
    values["stars"] = file.switch("stars")
    values |= {"bodies": tuple(bodies), "lights": tuple(lights), "time": time}
    values["observer"] = SceneObserver.read(file.table("observer", "a table [observer]"))
    values["view"] = View.read(file.table("camera", "a table [camera]"))
    file.finish()
    return System(**values)


def _time(file: TomlTable) -> datetime | None:
    """Time of the scene, with time zone."""
    if "time" not in file:
        return None
    allowed = "a time with a zone, such as '2017-08-21T18:25Z'"
    given = file.raw("time")
    if not isinstance(given, (str, datetime)):
        raise ParameterError("time", given, allowed)
    try:
        time = given if isinstance(given, datetime) else datetime.fromisoformat(given)
    except ValueError:
        raise ParameterError("time", given, allowed) from None
    if time.tzinfo is None:
        raise ParameterError("time", given, allowed)
    return time


def _placed_body(body: Body, time: datetime | None, table: TomlTable) -> Body:
    """Body with position and rotation by ephemeris."""
    if body.ephemeris is None:
        return body
    place = position_of(body.ephemeris, _needed(time, table))
    return replace(
        body,
        ephemeris=None,
        position=place.position,
        pole=place.pole,
        prime_meridian=place.prime_meridian,
    )


def _placed_light(light: Light, time: datetime | None, table: TomlTable) -> Light:
    """Star with position by ephemeris."""
    if light.ephemeris is None:
        return light
    place = position_of(light.ephemeris, _needed(time, table))
    return replace(light, ephemeris=None, position=place.position)


def _needed(time: datetime | None, table: TomlTable) -> datetime:
    if time is None:
        raise ConflictError(table.name_of("ephemeris"), "requires time")
    return time

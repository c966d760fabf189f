"""Reader of films from film, scene or planet files or preset names."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from airlight.errors import ParameterError
from airlight.image.display_settings import DisplaySettings
from airlight.planets.parameters import MISSING
from airlight.planets.reading.overrides import overridden
from airlight.planets.reading.reader import (
    file_text,
    nested_tables,
    planet_names,
    planet_text,
)
from airlight.planets.schema.toml_table import TomlTable, suggestion
from airlight.scene.display_fields import DISPLAY_FIELDS
from airlight.scene.system.reading import system_names, system_text
from airlight.studies.film.film import Film
from airlight.studies.film.plan import FilmPlan
from airlight.studies.film.view import PlanetView


def load_film(name_or_path: str | Path, changes: Mapping[str, Any] | None = None) -> Film:
    """Load a film.

    Parameters
    ----------
    name_or_path : str or Path
        Path of a film file (docs/films.md describes its keys), of a scene file or of a planet file;
        or the name of a scene or of a planet of the package.
    changes : mapping, optional
        Overrides, from path to value: ``film.frames``, ``view.look_at``, or a path of the scene or
        the planet.

    Raises
    ------
    FileError
        If the file does not exist, cannot be read, or is not TOML.
    ParameterError
        If the name is unknown, or the file is invalid.

    Examples
    --------
    >>> film = load_film("mars", {"film.frames": 48, "view.altitude": "10 m"})
    >>> film.name, film.plan.count, film.view["altitude"]
    ('mars', 48, '10 m')
    """
    name = str(name_or_path)
    if name in system_names() or name in planet_names():
        return _film({"scene" if name in system_names() else "planet": name}, name, None, changes)
    path = Path(name_or_path)
    if path.suffix != ".toml" and not path.exists():
        names = suggestion(name, (*planet_names(), *system_names()))
        raise ParameterError("film", name, f"{names}; or the path to a TOML file")
    tables = nested_tables(file_text(path), str(path))
    if not {"bodies", "planet", "scene", "film", "view", "display"} & set(tables):
        tables = {"planet": str(path.resolve())}
    return _film(tables, str(path), path.parent, changes)


def _film(
    tables: dict[str, Any], file: str, folder: Path | None, changes: Mapping[str, Any] | None
) -> Film:
    try:
        return _read(tables, file, folder, dict(changes or {}))
    except ParameterError as error:
        raise error if error.file is not None else error.in_file(file) from None


def _read(tables: dict[str, Any], file: str, folder: Path | None, changes: dict[str, Any]) -> Film:
    tables = dict(tables)
    stem = Path(file).stem
    plan_table, view, display = tables.pop("film", {}), None, tables.pop("display", {})
    if "bodies" in tables:
        what, text_file, inside = dict(tables), file, folder
        title = str(tables.get("name", stem))
    else:
        table = TomlTable({**tables, "film": plan_table}, folder=folder)
        title = table.text("name", "a title", stem)
        table.text("description", "a sentence", "")
        table.raw("film")
        which = [key for key in ("planet", "scene") if key in table]
        if len(which) != 1:
            given = " and ".join(which) if which else MISSING
            raise ParameterError("planet", given, "one of planet and scene")
        named = table.text(which[0], "a preset, or the path of a file")
        beside = table.beside(named)
        there = beside if beside.suffix == ".toml" and beside.is_file() else named
        text, text_file, inside = (planet_text if which[0] == "planet" else system_text)(there)
        what = nested_tables(text, text_file)
        if which[0] == "planet":
            view = table.raw("view") or {}
        table.finish()
        if which[0] == "scene":
            what.pop("film", None)
            what.pop("display", None)
    own = {"film": plan_table, "display": display} | ({} if view is None else {"view": view})
    mine = {p: value for p, value in changes.items() if p.split(".")[0].split("[")[0] in own}
    own = overridden(own, mine) if mine else own
    rest = {path: value for path, value in changes.items() if path not in mine}
    bodies = [f"{one.get('name')}." for one in what.get("bodies", []) if isinstance(one, dict)]
    of_bodies = {path: v for path, v in rest.items() if path.startswith(tuple(bodies))}
    rest = {path: value for path, value in rest.items() if path not in of_bodies}
    what = overridden(what, rest) if rest else what
    plan = FilmPlan.read(TomlTable(own["film"], "film"))
    if view is not None:
        PlanetView.read(TomlTable(own["view"], "view", folder))
    name, seen = title if "name" in tables else stem, own.get("view")
    return Film(
        name=name,
        plan=plan,
        tables=what,
        file=text_file,
        folder=inside,
        view=seen,
        changes=of_bodies,
        display=_display(own["display"]),
    )


def _display(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Validated table ``[display]``."""
    for name in table:
        if name not in DISPLAY_FIELDS:
            raise ParameterError("display", name, ", ".join(DISPLAY_FIELDS))
    try:
        DisplaySettings(**table)
    except ParameterError as error:
        raise error.named(f"display.{error.field}") from None
    return table

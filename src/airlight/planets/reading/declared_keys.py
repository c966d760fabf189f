"""Declarations of the keys of a planet file's nested tables, and expanded lists."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from airlight.errors import ParameterError
from airlight.planets.planet import Planet
from airlight.planets.reading.nested_tables import Tables, joined, steps_of
from airlight.planets.schema.field import Field, KindOfTable
from airlight.planets.schema.measures import listed
from airlight.planets.schema.toml_table import suggestion


def key_at(tables: Tables, path: str) -> Field:
    """Declaration of the key at a path; items of a list have the list's key."""
    cursor: Any = tables
    kind: KindOfTable | None = Planet
    found = None
    for step in steps_of(path):
        if isinstance(step, str):
            kind = kind if found is None else found.table
            found = declared_key(kind, step, path, cursor if isinstance(cursor, dict) else None)
            cursor = cursor.get(step) if isinstance(cursor, dict) else None
        else:
            cursor = cursor[step] if isinstance(cursor, list) and step < len(cursor) else None
    assert found is not None
    return found


def spelled_out(tables: Tables, folder: Path | None = None) -> Tables:
    """Copy of the tables with comma-separated lists split, and file names made absolute.

    Every number then has its own path.

    Parameters
    ----------
    folder : Path, optional
        Folder of named files.

    Examples
    --------
    >>> spelled_out({"wavelengths": "680, 550, 440 nm"})["wavelengths"]
    ['680 nm', '550 nm', '440 nm']
    """
    return _spelled(tables, Planet, "", folder)  # type: ignore[no-any-return]


def _spelled(value: Any, kind: KindOfTable, path: str, folder: Path | None) -> Any:
    if isinstance(value, list):
        return [_spelled(one, kind, joined(path, i), folder) for i, one in enumerate(value)]
    if not isinstance(value, dict):
        return value
    result = {}
    for name, one in value.items():
        key = declared_key(kind, name, joined(path, name), value)
        if isinstance(one, (dict, list)) and key.table is not None and not is_flat(one):
            one = _spelled(one, key.table, joined(path, name), folder)
        elif isinstance(one, str) and key.kind == "number" and "," in one:
            one = listed(one, key.unit)
        elif isinstance(one, str) and folder is not None and _names_file(key, one):
            one = str((folder / one).resolve())
        result[name] = one
    return result


def _names_file(key: Field, text: str) -> bool:
    """Whether the text of a key is the path of a table or of clouds."""
    return text.endswith(".csv") or (key.name == "file" and key.kind == "text")


def is_flat(value: Any) -> bool:
    """Whether the value is a list without tables."""
    return isinstance(value, list) and not any(isinstance(one, dict) for one in value)


def declared_key(kind: KindOfTable | None, name: str, path: str, table: Tables | None) -> Field:
    """Declaration of a key: from the table's own variant, else from any that has the key."""
    own = () if kind is None else kind.declared(table)
    for key in (*own, *(() if kind is None else kind.declared())):
        if key.name in (name, "*"):
            return key
    where = path.rpartition(".")[0] or "the file"
    allowed = suggestion(name, tuple(key.name for key in own)) or "none"
    raise ParameterError(f"a key of {where}", name, allowed)

"""Overrides of single keys of a planet file: ``dust.particles.optical_depth = 1``.

A path consists of nested keys with dots and of list indices: ``shell.top_radius``,
``ground.albedo[2]``. Constituents and gases are referred to by name, or as ``constituents[0]``;
clouds as ``clouds.cover`` if there is one table, ``clouds.cirrus.cover`` by name or kind, or
``clouds[0]``.
"""

from __future__ import annotations

import copy
import difflib
import functools
import re
import tomllib
from collections.abc import Iterator, Mapping
from functools import reduce
from typing import Any, Final

import numpy as np

from airlight.errors import Collector, ParameterError, ParameterErrors
from airlight.planets.reading.declared_keys import key_at
from airlight.planets.reading.nested_tables import joined
from airlight.planets.reading.shell_edit import BOTTOM, TOP, lifted

#: Field in errors; the command line replaces it by its option.
FIELD: Final = "override"
#: Largest number of overrides at once.
MOST_OVERRIDES: Final = 1000

_Step = str | int
_STEPS: Final = re.compile(r"[^.\[\]]+|\[\d{1,6}\]|\.")
#: Lists whose tables are referred to by name.
_NAMED: Final = ("constituents", "gases")


def overridden(values: Mapping[str, Any], overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a planet file with some keys overridden.

    Missing keys are added to existing tables. ``None`` removes a key. The top of the shell moves
    with the ground, unless overridden.

    Parameters
    ----------
    values : mapping
        Tables from the TOML parser; not modified.
    overrides : mapping
        Map from path to value, in order: values as in a file, including texts with a unit.

    Raises
    ------
    ParameterError
        If paths do not exist; the nearest existing ones are suggested.

    Examples
    --------
    >>> file = {"shell": {"top_radius": "6460 km"}, "constituents": [{"name": "dust", "at": 1}]}
    >>> overridden(file, {"shell.top_radius": "6500 km", "dust.at": "550 nm"})
    {'shell': {'top_radius': '6500 km'}, 'constituents': [{'name': 'dust', 'at': '550 nm'}]}
    """
    if not isinstance(overrides, Mapping) or len(overrides) > MOST_OVERRIDES:
        allowed = f"a mapping from at most {MOST_OVERRIDES} paths to values"
        raise ParameterError(f"{FIELD}s", overrides, allowed)
    changed = copy.deepcopy(dict(values))
    edited = []
    collector = Collector()
    for path, value in overrides.items():
        with collector:
            edited.append(_change(changed, path, _plain(value)))
    collector.raise_all()
    if BOTTOM in edited and TOP not in edited and "shell" not in edited:
        return lifted(changed, dict(values))
    return changed


def parsed(text: str) -> tuple[str, Any]:
    """Path and value of ``PATH=VALUE``, the value as TOML or as plain text.

    Parameters
    ----------
    text : str
        ``ground.albedo=0.3``; ``shell.top_radius=6500 km``, without quotes; ``air.scattering=["5e-6
        /m", "1e-5 /m"]``. ``PATH=`` removes the key.

    Returns
    -------
    value : object
        Value; None if empty.

    Examples
    --------
    >>> parsed("ground.albedo = 0.3"), parsed("air.gas.pressure=2 bar")
    (('ground.albedo', 0.3), ('air.gas.pressure', '2 bar'))
    """
    path, sign, value = text.partition("=")
    if not sign or not path.strip():
        raise ParameterError(FIELD, text, "PATH=VALUE, such as ground.albedo=0.3")
    return path.strip(), _value(value.strip())


def indexed_path(values: Mapping[str, Any], path: str) -> str:
    """Path of an override, with the constituent's index instead of its name.

    Examples
    --------
    >>> indexed_path({"constituents": [{"name": "dust", "amount": 1}]}, "dust.amount")
    'constituents[0].amount'
    """
    found = ""
    for step in _steps(values, path):
        found = joined(found, step)
    return found


def with_hint(
    error: ParameterError, values: Mapping[str, Any], overrides: Mapping[str, Any]
) -> ParameterError:
    """Reader's error with a suggestion for a misspelt path.

    Declared keys that are absent get no suggestion.

    Parameters
    ----------
    error : ParameterError
        Error of the reader for the overridden file.
    values : mapping
        Tables without overrides.
    overrides : mapping
        Map from path to value.
    """
    said = "did you mean" in error.allowed or isinstance(error, ParameterErrors)
    if error.field.startswith(FIELD) or error.field in overrides or said:
        return error
    if error.field == "refraction" and BOTTOM in overrides:  # refraction with another radius
        reason = error.allowed.partition(": ")[2]
        allowed = f"a smaller radius, or straight light (refraction=none): {reason}"
        return ParameterError(BOTTOM, overrides[BOTTOM], allowed, error.file)
    known = _paths(values)
    for path in overrides:
        if path in known or _is_declared(values, path):
            continue
        near = _nearest(path, known, least=0.75)
        if near:
            allowed = f"{error.allowed} (for {path!r} did you mean {near!r}?)"
            return ParameterError(error.field, error.value, allowed, error.file)
    return error


def _is_declared(values: Mapping[str, Any], path: str) -> bool:
    """Whether planet files may have a key at a path."""
    try:
        key_at(dict(values), functools.reduce(joined, _steps(values, path), ""))
    except ParameterError:
        return False
    return True


def _value(text: str) -> Any:
    if not text:
        return None
    try:
        made = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    return made["value"] if set(made) == {"value"} else text


def _plain(value: Any) -> Any:
    """Value as a TOML parser returns it: numbers and lists of Python, tables as dicts.

    Quantities are unchanged, as only the reader knows the unit.
    """
    if type(value) is np.ndarray or isinstance(value, np.generic):
        return value.tolist()
    if getattr(value, "ndim", 0) == 1:
        return list(value)
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value


def _change(root: dict[str, Any], path: Any, value: Any) -> str:
    """Change one key in place; returns its path with indices, ``constituents[0].profile``."""
    steps = _steps(root, path)
    place: Any = root
    for step in steps[:-1]:
        place = _inside(root, place, step, path)
    last = steps[-1]
    if isinstance(last, int):
        _inside(root, place, last, path)
        if value is None:
            raise ParameterError(FIELD, path, "a value: items of a list cannot be removed")
        place[last] = value
    elif not isinstance(place, dict):
        raise _nowhere(root, path)
    elif value is not None:
        place[last] = value
    elif place.pop(last, None) is None:
        raise _nowhere(root, path)
    return reduce(joined, steps, "")


def _inside(root: dict[str, Any], place: Any, step: _Step, path: str) -> Any:
    """Table, list or value that a step leads to."""
    if isinstance(step, int):
        if not isinstance(place, list) or step >= len(place):
            raise _nowhere(root, path)
        return place[step]
    if not isinstance(place, dict) or step not in place:
        raise _nowhere(root, path)
    return place[step]


def _steps(root: Mapping[str, Any], path: Any) -> list[_Step]:
    """Keys and indices of a path, with a constituent's name replaced by its index."""
    if not isinstance(path, str) or not path.strip():
        raise ParameterError(FIELD, path, "a path such as ground.albedo")
    first = re.split(r"[.\[]", path, maxsplit=1)[0]
    if first == "clouds" and path.startswith("clouds."):
        return _cloud_steps(root, path)
    if first in root:
        return _split(root, path)
    for (key, index), name in sorted(_names(root).items(), key=lambda found: -len(found[1])):
        if path == name or path.startswith((f"{name}.", f"{name}[")):
            rest = path[len(name) :].removeprefix(".")
            return [key, index, *(_split(root, rest) if rest else [])]
    if re.fullmatch(r"\w+", path):  # a key of the file, which its reader may know
        return [path]
    raise _nowhere(root, path)


def _cloud_steps(root: Mapping[str, Any], path: str) -> list[_Step]:
    """Keys and indices of a path into clouds, by name or, of a single table, without."""
    rest, titles = path.removeprefix("clouds."), _cloud_titles(root)
    for index, title in sorted(enumerate(titles), key=lambda found: -len(found[1])):
        if rest == title or rest.startswith((f"{title}.", f"{title}[")):
            inner = rest[len(title) :].removeprefix(".")
            return ["clouds", index, *(_split(root, inner) if inner else [])]
    if not titles:
        raise _nowhere(root, path)
    if len(titles) > 1:
        allowed = " or ".join(f"clouds.{title}.{rest}" for title in titles)
        raise ParameterError(FIELD, path, allowed)
    return ["clouds", 0, *_split(root, rest)]


def _cloud_titles(root: Mapping[str, Any]) -> list[str]:
    """Names or kinds of the clouds."""
    listed = root.get("clouds")
    tables = listed if isinstance(listed, list) else []
    return [
        str(next((one[key] for key in ("name", "kind") if key in one), "file"))
        for one in tables
        if isinstance(one, dict)
    ]


def _split(root: Mapping[str, Any], path: str) -> list[_Step]:
    parts = _STEPS.findall(path)
    if "".join(parts) != path or path.startswith((".", "[")) or path.endswith(".") or ".." in path:
        raise _nowhere(root, path)
    return [int(part[1:-1]) if part[0] == "[" else part for part in parts if part != "."]


def _names(root: Mapping[str, Any]) -> dict[tuple[str, int], str]:
    """Names of constituents and gases, by list and index, where they have one."""
    return {
        (key, index): one["name"]
        for key in _NAMED
        for index, one in enumerate(root[key] if isinstance(root.get(key), list) else [])
        if isinstance(one, dict) and isinstance(one.get("name"), str) and one["name"]
    }


def _nowhere(root: Mapping[str, Any], path: str) -> ParameterError:
    known = _paths(root)
    near = _nearest(path, known)
    own = [name for (key, _), name in _names(root).items() if key == _NAMED[0]]
    tables = [key for key in root if key not in _NAMED] + own
    allowed = f"a path into {', '.join(tables)}" + (f" (did you mean {near!r}?)" if near else "")
    return ParameterError(FIELD, path, allowed)


def _nearest(path: str, known: list[str], least: float = 0.5) -> str | None:
    """Path most similar to this path, or with the same last key; None if there is none."""
    last = path.rpartition(".")[2]
    same = [one for one in known if one.rpartition(".")[2] == last]
    for options, cutoff in ((known, 0.75), (same, 0.0), (known, least)):
        near = difflib.get_close_matches(path[:200], options, n=1, cutoff=cutoff)
        if near:
            return near[0]
    return None


def _paths(root: Mapping[str, Any]) -> list[str]:
    """All paths of a file, constituents by name."""
    names = _names(root)
    found: list[str] = []
    for key, value in root.items():
        found.append(key)
        if key == "clouds":
            titles = _cloud_titles(root)
            for title, one in zip(titles, value if isinstance(value, list) else [], strict=False):
                found += _below("clouds" if len(titles) == 1 else f"clouds.{title}", one)
        elif key not in _NAMED:
            found += _below(key, value)
        else:
            for index, one in enumerate(value if isinstance(value, list) else []):
                found += _below(names.get((key, index), f"{key}[{index}]"), one)
    return found


def _below(path: str, value: Any) -> Iterator[str]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield f"{path}.{key}"
            yield from _below(f"{path}.{key}", item)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _below(f"{path}[{index}]", item)

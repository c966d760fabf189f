"""The one declared list: every parameter of a planet file, for any planet.

Window, notebook and page make their controls from it. The tables of the file are walked, and each
key is known by its declaration in ``planets.reading.tables``; a key that is not declared is an
error, so that the list is complete.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.planets.reading.tables import keys_of
from airlight.planets.schema.key import Key
from airlight.planets.schema.measures import listed, number_in
from airlight.planets.schema.section import suggestion
from airlight.viewer.parameters.nested_tables import Tables, get, joined, steps_of
from airlight.viewer.parameters.parameter import Parameter
from airlight.viewer.parameters.view_parameters import VIEW_GROUPS

#: Groups of a planet that are not constituents.
PLANET_GROUPS: Final = ("planet", "shell", "ground", "star")
#: Tables of the file that are a group of their own.
_GROUPED: Final = ("shell", "ground", "star")


@dataclass(frozen=True)
class _Place:
    """Where the walk is: path, kind of table, group, words before labels, lists of this part."""

    path: str
    kind: str
    group: str
    prefix: str
    axes: Mapping[str, Any]


def parameters_of(tables: Tables) -> tuple[Parameter, ...]:
    """Every parameter of a planet, in the order of its file.

    Parameters
    ----------
    tables : dict
        Of a planet file, as ``spelled_out`` leaves them.

    Returns
    -------
    tuple of Parameter
        Keys that the file leaves out, but whose value is then known, included.

    Raises
    ------
    ParameterError
        If the file has a key that is not declared, or a value is not of its kind.

    Examples
    --------
    >>> from airlight.planets.reading.reader import planet_tables, planet_text
    >>> mars = spelled_out(planet_tables(*planet_text("mars")[:2]))
    >>> [(one.path, one.unit) for one in parameters_of(mars) if one.group == "shell"]
    [('shell.bottom_radius', 'km'), ('shell.top_radius', 'km')]
    """
    return tuple(_table(tables, _Place("", "planet", "planet", "", {})))


def group_of(constituents: list[Tables], index: int) -> str:
    """The group of a constituent: its name, marked if a group of that name exists already."""
    name = str(constituents[index].get("name", index))
    taken = [*PLANET_GROUPS, *VIEW_GROUPS, *(one.get("name") for one in constituents[:index])]
    return f"{name} ({index + 1})" if name in taken else name


def key_at(tables: Tables, path: str) -> Key:
    """The declaration of the key that a path names, items of lists by the list's key.

    Raises
    ------
    ParameterError
        If nothing is declared there.
    """
    place: Any = tables
    kind, found = "planet", None
    for step in steps_of(path):
        if isinstance(step, str):
            kind = kind if found is None else found.table
            found = _declared(kind, step, path, place if isinstance(place, dict) else None)
            place = place.get(step) if isinstance(place, dict) else None
        else:
            place = place[step] if isinstance(place, list) and step < len(place) else None
    assert found is not None
    return found


def value_at(tables: Tables, parameter: Parameter) -> float | str:
    """The value of a parameter of the planet: a number in its unit, or a word."""
    key = key_at(tables, parameter.path)
    value = get(tables, parameter.path)
    if value is None:
        value = _left_out(key)
    if parameter.kind == "number":
        return number_in(value, key.shown_unit, key.unit, parameter.path)
    return str(value)


def spelled_out(tables: Tables, folder: Path | None = None) -> Tables:
    """The tables with lists in one text taken apart, and files named from the root.

    What they say stays the same; every number then has a path of its own.

    Parameters
    ----------
    tables : dict
        Of a planet file.
    folder : Path, optional
        Where files that it names are.

    Examples
    --------
    >>> spelled_out({"wavelengths": "680, 550, 440 nm"})["wavelengths"]
    ['680 nm', '550 nm', '440 nm']
    """
    return _spelled(tables, "planet", "", folder)  # type: ignore[no-any-return]


def _spelled(value: Any, kind: str, path: str, folder: Path | None) -> Any:
    if isinstance(value, list):
        return [_spelled(one, kind, joined(path, i), folder) for i, one in enumerate(value)]
    if not isinstance(value, dict):
        return value
    result = {}
    for name, one in value.items():
        key = _declared(kind, name, joined(path, name), value)
        if isinstance(one, (dict, list)) and key.table and not _flat(one):
            one = _spelled(one, key.table, joined(path, name), folder)
        elif isinstance(one, str) and key.kind == "number" and "," in one:
            one = listed(one, key.unit)
        elif isinstance(one, str) and one.endswith(".csv") and folder is not None:
            one = str((folder / one).resolve())
        result[name] = one
    return result


def _flat(value: Any) -> bool:
    """Whether it is a list without tables."""
    return isinstance(value, list) and not any(isinstance(one, dict) for one in value)


def _declared(kind: str, name: str, path: str, table: Tables | None) -> Key:
    """The declaration of a key of a table: by the table's own kind, else by any that has it."""
    for declared in (keys_of(kind, table), keys_of(kind)) if kind else ():
        for key in declared:
            if key.name in (name, "*"):
                return key
    names = tuple(key.name for key in keys_of(kind, table)) if kind else ()
    where = path.rpartition(".")[0] or "the file"
    raise ParameterError(f"a key of {where}", name, suggestion(name, names) or "none")


def _left_out(key: Key) -> Any:
    """What an editor shows for a key that the file leaves out."""
    return key.stand_in or key.default


# --- the walk ---------------------------------------------------------------------------------


def _table(table: Tables, place: _Place) -> Iterator[Parameter]:
    for name in table:
        _declared(place.kind, name, joined(place.path, name), table)
    declared = keys_of(place.kind, table)
    order = [key.name for key in declared]
    if order == ["*"]:
        for name, value in table.items():
            key = replace(declared[0], label=name)
            yield from _value(key, value, joined(place.path, name), place)
        return
    declared += tuple(key for key in keys_of(place.kind) if key.name not in order)
    axes = {**place.axes, **{key.name: table[key.name] for key in declared if key.name in table}}
    place = replace(place, axes=axes)
    for key in declared:
        value = table.get(key.name)
        if value is None and key.name in order and key.offered(table):
            value = _left_out(key)
        if value is not None:
            yield from _value(key, value, joined(place.path, key.name), place)


def _value(key: Key, value: Any, path: str, place: _Place) -> Iterator[Parameter]:
    if key.kind == "table" and not _holds_tables(value):
        raise ParameterError(path, value, "a table" if key.name != "constituents" else "tables")
    if isinstance(value, dict):
        yield from _table(value, _within(key, path, place, value))
    elif isinstance(value, list) and not _flat(value):
        for index, one in enumerate(value):
            here = joined(path, index)
            if key.name == "constituents":
                group = group_of(value, index)
                yield from _table(one, _Place(here, key.table, group, "", {}))
            else:
                prefix = f"{place.prefix}{key.label} {index + 1}: "
                yield from _table(one, replace(place, path=here, kind=key.table, prefix=prefix))
    elif isinstance(value, list):
        yield from _items(key, value, path, place)
    elif key.kind == "text" or (isinstance(value, str) and value.endswith(".csv")):
        least, most = key.range if key.kind == "text" else (0.0, math.inf)
        yield _parameter(key, path, place, kind="text", least=max(least, 0.0), most=most)
    elif key.kind == "choice" or (isinstance(value, str) and value[:1].isalpha()):
        words = (*key.words(), *([key.stand_in] if key.stand_in else []))
        options = words if value in words else (*words, str(value))
        yield _parameter(key, path, place, kind="choice", options=options)
    else:
        yield _number(key, value, path, place)


def _holds_tables(value: Any) -> bool:
    """Whether it is a table or a list of tables."""
    if isinstance(value, list):
        return bool(value) and all(isinstance(one, dict) for one in value)
    return isinstance(value, dict)


def _within(key: Key, path: str, place: _Place, table: Tables) -> _Place:
    """The place of a table that stands at a key."""
    if key.table in _GROUPED and place.kind == "planet":
        return _Place(path, key.table, key.table, "", {})
    prefix = place.prefix
    if key.prefix and (not prefix or key.table == place.kind):
        prefix = f"{key.prefix}: "
    return replace(place, path=path, kind=key.table, prefix=prefix)


def _items(key: Key, values: list[Any], path: str, place: _Place) -> Iterator[Parameter]:
    axis = place.axes.get(key.per)
    for index, value in enumerate(values):
        here = joined(path, index)
        if isinstance(value, list):  # one row for each wavelength
            row = replace(place, prefix=f"{place.prefix}row {index + 1}: ")
            yield from _items(key, value, here, row)
            continue
        at = f"{index + 1}"
        if isinstance(axis, list) and index < len(axis):
            bare = {"nm": "nm", "km": "m", "deg": "deg"}[key.per_unit]
            at = f"at {number_in(axis[index], key.per_unit, bare, here):g} {key.per_unit}"
        one = _number(replace(key, label=f"{key.label} {at}"), value, here, place)
        yield replace(one, part_of=path)


def _number(key: Key, value: Any, path: str, place: _Place) -> Parameter:
    now = number_in(value, key.shown_unit, key.unit, path)
    ends, (least, most) = key.ends, key.limits
    low, high = min(ends[0], now), max(ends[1], now)
    if place.kind == "shell":
        low, high = _shell_range(key, now, place.axes, path)
    if key.scale == "log" and low <= 0.0:
        low = ends[0]
    return _parameter(
        key,
        path,
        place,
        kind="number",
        unit=key.shown_unit,
        low=low,
        high=high,
        least=least,
        most=most,
        scale=key.scale,
        step=1.02 if key.scale == "log" else 0.005 * (high - low) or 0.01,
    )


def _shell_range(key: Key, now: float, shell: Mapping[str, Any], path: str) -> tuple[float, float]:
    """Slider's ends for a radius: about the planet's own, and the top above the ground. [km]"""
    if key.name == "top_radius" and "bottom_radius" in shell:
        bottom = number_in(shell["bottom_radius"], key.shown_unit, key.unit, path)
        return bottom, bottom + 4.0 * max(now - bottom, 1e-6 * bottom)
    least, most = key.limits
    return max(0.1 * now, least), min(10.0 * now, most)


def _parameter(key: Key, path: str, place: _Place, **more: Any) -> Parameter:
    return Parameter(
        path=path,
        label=f"{place.prefix}{key.label}",
        group=place.group,
        help=key.help,
        mode=key.mode,
        **more,
    )


def finite_range(parameter: Parameter) -> tuple[float, float]:
    """The allowed numbers of a parameter; a limit that it lacks is the slider's. [unit]"""
    least = parameter.least if math.isfinite(parameter.least) else parameter.low
    most = parameter.most if math.isfinite(parameter.most) else parameter.high
    return least, most

"""Declared list of every parameter of a planet file, for any planet.

Window, notebook and page build their controls from it. The tables of the file are traversed, and
each key is looked up in its declaration; an undeclared key is an error, so that the list
is complete.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.planets.clouds import CLOUDS
from airlight.planets.ground import Ground
from airlight.planets.planet import Planet
from airlight.planets.reading.declared_keys import declared_key, is_flat, key_at
from airlight.planets.reading.nested_tables import Tables, get, joined
from airlight.planets.schema.field import Field, KindOfTable
from airlight.planets.schema.measures import number_in
from airlight.planets.shell import Shell
from airlight.planets.star import Star
from airlight.viewer.parameters.amounts import AMOUNTS
from airlight.viewer.parameters.cloud_kinds import (
    CLOUD_GROUP,
    NONE,
    cloud_options,
    further_clouds,
    is_cloud_kind,
)
from airlight.viewer.parameters.parameter import Parameter
from airlight.viewer.parameters.view_parameters import VIEW_GROUPS

#: Groups of a planet other than constituents.
PLANET_GROUPS: Final = (AMOUNTS, "planet", "shell", "ground", "star", CLOUD_GROUP)
#: Tables of the file that form a group.
_GROUPED: Final = (Shell, Ground, Star)


@dataclass(frozen=True)
class _Cursor:
    """State of the traversal: path, kind of table, group, prefix of labels, lists in scope."""

    path: str
    kind: KindOfTable
    group: str
    prefix: str
    axes: Mapping[str, Any]


def parameters_of(tables: Tables) -> tuple[Parameter, ...]:
    """Parameters of a planet, in the order of its file.

    Parameters
    ----------
    tables : dict
        Tables of a planet file, as returned by ``spelled_out``.

    Returns
    -------
    tuple of Parameter
        Parameters of all keys, including omitted ones that have a default.

    Examples
    --------
    >>> from airlight.planets.reading.declared_keys import spelled_out
    >>> from airlight.planets.reading.reader import nested_tables, planet_text
    >>> mars = spelled_out(nested_tables(*planet_text("mars")[:2]))
    >>> [(one.path, one.unit) for one in parameters_of(mars) if one.group == "shell"]
    [('shell.bottom_radius', 'km'), ('shell.top_radius', 'km')]
    """
    listed = _table(tables, _Cursor("", Planet, "planet", "", {}))
    return (*listed, *further_clouds(tables))


def group_of(constituents: list[Tables], index: int) -> str:
    """Group of a constituent: its name, numbered if that name is already taken."""
    name = str(constituents[index].get("name", index))
    taken = [
        AMOUNTS,
        *PLANET_GROUPS,
        *VIEW_GROUPS,
        *(one.get("name") for one in constituents[:index]),
    ]
    return f"{name} ({index + 1})" if name in taken else name


def value_at(tables: Tables, parameter: Parameter) -> float | str:
    """Value of a parameter of the planet: a number [parameter.unit], or a text."""
    key = key_at(tables, parameter.path)
    value = get(tables, parameter.path)
    if value is None and is_cloud_kind(parameter.path):
        return NONE
    if value is None:
        value = _left_out(key)
    if parameter.kind == "number":
        return number_in(value, key.shown_unit, key.unit, parameter.path)
    return str(value)


def _left_out(key: Field) -> Any:
    """Value that an editor shows for a key omitted from the file."""
    return key.placeholder or key.left_out


# --- traversal --------------------------------------------------------------------------------


def _table(table: Tables, cursor: _Cursor) -> Iterator[Parameter]:
    for name in table:
        declared_key(cursor.kind, name, joined(cursor.path, name), table)
    declared = cursor.kind.declared(table)
    order = [key.name for key in declared]
    if order == ["*"]:
        for name, value in table.items():
            key = replace(declared[0], label=name)
            yield from _value(key, value, joined(cursor.path, name), cursor)
        return
    declared += tuple(key for key in cursor.kind.declared() if key.name not in order)
    axes = {**cursor.axes, **{key.name: table[key.name] for key in declared if key.name in table}}
    cursor = replace(cursor, axes=axes)
    for key in declared:
        value = table.get(key.name)
        if value is None and key.name in order and key.offered(table):
            value = _left_out(key)
        if value is not None:
            yield from _value(key, value, joined(cursor.path, key.name), cursor)


def _value(key: Field, value: Any, path: str, cursor: _Cursor) -> Iterator[Parameter]:
    if key.name == "clouds" and key.table is CLOUDS and value == []:  # they were removed
        return
    if key.kind == "table" and not _holds_tables(value):
        raise ParameterError(path, value, "a table" if key.name != "constituents" else "tables")
    if isinstance(value, dict):
        yield from _table(value, _within(key, path, cursor, value))
    elif isinstance(value, list) and not is_flat(value) and key.table is not None:
        for index, one in enumerate(value):
            here = joined(path, index)
            if key.name == "constituents":
                group = group_of(value, index)
                yield from _table(one, _Cursor(here, key.table, group, "", {}))
            elif key.table is CLOUDS:
                prefix = f"{one.get('name', one.get('kind', 'file'))}: " if len(value) > 1 else ""
                for found in _table(one, _Cursor(here, key.table, CLOUD_GROUP, prefix, {})):
                    if is_cloud_kind(found.path):
                        found = replace(found, options=cloud_options({key.name: value}, found.path))
                    yield found
            else:
                prefix = f"{cursor.prefix}{key.label} {index + 1}: "
                yield from _table(one, replace(cursor, path=here, kind=key.table, prefix=prefix))
    elif isinstance(value, list):
        yield from _items(key, value, path, cursor)
    elif key.kind == "text" or (isinstance(value, str) and value.endswith(".csv")):
        least, most = key.range if key.kind == "text" else (0.0, math.inf)
        yield _parameter(key, path, cursor, kind="text", least=max(least, 0.0), most=most)
    elif key.kind == "choice" or (isinstance(value, str) and value[:1].isalpha()):
        words = (*key.choices(), *([key.placeholder] if key.placeholder else []))
        options = words if value in words else (*words, str(value))
        yield _parameter(key, path, cursor, kind="choice", options=options)
    else:
        yield _number(key, value, path, cursor)


def _holds_tables(value: Any) -> bool:
    """Whether the value is a table or a list of tables."""
    if isinstance(value, list):
        return bool(value) and all(isinstance(one, dict) for one in value)
    return isinstance(value, dict)


def _within(key: Field, path: str, cursor: _Cursor, table: Tables) -> _Cursor:
    """Cursor of the table at a key."""
    assert key.table is not None
    if key.table in _GROUPED and cursor.kind is Planet:
        return _Cursor(path, key.table, key.name, "", {})
    prefix = cursor.prefix
    if key.prefix and (not prefix or key.table is cursor.kind):
        prefix = f"{key.prefix}: "
    return replace(cursor, path=path, kind=key.table, prefix=prefix)


def _items(key: Field, values: list[Any], path: str, cursor: _Cursor) -> Iterator[Parameter]:
    axis = cursor.axes.get(key.per)
    for index, value in enumerate(values):
        here = joined(path, index)
        if isinstance(value, list):  # one row per wavelength
            row = replace(cursor, prefix=f"{cursor.prefix}row {index + 1}: ")
            yield from _items(key, value, here, row)
            continue
        at = f"{index + 1}"
        if isinstance(axis, list) and index < len(axis):
            bare = {"nm": "nm", "km": "m", "deg": "deg"}[key.per_unit]
            at = f"at {number_in(axis[index], key.per_unit, bare, here):g} {key.per_unit}"
        one = _number(replace(key, label=f"{key.label} {at}"), value, here, cursor)
        yield replace(one, part_of=path)


def _number(key: Field, value: Any, path: str, cursor: _Cursor) -> Parameter:
    now = number_in(value, key.shown_unit, key.unit, path)
    ends, (least, most) = key.ends, key.limits
    low, high = min(ends[0], now), max(ends[1], now)
    if cursor.kind is Shell:
        low, high = _shell_range(key, now, cursor.axes, path)
    if key.scale == "log" and low <= 0.0:
        low = ends[0]
    return _parameter(
        key,
        path,
        cursor,
        kind="number",
        unit=key.shown_unit,
        low=low,
        high=high,
        least=least,
        most=most,
        scale=key.scale,
        step=1.02 if key.scale == "log" else 0.005 * (high - low) or 0.01,
    )


def _shell_range(
    key: Field, now: float, shell: Mapping[str, Any], path: str
) -> tuple[float, float]:
    """Slider's ends for a radius: around the planet's radius, or from the ground up. [km]"""
    if key.name == "top_radius" and "bottom_radius" in shell:
        bottom = number_in(shell["bottom_radius"], key.shown_unit, key.unit, path)
        return bottom, bottom + 4.0 * max(now - bottom, 1e-6 * bottom)
    least, most = key.limits
    return max(0.1 * now, least), min(10.0 * now, most)


def _parameter(key: Field, path: str, cursor: _Cursor, **more: Any) -> Parameter:
    return Parameter(
        path=path,
        label=f"{cursor.prefix}{key.label}",
        group=cursor.group,
        help=key.help,
        mode=key.mode,
        synonyms=key.synonyms,
        **more,
    )

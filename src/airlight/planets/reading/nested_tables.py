"""Nested tables of a planet file: values by path, copies with a change, differences."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, Final

from airlight.errors import ParameterError

Tables = dict[str, Any]
Step = str | int

_STEPS: Final = re.compile(r"([^.\[\]]+)|\[(\d{1,6})\]|\.")


def steps_of(path: str) -> list[Step]:
    """Keys and indices of a path.

    Examples
    --------
    >>> steps_of("constituents[0].gas.composition.N2")
    ['constituents', 0, 'gas', 'composition', 'N2']
    """
    steps: list[Step] = []
    end = 0
    for match in _STEPS.finditer(path):
        if match.start() != end:
            break
        end = match.end()
        if match[1] is not None:
            steps.append(match[1])
        elif match[2] is not None:
            steps.append(int(match[2]))
    if not steps or end != len(path):
        raise ParameterError("path", path, "a path such as ground.albedo")
    return steps


def joined(path: str, step: Step) -> str:
    """Path of a key or an item within the table or list at a path.

    Examples
    --------
    >>> joined(joined("constituents", 1), "name")
    'constituents[1].name'
    """
    if isinstance(step, int):
        return f"{path}[{step}]"
    return f"{path}.{step}" if path else step


def get(tables: Tables, path: str) -> Any:
    """Value at a path, or None if there is none."""
    node: Any = tables
    for step in steps_of(path):
        if isinstance(node, dict) and isinstance(step, str):
            node = node.get(step)
        elif isinstance(node, list) and isinstance(step, int) and step < len(node):
            node = node[step]
        else:
            return None
    return node


def put(tables: Tables, path: str, value: Any) -> Tables:
    """Copy of the tables with a value at a path, or with the key removed for None.

    Only the tables along the path are copied.

    Parameters
    ----------
    tables : dict
        Tables, not modified.
    path : str
        Path whose tables exist, up to its last key.
    value : object
        Value as in the file, or None.

    Examples
    --------
    >>> put({"shell": {"top_radius": 1.0}}, "shell.top_radius", 2.0)
    {'shell': {'top_radius': 2.0}}
    """
    return _put(tables, steps_of(path), value, path)  # type: ignore[no-any-return]


def _put(node: Any, steps: list[Step], value: Any, path: str) -> Any:
    step, rest = steps[0], steps[1:]
    if isinstance(node, dict) and isinstance(step, str):
        copy: Any = dict(node)
        if not rest and value is None:
            copy.pop(step, None)
            return copy
        if rest and step not in node:
            raise ParameterError("path", path, "a path whose tables exist")
    elif isinstance(node, list) and isinstance(step, int) and step < len(node):
        copy = list(node)
        if not rest and value is None:
            del copy[step]
            return copy
    else:
        raise ParameterError("path", path, "a path whose tables exist")
    copy[step] = _put(node[step], rest, value, path) if rest else value
    return copy


def differences(first: Any, second: Any, path: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Paths at which two trees of tables differ, with both values; None for a missing value.

    Lists of different length differ as a whole.

    Examples
    --------
    >>> list(differences({"a": {"b": 1, "c": 2}}, {"a": {"b": 1, "d": 3}}))
    [('a.c', 2, None), ('a.d', None, 3)]
    """
    if isinstance(first, dict) and isinstance(second, dict):
        for key in (*first, *(key for key in second if key not in first)):
            yield from differences(first.get(key), second.get(key), joined(path, key))
    elif isinstance(first, list) and isinstance(second, list) and len(first) == len(second):
        for index, (one, other) in enumerate(zip(first, second, strict=True)):
            yield from differences(one, other, joined(path, index))
    elif type(first) is not type(second) or first != second:
        yield path, first, second

"""Writer of planet files, the inverse of the reader."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator, Mapping
from typing import Any, Final

from airlight.plain_text import plain
from airlight.planets.reading.nested_tables import Tables

#: Longest line of a list or a table. [character]
_WIDTH: Final = 96
_BARE: Final = re.compile(r"[A-Za-z0-9_-]+")
#: Length above which a table within a constituent gets its own header. [character]
_INLINE: Final = 160
#: Numbers with commas between them and a unit at the end.
_NUMBERS: Final = re.compile(r"[\d.,eE+\- ]+, [\d.eE+-]+ [^,]+")


def planet_file(
    tables: Tables, comments: tuple[str, ...] = (), within: Mapping[str, str] | None = None
) -> str:
    """Text of a planet file with these tables.

    Parameters
    ----------
    tables : dict
        Strings, numbers, booleans, and lists and tables of them.
    comments : tuple of str
        Comment lines at the top.
    within : mapping, optional
        Comment lines above keys and tables by path, where constituents go by name:
        ``air.profile``, ``ground``.

    Returns
    -------
    str
        TOML.

    Examples
    --------
    >>> print(planet_file({"name": "Dust", "shell": {"top_radius": "10 km"},
    ...                    "constituents": [{"name": "air", "gas": {"composition": {"N2": 1.0}}}]}))
    name = "Dust"
    <BLANKLINE>
    [shell]
    top_radius = "10 km"
    <BLANKLINE>
    [[constituents]]
    name = "air"
    gas = { composition = { N2 = 1.0 } }
    <BLANKLINE>
    """
    lines = [f"# {' '.join(plain(comment).split())}".rstrip() for comment in comments]
    lines += [""] if lines else []
    lines += list(_table(tables, "", "", within or {}))
    return "\n".join(lines) + "\n"


def _table(table: Tables, path: str, label: str, notes: Mapping[str, str]) -> Iterator[str]:
    later = []
    for key, value in table.items():
        if _own_header(value, path):
            later.append((key, value))
        else:
            yield from _comment(notes, f"{label}.{key}" if label else key)
            yield f"{_key(key)} = {_value(value, len(_key(key)) + 3)}"
    for key, value in later:
        name = f"{path}.{_key(key)}" if path else _key(key)
        for one in value if isinstance(value, list) else [value]:
            own = f"{label}.{key}" if label else key
            if isinstance(value, list):
                own = str(one.get("name", own))
            yield ""
            yield from _comment(notes, own)
            yield f"[[{name}]]" if isinstance(value, list) else f"[{name}]"
            yield from _table(one, name, own, notes)


def _comment(notes: Mapping[str, str], path: str) -> Iterator[str]:
    if path in notes:
        yield f"# {' '.join(plain(notes[path]).split())}"


def _own_header(value: Any, path: str) -> bool:
    """Whether the value is a table, or a list of tables, that needs its own header."""
    if isinstance(value, list):
        whole = bool(value) and all(isinstance(one, dict) for one in value)
        return whole and (not path or len(_value(value, 0)) > _INLINE)
    return isinstance(value, dict) and (not path or len(_inline(value)) > _INLINE)


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    # JSON's escapes are TOML's, except that TOML also requires DEL to be escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _inline(table: Tables) -> str:
    inside = ", ".join(f"{_key(key)} = {_flat(value)}" for key, value in table.items())
    return f"{{ {inside} }}" if inside else "{}"


def _flat(value: Any) -> str:
    """Value in one line."""
    if isinstance(value, dict):
        return _inline(value)
    if isinstance(value, list):
        return f"[{', '.join(_flat(one) for one in value)}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    return repr(value)


def _value(value: Any, indent: int) -> str:
    """Value, with a long list broken into lines."""
    line = _flat(value)
    if isinstance(value, str) and len(line) > _WIDTH and _NUMBERS.fullmatch(value):
        return f'"""\n{textwrap.indent(textwrap.fill(value, _WIDTH - 4), "    ")}"""'
    if not isinstance(value, list) or indent + len(line) <= _WIDTH:
        return line
    if value and all(isinstance(one, list) for one in value):
        rows = [textwrap.indent(_value(one, _WIDTH), "    ") for one in value]
        return "\n".join(["[", *(f"{row}," for row in rows), "]"])
    lines, row = [], "   "
    for one in value:
        item = f" {_flat(one)},"
        if len(row) + len(item) > _WIDTH and row.strip():
            lines.append(row)
            row = "   "
        row += item
    return "\n".join(["[", *lines, row, "]"])

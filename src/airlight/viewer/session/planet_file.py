"""The tables of a planet as the text of a planet file: the reader's way back."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any, Final

from airlight.viewer.parameters.nested_tables import Tables

#: Longest line of a list or a table. [letter]
_WIDTH: Final = 96
_BARE: Final = re.compile(r"[A-Za-z0-9_-]+")
#: A table within a constituent that is longer than this has a header of its own. [letter]
_INLINE: Final = 160


def planet_file(tables: Tables, comments: tuple[str, ...] = ()) -> str:
    """A planet file, which the reader turns into the same tables again.

    Parameters
    ----------
    tables : dict
        Texts, numbers, truth values, and lists and tables of them.
    comments : tuple of str
        Lines that stand at the top.

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
    lines = [f"# {' '.join(comment.split())}".rstrip() for comment in comments]
    lines += [""] if lines else []
    lines += list(_table(tables, ""))
    return "\n".join(lines) + "\n"


def _table(table: Tables, path: str) -> Iterator[str]:
    later = []
    for key, value in table.items():
        if _own_header(value, path):
            later.append((key, value))
        else:
            yield f"{_key(key)} = {_value(value, len(_key(key)) + 3)}"
    for key, value in later:
        name = f"{path}.{_key(key)}" if path else _key(key)
        for one in value if isinstance(value, list) else [value]:
            yield ""
            yield f"[[{name}]]" if isinstance(value, list) else f"[{name}]"
            yield from _table(one, name)


def _own_header(value: Any, path: str) -> bool:
    """Whether it is a table, or a list of tables, that does not go into one line."""
    if isinstance(value, list):
        whole = bool(value) and all(isinstance(one, dict) for one in value)
        return whole and (not path or len(_value(value, 0)) > _INLINE)
    return isinstance(value, dict) and (not path or len(_inline(value)) > _INLINE)


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    # JSON's escapes are TOML's, but for the delete character, which TOML wants escaped too.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _inline(table: Tables) -> str:
    inside = ", ".join(f"{_key(key)} = {_flat(value)}" for key, value in table.items())
    return f"{{ {inside} }}" if inside else "{}"


def _flat(value: Any) -> str:
    """A value in one line."""
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
    """A value; a long list is broken into lines."""
    line = _flat(value)
    if not isinstance(value, list) or indent + len(line) <= _WIDTH:
        return line
    lines, row = [], "   "
    for one in value:
        item = f" {_flat(one)},"
        if len(row) + len(item) > _WIDTH and row.strip():
            lines.append(row)
            row = "   "
        row += item
    return "\n".join(["[", *lines, row, "]"])

"""Key tables of ``docs/planet-files.md``, from the declarations."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Final

from airlight.planets.reading.tables import TABLES, keys_of
from airlight.planets.schema.field import Field
from airlight.planets.schema.tagged_union import Alternatives, TaggedUnion

_BLOCK: Final = re.compile(r"<!-- keys: (\w+) -->\n.*?<!-- end of keys -->", flags=re.DOTALL)
#: Largest number of words listed in a cell; more are described as tables.
_MOST_WORDS: Final = 6


def filled(page: str, table: Callable[[str], str] | None = None) -> str:
    """Fill every block between ``<!-- keys: kind -->`` and its end on a page.

    Parameters
    ----------
    page : str
        Text in Markdown.
    table : callable, optional
        ``table(kind)``, the contents of a block; ``key_table`` by default.
    """

    def block(match: re.Match[str]) -> str:
        return f"<!-- keys: {match[1]} -->\n{(table or key_table)(match[1])}<!-- end of keys -->"

    return _BLOCK.sub(block, page)


def key_table(kind: str) -> str:
    """Markdown table of the keys of one kind of table.

    Parameters
    ----------
    kind : str
        Name of the kind in ``TABLES``.

    Examples
    --------
    >>> print(key_table("bulk").splitlines()[2])
    | `temperature` | 0.001 to 1e9 K | required | Temperature T in the scale height RT/(Mg). |
    """
    lines: list[str] = []
    table = TABLES[kind]
    keys = keys_of(kind)
    if isinstance(table, TaggedUnion):
        lines += _of_kinds(table)
        keys = tuple(key for key in keys if key.name != "kind")
        lines += [""] if keys else []
    if keys:
        lines.append(rows_of(keys, table.keywords if isinstance(table, Alternatives) else ()))
    return "\n".join(lines) + "\n"


def rows_of(keys: Sequence[Field], which: Sequence[str] = ()) -> str:
    """Markdown table of keys: value, default and meaning.

    Parameters
    ----------
    keys : sequence of Field
        Declarations.
    """
    lines = ["| key | value | left out | meaning |", "|---|---|---|---|"]
    for key in keys:
        left_out = _left_out(key, one_of=key.name in which)
        lines.append(_row(_cell(f"`{key.name}`"), _value(key), left_out, _meaning(key)))
    return "\n".join(lines)


def _of_kinds(kinds: TaggedUnion[Any]) -> Iterator[str]:
    """Rows of a table of kinds: keyword, keys, and summary line of the class."""
    yield "| `kind` | keys | |"
    yield "|---|---|---|"
    for one in kinds.classes:
        names = ", ".join(f"`{key.name}`" for key in one.declared())
        summary = (inspect.getdoc(one) or "").splitlines()[0]
        yield _row(f'`"{one.keyword}"`', names, _cell(summary.replace("``", "`")))


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |".replace("|  |", "| |")


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _value(key: Field) -> str:
    """Allowed values: words, a table, a range in the unit in which it is edited."""
    parts = []
    words = key.choices()
    if key.kind == "text":
        parts.append("text")
    elif key.kind == "table":
        parts.append("a table")
    elif key.kind == "switch":
        parts.append("`true`, `false`")
    elif key.kind == "number":
        parts.append(_range(key))
        if key.spectral:
            parts.append("a list")
        elif key.listed:
            parts[-1] += ", a list"
    if words:
        few = len(words) <= _MOST_WORDS
        parts.append(", ".join(f'`"{word}"`' for word in words) if few else "a word, below")
    if key.table and key.kind != "table":
        parts.append("a table")
    return " or ".join(parts)


def _range(key: Field) -> str:
    unit = "" if key.shown_unit == "1" else f" {key.shown_unit}"
    low, high = key.limits
    if math.isfinite(low) and math.isfinite(high):
        return f"{_number(low)} to {_number(high)}{unit}"
    return f"a number{unit and f' of{unit}'}"


def _number(value: float) -> str:
    """Number with four digits, without the plus and the zeros of an exponent.

    Examples
    --------
    >>> _number(1e6), _number(1e-11), _number(0.5)
    ('1e6', '1e-11', '0.5')
    """
    return re.sub(r"e([+-])0*", lambda sign: "e" + sign[1].strip("+"), f"{value:.4g}")


def _left_out(key: Field, *, one_of: bool) -> str:
    if one_of:
        return "one of these"
    if key.required:
        return "required"
    default = key.default
    if isinstance(default, float):
        unit = "" if key.unit == "1" or default == 0.0 else f" {key.unit}"
        return f"{_number(default)}{unit}"
    return f"{default}" if isinstance(default, str) else ""


def _meaning(key: Field) -> str:
    return _cell(" ".join(part for part in (key.help, key.note) if part))

"""One key of a planet file as the declared list knows it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

Table = Mapping[str, Any]


def _always(table: Table) -> bool:
    return True


def nothing() -> tuple[str, ...]:
    """No words."""
    return ()


@dataclass(frozen=True, kw_only=True)
class Key:
    """What is declared about one key of one kind of table.

    Attributes
    ----------
    name : str
        As the file writes it; ``*`` in a table whose keys are names.
    label, help : str
        A few words; a sentence.
    kind : str
        ``number`` (also lists of numbers, and words among ``words`` instead), ``choice``,
        ``text``, or ``table``.
    unit, bare : str
        That it is edited in; that the file's reader takes for a bare number.
    low, high : float
        The ends of a slider. [unit]
    least, most : float
        What the reader allows. [unit]
    scale : str
        ``linear`` or ``log``, of the slider.
    words : callable
        The words that may stand here, looked up when asked for.
    table : str
        The kind of the table, or of each table of the list, that may stand here; empty if none.
    per : str
        The key whose list says what each item of a list here belongs to.
    per_unit : str
        That those are shown in.
    default : object
        What the reader takes where the key is left out; None if the key is then not shown.
    when : callable
        Whether the default applies to a table.
    mode : str
        ``standard`` or ``advanced``.
    """

    name: str
    label: str
    help: str
    kind: str = "number"
    unit: str = "1"
    bare: str = "1"
    low: float = 0.0
    high: float = 1.0
    least: float = 0.0
    most: float = math.inf
    scale: str = "linear"
    words: Callable[[], tuple[str, ...]] = nothing
    table: str = ""
    per: str = ""
    per_unit: str = "nm"
    default: Any = None
    when: Callable[[Table], bool] = _always
    mode: str = "standard"

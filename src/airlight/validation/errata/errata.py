"""Differences from the source documents, each with its computed effect."""

from __future__ import annotations

import functools

from airlight.errors import ParameterError
from airlight.kernel.threads import Progress
from airlight.validation.errata.atmosphere_plus import bruneton_walk, first_notes, later_notes
from airlight.validation.errata.erratum import SOURCES, Erratum
from airlight.validation.errata.openspace import openspace
from airlight.validation.errata.openspace_table import openspace_table

_TITLE = "# What the source documents print otherwise"
_INTRODUCTION = (
    "What is printed, what airlight does in its place, and what the difference changes: the "
    "quantity as printed → as here. The numbers are computed by the same functions that planets "
    "are made of; this page is written by `airlight errata -o docs/errata.md`."
)


def errata(source: str | None = None, *, progress: Progress | None = None) -> tuple[Erratum, ...]:
    """The table of differences.

    Parameters
    ----------
    source : str, optional
        One of ``AP1``, ``AP2``, ``BT`` and ``OS``; all if left out.
    progress : callable, optional
        See ``airlight.kernel.threads``: the first run of AP2 compiles a solver, half a minute.

    Returns
    -------
    tuple of Erratum
        Rows in the order of the sources.

    Raises
    ------
    ParameterError
        If ``source`` is unknown.

    Examples
    --------
    >>> print(errata("BT")[0].effect)
    from the ground to the top, 60° from the zenith: -591.3 → 195.6 km
    """
    if source is not None and source not in SOURCES:
        raise ParameterError("source", source, ", ".join(SOURCES))
    rows: list[Erratum] = []
    makers = (
        ("AP1", first_notes),
        ("AP2", functools.partial(later_notes, progress)),
        ("BT", bruneton_walk),
        ("OS", openspace),
        ("OS", openspace_table),
    )
    for name, make in makers:
        if source in (None, name):
            rows += make()
    return tuple(rows)


def markdown(rows: tuple[Erratum, ...]) -> str:
    """The table as a page of Markdown.

    Parameters
    ----------
    rows : tuple of Erratum
        Rows from ``errata``.
    """
    lines = [_TITLE, "", _INTRODUCTION, "", "| source | as printed | here | effect |"]
    lines.append("|---|---|---|---|")
    for row in rows:
        cells = (row.source, row.printed, row.here, row.effect)
        lines.append("| " + " | ".join(_escaped(cell) for cell in cells) + " |")
    names = {row.source.split()[0] for row in rows}
    lines += [""]
    lines += [f"* {name}: {title}" for name, title in SOURCES.items() if name in names]
    return "\n".join(lines) + "\n"


def _escaped(text: str) -> str:
    return text.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*")

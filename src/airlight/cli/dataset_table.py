"""Tables of datasets on the standard output stream."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from airlight.cli.console import say

if TYPE_CHECKING:
    from airlight.studies.observables.spectrum_files import DatasetTable

#: Rows that are printed.
_ROWS: Final = 24


def say_table(table: DatasetTable, digits: int = 5) -> None:
    """Print the first rows, with the unit below each name."""
    shown = [
        [one if isinstance(one, str) else f"{one:.{digits}g}" for one in row]
        for row in table.rows[:_ROWS]
    ]
    heads = list(table.units), [f"[{unit}]" for unit in table.units.values()]
    wide = [max(map(len, cells)) for cells in zip(*heads, *shown, strict=True)]
    for cells in (*heads, *shown):
        say("  ".join(f"{cell:>{width}}" for cell, width in zip(cells, wide, strict=True)))
    if len(table.rows) > _ROWS:
        say(f"… {len(table.rows) - _ROWS} rows more: -o FILE.csv has all")

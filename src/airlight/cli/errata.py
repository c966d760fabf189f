"""``airlight errata``: misprints and errors of the source documents, in numbers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from airlight.cli.console import console, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import FileError, ParameterError

if TYPE_CHECKING:
    from airlight.validation.errata.erratum import Erratum

EPILOG = examples(
    "airlight errata",
    "airlight errata --source OS",
    "airlight errata -o docs/errata.md",
)

#: Characters per line where the output is not a terminal.
_WIDTH = 150


def errata(
    source: Annotated[
        str | None,
        typer.Option(
            metavar="AP1|AP2|BT|OS",
            help="Source document: first or later Atmosphere Plus notes, Bruneton walk-through, "
            "OpenSpace paper.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="Output page, .md."),
    ] = None,
) -> None:
    """List misprints of the source documents, and compute their effects.

    Each row: the source, the text as printed, what stands here, and a quantity both ways. The first
    run compiles a solver, which takes half a minute.
    """
    from airlight.exports.atomic_file import atomic_file, check_target
    from airlight.validation.errata.errata import errata as table
    from airlight.validation.errata.errata import markdown

    if output is not None:
        if output.suffix.lower() != ".md":
            raise FileError(output, "the name of a page ends in .md")
        check_target(output)
    try:
        with shown_progress() as report:
            rows = table(source, progress=report)
    except ParameterError as error:
        raise error.named("--source") from None
    if output is None:
        _print(rows)
        return
    with atomic_file(output) as part:
        part.write_text(markdown(rows), encoding="utf-8")
    say(f"{output}  {len(rows)} rows")


def _print(rows: tuple[Erratum, ...]) -> None:
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, expand=False)
    table.add_column("source", style="bold", max_width=18)
    table.add_column("as printed", max_width=36)
    table.add_column("here", max_width=36)
    table.add_column("effect, as printed → here")
    for row in rows:
        cells = (row.source, row.printed, row.here, row.effect)
        table.add_row(*(Text(cell) for cell in cells), end_section=False)
        table.add_row()
    console(_WIDTH).print(table)

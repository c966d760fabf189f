"""Output of the command line: lines, tables, progress, and the examples of a help text.

Every command writes by these functions, and none by ``print``: characters that steer a terminal
stand as escapes, and Rich reads no markup.
"""

from __future__ import annotations

import contextlib
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from airlight.plain_text import plain

if TYPE_CHECKING:
    from rich.console import Console


#: Called with the amount done, the total, and a description of the work.
Report = Callable[[int, int, str], None]


def say(line: object = "", *, flush: bool = False) -> None:
    """Write a line to the standard output stream, and flush it if ``flush``."""
    print(plain(line), flush=flush)


def note(line: object) -> None:
    """Write a line with the program's name to the standard error stream."""
    print(f"airlight: {plain(line)}", file=sys.stderr)


@contextlib.contextmanager
def noted_warnings() -> Iterator[None]:
    """Write airlight's warnings as notes, each once."""
    from airlight.errors import AirlightWarning

    noted: set[str] = set()
    with warnings.catch_warnings():
        warnings.simplefilter("always", AirlightWarning)
        others = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *where: Any, **to: Any) -> None:
            if not issubclass(category, AirlightWarning):
                others(message, category, *where, **to)
            elif str(message) not in noted:
                noted.add(str(message))
                note(message)

        warnings.showwarning = show
        yield


def console(width: int | None = None) -> Console:
    """Console of Rich on the standard output stream, for tables.

    Parameters
    ----------
    width : int, optional
        Width of a line if the output is not a terminal; default: that of Rich.
    """
    from rich.console import Console

    class PlainConsole(Console):
        """Console for plain strings, without markup, emoji names and control characters."""

        def render_str(self, text: str, **options: Any) -> Any:
            return super().render_str(plain(text), **options)

    made = PlainConsole(markup=False, emoji=False)
    if width is None or made.is_terminal:
        return made
    return PlainConsole(markup=False, emoji=False, width=width)


@contextlib.contextmanager
def shown_progress() -> Iterator[Report]:
    """Context with a progress callback that draws a bar on a terminal.

    Yields
    ------
    callable
        Function ``report(done, total, message)``, callable from any thread. Long computations are
        announced in a line.
    """
    from airlight.kernel.cost import announce

    before = announce.set(note)
    try:
        with _bar() as report:
            yield report
    finally:
        announce.reset(before)


@contextlib.contextmanager
def _bar() -> Iterator[Report]:
    if not sys.stderr.isatty():
        yield lambda done, total, message: None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    with Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.completed:.0f}/{task.total:.0f}"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=Console(stderr=True),
        transient=True,
    ) as bar:
        task = bar.add_task("starting", total=1)

        def report(done: int, total: int, message: str) -> None:
            bar.update(task, completed=done, total=max(total, 1), description=plain(message))

        yield report


def examples(*lines: str) -> str:
    r"""Typer epilogue with command lines under the heading "Examples".

    Parameters
    ----------
    *lines : str
        Command lines.

    Returns
    -------
    str
        Paragraph that is not wrapped, because of ``\b``.

    Examples
    --------
    >>> examples("airlight planets")
    '\x08\nExamples:\n  $ airlight planets'
    """
    return "\n".join(["\b", "Examples:", *(f"  $ {line}" for line in lines)])

"""Progress on the standard error stream: announcements, and a bar on a terminal."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator

from airlight.cli.console import note
from airlight.plain_text import plain

#: Called with the amount done, the total, and a description of the work.
Report = Callable[[int, int, str], None]


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

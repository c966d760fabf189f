"""Console output, with control characters and markup of external texts escaped."""

from __future__ import annotations

import contextlib
import sys
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TextIO

from airlight.plain_text import plain

if TYPE_CHECKING:
    from rich.console import Console


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

        def show(
            message: Warning | str, category: type[Warning], filename: str, lineno: int,
            file: TextIO | None = None, line: str | None = None,
        ) -> None:  # fmt: skip
            if not issubclass(category, AirlightWarning):
                others(message, category, filename, lineno, file, line)
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

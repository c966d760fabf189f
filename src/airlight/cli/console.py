"""Output of the command line: control characters and markup of external texts are escaped.

Every command writes by these functions, and none by ``print``: characters that steer a terminal
stand as escapes, and Rich reads no markup.
"""

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
    """Write a line to the standard output stream, and on if ``flush``."""
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
        Characters of a line where the output is no terminal; Rich's own width by default.
    """
    from rich.console import Console

    class PlainConsole(Console):
        """Console to which a string is text: no markup, no emoji by name, no control characters."""

        def render_str(self, text: str, **options: Any) -> Any:
            return super().render_str(plain(text), **options)

    made = PlainConsole(markup=False, emoji=False)
    if width is None or made.is_terminal:
        return made
    return PlainConsole(markup=False, emoji=False, width=width)

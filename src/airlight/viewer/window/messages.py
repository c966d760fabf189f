"""Messages of the window's status line: results and errors."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Final

from airlight.errors import AirlightError

#: Time for which a message is shown. [s]
_SHOWN: Final = 5.0


class Messages:
    """Last message and last error.

    Parameters
    ----------
    draw : callable
        Function that requests another frame.

    Attributes
    ----------
    error : str
        Error of the last edit, in one line; empty if it succeeded.
    """

    def __init__(self, draw: Callable[[], None]) -> None:
        self._draw = draw
        self._said = ("", 0.0)
        self.error = ""

    def attempt(self, edit: Callable[[], object]) -> None:
        """Run an edit; an ``AirlightError`` is shown in one line."""
        try:
            edit()
            self.error = ""
        except AirlightError as error:
            self.error = str(error)
        self._draw()

    def say(self, text: str) -> None:
        """Show a message for a limited time."""
        self._said = (text, perf_counter() + _SHOWN)

    @property
    def text(self) -> str:
        """Last message, or empty once it has expired."""
        text, until = self._said
        return text if perf_counter() < until else ""

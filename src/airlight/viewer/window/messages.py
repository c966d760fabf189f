"""What the window says in its line: what was done, and what could not be."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Final

from airlight.errors import AirlightError

#: A message is shown for so long. [s]
_SHOWN: Final = 5.0


class Messages:
    """The last message and the last error.

    Parameters
    ----------
    draw : callable
        Asks for another frame.

    Attributes
    ----------
    error : str
        Why the last edit could not be; empty if it could.
    """

    def __init__(self, draw: Callable[[], None]) -> None:
        self._draw = draw
        self._said = ("", 0.0)
        self.error = ""

    def attempt(self, edit: Callable[[], object]) -> None:
        """Do something; if it cannot be, say so in one line."""
        try:
            edit()
            self.error = ""
        except AirlightError as error:
            self.error = str(error)
        self._draw()

    def say(self, text: str) -> None:
        """Show a line for a while."""
        self._said = (text, perf_counter() + _SHOWN)

    @property
    def text(self) -> str:
        """The last message, while it is shown."""
        text, until = self._said
        return text if perf_counter() < until else ""

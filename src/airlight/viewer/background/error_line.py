"""One-line error messages for a status line, while the picture stays interactive."""

from __future__ import annotations

import logging
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from airlight.errors import AirlightError
from airlight.plain_text import plain

_LOG: Final = logging.getLogger(__name__)


def one_line(error: Exception) -> str:
    r"""One-line message of an error, with the type unless it is an ``AirlightError``.

    Parameters
    ----------
    error : Exception
        Exception that was raised.

    Examples
    --------
    >>> one_line(AirlightError("the shell is empty"))
    'the shell is empty'
    >>> one_line(ValueError("no\n  such thing"))
    'ValueError: no such thing'
    """
    if isinstance(error, AirlightError):
        return str(error)
    return plain(f"{type(error).__name__}: {' '.join(str(error).split())}")


class Faults:
    """Failed parts of a frame, which are omitted and retried in the next frame.

    Examples
    --------
    >>> faults = Faults()
    >>> with faults.caught("side panel"):
    ...     raise AirlightError("the shell is empty")
    >>> faults.line
    'side panel: the shell is empty'
    >>> faults.forget()
    >>> faults.line
    ''
    """

    def __init__(self) -> None:
        self._lines: dict[str, str] = {}
        self._logged: set[tuple[str, type[Exception], str, int | None]] = set()

    @property
    def line(self) -> str:
        """First failed part of this frame and its error, in one line; empty if none failed."""
        return next(iter(self._lines.values()), "")

    def forget(self) -> None:
        """Clear the failures at the start of a frame."""
        self._lines = {}

    @contextmanager
    def caught(self, part: str) -> Iterator[None]:
        """Catch an exception of a part of the frame; its traceback is logged the first time.

        Parameters
        ----------
        part : str
            Name of the part, as shown to the user.
        """
        try:
            yield
        except Exception as error:
            self._lines[part] = f"{part}: {one_line(error)}"
            # Keyed by source line: the message may contain another number in each frame.
            deepest = traceback.extract_tb(error.__traceback__)[-1]
            place = (part, type(error), deepest.filename, deepest.lineno)
            if place not in self._logged:
                self._logged.add(place)
                _LOG.exception("%s failed; the window goes on without it", part)

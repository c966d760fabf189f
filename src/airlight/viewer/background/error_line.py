"""What went wrong, in one line: for a status line, beside a picture that goes on."""

from __future__ import annotations

import logging
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from airlight.errors import AirlightError

_LOG: Final = logging.getLogger(__name__)


def one_line(error: Exception) -> str:
    r"""An error as one line: the project's own speak for themselves, others with their type.

    Parameters
    ----------
    error : Exception
        Whatever was raised.

    Returns
    -------
    str

    Examples
    --------
    >>> one_line(AirlightError("the shell is empty"))
    'the shell is empty'
    >>> one_line(ValueError("no\n  such thing"))
    'ValueError: no such thing'
    """
    if isinstance(error, AirlightError):
        return str(error)
    return f"{type(error).__name__}: {' '.join(str(error).split())}"


class Faults:
    """Parts of a frame that failed: the frame goes on without them, the next tries them again.

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
        """Which part failed in this frame, and why, in one line; empty if none did."""
        return next(iter(self._lines.values()), "")

    def forget(self) -> None:
        """Begin a frame, in which nothing has failed yet."""
        self._lines = {}

    @contextmanager
    def caught(self, part: str) -> Iterator[None]:
        """Catch what a part of the frame raises; its traceback is logged the first time.

        Parameters
        ----------
        part : str
            What the user calls it.
        """
        try:
            yield
        except Exception as error:
            self._lines[part] = f"{part}: {one_line(error)}"
            # By its place: a message may have another number in it each frame.
            deepest = traceback.extract_tb(error.__traceback__)[-1]
            place = (part, type(error), deepest.filename, deepest.lineno)
            if place not in self._logged:
                self._logged.add(place)
                _LOG.exception("%s failed; the window goes on without it", part)

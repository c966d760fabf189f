"""What was changed, one step after another, for undo and redo."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

#: Edits of one parameter that follow each other so quickly are one step. [s]
TOGETHER: Final = 0.5
#: The most steps that are kept.
MOST_STEPS: Final = 1000


@dataclass
class Step:
    """One change.

    Attributes
    ----------
    part : str
        Of the session's state.
    path : str
        What was changed, for joining edits of one drag.
    before, after : object
        The part as it was and as it became; neither is changed any more.
    time : float
        Of the last edit that joined it. [s]
    open : bool
        Whether a drag still adds to it.
    """

    part: str
    path: str
    before: Any
    after: Any
    time: float
    open: bool = False


class History:
    """Steps done and undone; a new edit forgets what was undone."""

    def __init__(self) -> None:
        self._done: list[Step] = []
        self._undone: list[Step] = []

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to take back."""
        return bool(self._done)

    @property
    def can_redo(self) -> bool:
        """Whether there is a step to do again."""
        return bool(self._undone)

    def joins(self, part: str, path: str, time: float) -> Step | None:
        """The last step, if an edit of this path now belongs to it."""
        if not self._done or self._undone:
            return None
        last = self._done[-1]
        if (last.part, last.path) != (part, path):
            return None
        return last if last.open or time - last.time <= TOGETHER else None

    def add(self, step: Step) -> None:
        """A new step."""
        self._undone.clear()
        self._done.append(step)
        del self._done[:-MOST_STEPS]

    def close(self) -> None:
        """End the last step: the next edit is one of its own."""
        if self._done:
            self._done[-1].open = False
            self._done[-1].time = float("-inf")

    def undo(self) -> Step | None:
        """The step to take back, or None."""
        if not self._done:
            return None
        self._undone.append(self._done.pop())
        return self._undone[-1]

    def redo(self) -> Step | None:
        """The step to do again, or None."""
        if not self._undone:
            return None
        step = self._undone.pop()
        step.time = float("-inf")
        self._done.append(step)
        return step

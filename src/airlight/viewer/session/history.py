"""What was changed, one step after another, for undo and redo.

The page keeps its steps by the same rules, in ``web/state/history.js``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final

#: Edits of one thing that follow each other so quickly are one step. [s]
TOGETHER: Final = 0.5
#: The most steps that are kept.
MOST_STEPS: Final = 1000


@dataclass(frozen=True, kw_only=True)
class Change:
    """Part of what is edited: never changed itself.

    Attributes
    ----------
    planet : object
        The whole planet, or None where it is left as it is.
    view : mapping
        Values of the view by path; other paths are left as they are.
    """

    planet: Any = None
    view: Mapping[str, Any] = field(default_factory=dict)

    def over(self, earlier: Change) -> Change:
        """One change of an earlier one and this."""
        planet = earlier.planet if self.planet is None else self.planet
        return Change(planet=planet, view={**earlier.view, **self.view})


@dataclass
class Step:
    """One step.

    Attributes
    ----------
    name : str
        What was changed: the path of a parameter, or the name of a gesture.
    before, after : Change
        What it changed, as it was and as it became.
    time : float
        Of the last edit that joined it. [s]
    open : bool
        Whether a drag still adds to it.
    """

    name: str
    before: Change
    after: Change
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

    def joined(self, name: str, time: float) -> Step | None:
        """The last step, if an edit of this name now belongs to it."""
        if not self._done or self._undone:
            return None
        last = self._done[-1]
        if last.name != name:
            return None
        return last if last.open or time - last.time <= TOGETHER else None

    def record(self, step: Step) -> None:
        """A new edit: a step of its own, or part of the last one."""
        last = self.joined(step.name, step.time)
        if last is not None:
            last.before = last.before.over(step.before)
            last.after = step.after.over(last.after)
            last.time, last.open = step.time, last.open or step.open
            return
        self._undone.clear()
        self._done.append(replace(step))
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
        step.open, step.time = False, float("-inf")
        self._done.append(step)
        return step

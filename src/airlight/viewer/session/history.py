"""Undo history of edits.

The page follows the same rules, in ``web/state/history.js``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final

#: Longest time between edits of one name that are merged into one step. [s]
TOGETHER: Final = 0.5
#: Largest number of steps kept.
MOST_STEPS: Final = 1000


@dataclass(frozen=True, kw_only=True)
class Change:
    """Immutable change of the planet, the view, or both.

    Attributes
    ----------
    planet : object
        New state of the whole planet, or None if unchanged.
    view : mapping
        New values of the view by path; other paths are unchanged.
    """

    planet: Any = None
    view: Mapping[str, Any] = field(default_factory=dict)

    def over(self, earlier: Change) -> Change:
        """Merge an earlier change with this one, which takes precedence."""
        planet = earlier.planet if self.planet is None else self.planet
        return Change(planet=planet, view={**earlier.view, **self.view})


@dataclass
class Step:
    """One undo step.

    Attributes
    ----------
    name : str
        Path of the changed parameter, or name of a gesture.
    before, after : Change
        Changed values before and after the step.
    time : float
        Time of the last edit merged into it. [s]
    open : bool
        Whether a drag is still merged into it.
    """

    name: str
    before: Change
    after: Change
    time: float
    open: bool = False


class History:
    """Steps done and undone; a new edit discards the undone ones."""

    def __init__(self) -> None:
        self._done: list[Step] = []
        self._undone: list[Step] = []

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to undo."""
        return bool(self._done)

    @property
    def can_redo(self) -> bool:
        """Whether there is a step to redo."""
        return bool(self._undone)

    def joined(self, name: str, time: float) -> Step | None:
        """Last step, if an edit of this name at this time is merged into it; else None."""
        if not self._done or self._undone:
            return None
        last = self._done[-1]
        if last.name != name:
            return None
        return last if last.open or time - last.time <= TOGETHER else None

    def record(self, step: Step) -> None:
        """Add an edit, as a new step or merged into the last one."""
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
        """Close the last step, so that the next edit is a new one."""
        if self._done:
            self._done[-1].open = False
            self._done[-1].time = float("-inf")

    def undo(self) -> Step | None:
        """Step to undo, moved to the undone ones; None if there is none."""
        if not self._done:
            return None
        self._undone.append(self._done.pop())
        return self._undone[-1]

    def redo(self) -> Step | None:
        """Step to redo, moved to the done ones; None if there is none."""
        if not self._undone:
            return None
        step = self._undone.pop()
        step.open, step.time = False, float("-inf")
        self._done.append(step)
        return step

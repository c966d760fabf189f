"""Editing a planet and its view: values, edits, undo and redo, reset, and who follows."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.scene import Scene
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.view_parameters import (
    DEFAULTS,
    SOLVED,
    VIEW_VALUE,
    scene_of,
    view_parameters,
)
from airlight.viewer.session.history import Change, History
from airlight.viewer.session.planet_state import PlanetState
from airlight.viewer.session.side import Side
from airlight.viewer.session.solve_request import Versions, Wanted

#: Size of the picture until a host says otherwise. [pixel]
DEFAULT_SIZE: Final = (960, 540)


class Editing:
    """A planet and a view that are edited; see ``Session``, which compares and saves them too.

    Parameters
    ----------
    planet : str or Path
        The name of a preset, or a planet file.
    clock : callable
        Seconds that only grow, for joining quick edits into one step.
    """

    def __init__(
        self, planet: str | Path = "earth", *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._clock = clock
        self._side = Side(PlanetState.opened(planet), DEFAULTS, clock)
        self._other: Side | None = None
        self._showing = "A"
        self._versions = Versions(1, 1, 1)
        self._valued: tuple[Versions, Mapping[str, Value]] | None = None
        self._followers: list[Callable[[Versions], None]] = []
        self.size = DEFAULT_SIZE
        self.shares_camera = True

    # --- what there is ------------------------------------------------------------------------

    @property
    def planet(self) -> PlanetState:
        """The planet that is shown."""
        return self._side.planet

    @property
    def planet_name(self) -> str:
        """The planet's name, as its file has it."""
        return str(self.planet.tables.get("name", ""))

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The declared list for the planet that is shown, and for the view."""
        return self._side.parameters

    @property
    def values(self) -> dict[str, Value]:
        """Every parameter's value by its path: numbers in the parameter's unit."""
        if self._valued is None or self._valued[0] != self._versions:
            values = {one.path: self._side.value(one) for one in self.parameters}
            self._valued = (self._versions, values)
        return dict(self._valued[1])

    def parameter(self, path: str) -> Parameter:
        """A parameter by its path; constituents by place or by name.

        Raises
        ------
        ParameterError
            If there is none: the nearest is suggested.
        """
        return self._side.parameter(path)

    def value(self, path: str) -> Value:
        """One parameter's value. [parameter.unit]"""
        return self._side.value(self.parameter(path))

    @property
    def versions(self) -> Versions:
        """Counters: a host redoes what grew."""
        return self._versions

    @property
    def scene(self) -> Scene:
        """Observer, sun and camera, for a picture of ``size``."""
        return scene_of(self._side.view, *self.size)

    @property
    def view(self) -> Mapping[str, Value]:
        """Values of camera, sun, display and light by path."""
        return dict(self._side.view)

    @property
    def display(self) -> dict[str, Value]:
        """``automatic``, ``exposure`` [EV] and ``tone_map``."""
        return {name: self._side.view[f"display.{name}"] for name in
                ("automatic", "exposure", "tone_map")}  # fmt: skip

    @property
    def orders(self) -> str:
        """Which light is shown: ``all``, ``single`` or ``multiple``."""
        return str(self._side.view["light.orders"])

    @property
    def switches(self) -> dict[str, bool]:
        """Which constituents are on, by group."""
        return {
            group: index not in self.planet.off for index, group in enumerate(self.planet.groups)
        }

    @property
    def wanted(self) -> Wanted:
        """What has to be solved for what is shown."""
        return self._wanted(self._side)

    @property
    def wanted_other(self) -> Wanted | None:
        """What has to be solved for the other side of the comparison, if there is one."""
        return None if self._other is None else self._wanted(self._other)

    def _wanted(self, side: Side) -> Wanted:
        quality, count = (str(side.view[path]) for path in SOLVED)
        return Wanted(self._versions.planet, side.planet, quality, count)

    # --- who follows --------------------------------------------------------------------------

    def follow(self, follower: Callable[[Versions], None]) -> Callable[[], None]:
        """Call something after every change, from the host's thread; returns how to stop."""
        self._followers.append(follower)
        return lambda: self._followers.remove(follower) if follower in self._followers else None

    def _changed(self, paths: AbstractSet[str]) -> None:
        """Count what changed: paths of the view, and ``planet``."""
        self._grown({"planet" if path == "planet" else VIEW_VALUE[path].part for path in paths})

    def _grown(self, parts: set[str]) -> None:
        if not parts:
            return
        now = self._versions
        self._versions = now._replace(**{part: getattr(now, part) + 1 for part in parts})
        for follower in tuple(self._followers):
            follower(self._versions)

    # --- edits --------------------------------------------------------------------------------

    def set(self, path: str, value: Value) -> None:
        """Give a parameter another value; a step to undo, joined with those of the same drag.

        Parameters
        ----------
        path : str
            Of the parameter.
        value : float, str or bool
            A number in the parameter's unit.

        Raises
        ------
        ParameterError
            If there is no such parameter or the value is outside; nothing is changed then. What
            cannot be together is found by ``solving``.
        """
        parameter = self.parameter(path)
        new = parameter.checked(value)
        if new != self._side.value(parameter):
            self._changed(self._side.assign(parameter, new))

    def begin_drag(self, path: str) -> None:
        """All edits of a parameter until ``end_drag`` are one step."""
        self._side.begin_drag(path)

    @property
    def dragged(self) -> str:
        """The path of the parameter that is being dragged; empty if there is none."""
        return self._side.dragged

    def end_drag(self) -> None:
        """The next edit is a step of its own."""
        self._side.end_drag()

    def undo(self) -> str | None:
        """Take back the last step; what it had changed, or None if there is none."""
        step = self._side.history.undo()
        if step is None:
            return None
        self._changed(self._side.put(step.before))
        return step.name

    def redo(self) -> str | None:
        """Do the step last taken back again; what it changes, or None."""
        step = self._side.history.redo()
        if step is None:
            return None
        self._changed(self._side.put(step.after))
        return step.name

    @property
    def can_undo(self) -> bool:
        """Whether ``undo`` would do something."""
        return self._side.history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether ``redo`` would do something."""
        return self._side.history.can_redo

    def forget_steps(self) -> None:
        """Make what was done so far the beginning: it cannot be undone."""
        self._side.history = History()

    def reset(self, what: str = "") -> None:
        """Back to what the planet came with, and the view started with: one step to undo.

        Parameters
        ----------
        what : str
            The path of a parameter, the name of a group, or nothing for everything.

        Raises
        ------
        ParameterError
            If there is no such parameter or group.
        """
        self._changed(self._side.reset(what))

    def open(self, planet: str | Path) -> None:
        """Another planet, in place of the one that is shown; a step to undo.

        Raises
        ------
        FileError, ParameterError
            If there is none; nothing is changed then.
        """
        opened = PlanetState.opened(planet)
        self._changed(self._side.change("planet", Change(planet=opened)))

    def replace_tables(self, path: str, tables: Mapping[str, Any]) -> None:
        """Other tables for the whole planet, as one step named by a path."""
        planet = self.planet.with_tables(dict(tables))
        self._changed(self._side.change(path, Change(planet=planet)))

    def change_view(self, name: str, view: Mapping[str, Value]) -> None:
        """Give several parameters of the view other values, as one step of this name.

        Raises
        ------
        ParameterError
            If one is none of the view's, or a value is outside; nothing is changed then.
        """
        self._changed(self._side.change(name, Change(view=_checked(view, view_parameters()))))

    def move(self, view: Mapping[str, float], *, gesture: str = "", held: bool = False) -> None:
        """Camera and sun as a flight leaves them.

        Parameters
        ----------
        view : mapping
            Values by path, ``view.…`` only.
        gesture : str
            What moves them, such as ``look``: a step to undo, joined with those of the same
            gesture as edits of one parameter are. Without it there is no step.
        held : bool
            Whether the gesture goes on until ``end_drag``.

        Raises
        ------
        ParameterError
            If one is outside; nothing is changed then.
        """
        of_view = (one for one in view_parameters() if one.path.startswith("view."))
        after = _checked(view, of_view)
        change = Change(view=after)
        if not gesture:
            self._changed(self._side.put(change))
        elif any(value != self._side.view[path] for path, value in after.items()):
            self._changed(self._side.record(gesture, change, held=held))

    def resize(self, width: int, height: int) -> None:
        """Take the picture's size, for ``scene``. [pixel]"""
        if (width, height) != self.size:
            self.size = (max(1, int(width)), max(1, int(height)))
            self._grown({"view"})


def _checked(view: Mapping[str, Value], parameters: Iterable[Parameter]) -> dict[str, Value]:
    """Values by path, as their parameters take them."""
    known = {one.path: one for one in parameters}
    for path in view:
        if path not in known:
            raise ParameterError("path", path, ", ".join(known))
    return {path: known[path].checked(value) for path, value in view.items()}

"""Editing a planet and its view: values, edits, undo and redo, reset, and who follows."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.planets.schema.section import suggestion
from airlight.scene import Scene
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.parameter_list import value_at
from airlight.viewer.parameters.view_parameters import DEFAULTS, scene_of, view_parameters
from airlight.viewer.session.edits import edited, restored
from airlight.viewer.session.history import History, Step
from airlight.viewer.session.planet_state import PlanetState
from airlight.viewer.session.solve_request import SOLVED, Versions, Wanted, version_of

#: Size of the picture until a host says otherwise. [pixel]
DEFAULT_SIZE: Final = (960, 540)


class Side:
    """One of the two states that are compared."""

    def __init__(self, planet: PlanetState, view: dict[str, Value]) -> None:
        self.planet = planet
        self.view = view
        self.history = History()


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
        self._side = Side(PlanetState.opened(planet), dict(DEFAULTS))
        self._other: Side | None = None
        self._showing = "A"
        self._dragged = ""
        self._versions = Versions(1, 1, 1)
        self._listed: tuple[Any, tuple[str, ...], Any, dict[str, Parameter]] | None = None
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
        planet, groups = self.planet.parameters, self.planet.groups
        if self._listed is None or self._listed[0] is not planet or self._listed[1] != groups:
            whole = (*planet, *view_parameters(groups))
            self._listed = (planet, groups, whole, {one.path: one for one in whole})
        return self._listed[2]

    @property
    def values(self) -> dict[str, Value]:
        """Every parameter's value by its path: numbers in the parameter's unit."""
        if self._valued is None or self._valued[0] != self._versions:
            values = {one.path: self._value(one) for one in self.parameters}
            self._valued = (self._versions, values)
        return dict(self._valued[1])

    def parameter(self, path: str) -> Parameter:
        """A parameter by its path; constituents by place or by name.

        Raises
        ------
        ParameterError
            If there is none: the nearest is suggested.
        """
        full = self._full(path)
        whole = self.parameters
        assert self._listed is not None
        if full in self._listed[3]:
            return self._listed[3][full]
        known = tuple(one.path for one in whole)
        near = suggestion(full, known)
        hint = near[near.index(" (did") :] if " (did" in near else ""
        raise ParameterError("path", path, f"a parameter of the list{hint}")

    def value(self, path: str) -> Value:
        """One parameter's value. [parameter.unit]"""
        return self._value(self.parameter(path))

    def _value(self, parameter: Parameter) -> Value:
        path = parameter.path
        if path in self._side.view:
            return self._side.view[path]
        if path.startswith("light.constituents["):
            return int(path[19:-1]) not in self.planet.off
        return value_at(self.planet.tables, parameter)

    def _full(self, path: str) -> str:
        """The path with a constituent's place instead of its name."""
        for index, one in enumerate(self.planet.tables["constituents"]):
            name = str(one.get("name", ""))
            inside = name and path.startswith((f"{name}.", f"{name}["))
            if inside and name not in self.planet.tables:
                return f"constituents[{index}]{path[len(name) :]}"
        return path

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

    def _grown(self, *parts: str) -> None:
        now = self._versions
        self._versions = now._replace(**{part: getattr(now, part) + 1 for part in set(parts)})
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
        if new == self._value(parameter):
            return
        part = "view" if parameter.path in self._side.view else "planet"
        joined = self._side.history.joins(part, parameter.path, self._clock())
        before = joined.before if joined else self._part(part)
        if part == "view":
            after: Any = {**self._side.view, parameter.path: new}
            if joined:
                before = {**self._side.view, parameter.path: joined.before[parameter.path]}
        elif parameter.path.startswith("light."):
            after = self._switched(int(parameter.path[19:-1]), bool(new))
        else:
            # A drag starts from where it began, so that what goes along with it comes back.
            start = before if parameter.kind == "number" else self.planet
            same = parameter.kind == "number"
            after = start.with_tables(edited(start.tables, parameter, new), same_keys=same)
        self._record(part, parameter.path, before, after, joined)

    def _switched(self, index: int, on: bool) -> PlanetState:
        off = set(self.planet.off) - {index} if on else {*self.planet.off, index}
        return PlanetState(
            self.planet.source,
            self.planet.base,
            self.planet.tables,
            tuple(sorted(off)),
            self.planet._parameters,
        )

    def _part(self, part: str) -> Any:
        return self.planet if part == "planet" else dict(self._side.view)

    def _record(self, part: str, path: str, before: Any, after: Any, joined: Step | None) -> None:
        now = self._clock()
        if joined is not None:
            joined.before, joined.after, joined.time = before, after, now
        else:
            dragged = path == self._dragged
            self._side.history.add(Step(part, path, before, after, now, open=dragged))
        self._put(part, after)

    def _put(self, part: str, after: Any) -> None:
        if part == "planet":
            self._side.planet = after
            self._grown("planet")
            return
        changed = {path for path, value in after.items() if value != self._side.view[path]}
        self._side.view = dict(after)
        parts = {version_of(path) for path in changed}
        if parts:
            self._grown(*parts)

    def begin_drag(self, path: str) -> None:
        """All edits of a parameter until ``end_drag`` are one step."""
        self.end_drag()
        self._dragged = self.parameter(path).path

    def end_drag(self) -> None:
        """The next edit is a step of its own."""
        self._dragged = ""
        self._side.history.close()

    def undo(self) -> str | None:
        """Take back the last step; the path that it had changed, or None if there is none."""
        step = self._side.history.undo()
        if step is None:
            return None
        self._put(step.part, step.before)
        return step.path

    def redo(self) -> str | None:
        """Do the step last taken back again; its path, or None."""
        step = self._side.history.redo()
        if step is None:
            return None
        self._put(step.part, step.after)
        return step.path

    @property
    def can_undo(self) -> bool:
        """Whether ``undo`` would do something."""
        return self._side.history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether ``redo`` would do something."""
        return self._side.history.can_redo

    def reset(self, what: str = "") -> None:
        """Back to what the planet came with, and the view started with.

        Parameters
        ----------
        what : str
            The path of a parameter, the name of a group, or nothing for everything: then it is
            two steps, planet and view.

        Raises
        ------
        ParameterError
            If there is no such parameter or group.
        """
        groups = {one.group for one in self.parameters}
        if not what or what in groups:
            self._reset_group(what)
            return
        parameter = self.parameter(what)
        if parameter.path in self._side.view:
            after: Any = {**self._side.view, parameter.path: DEFAULTS[parameter.path]}
            self._change("view", parameter.path, after)
        elif parameter.path.startswith("light."):
            self._change("planet", parameter.path, self._switched(int(parameter.path[19:-1]), True))
        else:
            tables = restored(self.planet.tables, self.planet.base, parameter.path)
            self._change("planet", parameter.path, self.planet.with_tables(tables))

    def _reset_group(self, group: str) -> None:
        paths = {one.path for one in self.parameters if not group or one.group == group}
        view = {p: DEFAULTS[p] if p in paths else v for p, v in self._side.view.items()}
        state = self.planet
        if not group or any(path.startswith("light.constituents[") for path in paths):
            state = PlanetState(state.source, state.base, state.tables, (), state._parameters)
        if not group:
            state = state.with_tables(state.base)
        else:
            tables = state.tables
            for path in sorted(paths - set(view)):
                if not path.startswith("light."):
                    tables = restored(tables, state.base, path.split(".")[0].split("[")[0]
                                      if not path.startswith("constituents[")
                                      else path[: path.index("]") + 1])  # fmt: skip
            if tables is not state.tables:
                state = state.with_tables(tables)
        self._change("planet", group, state)
        self._change("view", group, view)

    def _change(self, part: str, path: str, after: Any) -> None:
        before = self._part(part)
        if after == before:
            return
        self.end_drag()
        self._record(part, path, before, after, None)
        self.end_drag()

    def open(self, planet: str | Path) -> None:
        """Another planet, in place of the one that is shown; a step to undo.

        Raises
        ------
        FileError, ParameterError
            If there is none; nothing is changed then.
        """
        self._change("planet", "planet", PlanetState.opened(planet))

    def replace_tables(self, path: str, tables: Mapping[str, Any]) -> None:
        """Other tables for the whole planet, as one step named by a path."""
        self._change("planet", path, self.planet.with_tables(dict(tables)))

    def move(self, view: Mapping[str, float]) -> None:
        """Camera and sun as a flight leaves them: no step to undo.

        Parameters
        ----------
        view : mapping
            Values by path, ``view.…`` only.

        Raises
        ------
        ParameterError
            If one is outside; nothing is changed then.
        """
        known = {one.path: one for one in view_parameters() if one.path.startswith("view.")}
        after = dict(self._side.view)
        for path, value in view.items():
            if path not in known:
                raise ParameterError("path", path, ", ".join(known))
            after[path] = known[path].checked(value)
        self._put("view", after)

    def resize(self, width: int, height: int) -> None:
        """The picture's size, for ``scene``. [pixel]"""
        if (width, height) != self.size:
            self.size = (max(1, int(width)), max(1, int(height)))
            self._grown("view")

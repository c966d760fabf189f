"""The session: a planet, a view and a display that are edited, undone, compared and saved.

It belongs to one thread, that of its host, and never waits: what an edit makes of the planet is
found out by ``solving``, on a thread of its own.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple

from airlight.errors import ParameterError
from airlight.exports.whole_file import whole_file
from airlight.planets.toml_section import suggestion
from airlight.scene import Scene
from airlight.viewer import saved_state
from airlight.viewer.comparing import Difference, differing
from airlight.viewer.edits import edited, restored
from airlight.viewer.history import History, Step
from airlight.viewer.parameter import Parameter, Value
from airlight.viewer.parameter_list import value_at
from airlight.viewer.planet_file import planet_file
from airlight.viewer.planet_state import PlanetState
from airlight.viewer.view_parameters import DEFAULTS, scene_of, switch_path, view_parameters

#: Size of the picture until a host says otherwise. [pixel]
DEFAULT_SIZE: Final = (960, 540)
#: Parameters of the view that need a new solution, beside the constituents' switches.
SOLVED: Final = ("light.quality", "light.wavelengths")


class Versions(NamedTuple):
    """Counters that grow with every change of their part.

    Attributes
    ----------
    planet : int
        What is solved: planet, switches, wavelengths, quality.
    view : int
        What is rendered: camera, sun, orders, size.
    display : int
        What is shown of it: exposure, tone map.
    """

    planet: int = 0
    view: int = 0
    display: int = 0


class Wanted(NamedTuple):
    """What has to be solved; see ``solving``.

    Attributes
    ----------
    version : int
        Of the planet.
    state : PlanetState
    quality : str
        That follows the preview.
    wavelengths : str
        How many, in a word: one of ``view_parameters.WAVELENGTHS``.
    """

    version: int
    state: PlanetState
    quality: str
    wavelengths: str

    @property
    def key(self) -> tuple[str, str]:
        """Equal where the same has to be solved, the quality apart."""
        return self.state.key, self.wavelengths


class _Side:
    """One of the two states that are compared."""

    def __init__(self, planet: PlanetState, view: dict[str, Value]) -> None:
        self.planet = planet
        self.view = view
        self.history = History()


class Session:
    """What window, notebook and page edit.

    Parameters
    ----------
    planet : str or Path
        The name of a preset, or a planet file.
    clock : callable
        Seconds that only grow, for joining quick edits into one step.

    Attributes
    ----------
    size : (int, int)
        Of the picture; set by ``resize``. [pixel]
    shares_camera : bool
        Whether both sides of a comparison are seen by the same camera, under the same sun.

    Examples
    --------
    >>> session = Session("mars")
    >>> session.set("dust.particles.optical_depth", 2.0)
    >>> session.values["constituents[1].particles.optical_depth"], session.versions.planet
    (2.0, 2)
    >>> session.undo()
    'constituents[1].particles.optical_depth'
    >>> session.value("dust.particles.optical_depth")
    0.5
    """

    def __init__(
        self, planet: str | Path = "earth", *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._clock = clock
        self._side = _Side(PlanetState.opened(planet), dict(DEFAULTS))
        self._other: _Side | None = None
        self._showing = "A"
        self._versions = Versions(1, 1, 1)
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
        return (*self.planet.parameters, *view_parameters(self.planet.groups))

    @property
    def values(self) -> dict[str, Value]:
        """Every parameter's value by its path: numbers in the parameter's unit."""
        return {one.path: self._value(one) for one in self.parameters}

    def parameter(self, path: str) -> Parameter:
        """A parameter by its path; constituents by place or by name.

        Raises
        ------
        ParameterError
            If there is none: the nearest is suggested.
        """
        full = self._full(path)
        for one in self.parameters:
            if one.path == full:
                return one
        known = tuple(one.path for one in self.parameters)
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

    def _wanted(self, side: _Side) -> Wanted:
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
            self._side.history.add(Step(part, path, before, after, now))
        self._put(part, after)

    def _put(self, part: str, after: Any) -> None:
        if part == "planet":
            self._side.planet = after
            self._grown("planet")
            return
        changed = {path for path, value in after.items() if value != self._side.view[path]}
        self._side.view = dict(after)
        parts = {_version_of(path) for path in changed}
        if parts:
            self._grown(*parts)

    def begin_drag(self, path: str) -> None:
        """All edits of a parameter until ``end_drag`` are one step."""
        self.end_drag()
        parameter = self.parameter(path)
        part = "view" if parameter.path in self._side.view else "planet"
        now = self._part(part)
        self._side.history.add(Step(part, parameter.path, now, now, self._clock(), open=True))

    def end_drag(self) -> None:
        """The next edit is a step of its own."""
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

    # --- two sides ----------------------------------------------------------------------------

    @property
    def showing(self) -> str:
        """``A`` or ``B``."""
        return self._showing

    @property
    def has_other(self) -> bool:
        """Whether there are two sides."""
        return self._other is not None

    def store_b(self) -> None:
        """Keep what is shown as the other side; edits from now on are of this one alone."""
        self._other = _Side(self._side.planet, dict(self._side.view))

    def swap(self) -> None:
        """Show the other side; the first time it is a copy of this one."""
        if self._other is None:
            self.store_b()
        assert self._other is not None
        self.end_drag()
        view = dict(self._other.view)
        if self.shares_camera:
            view |= {p: v for p, v in self._side.view.items() if p.startswith("view.")}
            self._other.view = view
        self._side, self._other = self._other, self._side
        self._showing = "B" if self._showing == "A" else "A"
        self._grown("planet", "view", "display")

    def forget_other(self) -> None:
        """One side again: the one that is shown, as A."""
        self._other = None
        self._showing = "A"

    def differences(self) -> tuple[Difference, ...]:
        """What differs from A to B, in the words of the list; empty without another side."""
        if self._other is None:
            return ()
        first, second = (self._side, self._other) if self._showing == "A" else (
            self._other, self._side)  # fmt: skip
        return tuple(_side_differences(first, second, self.shares_camera))

    # --- saving -------------------------------------------------------------------------------

    def save_planet(self, path: str | Path) -> None:
        """Write the planet as a planet file, whole or not at all.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        state = self.planet
        comments = [f"Made with airlight from {Path(state.source).name}."]
        changes = state.changes
        if changes:
            comments.append(f"Changed: {', '.join(change[0] for change in changes[:40])}.")
        with whole_file(path) as place:
            place.write_text(planet_file(state.tables, tuple(comments)), encoding="utf-8")

    def to_state(self) -> dict[str, Any]:
        """What is shown as JSON takes it: the planet's name, and what differs from it."""
        return saved_state.state_of(self.planet, self._side.view)

    def from_state(self, state: Mapping[str, Any]) -> None:
        """Show what ``to_state`` had kept.

        Raises
        ------
        ParameterError, FileError
            If it cannot be; nothing is changed then.
        """
        planet, view = saved_state.read_state(state, self.planet)
        self._change("planet", "state", planet)
        self._change("view", "state", view)


def _version_of(path: str) -> str:
    if path in SOLVED:
        return "planet"
    return "display" if path.startswith("display.") else "view"


def _side_differences(first: _Side, second: _Side, shares: bool) -> Iterator[Difference]:
    yield from differing(first.planet, second.planet)
    for one in view_parameters():
        if shares and one.path.startswith("view."):
            continue
        a, b = first.view[one.path], second.view[one.path]
        if a != b:
            yield Difference(path=one.path, label=one.label, unit=one.unit, first=a, second=b)


def switch_paths(session: Session) -> tuple[str, ...]:
    """The paths of the constituents' switches, in the planet's order."""
    return tuple(switch_path(index) for index in range(len(session.planet.groups)))

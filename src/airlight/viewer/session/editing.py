"""Editing of a planet and its view: values, edits, undo and redo, reset, observers."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

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
from airlight.viewer.session.adaptation import Adaptation
from airlight.viewer.session.history import Change, History
from airlight.viewer.session.planet_state import PlanetState, SolveRequest, Versions
from airlight.viewer.session.side import Side

if TYPE_CHECKING:
    from airlight.viewer.session.scene_around import SceneAround

#: Size of the picture until a host sets it. [pixel]
DEFAULT_SIZE: Final = (960, 540)


class Editing:
    """Editable planet and view; ``Session`` adds comparison and saving.

    Parameters
    ----------
    planet : str or Path
        Name of a preset, or path of a planet file.
    clock : callable
        Monotonic clock, used to merge edits in quick succession into one undo step. [s]
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
        self._observers: list[Callable[[Versions], None]] = []
        self.size = DEFAULT_SIZE
        self.shares_camera = True
        self.shares_exposure = True
        self.adaptation = Adaptation()

    # --- state --------------------------------------------------------------------------------

    @property
    def planet(self) -> PlanetState:
        """Current planet."""
        return self._side.planet

    @property
    def around(self) -> SceneAround | None:
        """Scene of several bodies to which the planet belongs; None without one."""
        return self._side.around

    @around.setter
    def around(self, scene: SceneAround | None) -> None:
        self._side.around = scene

    @property
    def planet_name(self) -> str:
        """Name of the planet, from its file."""
        return str(self.planet.tables.get("name", ""))

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Declared parameters of the current planet, and of the view."""
        return self._side.parameters

    @property
    def values(self) -> dict[str, Value]:
        """Values of all parameters by path. [parameter.unit]"""
        if self._valued is None or self._valued[0] != self._versions:
            values = {one.path: self._side.value(one) for one in self.parameters}
            self._valued = (self._versions, values)
        return dict(self._valued[1])

    def parameter(self, path: str) -> Parameter:
        """Parameter by its path, with constituents by index or by name."""
        return self._side.parameter(path)

    def value(self, path: str) -> Value:
        """Value of a parameter. [parameter.unit]"""
        return self._side.value(self.parameter(path))

    @property
    def versions(self) -> Versions:
        """Version counters; a host updates the parts whose counter has increased."""
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
        """Display values by name: ``automatic``, ``exposure`` [EV], ``tone_map``, …"""
        values = self._side.view.items()
        return {path[8:]: value for path, value in values if path.startswith("display.")}

    @property
    def holds_exposure(self) -> bool:
        """Whether the automatic exposure is locked."""
        return bool(self._side.view["display.locked"])

    @property
    def orders(self) -> str:
        """Displayed orders of scattering: ``all``, ``single`` or ``multiple``."""
        return str(self._side.view["light.orders"])

    @property
    def switches(self) -> dict[str, bool]:
        """Whether each constituent is on, by group."""
        return {
            group: index not in self.planet.off for index, group in enumerate(self.planet.groups)
        }

    @property
    def solve_request(self) -> SolveRequest:
        """Solve request of the current side."""
        return self._request(self._side)

    @property
    def solve_request_other(self) -> SolveRequest | None:
        """Solve request of the other side of the comparison; None without one."""
        return None if self._other is None else self._request(self._other)

    def _request(self, side: Side) -> SolveRequest:
        quality, count = (str(side.view[path]) for path in SOLVED)
        return SolveRequest(self._versions.planet, side.planet, quality, count)

    # --- observers ----------------------------------------------------------------------------

    def subscribe(self, observer: Callable[[Versions], None]) -> Callable[[], None]:
        """Call ``observer`` after every change, on the host's thread; returns an unsubscriber."""
        self._observers.append(observer)
        return lambda: self._observers.remove(observer) if observer in self._observers else None

    def _changed(self, paths: AbstractSet[str]) -> None:
        """Increment the versions of the changed parts, from view paths and ``planet``."""
        self._bump_versions(
            {"planet" if path == "planet" else VIEW_VALUE[path].part for path in paths}
        )

    def _bump_versions(self, parts: set[str]) -> None:
        if not parts:
            return
        now = self._versions
        self._versions = now._replace(**{part: getattr(now, part) + 1 for part in parts})
        for observer in tuple(self._observers):
            observer(self._versions)

    # --- edits --------------------------------------------------------------------------------

    def set(self, path: str, value: Value) -> None:
        """Set a parameter; edits of one drag are one undo step.

        Parameters
        ----------
        value : float, str or bool
            New value. [parameter.unit]

        Raises
        ------
        ParameterError
            If there is no such parameter or the value is out of range; nothing is changed then.
            Inconsistent values are reported by ``SolverThread``.
        """
        parameter = self.parameter(path)
        new = parameter.checked(value)
        if new != self._side.value(parameter):
            self._changed(self._side.assign(parameter, new))

    def begin_drag(self, path: str) -> None:
        """Merge all edits of a parameter until ``end_drag`` into one undo step."""
        self._side.begin_drag(path)

    @property
    def dragged(self) -> str:
        """Path of the parameter that is being dragged; empty if there is none."""
        return self._side.dragged

    def end_drag(self) -> None:
        """End the drag, so that the next edit is a separate undo step."""
        self._side.end_drag()

    def undo(self) -> str | None:
        """Undo the last step; returns its name, or None if there is none."""
        step = self._side.history.undo()
        if step is None:
            return None
        self._changed(self._side.put(step.before))
        return step.name

    def redo(self) -> str | None:
        """Redo the last undone step; returns its name, or None if there is none."""
        step = self._side.history.redo()
        if step is None:
            return None
        self._changed(self._side.put(step.after))
        return step.name

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to undo."""
        return self._side.history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether there is a step to redo."""
        return self._side.history.can_redo

    def forget_steps(self) -> None:
        """Clear the history; the view as it is becomes the first, which ``reset`` restores."""
        self._side.history = History()
        self._side.first = dict(self._side.view)

    @property
    def first_view(self) -> Mapping[str, Value]:
        """View values that ``reset`` restores, by path."""
        return self._side.first

    def reset(self, what: str = "") -> None:
        """Restore values of the planet's file and of the first view, as one undo step."""
        self._changed(self._side.reset(what))

    def open(self, planet: str | Path) -> None:
        """Replace the current planet, as an undo step."""
        opened = PlanetState.opened(planet)
        self._changed(self._side.change("planet", Change(planet=opened)))

    def replace_tables(self, path: str, tables: Mapping[str, Any]) -> None:
        """Replace the planet's tables, as one undo step named ``path``."""
        planet = self.planet.with_tables(dict(tables))
        self._changed(self._side.change(path, Change(planet=planet)))

    def change_view(self, name: str, view: Mapping[str, Value]) -> None:
        """Set several parameters of the view, as one undo step of this name."""
        self._changed(self._side.change(name, Change(view=_checked(view, view_parameters()))))

    def move(self, view: Mapping[str, float], *, gesture: str = "", held: bool = False) -> None:
        """Set camera, sun and exposure.

        Parameters
        ----------
        view : mapping
            Values by path: ``view.…``, and the exposure.
        gesture : str
            Name of the undo step, such as ``look``, merged with others of this name; empty for no
            undo step.
        held : bool
            Whether the gesture lasts until ``end_drag``.

        Raises
        ------
        ParameterError
            If a path is unknown or a value is out of range; nothing is changed then.
        """
        of_view = (
            one
            for one in view_parameters()
            if one.path.startswith("view.") or one.path in ("display.automatic", "display.exposure")
        )
        after = _checked(view, of_view)
        change = Change(view=after)
        if not gesture:
            self._changed(self._side.put(self._side.followed(change)))
        elif any(value != self._side.view[path] for path, value in after.items()):
            self._changed(self._side.record(gesture, change, held=held))

    def resize(self, width: int, height: int) -> None:
        """Set the size of the picture for ``scene``. [pixel]"""
        if (width, height) != self.size:
            self.size = (max(1, int(width)), max(1, int(height)))
            self._bump_versions({"view"})


def _checked(view: Mapping[str, Value], parameters: Iterable[Parameter]) -> dict[str, Value]:
    """Validate values by path."""
    known = {one.path: one for one in parameters}
    for path in view:
        if path not in known:
            raise ParameterError("path", path, ", ".join(known))
    return {path: known[path].checked(value) for path, value in view.items()}

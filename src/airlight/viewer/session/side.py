"""One editable side: a planet, a view, and their undo history."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.planets.schema.toml_table import suggestion
from airlight.viewer.parameters.amounts import Amount
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.parameter_list import value_at
from airlight.viewer.parameters.sun_clock import CLOCK, OF_DATE, with_sky
from airlight.viewer.parameters.view_parameters import view_parameters
from airlight.viewer.session.edited_amounts import amount_edited, amount_value, keys_of_amount
from airlight.viewer.session.edits import edited, restored
from airlight.viewer.session.history import Change, History, Step
from airlight.viewer.session.planet_state import PlanetState

if TYPE_CHECKING:
    from airlight.viewer.session.scene_around import SceneAround

#: Prefixes of the paths of a constituent's switch and of its keys.
_SWITCH: Final = "light.constituents["
_CONSTITUENT: Final = "constituents["


def _index(path: str) -> int:
    """Index of a constituent, from the path of its switch.

    Examples
    --------
    >>> _index("light.constituents[2]")
    2
    """
    return int(path[len(_SWITCH) : -1])


class Side:
    """Editable state of a session, one per compared side.

    Parameters
    ----------
    clock : callable
        Monotonic clock, used to merge edits in quick succession into one undo step. [s]

    Notes
    -----
    Editing methods return the paths of the view that have changed, and ``planet`` if it has.
    """

    def __init__(
        self,
        planet: PlanetState,
        view: Mapping[str, Value],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.planet = planet
        self.view = self.first = dict(view)
        self.history = History()
        self._clock = clock
        self.dragged = ""
        self.around: SceneAround | None = None
        self._listed: tuple[Any, tuple[str, ...], Any, dict[str, Parameter]] | None = None

    # --- state --------------------------------------------------------------------------------

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Amounts of the planet, its declared parameters, and those of the view."""
        amounts, planet, groups = self.planet.amounts, self.planet.parameters, self.planet.groups
        if self._listed is None or self._listed[0] is not planet or self._listed[1] != groups:
            dated = self.planet.tables.get("body") in NUMBERED
            view = (one for one in view_parameters(groups) if dated or one.path not in OF_DATE)
            whole = (*amounts, *planet, *view)
            self._listed = (planet, groups, whole, {one.path: one for one in whole})
        return self._listed[2]

    def parameter(self, path: str) -> Parameter:
        """Parameter by its path, with constituents by index or by name."""
        whole = self.parameters
        assert self._listed is not None
        if path in self._listed[3]:
            return self._listed[3][path]
        full = self._full(path)
        if full in self._listed[3]:
            return self._listed[3][full]
        known = tuple(one.path for one in whole)
        near = suggestion(full, known)
        hint = near[near.index(" (did") :] if " (did" in near else ""
        raise ParameterError("path", path, f"a parameter of the list{hint}")

    def _full(self, path: str) -> str:
        """Path with a constituent's index instead of its name."""
        for index, one in enumerate(self.planet.tables["constituents"]):
            name = str(one.get("name", ""))
            inside = name and path.startswith((f"{name}.", f"{name}["))
            if inside and name not in self.planet.tables:
                return f"{_CONSTITUENT}{index}]{path[len(name) :]}"
        return path

    def value(self, parameter: Parameter) -> Value:
        """Value of a parameter. [parameter.unit]"""
        path = parameter.path
        if path in self.view:
            return self.view[path]
        if path.startswith(_SWITCH):
            return _index(path) not in self.planet.off
        if isinstance(parameter, Amount):
            return amount_value(self.planet.tables, parameter)
        return value_at(self.planet.tables, parameter)

    # --- edits --------------------------------------------------------------------------------

    def assign(self, parameter: Parameter, value: Value) -> AbstractSet[str]:
        """Set a parameter to a validated value, merged with others of the same drag."""
        path = parameter.path
        if path in self.view:
            return self.record(path, Change(view={path: value}), held=path == self.dragged)
        if path.startswith(_SWITCH):
            planet = self._switched(_index(path), bool(value))
        else:
            # A drag edits the state at its start, so that dependent values are reversible.
            joined = self.history.joined(path, self._clock())
            is_number = parameter.kind == "number"
            start = joined.before.planet if joined and is_number else self.planet
            edit = amount_edited if isinstance(parameter, Amount) else edited
            tables = edit(start.tables, parameter, value)  # type: ignore[arg-type]
            planet = start.with_tables(tables, same_keys=is_number)
        return self.record(path, Change(planet=planet), held=path == self.dragged)

    def _switched(self, index: int, on: bool) -> PlanetState:
        off = set(self.planet.off) - {index} if on else {*self.planet.off, index}
        return self.planet.with_off(tuple(sorted(off)))

    def record(self, name: str, after: Change, *, held: bool = False) -> AbstractSet[str]:
        """Apply a change as an undo step, or as part of the last one.

        Parameters
        ----------
        name : str
            Name of the step; changes of one name are merged while held or in quick succession.
        held : bool
            Whether the step lasts until ``end_drag``, regardless of time.
        """
        after = self.followed(after)
        before = Change(
            planet=None if after.planet is None else self.planet,
            view={path: self.view[path] for path in after.view},
        )
        self.history.record(Step(name, before, after, self._clock(), open=held))
        return self.put(after)

    def followed(self, after: Change) -> Change:
        """Change completed by sun, Moon and aim from date and place, if the view uses them."""
        planet = self.planet if after.planet is None else after.planet
        body = planet.tables.get("body")
        opened = after.planet is not None and bool(self.view[CLOCK]) and CLOCK not in after.view
        view = {**after.view, CLOCK: True} if opened else after.view
        if self.around is not None:
            view = self.around.aimed(self.view, view)
        return replace(after, view=with_sky(body, self.view, view))

    def change(self, name: str, after: Change) -> AbstractSet[str]:
        """Apply a change as a separate undo step; no step if nothing changes."""
        planet = None if after.planet == self.planet else after.planet
        view = {path: value for path, value in after.view.items() if value != self.view[path]}
        if planet is None and not view:
            return set()
        self.end_drag()
        changed = self.record(name, Change(planet=planet, view=view))
        self.end_drag()
        return changed

    def put(self, after: Change) -> AbstractSet[str]:
        """Apply a change without an undo step."""
        changed = {path for path, value in after.view.items() if value != self.view[path]}
        self.view = {**self.view, **after.view}
        if after.planet is not None:
            self.planet = after.planet
            changed.add("planet")
        return changed

    def begin_drag(self, path: str) -> None:
        """Merge all edits of a parameter until ``end_drag`` into one undo step."""
        self.end_drag()
        self.dragged = self.parameter(path).path

    def end_drag(self) -> None:
        """End the drag, so that the next edit is a separate undo step."""
        self.dragged = ""
        self.history.close()

    # --- reset --------------------------------------------------------------------------------

    def reset(self, what: str) -> AbstractSet[str]:
        """Restore values of the planet's file and of the first view, as one undo step."""
        if not what or what in {one.group for one in self.parameters}:
            return self.change(what, self._group_reset(what))
        parameter = self.parameter(what)
        path = parameter.path
        if path in self.view:
            return self.change(path, Change(view={path: self.first[path]}))
        if path.startswith(_SWITCH):
            return self.change(path, Change(planet=self._switched(_index(path), True)))
        tables = self.planet.tables
        for key in self._keys_of(parameter):
            tables = restored(tables, self.planet.base, key)
        return self.change(path, Change(planet=self.planet.with_tables(tables)))

    def _keys_of(self, parameter: Parameter) -> tuple[str, ...]:
        """Paths of the planet's file that a parameter changes."""
        if isinstance(parameter, Amount):
            return keys_of_amount(self.planet.tables, parameter)
        return (parameter.path,)

    def _group_reset(self, group: str) -> Change:
        members = [one for one in self.parameters if not group or one.group == group]
        paths = {one.path for one in members}
        view = {path: self.first[path] for path in paths if path in self.view}
        state = self.planet
        if not group or any(path.startswith(_SWITCH) for path in paths):
            state = state.with_off(())
        if not group:
            return Change(planet=state.with_tables(state.base), view=view)
        tables = state.tables
        for one in members:
            if isinstance(one, Amount):
                paths.remove(one.path)
                for key in self._keys_of(one):
                    tables = restored(tables, state.base, key)
        for path in sorted(paths - set(view)):
            if path.startswith(_CONSTITUENT):
                tables = restored(tables, state.base, path[: path.index("]") + 1])
            elif not path.startswith("light."):
                tables = restored(tables, state.base, path.split(".")[0].split("[")[0])
        if tables is not state.tables:
            state = state.with_tables(tables)
        return Change(planet=state, view=view)

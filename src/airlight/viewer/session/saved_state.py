"""Session state as JSON for a page's URL: differences from the defaults."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, Final
from urllib.parse import quote, unquote

from airlight.errors import ParameterError
from airlight.planets.reading.declared_keys import spelled_out
from airlight.planets.reading.overrides import overridden
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.view_parameters import DEFAULTS, view_parameters
from airlight.viewer.session.planet_state import PlanetState

#: Characters that are not escaped in the URL.
_PLAIN: Final = ",:[]{}\"'!*()"
#: Keys of a state.
_KEYS: Final = ("planet", "set", "off", "view", "air")
#: Path of a constituent's amount on a page that solves edits.
_AMOUNT: Final = re.compile(r"air\.amounts\[(\d+)\]")


def state_of(planet: PlanetState, view: Mapping[str, Value]) -> dict[str, Any]:
    """State of planet and view as JSON values.

    Returns
    -------
    dict
        ``planet``: name of the preset or path of the file; ``set``: its overrides, as for
        ``load_planet``; ``off``: indices of constituents; ``view``: values by path. Only the first
        is always present.
    """
    state: dict[str, Any] = {"planet": planet.source}
    changed = {path: value for path, _, value in planet.changes}
    if changed:
        state["set"] = changed
    if planet.off:
        state["off"] = list(planet.off)
    moved = {path: value for path, value in view.items() if value != DEFAULTS[path]}
    if moved:
        state["view"] = {path: _short(value) for path, value in moved.items()}
    return state


def _short(value: Value) -> Value:
    """Round to nine significant digits."""
    if isinstance(value, bool) or not isinstance(value, float):
        return value
    short = float(f"{value:.9g}")
    return int(short) if short == int(short) and abs(short) < 1e9 else short


def read_state(
    state: Mapping[str, Any], current: PlanetState
) -> tuple[PlanetState, dict[str, Value]]:
    """Planet and view of a state made by ``state_of``.

    Parameters
    ----------
    state : mapping
        State as JSON values.
    current : PlanetState
        Current planet, whose file is not read again if the state has the same one.

    Returns
    -------
    view : dict
        View values by path, complete.
    """
    if not isinstance(state, Mapping) or not isinstance(state.get("planet"), str):
        raise ParameterError("state", state, "a table with the name of a planet")
    for key in state:
        if key not in _KEYS:
            raise ParameterError("state", key, ", ".join(_KEYS))
    name = state["planet"]
    planet = current if name == current.source else PlanetState.opened(name)
    changes = {**_table(state, "set"), **_of_page(_table(state, "air"))}
    tables = planet.base
    if changes:
        tables = spelled_out(overridden(planet.base, changes))
    try:
        planet = PlanetState(planet.source, planet.base, tables, _off(state, tables))
        for one in planet.parameters:
            one.checked(_checked_value(planet, one))
    except (AttributeError, TypeError, KeyError):
        raise ParameterError("state.set", changes, "keys of a planet file") from None
    return planet, _view(state)


def _table(state: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    given = state.get(name, {})
    if not isinstance(given, Mapping):
        raise ParameterError(f"state.{name}", given, "a table of values by path")
    return given


def _of_page(air: Mapping[str, Any]) -> dict[str, Any]:
    """Planet-file keys of a page's amounts."""
    found = {}
    for path, value in air.items():
        amount = _AMOUNT.fullmatch(path)
        if amount is None and path != "air.ground":
            raise ParameterError("state.air", path, "air.amounts[…], air.ground")
        found[f"constituents[{amount[1]}].amount" if amount else "ground.brightness"] = value
    return found


def _checked_value(planet: PlanetState, parameter: Any) -> Value:
    from airlight.viewer.parameters.parameter_list import value_at

    return value_at(planet.tables, parameter)


def _off(state: Mapping[str, Any], tables: Mapping[str, Any]) -> tuple[int, ...]:
    off, count = state.get("off", []), len(tables["constituents"])
    allowed = f"places of constituents, 0 to {count - 1}"
    if not isinstance(off, list):
        raise ParameterError("state.off", off, allowed)
    for place in off:
        if isinstance(place, bool) or not isinstance(place, int) or not 0 <= place < count:
            raise ParameterError("state.off", place, allowed)
    return tuple(sorted(set(off)))


def _view(state: Mapping[str, Any]) -> dict[str, Value]:
    given = _table(state, "view")
    known = {one.path: one for one in view_parameters()}
    view = dict(DEFAULTS)
    for path, value in given.items():
        if path not in known:
            raise ParameterError("state.view", path, ", ".join(known))
        view[path] = known[path].checked(value)
    return view


def to_fragment(state: Mapping[str, Any]) -> str:
    """Encode a state as the fragment of a URL, without the ``#``.

    Examples
    --------
    >>> to_fragment({"planet": "mars", "view": {"view.altitude": 2e5}})
    '{"planet":"mars","view":{"view.altitude":200000.0}}'
    """
    text = json.dumps(state, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return quote(text, safe=_PLAIN)


def from_fragment(fragment: str) -> dict[str, Any]:
    """Decode the state of a URL fragment, with or without the ``#``.

    Examples
    --------
    >>> from_fragment("#%7B%22planet%22:%22titan%22%7D")
    {'planet': 'titan'}
    """
    try:
        state = json.loads(unquote(fragment.removeprefix("#")))
    except (ValueError, RecursionError):
        raise ParameterError("fragment", fragment[:60], "a fragment from to_fragment") from None
    if not isinstance(state, dict):
        raise ParameterError("fragment", fragment[:60], "a fragment from to_fragment")
    return state

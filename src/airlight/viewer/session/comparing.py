"""Differences of two sides."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.parameter_list import value_at
from airlight.viewer.parameters.view_parameters import view_parameters
from airlight.viewer.session.planet_state import PlanetState
from airlight.viewer.session.side import Side


@dataclass(frozen=True, kw_only=True)
class ParameterDifference:
    """Parameter whose values differ between two sides.

    Attributes
    ----------
    path, label, unit : str
        Path, label and unit of the parameter; the group precedes the label.
    first, second : float, str, bool or None
        Values; None on a side without the parameter. [unit]
    """

    path: str
    label: str
    unit: str
    first: Value | None
    second: Value | None


def differing(first: Side, second: Side, shares_camera: bool) -> Iterator[ParameterDifference]:
    """Parameters that differ between two sides; constituents are matched by name.

    Parameters
    ----------
    first, second : Side
    shares_camera : bool
        Whether camera and sun are those of both.
    """
    yield from _differing_planets(first.planet, second.planet)
    for one in view_parameters():
        if shares_camera and one.path.startswith("view."):
            continue
        a, b = first.view[one.path], second.view[one.path]
        if a != b:
            yield ParameterDifference(
                path=one.path, label=one.label, unit=one.unit, first=a, second=b
            )


def _differing_planets(first: PlanetState, second: PlanetState) -> Iterator[ParameterDifference]:
    ones, others = _by_words(first), _by_words(second)
    for words in (*ones, *(words for words in others if words not in ones)):
        one, other = ones.get(words), others.get(words)
        a = None if one is None else value_at(first.tables, one)
        b = None if other is None else value_at(second.tables, other)
        if a != b:
            known = one or other
            assert known is not None
            label = f"{known.group}: {known.label}"
            yield ParameterDifference(
                path=known.path, label=label, unit=known.unit, first=a, second=b
            )
    for group in (*first.groups, *(one for one in second.groups if one not in first.groups)):
        a, b = (
            None if group not in state.groups else state.groups.index(group) not in state.off
            for state in (first, second)
        )
        if None not in (a, b) and a != b:
            label = f"{group}: on"
            yield ParameterDifference(
                path="light.constituents", label=label, unit="1", first=a, second=b
            )


def _by_words(state: PlanetState) -> dict[tuple[str, str], Parameter]:
    """Parameters by group and by the path within the constituent."""
    found = {}
    for one in state.parameters:
        inside = one.path.partition("]")[2] if one.path.startswith("constituents[") else one.path
        found[one.group, inside] = one
    return found

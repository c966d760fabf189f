"""Values of the amounts in a planet's tables, and edits of them."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Final

from airlight.errors import AirlightError
from airlight.planets.reading.nested_tables import Tables, get, put
from airlight.planets.reading.reader import declared_planet
from airlight.planets.schema.measures import number_in
from airlight.viewer.parameters.amounts import TURBIDITY, Amount, amounts_of
from airlight.viewer.parameters.turbidity import haze_of, turbidity_of

#: Number of planets whose amounts are stored.
_MOST_KEPT: Final = 16


class _Plain:
    """Unedited tables, cached by their text."""

    def __init__(self, tables: Tables) -> None:
        constituents = [
            {key: value for key, value in one.items() if key != "amount"}
            for one in tables["constituents"]
        ]
        ground = {key: value for key, value in tables["ground"].items() if key != "brightness"}
        self.tables = {**tables, "constituents": constituents, "ground": ground}
        self._text = repr(self.tables)

    def __hash__(self) -> int:
        return hash(self._text)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Plain) and self._text == other._text


@lru_cache(maxsize=_MOST_KEPT)
def _declared(plain: _Plain) -> tuple[Amount, ...]:
    try:
        return amounts_of(declared_planet(plain.tables))
    except (AirlightError, AttributeError, TypeError, KeyError, ValueError):
        return ()  # an edit in between; ``solving`` reports the error


def amounts_in(tables: Tables) -> tuple[Amount, ...]:
    """Amounts of the planet that tables describe; empty if the tables are invalid."""
    return _declared(_Plain(tables))


def amount_value(tables: Tables, amount: Amount) -> float:
    """Value of an amount. [amount.unit]"""
    if amount.path == TURBIDITY:
        gas, haze = (_depth(tables, matter) for matter in ("gas", "haze"))
        return turbidity_of(gas, haze) if gas > 0.0 else 1.0
    now = {one.path: one for one in amounts_in(tables)}.get(amount.path, amount)
    return _factor(tables, amount) * now.present


def amount_edited(tables: Tables, amount: Amount, value: float) -> Tables:
    """Copy of the tables with an amount.

    Parameters
    ----------
    tables : dict
        Tables before the edit; not modified.
    amount : Amount
        Amount from ``amounts_in`` of these or earlier tables of the planet.
    value : float
        New value; turbidity scales all haze equally. [amount.unit]
    """
    known = amounts_in(tables)
    if amount.path != TURBIDITY:
        now = {one.path: one for one in known}.get(amount.path, amount)
        return _with_factor(tables, now, value / now.present)
    haze = [one for one in known if one.matter == "haze"]
    before = _depth(tables, "haze")
    # Haze that was removed returns with the amount in the planet's file.
    old = {one.path: _factor(tables, one) if before > 0.0 else 1.0 for one in haze}
    total = sum(old[one.path] * one.depth for one in haze)
    share = haze_of(value, _depth(tables, "gas")) / total if total > 0.0 else 0.0
    for one in haze:
        tables = _with_factor(tables, one, old[one.path] * share)
    return tables


def _with_factor(tables: Tables, amount: Amount, factor: float) -> Tables:
    factor = min(max(float(f"{factor:.9g}"), 0.0), amount.most / amount.present)
    if factor == 1.0:  # as omitted from the file
        return put(tables, amount.key, None) if get(tables, amount.key) is not None else tables
    return put(tables, amount.key, factor)


def keys_of_amount(tables: Tables, amount: Amount) -> tuple[str, ...]:
    """Paths of the planet's file that an amount changes."""
    if amount.path != TURBIDITY:
        return (amount.key,)
    return tuple(one.key for one in amounts_in(tables) if one.matter == "haze")


def _factor(tables: Tables, amount: Amount) -> float:
    value: Any = get(tables, amount.key)
    return 1.0 if value is None else number_in(value, "1", "1", amount.key)


def _depth(tables: Tables, matter: str) -> float:
    """Optical depth of a kind of matter at 550 nm. [1]"""
    return sum(
        _factor(tables, one) * one.depth for one in amounts_in(tables) if one.matter == matter
    )

"""Texts with a unit as numbers in a declared unit, and back."""

from __future__ import annotations

from functools import cache
from typing import Any

from airlight.planets.reading.absorption_reader import column_of_gas
from airlight.units import quantities, quantity

#: Columns of gas, which have a unit of their own.
DOBSON = "DU"


@cache
def _factor(unit: str, bare: str) -> float:
    if unit == DOBSON:
        return column_of_gas("1 DU", "column")
    return 1.0 if unit == bare else quantity(f"1 {unit}", bare)


def number_in(value: Any, unit: str, bare: str, field: str) -> float:
    """What a file holds, as a number in a unit.

    Parameters
    ----------
    value : object
        A number, or a text with a unit, as a planet file has it.
    unit : str
        Of the result.
    bare : str
        The unit that a number without one is in.
    field : str
        Named in the error.

    Raises
    ------
    ParameterError
        If it is no quantity of that kind.

    Examples
    --------
    >>> number_in("6360 km", "km", "m", "radius"), number_in(6360e3, "km", "m", "radius")
    (6360.0, 6360.0)
    >>> number_in("345 DU", "DU", "1/m^2", "ozone")
    345.0
    """
    if unit == DOBSON:
        found = column_of_gas(value, field)
    else:
        found = quantity(value, bare, field)
    # The shortest number that means the same: 5.802e-6 /m is 0.005802 /km.
    return float(f"{found / _factor(unit, bare):.14g}")


def text_of(number: float, unit: str) -> float | str:
    """A number in a unit as a file holds it: with the unit, if it has one.

    Examples
    --------
    >>> text_of(6400.0, "km"), text_of(0.3, "1")
    ('6400 km', 0.3)
    """
    if unit == "1":
        return number
    whole = repr(int(number)) if number == int(number) and abs(number) < 1e15 else repr(number)
    return f"{whole} {unit}"


def listed(text: str, bare: str) -> list[Any]:
    """The items of a list that is written as one text with commas.

    Examples
    --------
    >>> listed("0, 5, 12.5 km", "m")
    ['0 km', '5 km', '12.5 km']
    """
    items = [item.strip() for item in text.split(",")]
    numbers = quantities(text, bare)
    unit = items[-1].lstrip("+-.0123456789eE").strip()
    return [
        _with_unit(item, unit, number, bare) for item, number in zip(items, numbers, strict=True)
    ]


def _with_unit(item: str, unit: str, number: float, bare: str) -> str:
    """The item with the last one's unit if it has none and means the same with it."""
    if unit:
        try:
            if quantity(f"{item} {unit}", bare) == number:
                return f"{item} {unit}"
        except ValueError:
            pass
    return item

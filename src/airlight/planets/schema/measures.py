"""Conversion of texts with a unit to numbers in a declared unit, and back."""

from __future__ import annotations

import re
from functools import cache
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.physics.constants import AVOGADRO
from airlight.physics.units import quantities, quantity

#: Unit of columns of gas.
DOBSON = "DU"


@cache
def _factor(unit: str, bare: str) -> float:
    """Factor from one unit to another."""
    if unit == DOBSON:
        return column_of_gas("1 DU", "column")
    return 1.0 if unit == bare else quantity(f"1 {unit}", bare)


def converted(number: float, unit: str, shown: str) -> float:
    """Convert a number from one unit to another of the same kind.

    Examples
    --------
    >>> converted(1000.0, "m", "km"), converted(1e-3, "1/m", "/km")
    (1.0, 1.0)
    """
    # The shortest number of the same value: 5.802e-6 /m is 0.005802 /km.
    return float(f"{number / _factor(shown, unit):.14g}")


#: Names of the units of columns, with an example.
COLUMN_UNITS: Final = "'DU', 'atm-cm', 'mol/m^2' or '1/m^2': '300 DU'"
#: Thickness of a column at 0 °C and 1 atm, in Dobson units of 10 µm: factor by unit name.
_THICKNESS: Final = {"DU": 1.0, "atm-cm": 1e3, "atm cm": 1e3, "atmcm": 1e3, "matm-cm": 1.0}
_COLUMN: Final = re.compile(rf"\s*(\S{{1,40}}?)\s*({'|'.join(_THICKNESS)})\s*")


def column_of_gas(value: Any, field: str, *, bare: bool = False) -> float:
    """Column of molecules from text such as ``345 DU``, ``0.345 atm-cm``. [m⁻²]

    Parameters
    ----------
    value : float, str or quantity
        Column as a thickness (1 atm-cm is 1000 DU), or in moles or molecules per area.
    field : str
        Name in the error.
    bare : bool
        As for ``airlight.physics.units.quantity``.

    Examples
    --------
    >>> f"{column_of_gas('345 DU', 'ozone'):.3e}", f"{column_of_gas('0.345 atm-cm', 'ozone'):.3e}"
    ('9.269e+22', '9.269e+22')
    >>> f"{column_of_gas('1 mol/m^2', 'ozone'):.8e}"
    '6.02214076e+23'
    """
    allowed = f"a column with a unit such as {COLUMN_UNITS}"
    if isinstance(value, str) and (match := _COLUMN.fullmatch(value)):
        from airlight.physics.optics.gas_absorption import column_from_dobson

        thickness = quantity(match[1], "1", field, allowed=allowed)
        return column_from_dobson(_THICKNESS[match[2]] * thickness)
    try:
        return quantity(value, "1/m^2", field, bare=bare, allowed=allowed)
    except ParameterError as error:
        if isinstance(value, (int, float)):
            raise
        try:
            return AVOGADRO * quantity(value, "mol/m^2", field, allowed=allowed)
        except ParameterError:
            raise error from None


def number_in(value: Any, unit: str, bare: str, field: str) -> float:
    """Convert a value of a file to a number in a unit.

    Parameters
    ----------
    value : object
        Number, or text with a unit, as in a planet file.
    unit : str
        Unit of the result.
    bare : str
        Unit of a plain number.

    Examples
    --------
    >>> number_in("6360 km", "km", "m", "radius"), number_in(6360e3, "km", "m", "radius")
    (6360.0, 6360.0)
    >>> number_in("345 DU", "DU", "1/m^2", "ozone")
    345.0
    """
    if unit == DOBSON:
        found = column_of_gas(value, field, bare=True)
    else:
        found = quantity(value, bare, field, bare=True)
    return converted(found, bare, unit)


def text_of(number: float, unit: str) -> float | str:
    """Text of a number for a planet file, with its unit.

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
    """Items of a comma-separated list.

    Examples
    --------
    >>> listed("0, 5, 12.5 km", "m")
    ['0 km', '5 km', '12.5 km']
    """
    items = [item.strip() for item in text.split(",")]
    numbers = quantities(text, bare, bare=True)
    unit = items[-1].lstrip("+-.0123456789eE").strip()
    return [
        _with_unit(item, unit, number, bare) for item, number in zip(items, numbers, strict=True)
    ]


def _with_unit(item: str, unit: str, number: float, bare: str) -> str:
    """List item with the shared unit added, if its value is unchanged."""
    if unit:
        try:
            if quantity(f"{item} {unit}", bare, bare=True) == number:
                return f"{item} {unit}"
        except ValueError:
            pass
    return item

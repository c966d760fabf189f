"""Text with a unit to a number in SI: pint, at the door only."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import TYPE_CHECKING, Any

from airlight.errors import ParameterError

if TYPE_CHECKING:
    import pint

#: Units that angles and wavelengths are kept in, beside SI for all else.
_KEPT = {"deg": "degree", "nm": "nanometer", "1": "dimensionless"}


@cache
def _registry() -> pint.UnitRegistry[Any]:
    import pint

    try:
        return pint.UnitRegistry(cache_folder=":auto:")  # parsed definitions, a tenth of a second
    except Exception:  # a home without a place for it, or a damaged cache
        return pint.UnitRegistry()


def quantity(text: str | float, unit: str, field: str = "value") -> float:
    """Convert one number with a unit to a float in the given unit.

    A number without a unit is taken to be in ``unit`` already.

    Parameters
    ----------
    text : str or float
        For example ``"8 km"``, ``"5.802e-6 /m"``, ``"0.2678 deg"``, ``8000.0``.
    unit : str
        The unit of the result, in pint's spelling: ``"m"``, ``"1/m"``, ``"deg"``, ``"1"``.
    field : str
        Named in the error.

    Returns
    -------
    float
        Finite. [unit]

    Raises
    ------
    ParameterError
        If the text is no number, has a unit of another kind, or is not finite.

    Examples
    --------
    >>> quantity("8 km", "m")
    8000.0
    >>> quantity("5.802e-6 /m", "1/m")
    5.802e-06
    """
    allowed = "a finite number" if unit == "1" else f"a finite number with a unit such as {unit!r}"
    if isinstance(text, bool) or not isinstance(text, (int, float, str)):
        raise ParameterError(field, text, allowed)
    if isinstance(text, (int, float)):
        try:
            number = float(text)
        except OverflowError:
            number = math.inf
    else:
        number = _parse(text, unit, field, allowed)
    if not math.isfinite(number):
        raise ParameterError(field, text, allowed)
    return number


_NAME = r"[A-Za-zµμ°%Å]+(?:(?:\^|\*\*)?-?[1-9])?"
#: A number, then at most a unit: names with a one-digit power, joined by ``*``, ``/`` or a space.
#: Anything wider would hand pint an expression to evaluate.
_FORM = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    rf"\s*(?P<unit>(?:1?\s*/\s*)?(?:{_NAME})(?:\s*[*/ ]\s*{_NAME})*)?\s*"
)


def _parse(text: str, unit: str, field: str, allowed: str) -> float:
    match = _FORM.fullmatch(text) if len(text) < 100 else None
    if match is None:
        raise ParameterError(field, text, allowed)
    number = float(match["number"])
    given = match["unit"]
    if given is None:
        return number
    try:
        return number * _factor(given, unit)
    except Exception as error:  # pint raises many kinds, its tokenizer's own among them
        raise ParameterError(field, text, allowed) from error


@cache
def _factor(given: str, unit: str) -> float:
    registry = _registry()
    source = registry.parse_expression("1" + given if given.startswith("/") else given)
    target = registry.parse_expression(_KEPT.get(unit, unit))
    return float((source / target).to("dimensionless").magnitude)


def quantities(
    text: str | float | list[Any] | tuple[Any, ...], unit: str, field: str = "value"
) -> list[float]:
    """A list of numbers with units, as floats in the unit asked for.

    Accepts a single quantity, a list of quantities, or one text with commas whose last
    item carries the unit for all that have none: ``"680, 550, 440 nm"``.

    Examples
    --------
    >>> quantities("680, 550, 440 nm", "nm")
    [680.0, 550.0, 440.0]
    >>> quantities(["1 km", 500.0], "m")
    [1000.0, 500.0]
    """
    if isinstance(text, str):
        items: list[Any] = [item.strip() for item in text.split(",")]
        last = _FORM.fullmatch(items[-1])
        if last is not None and last["unit"] is not None:
            items = [_with_unit(item, last["unit"]) for item in items]
    elif isinstance(text, (list, tuple)):
        items = list(text)
    else:
        items = [text]
    if not items:
        raise ParameterError(field, text, "at least one number")
    return [
        quantity(item, unit, field if len(items) == 1 else f"{field}[{index}]")
        for index, item in enumerate(items)
    ]


def _with_unit(item: str, unit: str) -> str:
    match = _FORM.fullmatch(item)
    return f"{item} {unit}" if match is not None and match["unit"] is None else item

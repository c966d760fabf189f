"""Conversion of text with a unit to a number in SI: usual units by a table, others by pint."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from airlight.errors import ParameterError

if TYPE_CHECKING:
    import pint

#: Powers of metre, kilogram, second, kelvin and mole. [1]
_Dimension: TypeAlias = tuple[int, int, int, int, int]

_LENGTH: Final = (1, 0, 0, 0, 0)
_PRESSURE: Final = (-1, 1, -2, 0, 0)
_NUMBER: Final = (0, 0, 0, 0, 0)
#: Units that need no pint, whose import takes a tenth of a second: factor to SI, dimension. The
#: factors are definitions (SI brochure; IAU 2012 for the astronomical unit); angles are numbers.
_USUAL: Final[dict[str, tuple[float, _Dimension]]] = {
    "m": (1.0, _LENGTH),
    "km": (1e3, _LENGTH),
    "cm": (1e-2, _LENGTH),
    "mm": (1e-3, _LENGTH),
    "um": (1e-6, _LENGTH),
    "µm": (1e-6, _LENGTH),
    "nm": (1e-9, _LENGTH),
    "au": (149_597_870_700.0, _LENGTH),
    "kg": (1.0, (0, 1, 0, 0, 0)),
    "g": (1e-3, (0, 1, 0, 0, 0)),
    "s": (1.0, (0, 0, 1, 0, 0)),
    "K": (1.0, (0, 0, 0, 1, 0)),
    "mol": (1.0, (0, 0, 0, 0, 1)),
    "W": (1.0, (2, 1, -3, 0, 0)),
    "Pa": (1.0, _PRESSURE),
    "hPa": (1e2, _PRESSURE),
    "bar": (1e5, _PRESSURE),
    "mbar": (1e2, _PRESSURE),
    "rad": (1.0, _NUMBER),
    "deg": (math.pi / 180.0, _NUMBER),
    "1": (1.0, _NUMBER),
}

#: Units of angles and wavelengths, which are not converted to SI.
_KEPT = {"deg": "degree", "nm": "nanometer", "1": "dimensionless"}


@cache
def _registry() -> pint.UnitRegistry[Any]:
    import pint

    try:
        return pint.UnitRegistry(cache_folder=":auto:")  # parsed definitions, a tenth of a second
    except Exception:  # a home without a writable cache, or a damaged one
        return pint.UnitRegistry()


def quantity(text: str | float, unit: str, field: str = "value", *, bare: bool = False) -> float:
    """Convert one number with a unit to a float in the given unit.

    Parameters
    ----------
    text : str or float
        Number with a unit, such as ``"8 km"``, ``"5.802e-6 /m"``, ``"0.2678 deg"``; without a unit
        where ``unit`` is ``"1"``, and zero.
    unit : str
        Unit of the result, in pint's spelling: ``"m"``, ``"1/m"``, ``"deg"``, ``"1"``.
    field : str
        Field named in the error.
    bare : bool
        Whether a number without a unit is taken to be in ``unit``; otherwise it is refused.

    Returns
    -------
    float
        Finite value. [unit]

    Raises
    ------
    ParameterError
        If the text is not a number, has no unit, one that is unknown or of another dimension, or is
        not finite.

    Examples
    --------
    >>> quantity("8 km", "m"), quantity("5.802e-6 /m", "1/m"), quantity(0, "m")
    (8000.0, 5.802e-06, 0.0)
    >>> quantity(5, "Pa", "pressure")
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: pressure is 5; allowed: a number with its unit, such as '5 Pa'
    """
    allowed = "a finite number" if unit == "1" else f"a finite number with a unit such as {unit!r}"
    if isinstance(text, bool) or not isinstance(text, (int, float, str)):
        raise ParameterError(field, text, allowed)
    if isinstance(text, (int, float)):
        try:
            number = float(text)
        except OverflowError:
            number = math.inf
        named = False
    else:
        number, named = _parse(text, unit, field, allowed)
    if not math.isfinite(number):
        raise ParameterError(field, text, allowed)
    if not (named or bare or unit == "1" or number == 0.0):
        example = f"{str(text).strip()} {unit.removeprefix('1')}"
        raise ParameterError(field, text, f"a number with its unit, such as {example!r}")
    return number


_NAME = r"[A-Za-zµμ°%Å]+(?:(?:\^|\*\*)?-?[1-9])?"
#: A number, then at most one unit: names with a one-digit power, joined by ``*``, ``/`` or a space.
#: Anything wider would let pint evaluate an expression.
_FORM = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    rf"\s*(?P<unit>(?:1?\s*/\s*)?(?:{_NAME})(?:\s*[*/ ]\s*{_NAME})*)?\s*"
)


#: A number and what follows it, of a text that ``_FORM`` does not read.
_BEGUN: Final = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*(?P<rest>\D.*?)\s*")
#: Signs with which no unit begins.
_SIGNS: Final = ",.;:+-*/()[]{}'\""


def _parse(text: str, unit: str, field: str, allowed: str) -> tuple[float, bool]:
    """Number in the unit, and whether the text names one."""
    match = _FORM.fullmatch(text) if len(text) < 100 else None
    if match is None:
        begun = _BEGUN.fullmatch(text) if len(text) < 100 else None
        if begun is not None and begun["rest"][0] not in _SIGNS:
            allowed = f"{allowed}; the unit {begun['rest']!r} is not known"
        raise ParameterError(field, text, allowed)
    number = float(match["number"])
    given = match["unit"]
    if given is None:
        return number, False
    try:
        return number * _factor(given, unit), True
    except Exception as error:  # pint raises many kinds, its tokenizer's own among them
        kind = type(error).__name__
        if kind == "UndefinedUnitError":
            allowed = f"{allowed}; the unit {given!r} is not known"
        elif kind == "DimensionalityError":
            allowed = f"{allowed}; {given!r} is a unit of something else"
        else:  # a scale with an offset, such as degC
            allowed = f"{allowed}; {given!r} is no multiple of it"
        raise ParameterError(field, text, allowed) from error


@cache
def _factor(given: str, unit: str) -> float:
    """What a number in the unit given is multiplied with; pint's errors where nothing fits."""
    usual, usual_target = _usual(given), _usual(unit)
    if usual is not None and usual_target is not None and usual[1] == usual_target[1]:
        return usual[0] / usual_target[0]
    registry = _registry()
    source = registry.parse_expression("1" + given if given.startswith("/") else given)
    target = registry.parse_expression(_KEPT.get(unit, unit))
    return float((source / target).to("dimensionless").magnitude)


#: Unit in a product, the sign before it (none before the first), and its power.
_PART: Final = re.compile(r"\s*([*/ ]?)\s*([A-Za-zµ]+|1)(?:(?:\^|\*\*)(-?[1-9]))?")


def _usual(text: str) -> tuple[float, _Dimension] | None:
    """Factor to SI and dimension of a product of usual units, read from left to right; or None."""
    text = text.strip().replace("μ", "µ")
    factor, powers = 1.0, [0] * len(_NUMBER)
    at = 0
    while at < len(text):
        part = _PART.match(text, at)
        if part is None or part[2] not in _USUAL:
            return None
        one, dimension = _USUAL[part[2]]
        power = int(part[3] or "1")
        raised = one ** abs(power)
        if (part[1] == "/") != (power < 0):
            factor /= raised
        else:
            factor *= raised
        sign = -power if part[1] == "/" else power
        powers = [p + sign * d for p, d in zip(powers, dimension, strict=True)]
        at = part.end()
    m, kg, s, kelvin, mol = powers
    return factor, (m, kg, s, kelvin, mol)


def quantities(
    text: str | float | list[Any] | tuple[Any, ...],
    unit: str,
    field: str = "value",
    *,
    bare: bool = False,
) -> list[float]:
    """Convert a list of numbers with units to floats in the given unit.

    Accepts a single quantity, a list of quantities, or one text with commas whose last
    item carries the unit for all that have none: ``"680, 550, 440 nm"``. ``bare`` as for
    ``quantity``.

    Examples
    --------
    >>> quantities("680, 550, 440 nm", "nm")
    [680.0, 550.0, 440.0]
    >>> quantities(["1 km", 500.0], "m", bare=True)
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
        quantity(item, unit, field if len(items) == 1 else f"{field}[{index}]", bare=bare)
        for index, item in enumerate(items)
    ]


def _with_unit(item: str, unit: str) -> str:
    match = _FORM.fullmatch(item)
    return f"{item} {unit}" if match is not None and match["unit"] is None else item

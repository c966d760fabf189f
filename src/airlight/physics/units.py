"""Conversion of texts with units and of quantities to numbers.

A value is a number in the requested unit, text with a unit, a quantity of pint, astropy or unyt, a
labelled array with the attribute ``units``, or a list of these. Units are never ignored.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, Final, Generic, Protocol, TypeAlias, TypeVar

from airlight.errors import ParameterError
from airlight.files.cache_folders import cache_folder, make_folder, trusted_folder

if TYPE_CHECKING:
    import pint
    from numpy import float64
    from numpy.typing import ArrayLike, NDArray

Read = TypeVar("Read", bound=float | None)


class HasUnit(Protocol):
    """Quantity of pint, astropy or unyt."""

    def to(self, *unit: Any, **options: Any) -> Any:
        """Quantity in another unit."""


#: Number in the expected unit, text with a unit, or a quantity.
Measure: TypeAlias = float | str | HasUnit
if TYPE_CHECKING:
    #: The same, as an array or a list.
    Measures: TypeAlias = ArrayLike | HasUnit | Sequence[Measure]


class Measured(Generic[Read]):
    """Type of a dataclass field that is set by any ``Measure`` and read as a number.

    For annotations only: the class converts the value at construction.
    """

    def __get__(self, instance: object, owner: Any) -> Read:
        """Number."""
        raise NotImplementedError

    def __set__(self, instance: object, value: Read | Measure) -> None:
        """Set by a number, text with a unit or a quantity."""
        raise NotImplementedError


def measured(default: float | None) -> Any:
    """Default of a field whose type is ``Measured``."""
    return default


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

#: Units that a text may omit, being the only plausible ones.
UNDERSTOOD: Final = ("deg", "nm", "K", "s")
#: Largest number of values that a range may have.
MOST_VALUES: Final = 100_000
#: Names of a degree in the CF conventions.
_CF_DEGREES: Final = re.compile(r"degrees?_?(?:north|east|N|E)")
#: Units of dimensionless quantities.
_UNITLESS: Final = ("", "1", "dimensionless", "(dimensionless)")
#: Units of angles and wavelengths, which are not converted to SI.
_KEPT = {"deg": "degree", "nm": "nanometer", "1": "dimensionless"}


@cache
def _registry() -> pint.UnitRegistry[Any]:
    import pint

    try:
        cache = trusted_folder(cache_folder(), "units")  # which pint unpickles
        if cache is not None:
            make_folder(cache)
        return pint.UnitRegistry(cache_folder=cache)  # parsed definitions, a tenth of a second
    except Exception:  # a home without a writable cache, or a damaged one
        return pint.UnitRegistry()


def quantity(
    text: Measure, unit: str, field: str = "value", *, bare: bool = False, allowed: str = ""
) -> float:
    """Number in a unit, from a number, text with a unit or quantity.

    Parameters
    ----------
    text : float, str or quantity
        Number with a unit, such as ``"8 km"``, ``"5.802e-6 /m"``, ``"0.2678 deg"``, or a quantity,
        see ``values_in``; without a unit where ``unit`` is ``"1"``, and zero.
    unit : str
        Unit of the result, in pint's spelling: ``"m"``, ``"1/m"``, ``"deg"``, ``"1"``.
    field : str
        Field named in the error.
    bare : bool
        Whether a number without a unit is in ``unit``; otherwise it is an error.
    allowed : str
        Allowed values in the error message.

    Returns
    -------
    float
        Finite value. [unit]

    Examples
    --------
    >>> quantity("8 km", "m"), quantity("5.802e-6 /m", "1/m"), quantity(0, "m")
    (8000.0, 5.802e-06, 0.0)
    >>> quantity(5, "Pa", "pressure")
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: pressure is 5; allowed: a number with its unit, such as '5 Pa'
    """
    without = allowed
    if not allowed:
        allowed = f"a finite number with a unit such as {unit!r}"
        allowed = "a finite number" if unit == "1" else allowed
    if isinstance(text, str):
        number, named = _parse(text, unit, field, allowed)
    elif type(text) in (int, float):
        try:
            number, named = float(text), False  # type: ignore[arg-type]
        except OverflowError:
            number, named = math.inf, False
    else:
        values = values_in(text, unit, field, allowed=allowed)
        if values.ndim:
            raise ParameterError(field, text, allowed)
        number, named = float(values), _unit_of(text) is not None
    if not math.isfinite(number):
        raise ParameterError(field, text, allowed)
    if not (named or bare or unit == "1" or number == 0.0):
        example = f"{str(text).strip()} {unit.removeprefix('1')}"
        without = without or f"a number with its unit, such as {example!r}"
        raise ParameterError(field, text, without)
    return number


def values_in(
    value: Measures, unit: str, field: str = "value", *, allowed: str = ""
) -> NDArray[float64]:
    """Numbers in a unit, from a value of any kind.

    Parameters
    ----------
    value : array
        Numbers in ``unit``; text with a unit (``"400 km"``), with commas (``"680, 550, 440 nm"``)
        or a range with its end (``"0:80:10 deg"``); a quantity of pint, astropy or unyt; a labelled
        array, whose attribute ``units`` counts; or a list of these.
    unit : str
        Unit of the result, as for ``quantity``. Lists and ranges in a text may omit units of
        ``UNDERSTOOD``.
    allowed : str
        Allowed values in the error message.

    Returns
    -------
    array, shape (...)
        Numbers; their range is not checked. [unit]

    Examples
    --------
    >>> values_in("0:60:20", "deg").tolist(), values_in(["2 km", 500.0], "m").tolist()
    ([0.0, 20.0, 40.0, 60.0], [2000.0, 500.0])
    >>> import pint
    >>> values_in(pint.Quantity([0.55, 0.44], "um"), "nm").round(9).tolist()
    [550.0, 440.0]
    """
    import numpy as np

    if type(value) is np.ndarray and value.dtype.kind in "fiu":
        return np.asarray(value, np.float64)
    allowed = allowed or ("numbers" if unit == "1" else f"numbers in {unit}, or with a unit")
    if isinstance(value, str):
        return np.asarray(_values_of_text(value, unit, field, allowed))
    given = _unit_of(value)
    if given is not None:
        return _values_of_quantity(value, str(given).strip(), unit, field, allowed)
    many: Any = value
    if getattr(getattr(many, "dtype", None), "kind", "") == "O":
        many = many.tolist()
    if isinstance(many, (list, tuple)) and any(type(one) not in (int, float) for one in many):
        many = [values_in(one, unit, field, allowed=allowed) for one in many]
    try:
        plain = np.asarray(many)
        if plain.dtype.kind not in "fiu" and plain.size:
            raise TypeError
        return plain.astype(np.float64)
    except (TypeError, ValueError, OverflowError):  # words, bools, lists of unequal lengths
        raise ParameterError(field, value, allowed) from None


def _values_of_text(text: str, unit: str, field: str, allowed: str) -> float | list[float]:
    """Number, list with commas, or range ``FROM:TO:STEP`` with its end. [unit]"""
    bare = unit in UNDERSTOOD
    if ":" not in text:
        if "," not in text:
            return quantity(text, unit, field, allowed=allowed)
        return quantities(text, unit, field, bare=bare, allowed=allowed)
    form = "a list, or FROM:TO:STEP such as 0:90:5"
    try:
        start, end, step = quantities(text.replace(":", ","), unit, field, bare=bare)
    except ValueError:
        raise ParameterError(field, text, form) from None
    if not step > 0.0 or end < start or (end - start) / step > MOST_VALUES:
        raise ParameterError(field, text, f"{form}, with at most {MOST_VALUES} values")
    count = int((end - start) / step + 1e-9)
    return [float(f"{start + k * step:.12g}") for k in range(count + 1)]


def _unit_of(value: Any) -> Any:
    """Unit of a quantity or of a labelled array; None for plain numbers."""
    if _has_attributes(value):
        unit = _unit_of(value.data)
        return value.attrs.get("units") or None if unit is None else unit
    unit = getattr(value, "units", None)
    return getattr(value, "unit", None) if unit is None else unit


def without_unit(value: Any, field: str) -> Any:
    """Value without a unit; raises an error for a quantity."""
    unit = _unit_of(value)
    if unit is not None and str(unit).strip() not in _UNITLESS:
        raise ParameterError(field, value, f"numbers without a unit, not in {str(unit)!r}")
    return value


def _has_attributes(value: object) -> bool:
    """Whether a value is an array of xarray, with the attribute ``units``."""
    return hasattr(value, "dims") and hasattr(value, "attrs")


def _values_of_quantity(
    value: Any, given: str, unit: str, field: str, allowed: str
) -> NDArray[float64]:
    """Numbers of a quantity by its own conversion, or of a labelled array. [unit]"""
    import numpy as np

    if given in _UNITLESS and unit == "deg":
        raise ParameterError(field, value, f"{allowed}; {given!r} is not a unit of an angle")
    if _has_attributes(value):
        if _unit_of(value.data) is not None:
            return values_in(value.data, unit, field, allowed=allowed)
        return np.asarray(value.data, np.float64) * _labelled_factor(given, unit, field, allowed)
    try:
        found = value.to(_product(unit))
        plain = found.magnitude if hasattr(found, "magnitude") else found.value
        return np.asarray(plain, np.float64)
    except Exception as error:  # each package has its own
        reason = f"{given!r} is a unit of something else"
        raise ParameterError(field, value, f"{allowed}; {reason}") from error


def _labelled_factor(given: str, unit: str, field: str, allowed: str) -> float:
    """Factor of a labelled array's unit in CF notation: ``W m-2 nm-1``."""
    text = "degree" if _CF_DEGREES.fullmatch(given) else with_powers(given)
    if text == unit or (text in _UNITLESS and unit == "1"):
        return 1.0
    return _parse(f"1 {text}", unit, f"units of {field}", allowed)[0]


def with_powers(unit: str) -> str:
    """Unit with explicit powers.

    Examples
    --------
    >>> with_powers("W m-2 nm-1")
    'W m^-2 nm^-1'
    """
    return re.sub(r"([A-Za-zµμÅ])(-?[1-9])", r"\1^\2", unit)


def _product(unit: str) -> str:
    """Unit in a notation common to pint, astropy and unyt: ``W*m**-2*nm**-1`` for ``W/m^2/nm``."""
    top, *below = unit.split("/")
    parts = [] if top in ("1", "") else [top.replace("^", "**")]
    for part in below:
        name, _, power = part.partition("^")
        parts.append(f"{name}**-{power or 1}")
    return "*".join(parts)


_NAME = r"[A-Za-zµμ°%Å]+(?:(?:\^|\*\*)?-?[1-9])?"
#: A number, then at most one unit: names with a one-digit power, joined by ``*``, ``/`` or a space.
#: Anything wider would let pint evaluate an expression.
_FORM = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    rf"\s*(?P<unit>(?:1?\s*/\s*)?(?:{_NAME})(?:\s*[*/ ]\s*{_NAME})*)?\s*"
)


#: A number and what follows it, of a text that ``_FORM`` does not read.
_BEGUN: Final = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*(?P<rest>\D.*?)\s*")
#: Characters with which no unit begins.
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
    except Exception as error:  # pint raises many kinds, including its tokenizer's
        kind = type(error).__name__
        if kind == "UndefinedUnitError":
            allowed = f"{allowed}; the unit {given!r} is not known"
        elif kind == "DimensionalityError":
            allowed = f"{allowed}; {given!r} is a unit of something else"
        else:  # a scale with an offset, such as degC
            allowed = f"{allowed}; {given!r} is not a multiple of it"
        raise ParameterError(field, text, allowed) from error


@cache
def _factor(given: str, unit: str) -> float:
    """Conversion factor between two units; errors of pint if there is none."""
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
    """Factor to SI and dimension of a product of common units; None if unknown."""
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
    text: Measures, unit: str, field: str = "value", *, bare: bool = False, allowed: str = ""
) -> list[float]:
    """Numbers in a unit, from a list of numbers with units.

    Accepts a quantity, a list or array of quantities, or a text with commas whose last unit applies
    to items without one: ``"680, 550, 440 nm"``. ``bare`` and ``allowed`` as for ``quantity``.

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
    elif isinstance(text, (list, tuple)) or getattr(text, "ndim", 0) == 1:
        items = list(text)  # type: ignore[arg-type]
    else:
        items = [text]
    if not items:
        raise ParameterError(field, text, "at least one number")
    names = [field] if len(items) == 1 else [f"{field}[{index}]" for index in range(len(items))]
    return [
        quantity(item, unit, name, bare=bare, allowed=allowed)
        for item, name in zip(items, names, strict=True)
    ]


def _with_unit(item: str, unit: str) -> str:
    match = _FORM.fullmatch(item)
    return f"{item} {unit}" if match is not None and match["unit"] is None else item

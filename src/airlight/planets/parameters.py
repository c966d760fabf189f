"""Parameter objects: frozen, keyword only, validated when created, with one-line errors."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from typing import Any, TypeVar, dataclass_transform

import numpy as np
import pydantic
import pydantic.dataclasses
from pydantic import BeforeValidator, ValidationInfo

from airlight.errors import ParameterError, ParameterErrors
from airlight.physics.units import quantity

Class = TypeVar("Class", bound=type[Any])
Instance = TypeVar("Instance")


class _Missing:
    """Marker of a missing value in errors."""

    def __repr__(self) -> str:
        return "missing"


#: Value of a missing field in errors.
MISSING = _Missing()


@dataclass_transform(frozen_default=True, kw_only_default=True)
def parameters(cls: Class) -> Class:
    """Decorator for frozen, keyword-only pydantic dataclasses that raise ``ParameterError``.

    Fields carry their range as an annotation, ``between(0.0, 1.0)``, or a declaration; relations
    between fields are checked in ``__post_init__``.
    """
    config = pydantic.ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    made: Any = pydantic.dataclasses.dataclass(frozen=True, kw_only=True, config=config)(cls)
    checked_init: Callable[..., None] = made.__init__

    def __init__(self: Any, *positional: Any, **values: Any) -> None:
        try:
            checked_init(self, *positional, **values)
        except pydantic.ValidationError as error:
            raise _parameter_error(cls.__name__, error) from None

    __init__.__doc__ = checked_init.__doc__
    made.__init__ = __init__
    return made  # type: ignore[no-any-return]


def _parameter_error(owner: str, error: pydantic.ValidationError) -> ParameterError:
    """Errors of pydantic, as one line; of a field's alternative types, the first."""
    found: dict[str, ParameterError] = {}
    for one in error.errors(include_url=False):
        field = str(one["loc"][0]) if one["loc"] else owner
        own = one.get("ctx", {}).get("error")
        if not isinstance(own, ParameterError):
            own = ParameterError(field, one.get("input"), one["msg"])
            if one["type"] == "missing":
                own = ParameterError(field, MISSING, f"a required field of {owner}")
        found.setdefault(field, own)
    first, *others = found.values()
    return ParameterErrors([first, *others]) if others else first


def replace(instance: Instance, **changes: Any) -> Instance:
    """Copy of a parameter object with some fields changed, validated.

    Parameters
    ----------
    instance : parameter object
        Parameter object: a ``Planet``, a ``Constituent``, a profile, …
    **changes
        Fields and their new values.

    Raises
    ------
    ParameterError
        If a field does not exist or the changed object is invalid.

    Examples
    --------
    >>> from airlight.planets.matter.profiles import Exponential
    >>> replace(Exponential(scale_height=8000.0), scale_height=8500.0)
    Exponential(scale_height=8500.0)
    """
    if not dataclasses.is_dataclass(instance) or isinstance(instance, type):
        raise ParameterError("instance", instance, "a parameter object such as a Planet")
    known = [field.name for field in dataclasses.fields(instance) if field.init]
    for name in changes:
        if name not in known:
            raise ParameterError(f"field of {type(instance).__name__}", name, ", ".join(known))
    return dataclasses.replace(instance, **changes)


def finite(value: Any, field: str, allowed: str = "a finite number", unit: str = "") -> float:
    """Finite float of a number or a quantity; text is rejected, as its unit is unknown."""
    if isinstance(value, (str, bytes)):
        raise ParameterError(field, value, allowed)
    return quantity(value, unit or "1", field, bare=True, allowed=allowed)


def inside(
    value: Any, field: str, low: float, high: float, unit: str, *, above: bool, below: bool
) -> float:
    """Validated value from low to high; ``above`` and ``below`` exclude the ends."""
    lower = f"more than {low:g}" if above else f"{low:g}"
    upper = f"less than {high:g}" if below else f"{high:g}"
    allowed = f"{lower} to {upper} {unit}".rstrip()
    number = finite(value, field, allowed, unit)
    if number < low or number > high or (above and number == low) or (below and number == high):
        raise ParameterError(field, value, allowed)
    return number


def between(
    low: float, high: float, unit: str = "", *, above: bool = False, below: bool = False
) -> BeforeValidator:
    """Validator of a field: a finite number in a range.

    Parameters
    ----------
    low, high : float
        Inclusive ends of the range.
    unit : str
        Unit in the error.
    above, below : bool
        Whether the lower or the upper end is excluded.
    """

    def check(value: Any, info: ValidationInfo) -> float:
        return inside(value, info.field_name or "value", low, high, unit, above=above, below=below)

    return BeforeValidator(check)


def numbers(value: Any, field: str, low: float, high: float, unit: str = "") -> tuple[float, ...]:
    """Convert a sequence of finite numbers in a range to a tuple of floats."""
    if type(value) is np.ndarray:  # no subclass that has a unit
        value = value.tolist()
    if isinstance(value, (str, bytes, dict)) or not isinstance(value, Iterable):
        raise ParameterError(
            field, value, f"a list of numbers, {low:g} to {high:g} {unit}".rstrip()
        )
    items = tuple(value)
    if all(type(item) is float for item in items):  # at once
        array = np.array(items)
        if np.all((array >= low) & (array <= high) & np.isfinite(array)):
            return items
    return tuple(
        inside(item, f"{field}[{index}]", low, high, unit, above=False, below=False)
        for index, item in enumerate(items)
    )


def all_between(low: float, high: float, unit: str = "") -> BeforeValidator:
    """Validator of a field: a list of finite numbers, each in a range."""

    def check(value: Any, info: ValidationInfo) -> tuple[float, ...]:
        return numbers(value, info.field_name or "value", low, high, unit)

    return BeforeValidator(check)


def ascending(values: tuple[float, ...], field: str, unit: str = "") -> None:
    """Raise an error for a list that is not strictly ascending."""
    for index in range(1, len(values)):
        if values[index] <= values[index - 1]:
            raise ParameterError(
                f"{field}[{index}]",
                values[index],
                f"more than the previous value, {values[index - 1]:g} {unit}".rstrip(),
            )


def instance_of(*classes: type[Any]) -> BeforeValidator:
    """Validator of a field: an object of one of the classes."""

    def check(value: Any, info: ValidationInfo) -> Any:
        if not isinstance(value, classes):
            names = ", ".join(cls.__name__ for cls in classes)
            raise ParameterError(info.field_name or "value", value, f"one of {names}")
        return value

    return BeforeValidator(check)


def one_of(*words: str) -> BeforeValidator:
    """Validator of a field: a word from a list."""

    def check(value: Any, info: ValidationInfo) -> Any:
        if value not in words:
            raise ParameterError(info.field_name or "value", value, " or ".join(map(repr, words)))
        return value

    return BeforeValidator(check)

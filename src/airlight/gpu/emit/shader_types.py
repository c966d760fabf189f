"""What the emitter knows of a value: its type, or the table or constant that it stands for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True)
class Scalar:
    """A number at run time, or four wavelengths of one.

    Attributes
    ----------
    name : str
        ``f32``, ``i32``, ``bool`` or ``vec4f``.
    """

    name: str


F32: Final = Scalar("f32")
I32: Final = Scalar("i32")
BOOL: Final = Scalar("bool")
VEC4: Final = Scalar("vec4f")


@dataclass(frozen=True)
class Constant:
    """A number known when the shader is written."""

    value: float | int | bool


@dataclass(frozen=True)
class Uniform:
    """A number that the shader finds in a uniform, where all numbers are floats.

    Attributes
    ----------
    text : str
        The expression of the float, the same in all languages of shaders.
    scalar : Scalar
        Type that it stands for: whole numbers are rounded off, and a switch is on above a half.
    """

    text: str
    scalar: Scalar = F32


@dataclass(frozen=True)
class Table:
    """An array that is read only, in a texture.

    The shader's function ``read_NAME(index)`` gives an element, ``size_NAME(axis)`` the length of
    an axis.

    Attributes
    ----------
    name : str
    rank : int
        Number of axes.
    spectral : bool
        Whether an element is four wavelengths rather than one number.
    """

    name: str
    rank: int = 1
    spectral: bool = False

    @property
    def element(self) -> Scalar:
        """The type of an element."""
        return VEC4 if self.spectral else F32


@dataclass(frozen=True)
class Room:
    """An array of the function itself, or of its caller.

    Attributes
    ----------
    size : int
        Number of elements.
    element : Scalar
        Their type.
    variable : str
        Of the module, where a language keeps arrays there.
    """

    size: int
    element: Scalar = F32
    variable: str = ""

    @property
    def name(self) -> str:
        """Name of the type, for messages."""
        return f"array<{self.element.name}, {self.size}>"


@dataclass(frozen=True)
class Bundle:
    """A NamedTuple whose fields are bound when the shader is written.

    Attributes
    ----------
    fields : mapping from str to Value
        In the order of the tuple.
    """

    fields: Mapping[str, Value]

    def __hash__(self) -> int:
        return hash(tuple(self.fields.items()))


@dataclass(frozen=True)
class Several:
    """A tuple of values, as functions return them."""

    items: tuple[Scalar, ...]

    @property
    def name(self) -> str:
        """Name of the struct that stands for it."""
        return "Several_" + "_".join(item.name for item in self.items)


Value = Scalar | Constant | Uniform | Table | Room | Bundle | Several


def run_time(value: Value) -> Scalar | Room | Several:
    """The type that a value has in the shader.

    Parameters
    ----------
    value : Value

    Raises
    ------
    TypeError
        If it is a table or a bundle.
    """
    if isinstance(value, Uniform):
        return value.scalar
    if isinstance(value, Constant):
        if isinstance(value.value, bool):
            return BOOL
        return I32 if isinstance(value.value, int) else F32
    if isinstance(value, (Scalar, Room, Several)):
        return value
    raise TypeError(value)


def joined(first: Scalar, second: Scalar) -> Scalar:
    """The type of a sum of two numbers.

    Parameters
    ----------
    first, second : Scalar
        Not bool.
    """
    if VEC4 in (first, second):
        return VEC4
    if F32 in (first, second):
        return F32
    return first

"""Emission-time values: types, constants, uniforms, tables, arrays and structs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

#: Number of texels in a row of a flat texture, and its binary logarithm: texel i is in column
#: i & (FLAT_WIDTH - 1) of row i >> FLAT_SHIFT.
FLAT_SHIFT: Final = 11
FLAT_WIDTH: Final = 1 << FLAT_SHIFT
#: The same of a texture of packed texels, which holds a map of 7000 by 3500.
PACKED_SHIFT: Final = 12
PACKED_WIDTH: Final = 1 << PACKED_SHIFT


@dataclass(frozen=True)
class Scalar:
    """Run-time scalar, or vector of four wavelengths.

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
#: Types of the fields of a NamedTuple.
SCALARS: Final = {float: F32, int: I32, bool: BOOL}


@dataclass(frozen=True)
class Constant:
    """Compile-time constant."""

    value: float | int | bool


@dataclass(frozen=True)
class ConstantFunction:
    """Kernel or inlined function as an argument, known at emission."""

    function: Callable[..., Any]


@dataclass(frozen=True)
class UniformValue:
    """Field of the uniform struct, stored as float.

    Attributes
    ----------
    text : str
        Field expression, the same in all shading languages.
    scalar : Scalar
        Represented type: integers are truncated, booleans are true above 0.5.
    """

    text: str
    scalar: Scalar = F32


@dataclass(frozen=True)
class ShaderTable:
    """Array in a texture, read-only; in JavaScript an object, see ``javascript``.

    ``read_NAME(index)`` returns an element, ``size_NAME_AXIS()`` an axis length.

    Attributes
    ----------
    name : str
        Name of the table.
    rank : int
        Number of axes.
    spectral : bool
        Whether elements are vectors of four wavelengths.
    image : bool
        Whether it is an image: ``read_NAME(row, column)`` returns a texel.
    """

    name: str
    rank: int = 1
    spectral: bool = False
    image: bool = False

    @property
    def element(self) -> Scalar:
        """Type of an element."""
        return VEC4 if self.spectral else F32


@dataclass(frozen=True)
class LocalArray:
    """Local array, or array parameter.

    Attributes
    ----------
    size : int
        Number of elements.
    element : Scalar
        Type of the elements.
    variable : str
        Module variable, in languages with module arrays.
    columns : int
        Length of the second of two axes; 0 with one axis.
    """

    size: int
    element: Scalar = F32
    variable: str = ""
    columns: int = 0

    @property
    def name(self) -> str:
        """Name of the type, for error messages."""
        return f"array<{self.element.name}, {self.size}>"


@dataclass(frozen=True)
class StructValue:
    """NamedTuple with fields bound at emission.

    Attributes
    ----------
    fields : mapping from str to Value
        Fields in the order of the tuple.
    vector : TupleType, optional
        Type as which a vector, whose fields are all numbers, is passed at run time.
    """

    fields: Mapping[str, Value]
    vector: TupleType | None = None

    def __hash__(self) -> int:
        return hash(tuple(self.fields.items()))


@dataclass(frozen=True)
class TupleType:
    """Type of a tuple, or of a NamedTuple that a function makes.

    Attributes
    ----------
    items : tuple of Scalar or TupleType
        Types of the members.
    label : str
        Name of the NamedTuple.
    fields : tuple of str
        Its fields.
    """

    items: tuple[Scalar | TupleType, ...]
    label: str = ""
    fields: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of its struct."""
        return self.label or "Tuple_" + "_".join(item.name for item in self.items)


#: ``geometry.vectors.Vec3``, for which shading languages have a type of their own.
VEC3: Final = TupleType((F32, F32, F32), "Vec3", ("x", "y", "z"))

Value = (
    Scalar
    | Constant
    | ConstantFunction
    | UniformValue
    | ShaderTable
    | LocalArray
    | StructValue
    | TupleType
)


def run_time(value: Value) -> Scalar | LocalArray | TupleType:
    """Run-time type of a value.

    Parameters
    ----------
    value : Value
        Emission-time value.
    """
    if isinstance(value, UniformValue):
        return value.scalar
    if isinstance(value, Constant):
        if isinstance(value.value, bool):
            return BOOL
        return I32 if isinstance(value.value, int) else F32
    if isinstance(value, (Scalar, LocalArray, TupleType)):
        return value
    raise TypeError(value)


def joined(first: Scalar, second: Scalar) -> Scalar:
    """Promoted type of an arithmetic operation.

    Parameters
    ----------
    first, second : Scalar
        Types other than bool.
    """
    if VEC4 in (first, second):
        return VEC4
    if F32 in (first, second):
        return F32
    return first

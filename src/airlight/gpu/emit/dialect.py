"""Syntax in which the target languages differ: types, declarations, heads, casts, selections.

The emitter asks a ``Dialect`` wherever languages differ; what they share — operators, brackets,
``if``, ``for``, ``while``, assignments — it writes itself.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from airlight.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    VEC4,
    Constant,
    LocalArray,
    Scalar,
    StructValue,
    Table,
    TupleType,
    Value,
)

#: A name and its type.
Named = tuple[str, Scalar | LocalArray | TupleType | Table]


class Dialect(ABC):
    """Target language of the emitter.

    Attributes
    ----------
    name : str
        Name of the language.
    reserved : frozenset of str
        Keywords of the language, and names that the emitted text calls.
    mathematics : mapping
        Names in the language by Python function, or a Python function that is emitted in its
        place.
    module_arrays : bool
        Whether arrays of a function are declared in the module, and each function is written once
        for the arrays that it is called with: for languages that would copy them.
    unrolls : bool
        Whether innermost loops are unrolled four times.
    largest : float
        Largest literal allowed.
    """

    name: ClassVar[str]
    reserved: ClassVar[frozenset[str]]
    mathematics: ClassVar[Mapping[Any, str | Callable[..., Any]]]
    module_arrays: ClassVar[bool] = False
    unrolls: ClassVar[bool] = True
    largest: ClassVar[float] = 3.4e38

    @abstractmethod
    def type_name(self, kind: Scalar | LocalArray | TupleType | Table) -> str:
        """Name of a type."""

    @abstractmethod
    def declared(self, name: str, kind: Scalar | LocalArray) -> str:
        """Declare a variable that is assigned later."""

    @abstractmethod
    def let(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        """Declare a name for a constant value."""

    @abstractmethod
    def variable(self, name: str, kind: Scalar, text: str) -> str:
        """Declare a variable with its initial value."""

    @abstractmethod
    def head(
        self, name: str, parameters: Sequence[Named], result: Scalar | TupleType | None
    ) -> str:
        """First line of a function, including the brace."""

    @abstractmethod
    def struct(self, kind: TupleType) -> str:
        """Declare the type of a tuple; empty if the language needs none."""

    @abstractmethod
    def tuple_expr(self, kind: TupleType, parts: Sequence[str]) -> str:
        """Tuple of these parts."""

    @abstractmethod
    def part(self, text: str, index: int) -> str:
        """Part of a tuple."""

    @abstractmethod
    def convert(self, text: str, wanted: Scalar) -> str:
        """Convert a number to another type."""

    @abstractmethod
    def select(self, test: str, yes: str, no: str) -> str:
        """Select one of two values."""

    @abstractmethod
    def quotient(self, first: str, second: str) -> str:
        """Quotient of integers, rounded down."""

    @abstractmethod
    def modulo(self, first: str, second: str) -> str:
        """Remainder of that quotient, with the divisor's sign."""

    def unused(self, text: str) -> str:
        """Statement that calls a function and discards its result."""
        return f"{text};"

    def array_argument(self, text: str) -> str:
        """Pass a local array as an argument."""
        return text

    def array(self, name: str, *, is_argument: bool) -> str:
        """Array as written before its index, local or passed as an argument."""
        return name

    def at_run_time(self, value: Value) -> bool:
        """Whether a value is passed when a function is called."""
        if isinstance(value, LocalArray):
            return not value.variable
        return not isinstance(value, (Constant, Table, StructValue))

    def element(self, table: str, index: str) -> str:
        """Element of a table."""
        return f"read_{table}({index})"

    def texel(self, table: str, row: str, column: str) -> str:
        """Texel of a picture."""
        return f"read_{table}({row}, {column})"

    def length(self, table: str, axis: str) -> str:
        """Length of an axis of a table."""
        return f"size_{table}_{axis}()"

    def uniform(self, text: str, kind: Scalar) -> str:
        """Convert the float in a uniform to a number of its type."""
        if kind == I32:
            return self.convert(text, I32)
        return f"({text} > 0.5)" if kind == BOOL else text


class ShaderDialect(Dialect):
    """Shading language: it also has textures, uniforms and entry points."""

    #: Integer functions that every shader needs.
    integer_functions: ClassVar[str]
    #: Vertex function of all passes: one triangle that covers the target, with the corners
    #: (-1, -1), (3, -1), (-1, 3).
    triangle: ClassVar[str]

    def quotient(self, first: str, second: str) -> str:
        """Quotient of integers, rounded down; the language's own rounds towards 0."""
        return f"floor_div({first}, {second})"

    def modulo(self, first: str, second: str) -> str:
        """Remainder of that quotient, with the divisor's sign."""
        return f"floor_mod({first}, {second})"

    @abstractmethod
    def fetch(self, texture: str, index: str, shift: int) -> str:
        """Texel of a texture with rows of 2^shift texels; the index is a name or a number."""

    @abstractmethod
    def fetch_image(self, texture: str, row: str, column: str) -> str:
        """Texel of a picture; row and column are names or numbers."""

    @abstractmethod
    def fetch_volume(self, texture: str, x: str, y: str, z: str) -> str:
        """Texel of a texture of three dimensions; the places are names or numbers."""

    @abstractmethod
    def image_length(self, texture: str, axis: str) -> str:
        """Number of rows, axis 0, or columns of a picture."""

    @abstractmethod
    def texture_name(self, name: str, group: int, binding: int) -> str:
        """Name of a texture inside functions."""

    @abstractmethod
    def texture(self, name: str, group: int, binding: int) -> str:
        """Declare a texture."""

    @abstractmethod
    def volume(self, name: str, group: int, binding: int) -> str:
        """Declare a texture of three dimensions."""

    @abstractmethod
    def uniforms(
        self, name: str, fields: Sequence[str | tuple[str, int]], group: int, binding: int
    ) -> str:
        """Declare a struct of vectors and arrays of vectors, and a uniform of that type."""

    @abstractmethod
    def fragment(self, name: str, targets: int, body: Sequence[str], results: Sequence[str]) -> str:
        """Entry point: its statements, which can read ``at``, and a vector for each target."""

    @abstractmethod
    def module(self, parts: Sequence[str]) -> str:
        """Join parts to a complete shader."""

    def function(
        self, name: str, parameters: Sequence[Named], result: Scalar, lines: Sequence[str]
    ) -> str:
        """Function whose last line is its result."""
        *before, last = lines
        body = "".join(f"  {line}\n" for line in before)
        return f"{self.head(name, parameters, result)}\n{body}  return {last};\n}}\n"


#: Names of the types in C-like languages.
PLAIN_NAMES = {F32: "float", I32: "int", BOOL: "bool", VEC4: "vec4"}

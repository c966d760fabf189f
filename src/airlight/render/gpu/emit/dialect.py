"""Dialects: syntax that differs between target languages.

The emitter writes what they share: operators, brackets, ``if``, ``for``, ``while``, assignments.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from airlight.render.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    VEC3,
    VEC4,
    Constant,
    ConstantFunction,
    LocalArray,
    Scalar,
    ShaderTable,
    StructValue,
    TupleType,
    Value,
)

#: A name and its type.
Named = tuple[str, Scalar | LocalArray | TupleType | ShaderTable]


class Dialect(ABC):
    """Target language of the emitter.

    Attributes
    ----------
    name : str
        Name of the language.
    reserved : frozenset of str
        Keywords and built-in functions in use.
    mathematics : mapping
        Built-in function by Python function, or a Python function to emit instead.
    module_arrays : bool
        Whether arrays are module variables and functions are specialised for them, for languages
        that pass arrays by value.
    unrolls : bool
        Whether innermost loops are unrolled by four.
    whole : int
        Most turns of a constant innermost loop that is unrolled as a whole.
    largest : float
        Largest literal.
    writes_tables : bool
        Whether elements of tables can be assigned.
    """

    name: ClassVar[str]
    reserved: ClassVar[frozenset[str]]
    mathematics: ClassVar[Mapping[Any, str | Callable[..., Any]]]
    module_arrays: ClassVar[bool] = False
    unrolls: ClassVar[bool] = True
    whole: ClassVar[int] = 0
    largest: ClassVar[float] = 3.4e38
    writes_tables: ClassVar[bool] = False

    @abstractmethod
    def type_name(self, kind: Scalar | LocalArray | TupleType | ShaderTable) -> str:
        """Name of a type."""

    @abstractmethod
    def declared(self, name: str, kind: Scalar | LocalArray | TupleType) -> str:
        """Declaration of an uninitialised variable."""

    def in_module(self, name: str, kind: LocalArray) -> str:
        """Declaration of an array of the module."""
        return self.declared(name, kind)

    @abstractmethod
    def let(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        """Declaration of an immutable variable."""

    @abstractmethod
    def variable(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        """Declaration of a mutable variable with its initial value."""

    @abstractmethod
    def head(
        self, name: str, parameters: Sequence[Named], result: Scalar | TupleType | None
    ) -> str:
        """Function header with the opening brace."""

    @abstractmethod
    def struct(self, kind: TupleType) -> str:
        """Declaration of the struct of a tuple; empty if the language has tuples."""

    @abstractmethod
    def tuple_expr(self, kind: TupleType, parts: Sequence[str]) -> str:
        """Tuple expression."""

    def part(self, text: str, index: int, kind: TupleType | None = None) -> str:
        """Element of a tuple; the type distinguishes a vector."""
        return f"{text}.{'xyz'[index] if kind == VEC3 else f'v{index}'}"

    @abstractmethod
    def convert(self, text: str, wanted: Scalar) -> str:
        """Conversion to another scalar type."""

    @abstractmethod
    def select(self, test: str, yes: str, no: str) -> str:
        """Selection of one of two values."""

    @abstractmethod
    def quotient(self, first: str, second: str) -> str:
        """Integer division, rounded down."""

    @abstractmethod
    def modulo(self, first: str, second: str) -> str:
        """Remainder of ``quotient``, with the sign of the divisor."""

    def unused(self, text: str) -> str:
        """Call statement with a discarded result."""
        return f"{text};"

    def array_argument(self, text: str) -> str:
        """Local array as an argument."""
        return text

    def array(self, name: str, *, is_argument: bool) -> str:
        """Array in front of an index."""
        return name

    def at_run_time(self, value: Value) -> bool:
        """Whether a value is a run-time argument."""
        if isinstance(value, LocalArray):
            return not value.variable
        return not isinstance(value, (Constant, ConstantFunction, ShaderTable, StructValue))

    def element(self, table: ShaderTable, index: str) -> str:
        """Element of a table."""
        return f"read_{table.name}({index})"

    def texel(self, table: str, row: str, column: str) -> str:
        """Texel of an image."""
        return f"read_{table}({row}, {column})"

    def length(self, table: str, axis: str) -> str:
        """Length of an axis of a table."""
        return f"size_{table}_{axis}()"

    def uniform(self, text: str, kind: Scalar) -> str:
        """Uniform, converted from float to its type."""
        if kind == I32:
            return self.convert(text, I32)
        return f"({text} > 0.5)" if kind == BOOL else text


class ShaderDialect(Dialect):
    """Shading language, with textures, uniforms and entry points."""

    #: Integer division functions of every shader.
    integer_functions: ClassVar[str]
    #: Vertex shader of all passes: one triangle (-1, -1), (3, -1), (-1, 3) that covers the target.
    triangle: ClassVar[str]

    def quotient(self, first: str, second: str) -> str:
        """Integer division, rounded down; that of the language rounds towards 0."""
        return f"floor_div({first}, {second})"

    def modulo(self, first: str, second: str) -> str:
        """Remainder of ``quotient``, with the sign of the divisor."""
        return f"floor_mod({first}, {second})"

    @abstractmethod
    def fetch(self, texture: str, index: str, shift: int) -> str:
        """Texel fetch by flat index (a simple expression), with rows of 2^shift texels."""

    @abstractmethod
    def fetch_image(self, texture: str, row: str, column: str) -> str:
        """Texel fetch from an image; row and column are simple expressions."""

    @abstractmethod
    def fetch_volume(self, texture: str, x: str, y: str, z: str) -> str:
        """Texel fetch from a 3-D texture; the indices are simple expressions."""

    @abstractmethod
    def image_length(self, texture: str, axis: str) -> str:
        """Number of rows (axis 0) or columns of an image."""

    @abstractmethod
    def texture_name(self, name: str, group: int, binding: int) -> str:
        """Identifier of a texture."""

    @abstractmethod
    def texture(self, name: str, group: int, binding: int) -> str:
        """Declaration of a texture."""

    @abstractmethod
    def uniforms(
        self, name: str, fields: Sequence[str | tuple[str, int]], group: int, binding: int
    ) -> str:
        """Declaration of a uniform struct of vectors and vector arrays."""

    @abstractmethod
    def fragment(self, name: str, targets: int, body: Sequence[str], results: Sequence[str]) -> str:
        """Fragment entry point: statements, with the texel ``at``, and a vector for each target."""

    @abstractmethod
    def module(self, parts: Sequence[str]) -> str:
        """Complete shader from its parts."""

    def function(
        self, name: str, parameters: Sequence[Named], result: Scalar, lines: Sequence[str]
    ) -> str:
        """Function whose last line is its result expression."""
        *before, last = lines
        body = "".join(f"  {line}\n" for line in before)
        return f"{self.head(name, parameters, result)}\n{body}  return {last};\n}}\n"


#: Type names in GLSL and HLSL.
PLAIN_NAMES = {F32: "float", I32: "int", BOOL: "bool", VEC4: "vec4", VEC3: "vec3"}

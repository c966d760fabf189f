"""What a language needs to say the same function: types, declarations, heads, casts, choices.

A ``Dialect`` is asked wherever languages differ; what they share — operators, brackets, ``if``,
``for``, ``while``, assignments — the emitter writes itself.
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
    Bundle,
    Constant,
    Room,
    Scalar,
    Several,
    Table,
    Value,
)

#: A name and its type.
Named = tuple[str, Scalar | Room | Several | Table]


class Dialect(ABC):
    """A language that functions are written in.

    Attributes
    ----------
    name : str
        Of the language.
    reserved : frozenset of str
        Names that the language keeps for itself, or that its text calls.
    mathematics : mapping
        From Python's functions to the language's names, or to a Python function that is emitted
        in their place.
    module_arrays : bool
        Whether arrays of a function stand in the module, each function being written once for
        the arrays that it is called with: for languages that would copy them.
    unrolls : bool
        Whether innermost loops are written four turns at a time.
    largest : float
        No literal may be larger.
    """

    name: ClassVar[str]
    reserved: ClassVar[frozenset[str]]
    mathematics: ClassVar[Mapping[Any, str | Callable[..., Any]]]
    module_arrays: ClassVar[bool] = False
    unrolls: ClassVar[bool] = True
    largest: ClassVar[float] = 3.4e38

    @abstractmethod
    def type_name(self, kind: Scalar | Room | Several | Table) -> str:
        """Name of a type."""

    @abstractmethod
    def declared(self, name: str, kind: Scalar | Room) -> str:
        """Declare a variable that is assigned to later."""

    @abstractmethod
    def kept(self, name: str, kind: Scalar | Several, text: str) -> str:
        """Declare a name for a value that does not change."""

    @abstractmethod
    def variable(self, name: str, kind: Scalar, text: str) -> str:
        """Declare a variable with its first value."""

    @abstractmethod
    def head(self, name: str, parameters: Sequence[Named], result: Scalar | Several | None) -> str:
        """First line of a function, up to the brace."""

    @abstractmethod
    def struct(self, kind: Several) -> str:
        """Declare the type of a tuple; empty where it needs none."""

    @abstractmethod
    def several(self, kind: Several, parts: Sequence[str]) -> str:
        """A tuple of these parts."""

    @abstractmethod
    def part(self, text: str, index: int) -> str:
        """Part of a tuple."""

    @abstractmethod
    def converted(self, text: str, wanted: Scalar) -> str:
        """A number as another type of number."""

    @abstractmethod
    def chosen(self, test: str, yes: str, no: str) -> str:
        """One of two values."""

    @abstractmethod
    def quotient(self, first: str, second: str) -> str:
        """Quotient of whole numbers, rounded down."""

    @abstractmethod
    def rest(self, first: str, second: str) -> str:
        """Rest of that quotient, of the divisor's sign."""

    def unused(self, text: str) -> str:
        """A call whose result nobody wants, as a statement."""
        return f"{text};"

    def array_argument(self, text: str) -> str:
        """An array of this function, handed over."""
        return text

    def array(self, name: str, *, handed_over: bool) -> str:
        """An array as it stands before its index, of this function or handed over to it."""
        return name

    def at_run_time(self, value: Value) -> bool:
        """Whether a value is handed over when a function is called."""
        if isinstance(value, Room):
            return not value.variable
        return not isinstance(value, (Constant, Table, Bundle))

    def element(self, table: str, index: str) -> str:
        """Element of a table."""
        return f"read_{table}({index})"

    def length(self, table: str, axis: str) -> str:
        """Length of an axis of a table."""
        return f"size_{table}({axis})"

    def uniform(self, text: str, kind: Scalar) -> str:
        """A number that stands in a uniform as a float."""
        if kind == I32:
            return self.converted(text, I32)
        return f"({text} > 0.5)" if kind == BOOL else text


class ShaderDialect(Dialect):
    """A language of shaders: it has textures, uniforms and entry points too."""

    #: Functions of whole numbers that every shader needs.
    whole_numbers: ClassVar[str]
    #: The vertex function of all passes: one triangle that covers the target, whose corners are
    #: (-1, -1), (3, -1), (-1, 3).
    triangle: ClassVar[str]

    def quotient(self, first: str, second: str) -> str:
        """Quotient of whole numbers, rounded down; the language's own goes towards 0."""
        return f"whole_quotient({first}, {second})"

    def rest(self, first: str, second: str) -> str:
        """Rest of that quotient, of the divisor's sign."""
        return f"whole_rest({first}, {second})"

    @abstractmethod
    def fetched(self, texture: str, index: str) -> str:
        """Texel of a flat texture; the index is a name or a number."""

    @abstractmethod
    def texture_name(self, name: str, group: int, binding: int) -> str:
        """Name by which functions know a texture."""

    @abstractmethod
    def texture(self, name: str, group: int, binding: int) -> str:
        """Declare a texture."""

    @abstractmethod
    def uniforms(
        self, name: str, fields: Sequence[str | tuple[str, int]], group: int, binding: int
    ) -> str:
        """Declare a struct of vectors, some of them arrays of so many, and the uniform of it."""

    @abstractmethod
    def fragment(self, name: str, targets: int, body: Sequence[str], results: Sequence[str]) -> str:
        """An entry point: its statements, which know ``at``, and a vector for each target."""

    @abstractmethod
    def module(self, parts: Sequence[str]) -> str:
        """A whole shader of its parts."""

    def function(
        self, name: str, parameters: Sequence[Named], result: Scalar, lines: Sequence[str]
    ) -> str:
        """A function whose last line is its result."""
        *before, last = lines
        body = "".join(f"  {line}\n" for line in before)
        return f"{self.head(name, parameters, result)}\n{body}  return {last};\n}}\n"


#: Types by their names in C's languages.
PLAIN_NAMES = {F32: "float", I32: "int", BOOL: "bool", VEC4: "vec4"}

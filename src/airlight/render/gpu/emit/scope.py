"""Scope of a function in restricted Python: types of variables, constants and constant folding.

Parameters and variables have types; module constants, tables, struct values and boolean constants
are known at emission, and conditions on them are folded.
"""

from __future__ import annotations

import ast
import inspect
import math
from collections.abc import Callable, Sequence
from typing import Any, Final, Protocol

import numpy as np

from airlight.errors import AirlightError
from airlight.kernel import lanes as lane_module
from airlight.kernel.tuple_item import tuple_item
from airlight.render.gpu.emit.dialect import Dialect, Named
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    VEC4,
    Constant,
    LocalArray,
    Scalar,
    ShaderTable,
    StructValue,
    TupleType,
    UniformValue,
    Value,
    joined,
    run_time,
)

#: Python's comparison operators, the same in all target languages.
COMPARISONS: Final[dict[type[ast.cmpop], str]] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}


class SubsetError(AirlightError):
    """Construct outside the Python subset, with file, line and reason."""


class Callee(Protocol):
    """Emitted function; see ``statements.Emitted``."""

    name: str
    parameters: tuple[tuple[str, Value], ...]
    result: Scalar | TupleType | None

    def argument_lists(self, dialect: Dialect) -> list[list[Named]]:
        """Run-time arguments of each parameter: names and types."""


class Functions(Protocol):
    """Interface of ``emitter.Emitter`` for emitting callees."""

    @property
    def dialect(self) -> Dialect:
        """Target language."""

    @property
    def taken(self) -> set[str]:
        """Function names in use."""

    def add(self, function: Callable[..., Any], *arguments: Value) -> Callee:
        """Emit a function."""

    def tuple_type(self, items: Sequence[Scalar | TupleType]) -> TupleType:
        """Struct that represents a tuple."""

    def record_type(self, kind: Any) -> TupleType:
        """Struct that represents a NamedTuple."""

    def module_array(self, name: str, kind: LocalArray) -> LocalArray:
        """Array declared in the module."""


class Scope:
    """Scope of one function: values and types of its names.

    Parameters
    ----------
    emitter : Functions
        Emitter of the functions that are called.
    function : callable
        Plain Python function; its module provides the constants.
    names : dict from str to Value
        Values and types of the parameters; variables are added on assignment.
    arrays : set of str
        Receives the arrays of struct values in use; see ``statements.Emitted``.
    """

    def __init__(
        self,
        emitter: Functions,
        function: Callable[..., Any],
        names: dict[str, Value],
        arrays: set[str],
    ) -> None:
        self.emitter, self.function, self.names, self.arrays = emitter, function, names, arrays
        self.dialect = emitter.dialect
        closure = inspect.getclosurevars(function)
        self.globals = {**function.__globals__, **closure.nonlocals}
        self.first_line = function.__code__.co_firstlineno

    def refuse(self, node: ast.AST, why: str) -> SubsetError:
        """Error for a node: file, line, source text and reason."""
        line = self.first_line + getattr(node, "lineno", 1) - 1
        text = " ".join(ast.unparse(node).split())[:80]
        return SubsetError(f"{self.function.__code__.co_filename}:{line}: {text!r}: {why}")

    def mangle(self, name: str) -> str:
        """Identifier in the target language for a Python name."""
        taken = name in self.dialect.reserved or name in self.emitter.taken
        return f"{name}_1" if taken else name.lstrip("_")

    def declare(self, node: ast.AST, name: str, found: Value) -> None:
        """Set the type of a variable, promoted if it already has one."""
        for twin in {name.lstrip("_"), f"_{name}"} - {name}:
            if twin in self.names:
                raise self.refuse(node, f"{name} and {twin} are one name in shaders")
        before = self.names.get(name)
        if isinstance(before, StructValue) and isinstance(found, StructValue):
            before = None  # items of a tuple, one after another
        if isinstance(before, UniformValue):
            before = before.scalar
        if isinstance(before, Constant):
            before = run_time(before)
        if before is None or before == found:
            self.names[name] = found
        elif (
            isinstance(before, Scalar)
            and isinstance(found, Scalar)
            and BOOL
            not in (
                before,
                found,
            )
        ):
            self.names[name] = joined(before, found)
        else:
            raise self.refuse(node, f"{name} was {before} and would be {found}")

    def literal(self, node: ast.AST, value: float | int | bool) -> str:
        """Literal of a number."""
        if isinstance(value, (bool, np.bool_)):
            return "true" if value else "false"
        if isinstance(value, (int, np.integer)):
            return str(int(value))
        if not math.isfinite(value) or abs(value) > self.dialect.largest:
            raise self.refuse(node, "is out of the range of single precision")
        if 0.0 < abs(value) < 1.2e-38:
            return "0.0"
        text = repr(float(value))
        return text if any(mark in text for mark in ".en") else f"{text}.0"

    def cast(self, text: str, found: Value | None, wanted: Scalar | TupleType) -> str:
        """Expression with an implicit conversion to another type."""
        if found == wanted:
            return text
        if found is None or isinstance(found, (ShaderTable, StructValue, LocalArray, TupleType)):
            raise SubsetError(f"{self.function.__qualname__}: {text} is not a number")
        kind = run_time(found)
        if kind == wanted:
            return text
        if wanted == F32 and kind in (I32, BOOL):
            if isinstance(found, Constant):
                return f"{float(found.value)!r}"
            return self.dialect.convert(text, F32)
        if wanted == VEC4 and kind in (F32, I32):
            return self.dialect.convert(self.cast(text, found, F32), VEC4)
        raise SubsetError(f"{self.function.__qualname__}: {text} is {kind}, not {wanted}")

    def known(self, node: ast.expr) -> bool | None:
        """Constant value of a condition; None if it is not constant."""
        value = self.fold(node)
        return None if value is None else bool(value)

    def fold(self, node: ast.expr) -> float | int | bool | None:
        """Value of a constant expression; None if it is not constant."""
        match node:
            case ast.Constant(value=bool() | int() | float() as value):
                return value
            case ast.Name() | ast.Attribute():
                found = self.bound(node)
                return found.value if isinstance(found, Constant) else None
            case ast.Call(func=ast.Name(id="len"), args=[several]):
                members = self.bound(several)
                return len(members.fields) if isinstance(members, StructValue) else None
            case ast.UnaryOp(op=op, operand=operand):
                inside = self.fold(operand)
                if inside is None:
                    return None
                return -inside if isinstance(op, ast.USub) else not inside
            case ast.BinOp(left=left, op=op, right=right):
                first, second = self.fold(left), self.fold(right)
                if first is None or second is None:
                    return None
                operation = {
                    ast.Add: lambda a, b: a + b,
                    ast.Sub: lambda a, b: a - b,
                    ast.Mult: lambda a, b: a * b,
                    ast.Div: lambda a, b: a / b,
                    ast.FloorDiv: lambda a, b: a // b,
                    ast.Mod: lambda a, b: a % b,
                    ast.Pow: lambda a, b: a**b,
                }.get(type(op))
                return None if operation is None else operation(first, second)
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                first, second = self.fold(left), self.fold(right)
                if first is None or second is None:
                    return None
                sign = COMPARISONS.get(type(op))
                return {
                    "<": first < second,
                    "<=": first <= second,
                    ">": first > second,
                    ">=": first >= second,
                    "==": first == second,
                    "!=": first != second,
                }.get(sign or "")
            case ast.BoolOp(op=op, values=values):
                folded = [self.fold(one) for one in values]
                decided = isinstance(op, ast.Or)
                if any(one is not None and bool(one) == decided for one in folded):
                    return decided
                return None if None in folded else not decided
        return None

    def bound(self, node: ast.expr) -> Any:
        """Value, function or module bound to a name or attribute; None if unknown."""
        if isinstance(node, ast.Name):
            if node.id in self.names:
                return self.names[node.id]
            if node.id == "LANES" and self.globals.get("LANES") == lane_module.LANES:
                return Constant(1)
            found = self.globals.get(node.id, _builtin(node.id))
            if isinstance(found, (bool, int, float, np.floating, np.integer)):
                return Constant(found.item() if isinstance(found, np.generic) else found)
            return found
        if isinstance(node, ast.Attribute):
            owner = self.bound(node.value)
            if isinstance(owner, StructValue):
                return owner.fields.get(node.attr)
            if isinstance(owner, TupleType) and node.attr in owner.fields:
                return owner.items[owner.fields.index(node.attr)]
            if isinstance(owner, LocalArray) and node.attr == "size":
                return Constant(owner.size)
            if inspect.ismodule(owner):
                found = getattr(owner, node.attr, None)
                if isinstance(found, float):
                    return Constant(found)
                return found
        if isinstance(node, ast.Call) and self.bound(node.func) is tuple_item:
            several, index = self.bound(node.args[0]), self.fold(node.args[1])
            if isinstance(several, StructValue):
                return several.fields.get(str(index))
        return None


def _builtin(name: str) -> Any:
    return {"min": min, "max": max, "abs": abs, "int": int, "float": float, "range": range}.get(
        name
    )

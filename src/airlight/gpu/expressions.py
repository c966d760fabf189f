"""Expressions of restricted Python as WGSL text, with their types."""

from __future__ import annotations

import ast
import inspect
import math
import re
from collections.abc import Callable, Sequence
from typing import Any, Final, Protocol

import numpy as np

from airlight.errors import AirlightError
from airlight.gpu.shader_types import (
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
    Uniform,
    Value,
    joined,
    run_time,
)
from airlight.kernel import lanes as lane_module

#: Python's mathematics in WGSL; those that the prelude brings are good to float32.
_MATH: Final[dict[Any, str]] = {
    math.sqrt: "sqrt", math.exp: "exp", math.log: "log", math.log2: "log2",
    math.sin: "sine", math.cos: "cosine", math.tan: "tan",
    math.acos: "arc_cosine", math.asin: "arc_sine", math.atan: "arc_tangent",
    math.atan2: "angle_of",
}  # fmt: skip
#: What ``airlight.kernel.lanes`` offers to a shader.
_LANE_CALLS: Final = (
    "load", "store", "splat", "exponential", "maximum", "minimum", "fourth_root",
)  # fmt: skip
_OPERATORS: Final[dict[type[ast.operator], str]] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
}
_COMPARISONS: Final[dict[type[ast.cmpop], str]] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
#: Names that WGSL or GLSL keep for themselves, or that the shader calls.
_TAKEN: Final = frozenset(
    re.findall(
        r"\w+",
        """
    abs acos all angle_of any arc_cosine arc_sine arc_tangent array asin atan atan2 bool break
    case ceil clamp const continue cos cosine
    cross cubed default degrees discard distance do dot else enum exp exp2 f16 f32 false field
    floor fn for fract i32 if in inout input int float inverse inverseSqrt layout length let log
    log2 loop main max min mix mod normalize out output override pow precision radians reflect
    refract return round sample sampler select shared sign sin sine smooth sqrt squared step
    struct switch tan texture trunc true u32 uniform var vec4f while active centroid common
    whole_quotient whole_rest
    filter half fixed image interface packed partition public static superp target template this
    union unsigned using volatile highp lowp mediump flat buffer texel
    """,
    )
)


class SubsetError(AirlightError):
    """A function that has no WGSL: names file, line and reason."""


class Callee(Protocol):
    """A function as it stands in the shader; see ``emitter.Emitted``."""

    name: str
    parameters: tuple[tuple[str, Value], ...]
    result: Scalar | Several | None


class Functions(Protocol):
    """Emits what is called; see ``emitter.Emitter``."""

    @property
    def taken(self) -> set[str]:
        """Names of functions."""

    def add(self, function: Callable[..., Any], *arguments: Value) -> Callee:
        """Emit a function."""

    def tuple_type(self, items: Sequence[Scalar]) -> Several:
        """The struct that stands for a tuple."""


class Expressions:
    """Writes the expressions of one function.

    Parameters
    ----------
    emitter : Functions
        Emits what is called.
    function : callable
        Plain Python: its module gives the constants.
    names : dict from str to Value
        What is known of the parameters; variables are added as they are met.
    """

    def __init__(
        self, emitter: Functions, function: Callable[..., Any], names: dict[str, Value]
    ) -> None:
        self.emitter, self.function, self.names = emitter, function, names
        closure = inspect.getclosurevars(function)
        self.globals = {**function.__globals__, **closure.nonlocals}
        self.first_line = function.__code__.co_firstlineno

    def refuse(self, node: ast.AST, why: str) -> SubsetError:
        """The error for a node: file, line, what stands there, and why it cannot be."""
        line = self.first_line + getattr(node, "lineno", 1) - 1
        text = " ".join(ast.unparse(node).split())[:80]
        return SubsetError(f"{self.function.__code__.co_filename}:{line}: {text!r}: {why}")

    def spelled(self, name: str) -> str:
        """A Python name as it may stand in WGSL."""
        return f"{name}_1" if name in _TAKEN or name in self.emitter.taken else name.lstrip("_")

    def learn(self, node: ast.AST, name: str, found: Value) -> None:
        """A name was assigned to: remember its type, the wider one of two."""
        before = self.names.get(name)
        if isinstance(before, Uniform):
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
        """A number in WGSL."""
        if isinstance(value, (bool, np.bool_)):
            return "true" if value else "false"
        if isinstance(value, (int, np.integer)):
            return str(int(value))
        if not math.isfinite(value) or abs(value) > 3.4e38:
            raise self.refuse(node, "is no number of single precision")
        if 0.0 < abs(value) < 1.2e-38:
            return "0.0"
        text = repr(float(value))
        return text if any(mark in text for mark in ".en") else f"{text}.0"

    def cast(self, text: str, found: Value | None, wanted: Scalar) -> str:
        """Text of a type as another one, where Python would do so by itself."""
        if found is None or isinstance(found, (Table, Bundle, Room, Several)):
            raise SubsetError(f"{self.function.__qualname__}: {text} is no number")
        kind = run_time(found)
        if kind == wanted:
            return text
        if wanted == F32 and kind in (I32, BOOL):
            if isinstance(found, Constant):
                return f"{float(found.value)!r}"
            return f"f32({text})"
        if wanted == VEC4 and kind in (F32, I32):
            return f"vec4f({self.cast(text, found, F32)})"
        raise SubsetError(f"{self.function.__qualname__}: {text} is {kind}, not {wanted}")

    def as_scalar(self, node: ast.expr, wanted: Scalar) -> str:
        """An expression as a number of a type."""
        text, found = self.write(node)
        try:
            return self.cast(text, found, wanted)
        except SubsetError:
            raise self.refuse(node, f"is no {wanted.name}") from None

    def known(self, node: ast.expr) -> bool | None:
        """What a condition is, if the emitter can tell."""
        value = self.fold(node)
        return None if value is None else bool(value)

    def fold(self, node: ast.expr) -> float | int | bool | None:
        """The value of an expression of constants, or None."""
        match node:
            case ast.Constant(value=bool() | int() | float() as value):
                return value
            case ast.Name() | ast.Attribute():
                found = self.bound(node)
                return found.value if isinstance(found, Constant) else None
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
                    ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b,
                    ast.Mult: lambda a, b: a * b, ast.Div: lambda a, b: a / b,
                    ast.FloorDiv: lambda a, b: a // b, ast.Mod: lambda a, b: a % b,
                    ast.Pow: lambda a, b: a**b,
                }.get(type(op))  # fmt: skip
                return None if operation is None else operation(first, second)
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                first, second = self.fold(left), self.fold(right)
                if first is None or second is None:
                    return None
                sign = _COMPARISONS.get(type(op))
                return {
                    "<": first < second, "<=": first <= second, ">": first > second,
                    ">=": first >= second, "==": first == second, "!=": first != second,
                }.get(sign or "")  # fmt: skip
            case ast.BoolOp(op=op, values=values):
                folded = [self.fold(one) for one in values]
                decided = isinstance(op, ast.Or)
                if any(one is not None and bool(one) == decided for one in folded):
                    return decided
                return None if None in folded else not decided
        return None

    def bound(self, node: ast.expr) -> Any:
        """What a name or attribute stands for: a Value, a function, a module; None if unknown."""
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
            if isinstance(owner, Bundle):
                return owner.fields.get(node.attr)
            if isinstance(owner, Room) and node.attr == "size":
                return Constant(owner.size)
            if inspect.ismodule(owner):
                found = getattr(owner, node.attr, None)
                if isinstance(found, float):
                    return Constant(found)
                return found
        return None

    def write(self, node: ast.expr) -> tuple[str, Value | None]:
        """An expression and its type; None for a call that gives nothing."""
        folded = self.fold(node)
        if folded is not None:
            return self.literal(node, folded), Constant(folded)
        match node:
            case ast.Name() | ast.Attribute():
                return self.name(node)
            case ast.BinOp():
                return self.operation(node)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                text, found = self.write(operand)
                return f"(-{text})", self.number(operand, found)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"(!{self.as_scalar(operand, BOOL)})", BOOL
            case ast.Compare():
                return self.comparison(node)
            case ast.BoolOp(op=op, values=values):
                sign = " && " if isinstance(op, ast.And) else " || "
                return f"({sign.join(self.as_scalar(one, BOOL) for one in values)})", BOOL
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self.choice(test, body, orelse)
            case ast.Subscript():
                return self.element(node)
            case ast.Call():
                return self.call(node)
        raise self.refuse(node, f"{type(node).__name__} has no WGSL")

    def number(self, node: ast.AST, found: Value | None) -> Scalar:
        """The type of an expression that must be a number."""
        if found is not None and not isinstance(found, (Table, Bundle)):
            kind = run_time(found)
            if isinstance(kind, Scalar):
                return kind
        raise self.refuse(node, "is no number")

    def name(self, node: ast.Name | ast.Attribute) -> tuple[str, Value]:
        """A variable, a parameter, or a field of a bundle."""
        if isinstance(node, ast.Attribute) and node.attr == "size":
            owner = self.bound(node.value)
            if isinstance(owner, Table) and owner.rank == 1:
                return f"size_{owner.name}(0)", I32
        found = self.bound(node)
        if isinstance(found, Uniform):
            return found.text, found.scalar
        if isinstance(found, (Table, Bundle)):
            return "", found
        if isinstance(found, (Scalar, Room, Several)):
            assert isinstance(node, ast.Name)
            return self.spelled(node.id), found
        raise self.refuse(node, "is not known here")

    def operation(self, node: ast.BinOp) -> tuple[str, Value]:
        """A sum, difference, product, quotient or power."""
        if isinstance(node.op, ast.Pow):
            return self.power(node)
        left, left_type = self.write(node.left)
        right, right_type = self.write(node.right)
        first, second = self.number(node.left, left_type), self.number(node.right, right_type)
        if isinstance(node.op, (ast.FloorDiv, ast.Mod)):
            if (first, second) != (I32, I32):
                raise self.refuse(node, "is for whole numbers only")
            name = "whole_quotient" if isinstance(node.op, ast.FloorDiv) else "whole_rest"
            return f"{name}({left}, {right})", I32
        sign = _OPERATORS.get(type(node.op))
        if sign is None:
            raise self.refuse(node, "has no WGSL")
        kind = joined(first, second)
        if kind == I32 and sign == "/":
            kind = F32
        if kind != I32:  # a vector takes plain numbers of single precision beside it
            left = self.cast(left, left_type, F32) if first != VEC4 else left
            right = self.cast(right, right_type, F32) if second != VEC4 else right
        return f"({left} {sign} {right})", kind

    def power(self, node: ast.BinOp) -> tuple[str, Value]:
        """Small whole powers by products, which take negative bases too."""
        base = self.as_scalar(node.left, F32)
        exponent = self.fold(node.right)
        if exponent in (2, 3):
            return f"{'squared' if exponent == 2 else 'cubed'}({base})", F32
        return f"pow({base}, {self.as_scalar(node.right, F32)})", F32

    def comparison(self, node: ast.Compare) -> tuple[str, Value]:
        """One comparison or a chain of them."""
        parts = []
        left = node.left
        for op, right in zip(node.ops, node.comparators, strict=True):
            sign = _COMPARISONS.get(type(op))
            if sign is None:
                raise self.refuse(node, "has no WGSL")
            first, first_type = self.write(left)
            second, second_type = self.write(right)
            kinds = self.number(left, first_type), self.number(right, second_type)
            wanted = BOOL if BOOL in kinds else joined(*kinds)
            first = self.cast(first, first_type, wanted)
            second = self.cast(second, second_type, wanted)
            parts.append(f"({first} {sign} {second})")
            left = right
        return (parts[0] if len(parts) == 1 else f"({' && '.join(parts)})"), BOOL

    def choice(self, test: ast.expr, body: ast.expr, orelse: ast.expr) -> tuple[str, Value | None]:
        """``x if c else y``: both are worked out, one is taken."""
        known = self.known(test)
        if known is not None:
            return self.write(body if known else orelse)
        yes, yes_type = self.write(body)
        no, no_type = self.write(orelse)
        kinds = self.number(body, yes_type), self.number(orelse, no_type)
        wanted = BOOL if BOOL in kinds else joined(*kinds)
        yes, no = self.cast(yes, yes_type, wanted), self.cast(no, no_type, wanted)
        return f"select({no}, {yes}, {self.as_scalar(test, BOOL)})", wanted

    def element(self, node: ast.Subscript) -> tuple[str, Value]:
        """An element of a table or of a room, or the length of an axis."""
        if isinstance(node.value, ast.Attribute) and node.value.attr == "shape":
            owner = self.bound(node.value.value)
            axis = self.fold(node.slice)
            if isinstance(owner, Table) and isinstance(axis, int) and axis < owner.rank:
                return f"size_{owner.name}({axis})", I32
            if isinstance(owner, Room) and axis == 0:
                return str(owner.size), Constant(owner.size)
        owner = self.bound(node.value)
        if isinstance(owner, Table):
            if owner.spectral:
                raise self.refuse(node, "is read with load()")
            return f"read_{owner.name}({self.flat_index(node, owner)})", F32
        return self.place(node)

    def flat_index(self, node: ast.Subscript, table: Table) -> str:
        """The place of a table's element in its texture."""
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        if len(indices) != table.rank:
            raise self.refuse(node, f"needs {table.rank} indices")
        flat = self.as_scalar(indices[0], I32)
        for axis, one in enumerate(indices[1:], start=1):
            flat = f"({flat} * size_{table.name}({axis}) + {self.as_scalar(one, I32)})"
        return flat

    def place(self, node: ast.Subscript) -> tuple[str, Scalar]:
        """An element of a room, to read or to write."""
        owner = self.bound(node.value)
        if not isinstance(owner, Room) or not isinstance(node.value, ast.Name):
            raise self.refuse(node, "is neither a table nor a room")
        return f"{self.room(node.value)}[{self.as_scalar(node.slice, I32)}]", owner.element

    def room(self, node: ast.Name) -> str:
        """A room as it stands before its index: a caller's is a pointer."""
        spelled = self.spelled(node.id)
        return (
            f"(*{spelled})"
            if node.id in self.function.__code__.co_varnames[: self.function.__code__.co_argcount]
            else spelled
        )

    def call(self, node: ast.Call) -> tuple[str, Value | None]:
        """A call of mathematics, of lanes or of another function."""
        called = self.bound(node.func)
        if node.keywords:
            raise self.refuse(node, "takes no names for arguments")
        if called is min or called is max:
            return self.extreme(node, "min" if called is min else "max")
        if called is abs:
            text, found = self.write(node.args[0])
            return f"abs({text})", self.number(node.args[0], found)
        if called is math.floor:
            return f"i32(floor({self.as_scalar(node.args[0], F32)}))", I32
        if called is int:
            return f"i32({self.as_scalar(node.args[0], F32)})", I32
        if called in (float, np.float32, np.float64):
            return self.as_scalar(node.args[0], F32), F32
        if called is np.empty:
            size = self.fold(node.args[0])
            if not isinstance(size, int):
                raise self.refuse(node, "the size of a room is a constant")
            return "", Room(size)
        if called is lane_module.room_of_lanes:
            size = self.fold(node.args[0])
            if not isinstance(size, int):
                raise self.refuse(node, "the size of a room is a constant")
            return "", Room(size, VEC4)
        if _is(called, _MATH):
            arguments = ", ".join(self.as_scalar(one, F32) for one in node.args)
            return f"{_MATH[called]}({arguments})", F32
        for name in _LANE_CALLS:
            if called is getattr(lane_module, name):
                return self.lane_call(node, name)
        if inspect.isfunction(getattr(called, "py_func", called)):
            return self.kernel_call(node, called)
        raise self.refuse(node, "is not known here")

    def extreme(self, node: ast.Call, name: str) -> tuple[str, Value]:
        """``min`` or ``max`` of two or more numbers."""
        written = [self.write(one) for one in node.args]
        kinds = [self.number(node, found) for _, found in written]
        wanted = kinds[0]
        for kind in kinds[1:]:
            wanted = joined(wanted, kind)
        texts = [self.cast(text, found, wanted) for text, found in written]
        total = texts[0]
        for text in texts[1:]:
            total = f"{name}({total}, {text})"
        return total, wanted

    def lane_call(self, node: ast.Call, name: str) -> tuple[str, Value | None]:
        """A call of ``airlight.kernel.lanes``."""
        if name == "splat":
            return self.as_scalar(node.args[0], VEC4), VEC4
        if name == "exponential":
            return f"exp({self.as_scalar(node.args[0], VEC4)})", VEC4
        if name == "fourth_root":
            return f"sqrt(sqrt(max({self.as_scalar(node.args[0], VEC4)}, vec4f(0.0))))", VEC4
        if name in ("maximum", "minimum"):
            texts = [self.as_scalar(one, VEC4) for one in node.args]
            return f"{name[:3]}({', '.join(texts)})", VEC4
        if name in ("load", "store"):
            owner = self.bound(node.args[0])
            index = self.as_scalar(node.args[1], I32)
            if isinstance(owner, Table) and owner.spectral and name == "load":
                return f"read_{owner.name}({index})", VEC4
            if isinstance(owner, Room) and owner.element == VEC4:
                assert isinstance(node.args[0], ast.Name)
                place = f"{self.room(node.args[0])}[{index}]"
                if name == "load":
                    return place, VEC4
                return f"{place} = {self.as_scalar(node.args[2], VEC4)}", None
        raise self.refuse(node, "lanes have no such thing on the GPU")

    def kernel_call(self, node: ast.Call, called: Any) -> tuple[str, Value | None]:
        """A call of another function, which is emitted for these arguments."""
        texts: list[str] = []
        values: list[Value] = []
        for one in node.args:
            if isinstance(one, ast.Tuple):
                members = [self.bound(item) for item in one.elts]
                if not all(isinstance(item, (Table, Uniform, Constant)) for item in members):
                    raise self.refuse(one, "a tuple handed over holds tables and uniforms")
                values.append(Bundle({str(i): item for i, item in enumerate(members)}))
                texts.append("")
                continue
            folded = self.fold(one)
            if folded is not None:
                # Whole numbers and switches are bound, which unrolls what depends on them.
                values.append(Constant(folded) if isinstance(folded, (bool, int)) else F32)
                texts.append(self.literal(one, folded))
                continue
            text, found = self.write(one)
            if found is None:
                raise self.refuse(one, "is nothing")
            if isinstance(found, Room):
                assert isinstance(one, ast.Name)
                pointer = self.room(one).startswith("(*")
                text = self.spelled(one.id) if pointer else f"&{text}"
            values.append(found)
            texts.append(text)
        made = self.emitter.add(called, *values)
        handed = [
            text
            for text, (_, value) in zip(texts, made.parameters, strict=True)
            if not isinstance(value, (Table, Bundle, Constant))
        ]
        return f"{made.name}({', '.join(handed)})", made.result


def _builtin(name: str) -> Any:
    return {"min": min, "max": max, "abs": abs, "int": int, "float": float, "range": range}.get(
        name
    )


def _is(called: Any, table: dict[Any, str]) -> bool:
    try:
        return called in table
    except TypeError:
        return False

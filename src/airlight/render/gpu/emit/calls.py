"""Emission of calls: mathematical functions, lane operations and kernels."""

from __future__ import annotations

import ast
import inspect
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from airlight.image.encoding import srgb_curve_inverse
from airlight.image.texels import CHANNELS, channel_of
from airlight.kernel import lanes as lane_module
from airlight.kernel.tuple_item import tuple_item
from airlight.render.gpu.emit.scope import Scope, SubsetError
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    VEC4,
    Constant,
    ConstantFunction,
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

#: Functions of ``airlight.kernel.lanes`` that a shader can call.
_LANE_CALLS: Final = (
    "load", "store", "splat", "exponential", "maximum", "minimum", "fourth_root", "folded",
    "largest",
)  # fmt: skip


class Calls(Scope, ABC):
    """Emitter of call expressions; see ``Scope`` for the parameters."""

    @abstractmethod
    def write(self, node: ast.expr) -> tuple[str, Value | None]:
        """Emit an expression: text and type, None for a call without result."""

    def as_scalar(self, node: ast.expr, wanted: Scalar | TupleType) -> str:
        """Emit an expression, cast to a scalar type, or of the type of a NamedTuple."""
        text, found = self.write(node)
        try:
            return self.cast(text, found, wanted)
        except SubsetError:
            raise self.refuse(node, f"is not {wanted.name}") from None

    def number(self, node: ast.AST, found: Value | None) -> Scalar:
        """Scalar type of an expression; an error if it has none."""
        if found is not None and not isinstance(found, (ShaderTable, StructValue)):
            kind = run_time(found)
            if isinstance(kind, Scalar):
                return kind
        raise self.refuse(node, "is not a number")

    def array_text(self, node: ast.expr) -> str:
        """Array expression in front of an index."""
        found = self.bound(node)
        if isinstance(found, LocalArray) and found.variable:
            return found.variable
        name, is_argument = self.array_name(node)
        return self.dialect.array(name, is_argument=is_argument)

    def array_name(self, node: ast.expr) -> tuple[str, bool]:
        """Identifier of an array or array field, and whether it is a parameter."""
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            owner = node.value.id
            self.arrays.add(f"{owner}_{node.attr}")
            return self.mangle(f"{owner}_{node.attr}"), self.is_parameter(owner)
        if isinstance(node, ast.Name):
            return self.mangle(node.id), self.is_parameter(node.id)
        raise self.refuse(node, "is not a name of an array")

    def array_argument(self, node: ast.expr) -> str:
        """Array as an argument of a call."""
        name, is_argument = self.array_name(node)
        return name if is_argument else self.dialect.array_argument(name)

    def is_parameter(self, name: str) -> bool:
        """Whether a name is one of the function's parameters."""
        code = self.function.__code__
        return name in code.co_varnames[: code.co_argcount]

    def mathematics(self, function: Any, arguments: Sequence[str]) -> str:
        """Call of a built-in mathematical function, or of an emitted replacement."""
        known = self.dialect.mathematics[function]
        if not isinstance(known, str):
            known = self.emitter.add(known, *(F32 for _ in arguments)).name
        return f"{known}({', '.join(arguments)})"

    def call(self, node: ast.Call) -> tuple[str, Value | None]:
        """Emit a call."""
        called = self.bound(node.func)
        if isinstance(called, ConstantFunction):
            called = called.function
        if node.keywords:
            raise self.refuse(node, "takes no keyword arguments")
        if called is min or called is max:
            return self.extreme(node, called)
        if called is abs:
            text, found = self.write(node.args[0])
            return self.mathematics(abs, [text]), self.number(node.args[0], found)
        if called is math.floor:
            below = self.mathematics(called, [self.as_scalar(node.args[0], F32)])
            return self.dialect.convert(below, I32), I32
        if called is int:
            return self.dialect.convert(self.as_scalar(node.args[0], F32), I32), I32
        if called is tuple_item:
            item = self.bound(node)
            if isinstance(item, StructValue):
                return "", item
        if called in (float, np.float32, np.float64):
            return self.as_scalar(node.args[0], F32), F32
        if called is np.empty:
            size = self.fold(node.args[0])
            if not isinstance(size, int):
                raise self.refuse(node, "the size of an array must be constant")
            return "", LocalArray(size)
        if called is lane_module.lane_array:
            size = self.fold(node.args[0])
            if not isinstance(size, int):
                raise self.refuse(node, "the size of an array must be constant")
            return "", LocalArray(size, VEC4)
        if _is(called, self.dialect.mathematics):
            if called is math.isfinite:
                return self.mathematics(called, [self.as_scalar(node.args[0], F32)]), BOOL
            return self.mathematics(called, [self.as_scalar(one, F32) for one in node.args]), F32
        for name in _LANE_CALLS:
            if called is getattr(lane_module, name):
                return self.lane_call(node, name)
        if called is channel_of:
            return self.channel(node)
        if hasattr(called, "_fields"):
            kind = self.emitter.record_type(called)
            if len(node.args) != len(kind.items):
                raise self.refuse(node, f"{len(kind.items)} fields")
            chosen = [one for one in map(self.fold, node.args) if isinstance(one, bool)]
            if len(chosen) == len(node.args):  # they choose code
                fields = zip(called._fields, map(Constant, chosen), strict=True)
                return "", StructValue(dict(fields))
            pairs = zip(node.args, kind.items, strict=True)
            return self.dialect.tuple_expr(kind, [self.as_scalar(*pair) for pair in pairs]), kind
        if inspect.isfunction(getattr(called, "py_func", called)):
            return self.kernel_call(node, called)
        raise self.refuse(node, "is unknown")

    def extreme(self, node: ast.Call, called: Any) -> tuple[str, Value]:
        """Emit ``min`` or ``max`` of two or more arguments."""
        written = [self.write(one) for one in node.args]
        kinds = [self.number(node, found) for _, found in written]
        wanted = kinds[0]
        for kind in kinds[1:]:
            wanted = joined(wanted, kind)
        texts = [self.cast(text, found, wanted) for text, found in written]
        total = texts[0]
        for text in texts[1:]:
            total = self.mathematics(called, [total, text])
        return total, wanted

    def lane_call(self, node: ast.Call, name: str) -> tuple[str, Value | None]:
        """Emit a call of ``airlight.kernel.lanes``."""
        if name == "splat":
            return self.as_scalar(node.args[0], VEC4), VEC4
        if name == "exponential":
            return f"exp({self.as_scalar(node.args[0], VEC4)})", VEC4
        if name == "folded":  # there are no upper halves
            return self.as_scalar(node.args[0], VEC4), VEC4
        if name == "largest":
            whole = self.as_scalar(node.args[0], VEC4)
            return f"max(max({whole}.x, {whole}.y), max({whole}.z, {whole}.w))", F32
        if name == "fourth_root":
            nothing = self.dialect.convert("0.0", VEC4)
            return f"sqrt(sqrt(max({self.as_scalar(node.args[0], VEC4)}, {nothing})))", VEC4
        if name in ("maximum", "minimum"):
            texts = [self.as_scalar(one, VEC4) for one in node.args]
            return f"{name[:3]}({', '.join(texts)})", VEC4
        if name in ("load", "store"):
            owner = self.bound(node.args[0])
            index = self.as_scalar(node.args[1], I32)
            if isinstance(owner, ShaderTable) and owner.spectral and name == "load":
                return self.dialect.element(owner, index), VEC4
            if isinstance(owner, LocalArray) and owner.element == VEC4:
                place = f"{self.array_text(node.args[0])}[{index}]"
                if name == "load":
                    return place, VEC4
                return f"{place} = {self.as_scalar(node.args[2], VEC4)}", None
        raise self.refuse(node, "is not supported for lanes on the GPU")

    def channel(self, node: ast.Call) -> tuple[str, Value]:
        """Emit a channel of a texel; sRGB is decoded here, as GPUs' own decoding differs."""
        texels, channel = self.bound(node.args[0]), self.fold(node.args[2])
        if isinstance(texels, ShaderTable) and texels.spectral and isinstance(channel, int):
            read = self.dialect.element(texels, self.as_scalar(node.args[1], I32))
            value = f"{read}.{'xyzw'[channel]}"
            if channel == CHANNELS - 1:
                return value, F32
            return f"{self.emitter.add(srgb_curve_inverse, F32).name}({value})", F32
        raise self.refuse(node, "needs a texel of a table and a constant channel")

    def kernel_call(self, node: ast.Call, called: Any) -> tuple[str, Value | None]:
        """Emit a kernel for the types of its arguments, and a call of it."""
        texts: list[str] = []
        values: list[Value] = []
        for one in node.args:
            if isinstance(one, ast.Tuple):
                members = [self.bound(item) for item in one.elts]
                if not all(
                    isinstance(item, (ShaderTable, UniformValue, Constant)) for item in members
                ):
                    raise self.refuse(one, "a tuple argument may contain only tables and uniforms")
                values.append(StructValue({str(i): item for i, item in enumerate(members)}))
                texts.append("")
                continue
            folded = self.fold(one)
            if folded is not None:
                # Integer and boolean constants specialise the callee.
                values.append(Constant(folded) if isinstance(folded, (bool, int)) else F32)
                texts.append(self.literal(one, folded))
                continue
            text, found = self.write(one)
            if found is None:
                raise self.refuse(one, "has no value")
            if isinstance(found, LocalArray):
                text = self.array_argument(one)
            if isinstance(found, ShaderTable):
                text = found.name
            values.append(found)
            texts.append(text)
        made = self.emitter.add(called, *values)
        handed: list[str] = []
        several = made.argument_lists(self.dialect)
        for one, text, (name, value), parts in zip(
            node.args, texts, made.parameters, several, strict=True
        ):
            if not isinstance(value, StructValue):
                handed += [text] if parts else []
                continue
            for part, _ in parts:
                member = ast.Attribute(one, part.removeprefix(f"{name}_"), ast.Load())
                handed.append(self.array_argument(ast.copy_location(member, one)))
        return f"{made.name}({', '.join(handed)})", made.result


def _is(called: Any, table: Mapping[Any, Any]) -> bool:
    try:
        return called in table
    except TypeError:
        return False

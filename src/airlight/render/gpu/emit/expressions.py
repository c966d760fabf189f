"""Emission of expressions of restricted Python, with type inference."""

from __future__ import annotations

import ast
from typing import Final

from airlight.render.gpu.emit.calls import Calls
from airlight.render.gpu.emit.scope import COMPARISONS
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
)
from airlight.render.gpu.emit.single_precision import cubed, squared

_OPERATORS: Final[dict[type[ast.operator], str]] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
}


class Expressions(Calls):
    """Emitter of expressions; see ``Scope`` for the parameters."""

    def write(self, node: ast.expr) -> tuple[str, Value | None]:
        """Emit an expression: text and type, None for a call without result."""
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
                text, found = self.write(operand)
                kind = self.number(operand, found)
                if kind == BOOL:
                    return f"(!{self.cast(text, found, BOOL)})", BOOL
                return f"({text} == {'0' if kind == I32 else '0.0'})", BOOL
            case ast.Compare():
                return self.comparison(node)
            case ast.BoolOp(op=op, values=values):
                sign = " && " if isinstance(op, ast.And) else " || "
                open_ones = [one for one in values if self.known(one) is None]
                return f"({sign.join(self.as_scalar(one, BOOL) for one in open_ones)})", BOOL
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self.choice(test, body, orelse)
            case ast.Subscript():
                return self.element(node)
            case ast.Call():
                return self.call(node)
        raise self.refuse(node, f"{type(node).__name__} is not supported")

    def name(self, node: ast.Name | ast.Attribute) -> tuple[str, Value]:
        """Emit a variable, parameter or struct field."""
        if isinstance(node, ast.Attribute) and node.attr == "size":
            owner = self.bound(node.value)
            if isinstance(owner, ShaderTable) and owner.rank == 1:
                return self.dialect.length(owner.name, "0"), I32
        found = self.bound(node)
        if isinstance(found, UniformValue):
            return self.dialect.uniform(found.text, found.scalar), found.scalar
        if isinstance(found, StructValue) and found.vector is not None:
            members = [ast.Attribute(node, name, ast.Load()) for name in found.fields]
            parts = [self.as_scalar(ast.copy_location(one, node), F32) for one in members]
            return self.dialect.tuple_expr(found.vector, parts), found.vector
        if isinstance(found, (ShaderTable, StructValue)):
            return "", found
        if isinstance(found, LocalArray):
            return self.array_name(node)[0], found
        if isinstance(found, (Scalar, TupleType)):
            if isinstance(node, ast.Name):
                return self.mangle(node.id), found
            text, owner = self.write(node.value)
            assert isinstance(owner, TupleType)
            return self.dialect.part(text, owner.fields.index(node.attr), owner), found
        raise self.refuse(node, "is unknown")

    def operation(self, node: ast.BinOp) -> tuple[str, Value]:
        """Emit an arithmetic operation."""
        if isinstance(node.op, ast.Pow):
            return self.power(node)
        left, left_type = self.write(node.left)
        right, right_type = self.write(node.right)
        first, second = self.number(node.left, left_type), self.number(node.right, right_type)
        if isinstance(node.op, (ast.FloorDiv, ast.Mod)):
            if (first, second) != (I32, I32):
                raise self.refuse(node, "requires integers")
            if isinstance(node.op, ast.FloorDiv):
                return self.dialect.quotient(left, right), I32
            return self.dialect.modulo(left, right), I32
        sign = _OPERATORS.get(type(node.op))
        if sign is None:
            raise self.refuse(node, "is not supported")
        kind = joined(first, second)
        if kind == I32 and sign == "/":
            kind = F32
        if kind != I32:  # a vector combines with plain numbers of single precision
            left = self.cast(left, left_type, F32) if first != VEC4 else left
            right = self.cast(right, right_type, F32) if second != VEC4 else right
        return f"({left} {sign} {right})", kind

    def power(self, node: ast.BinOp) -> tuple[str, Value]:
        """Emit a power; squares and cubes as products, which allow negative bases."""
        base = self.as_scalar(node.left, F32)
        exponent = self.fold(node.right)
        if exponent in (2, 3):
            power = squared if exponent == 2 else cubed
            return f"{self.emitter.add(power, F32).name}({base})", F32
        return self.mathematics(pow, [base, self.as_scalar(node.right, F32)]), F32

    def comparison(self, node: ast.Compare) -> tuple[str, Value]:
        """Emit a comparison or a chain of comparisons."""
        parts = []
        left = node.left
        for op, right in zip(node.ops, node.comparators, strict=True):
            sign = COMPARISONS.get(type(op))
            if sign is None:
                raise self.refuse(node, "is not supported")
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
        """Emit ``x if c else y`` as a selection, which evaluates both."""
        known = self.known(test)
        if known is not None:
            return self.write(body if known else orelse)
        yes, yes_type = self.write(body)
        no, no_type = self.write(orelse)
        kinds = self.number(body, yes_type), self.number(orelse, no_type)
        wanted = BOOL if BOOL in kinds else joined(*kinds)
        yes, no = self.cast(yes, yes_type, wanted), self.cast(no, no_type, wanted)
        return self.dialect.select(self.as_scalar(test, BOOL), yes, no), wanted

    def element(self, node: ast.Subscript) -> tuple[str, Value]:
        """Emit an element of a table or array, or an axis length."""
        if isinstance(node.value, ast.Attribute) and node.value.attr == "shape":
            owner = self.bound(node.value.value)
            axis = self.fold(node.slice)
            if isinstance(owner, ShaderTable) and isinstance(axis, int) and axis < owner.rank:
                return self.dialect.length(owner.name, str(axis)), I32
            if isinstance(owner, ShaderTable) and owner.spectral and axis == owner.rank:
                return "1", Constant(1)
            if isinstance(owner, LocalArray) and axis == 0:
                return str(owner.size), Constant(owner.size)
        owner = self.bound(node.value)
        if isinstance(owner, ShaderTable):
            lane = self.lane(node, owner.rank) if owner.spectral else None
            if lane is not None:
                whole, component = lane
                return f"{self.element(whole)[0]}[{component}]", F32
            if owner.image:
                places = self.indices(node, owner)
                return self.dialect.texel(owner.name, *places), owner.element
            return self.dialect.element(owner, self.flat_index(node, owner)), owner.element
        return self.place(node)

    def indices(self, node: ast.Subscript, table: ShaderTable) -> list[str]:
        """Index expressions of a table element."""
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        if len(indices) != table.rank:
            raise self.refuse(node, f"needs {table.rank} indices")
        return [self.as_scalar(one, I32) for one in indices]

    def flat_index(self, node: ast.Subscript, table: ShaderTable) -> str:
        """Flat index of a table element in its texture."""
        flat, *others = self.indices(node, table)
        for axis, one in enumerate(others, start=1):
            length = self.dialect.length(table.name, str(axis))
            flat = f"({flat} * {length} + {one})"
        return flat

    def lane(self, node: ast.Subscript, rank: int) -> tuple[ast.Subscript, str] | None:
        """Element of a number of indices, and the lane that an index after these is of it."""
        if not isinstance(node.slice, ast.Tuple) or len(node.slice.elts) != rank + 1:
            return None
        *indices, last = node.slice.elts
        place = indices[0] if rank == 1 else ast.Tuple(indices, ast.Load())
        whole = ast.copy_location(ast.Subscript(node.value, place, ast.Load()), node)
        return whole, self.as_scalar(last, I32)

    def place(self, node: ast.Subscript) -> tuple[str, Scalar]:
        """Emit an array element as an lvalue or rvalue, or an element of a table as an lvalue."""
        owner = self.bound(node.value)
        if isinstance(owner, ShaderTable) and self.dialect.writes_tables:
            return self.dialect.element(owner, self.flat_index(node, owner)), owner.element
        if not isinstance(owner, LocalArray):
            raise self.refuse(node, "is neither a table nor an array")
        if owner.columns and isinstance(node.slice, ast.Tuple):
            row, column = (self.as_scalar(one, I32) for one in node.slice.elts)
            index = f"({row} * {owner.columns} + {column})"
            return f"{self.array_text(node.value)}[{index}]", owner.element
        lane = self.lane(node, 1) if owner.element == VEC4 else None
        if lane is not None:
            return f"{self.place(lane[0])[0]}[{lane[1]}]", F32
        return f"{self.array_text(node.value)}[{self.as_scalar(node.slice, I32)}]", owner.element

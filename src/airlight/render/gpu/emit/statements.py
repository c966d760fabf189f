"""Emission of statements and functions of restricted Python.

Variables are declared at the top with the promoted type of all their assignments; the body is
emitted repeatedly until the types are stable.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Final

from airlight.render.gpu.emit.dialect import Named
from airlight.render.gpu.emit.emitted import Emitted
from airlight.render.gpu.emit.expressions import Expressions
from airlight.render.gpu.emit.scope import Functions, SubsetError
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    I32,
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

#: Calls that do not prevent the unrolling of a loop.
_SHORT: Final = frozenset(
    {"load", "store", "splat", "float32", "between", "min", "max", "abs", "int"}
)
#: Unrolling factor of innermost loops.
_UNROLLED: Final = 4
#: Largest number of operations of an unrolled loop: drivers inline every call, so that unrolling
#: multiplies their compile time.
_MOST_OPERATIONS: Final = 12


class FunctionBody:
    """Emitter of the body of one function.

    Parameters
    ----------
    emitter : Functions
        Emitter of the functions that are called.
    made : Emitted
        Function; ``write`` sets its result and text.
    tree : ast.FunctionDef
        Source of the function.
    """

    def __init__(self, emitter: Functions, made: Emitted, tree: ast.FunctionDef) -> None:
        self.made, self.tree = made, tree
        self.dialect = emitter.dialect
        self.expressions = Expressions(emitter, made.function, dict(made.parameters), made.arrays)
        self.names = self.expressions.names
        self.lines: list[str] = []
        self.loops = 0
        self.temporaries = 0

    def write(self) -> None:
        """Emit the body; up to three passes, until the inferred types are stable."""
        parameters = {name for name, _ in self.made.parameters}
        for _ in range(3):
            before = dict(self.names)
            self.lines, self.temporaries = [], 0
            self.made.arrays.clear()
            self.block(self.tree.body, 1)
            if self.names == before:
                break
        spell = self.expressions.mangle
        heads: list[Named] = []
        copies: list[str] = []
        changed = _assigned(self.tree)
        handed = self.made.argument_lists(self.dialect)
        for name, kind in (one for several in handed for one in several):
            if isinstance(kind, (Scalar, TupleType)) and name in changed:
                given = f"{spell(name)}_given"
                heads.append((given, kind))
                now = self.names[name]
                assert isinstance(now, (Scalar, TupleType))
                if isinstance(now, Scalar) and now != kind:
                    given = self.dialect.convert(given, now)
                copies.append(f"  {self.dialect.variable(spell(name), now, given)}")
            else:
                heads.append((spell(name), kind))
        for name, value in self.names.items():
            if name in parameters or not isinstance(value, (Scalar, LocalArray, TupleType)):
                continue
            if not (isinstance(value, LocalArray) and value.variable):
                copies.append(f"  {self.dialect.declared(spell(name), value)}")
        head = self.dialect.head(self.made.name, heads, self.made.result)
        self.made.text = "\n".join([head, *copies, *self.lines, "}\n"])

    def refuse(self, node: ast.AST, why: str) -> SubsetError:
        """Error for a node; see ``Scope.refuse``."""
        return self.expressions.refuse(node, why)

    def block(self, body: Sequence[ast.stmt], depth: int) -> bool:
        """Emit statements up to the first unconditional return; returns whether there is one."""
        for statement in body:
            if isinstance(statement, ast.If):
                known = self.expressions.known(statement.test)
                if known is not None:
                    if self.block(statement.body if known else statement.orelse, depth):
                        return True
                    continue
            self.statement(statement, depth)
            if isinstance(statement, ast.Return):
                return True
        return False

    def add_line(self, depth: int, text: str) -> None:
        """Add a line, indented by ``depth`` levels."""
        self.lines.append("  " * depth + text)

    def statement(self, node: ast.stmt, depth: int) -> None:
        """Emit a statement."""
        match node:
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                return
            case ast.Expr(value=ast.Call() as call):
                text, value = self.expressions.write(call)
                self.add_line(depth, f"{text};" if value is None else self.dialect.unused(text))
            case ast.Assign(targets=[ast.Tuple() as target], value=value):
                self.unpack(target, value, depth)
            case ast.Assign(targets=[target], value=value):
                self.assign(target, value, depth)
            case ast.AugAssign(target=target, op=op, value=value):
                reading = ast.copy_location(_as_read(target), node)
                total = ast.copy_location(ast.BinOp(left=reading, op=op, right=value), node)
                self.assign(target, total, depth)
            case ast.If():
                self.branch(node, depth)
            case ast.While(test=test, body=body, orelse=[]):
                self.add_line(depth, f"while ({self.condition(test)}) {{")
                self.block(body, depth + 1)
                self.add_line(depth, "}")
            case ast.For():
                self.loop(node, depth)
            case ast.Break():
                self.add_line(depth, "break;")
            case ast.Continue():
                self.add_line(depth, "continue;")
            case ast.Return():
                self.return_statement(node, depth)
            case _:
                raise self.refuse(node, f"{type(node).__name__} is not supported")

    def condition(self, test: ast.expr) -> str:
        """Condition of ``if`` and ``while``."""
        text, value = self.expressions.write(test)
        if value is None or not isinstance(value, (Scalar, UniformValue, Constant)):
            raise self.refuse(test, "is not a condition")
        return text if run_time(value) == BOOL else f"{text} != 0"

    def branch(self, node: ast.If, depth: int) -> None:
        """Emit a run-time branch."""
        self.add_line(depth, f"if ({self.condition(node.test)}) {{")
        self.block(node.body, depth + 1)
        if node.orelse:
            self.add_line(depth, "} else {")
            self.block(node.orelse, depth + 1)
        self.add_line(depth, "}")

    def loop(self, node: ast.For, depth: int) -> None:
        """Emit ``for … in range(…)``."""
        call, target = node.iter, node.target
        plain = (
            isinstance(call, ast.Call)
            and isinstance(call.func, ast.Name)
            and call.func.id == "range"
            and isinstance(target, ast.Name)
            and not node.orelse
        )
        if not plain:
            raise self.refuse(node, "a loop must iterate over range(…)")
        assert isinstance(call, ast.Call)
        assert isinstance(target, ast.Name)
        ends = [self.expressions.as_scalar(one, I32) for one in call.args]
        first, last = ("0", ends[0]) if len(ends) == 1 else (ends[0], ends[1])
        step = ends[2] if len(ends) == 3 else "1"
        sign = "<"
        if len(ends) == 3 and isinstance(call.args[2], ast.UnaryOp):
            sign = ">"
        if self.single_iteration(node, target, call.args, depth):
            return
        if self.at_emission(node, target, call.args, depth):
            return
        self.expressions.declare(node, target.id, I32)
        name = self.expressions.mangle(target.id)
        turns = self.constant_range(call.args)
        short = turns is not None and len(turns) < _UNROLLED
        if self.dialect.unrolls and len(ends) < 3 and not short and not _is_not_unrolled(node):
            self.unrolled(node, name, first, last, depth)
            return
        self.add_line(
            depth, f"for ({name} = {first}; {name} {sign} {last}; {name} = {name} + {step}) {{"
        )
        self.block(node.body, depth + 1)
        self.add_line(depth, "}")

    def constant_range(self, ends: Sequence[ast.expr]) -> range | None:
        """Constant iteration range of a loop; None if it is not constant."""
        known = [self.expressions.fold(one) for one in ends]
        numbers = [one for one in known if isinstance(one, int)]
        return range(*numbers) if len(numbers) == len(known) else None

    def single_iteration(
        self, node: ast.For, target: ast.Name, ends: Sequence[ast.expr], depth: int
    ) -> bool:
        """Emit the body of a loop of exactly one iteration; returns whether it is such a loop.

        A GPU has a single lane group, so that loops over lane groups are not emitted.
        """
        turns = self.constant_range(ends)
        parts = [inside for statement in node.body for inside in ast.walk(statement)]
        leaves = any(isinstance(one, (ast.Break, ast.Continue)) for one in parts)
        if leaves or turns is None or len(turns) != 1:
            return False
        before = self.names.get(target.id)
        self.names[target.id] = Constant(turns[0])
        self.block(node.body, depth)
        if before is None:
            del self.names[target.id]
        else:
            self.names[target.id] = before
        return True

    def at_emission(
        self, node: ast.For, target: ast.Name, ends: Sequence[ast.expr], depth: int
    ) -> bool:
        """Emit the body for each item of a tuple, or of a short loop; returns whether it is one."""
        inside = [one for end in ends for one in ast.walk(end)]
        turns = self.constant_range(ends)
        if turns is None:
            return False
        short = len(turns) <= self.dialect.whole and not _is_not_unrolled(node)
        if not short and not any(isinstance(one, ast.Call) for one in inside):
            return False
        for turn in turns:
            self.names[target.id] = Constant(turn)
            self.block(node.body, depth)
        del self.names[target.id]
        return True

    def unrolled(self, node: ast.For, name: str, first: str, last: str, depth: int) -> None:
        """Emit an innermost loop unrolled by four, and a remainder loop.

        Mesa's software renderer ends all loops of a shader after 65 535 iterations in total.
        """
        self.temporaries += 1
        end = f"end_{self.temporaries}"
        self.add_line(depth, self.dialect.let(end, I32, last))
        self.add_line(
            depth,
            f"for ({name} = {first}; {name} + {_UNROLLED - 1} < {end}; {name} = {name} + 1) {{",
        )
        for turn in range(_UNROLLED):
            if turn:
                self.add_line(depth + 1, f"{name} = {name} + 1;")
            self.block(node.body, depth + 1)
        self.add_line(depth, "}")
        self.add_line(depth, f"for (; {name} < {end}; {name} = {name} + 1) {{")
        self.block(node.body, depth + 1)
        self.add_line(depth, "}")

    def return_statement(self, node: ast.Return, depth: int) -> None:
        """Emit ``return``."""
        if node.value is None:
            self.add_line(depth, "return;")
            return
        if isinstance(node.value, ast.Tuple):
            written = [self.expressions.write(one) for one in node.value.elts]
            items = [
                value if isinstance(value, TupleType) else self.expressions.number(node, value)
                for _, value in written
            ]
            before = self.made.result
            if isinstance(before, TupleType) and len(before.items) == len(items):
                items = [_promoted(a, b) for a, b in zip(before.items, items, strict=True)]
            several = self.expressions.emitter.tuple_type(items)
            parts = [
                self.expressions.cast(text, value, item)
                for (text, value), item in zip(written, several.items, strict=True)
            ]
            self.made.result = several
            self.add_line(depth, f"return {self.dialect.tuple_expr(several, parts)};")
            return
        text, value = self.expressions.write(node.value)
        if isinstance(value, TupleType):
            self.made.result = value
            self.add_line(depth, f"return {text};")
            return
        kind = self.expressions.number(node, value)
        if isinstance(self.made.result, Scalar):
            kind = joined(self.made.result, kind) if kind != BOOL else kind
        self.made.result = kind
        self.add_line(depth, f"return {self.expressions.cast(text, value, kind)};")

    def assign(self, target: ast.expr, value: ast.expr, depth: int) -> None:
        """Emit an assignment to a name or an array element."""
        if isinstance(target, ast.Subscript):
            place, kind = self.expressions.place(target)
            self.add_line(depth, f"{place} = {self.expressions.as_scalar(value, kind)};")
            return
        if not isinstance(target, ast.Name):
            raise self.refuse(target, "cannot be assigned to")
        text, found = self.expressions.write(value)
        self.bind(target, text, found, depth)

    def bind(self, target: ast.Name, text: str, found: Value | None, depth: int) -> None:
        """Bind a name to an expression, at run time or at emission."""
        if found is None:
            raise self.refuse(target, "has no value to assign")
        if isinstance(found, (ShaderTable, StructValue)):
            self.expressions.declare(target, target.id, found)
            return
        kind = run_time(found)
        if isinstance(kind, TupleType) and not kind.label:
            raise self.refuse(target, "a tuple must be unpacked where it is created")
        if isinstance(kind, LocalArray):
            if text:
                raise self.refuse(target, "an array cannot be assigned to another name")
            if self.dialect.module_arrays and not kind.variable:
                name = f"{self.made.name}_{target.id}"
                kind = self.expressions.emitter.module_array(name, kind)
            self.expressions.declare(target, target.id, kind)
            return
        self.expressions.declare(target, target.id, kind)
        now = self.names[target.id]
        assert isinstance(now, (Scalar, TupleType))
        mangle = self.expressions.mangle(target.id)
        self.add_line(depth, f"{mangle} = {self.expressions.cast(text, found, now)};")

    def unpack(self, target: ast.Tuple, value: ast.expr, depth: int) -> None:
        """Emit an unpacking assignment."""
        if isinstance(value, ast.Tuple):
            if len(value.elts) != len(target.elts):
                raise self.refuse(target, "a different number of values")
            written = [self.expressions.write(one) for one in value.elts]
            fixed: list[tuple[str, Value | None]] = []
            for text, found in written:
                if found is None or isinstance(found, (ShaderTable, StructValue, LocalArray)):
                    fixed.append((text, found))
                    continue
                self.temporaries += 1
                now, kind = f"now_{self.temporaries}", run_time(found)
                if isinstance(kind, LocalArray):
                    raise self.refuse(target, "an array cannot be assigned to another name")
                self.add_line(depth, self.dialect.let(now, kind, text))
                fixed.append((now, kind))
            for one, (text, found) in zip(target.elts, fixed, strict=True):
                self.assign_element(one, text, found, depth)
            return
        text, found = self.expressions.write(value)
        if isinstance(found, StructValue):
            if len(found.fields) != len(target.elts):
                raise self.refuse(target, f"the value has {len(found.fields)} fields")
            for one, member in zip(target.elts, found.fields.values(), strict=True):
                written_member = ""
                if isinstance(member, UniformValue):
                    written_member = self.dialect.uniform(member.text, member.scalar)
                if isinstance(member, Constant):
                    written_member = self.expressions.literal(one, member.value)
                self.assign_element(one, written_member, member, depth)
            return
        if not isinstance(found, TupleType) or len(found.items) != len(target.elts):
            raise self.refuse(target, "a different number of values")
        self.temporaries += 1
        several = f"several_{self.temporaries}"
        self.add_line(depth, self.dialect.let(several, found, text))
        for i, (one, kind) in enumerate(zip(target.elts, found.items, strict=True)):
            self.assign_element(one, self.dialect.part(several, i, found), kind, depth)

    def assign_element(self, target: ast.expr, text: str, found: Value | None, depth: int) -> None:
        """Emit the assignment of one tuple element."""
        if isinstance(target, ast.Name):
            if target.id != "_":
                self.bind(target, text, found, depth)
            return
        if isinstance(target, ast.Subscript):
            place, kind = self.expressions.place(target)
            self.add_line(depth, f"{place} = {self.expressions.cast(text, found, kind)};")
            return
        raise self.refuse(target, "cannot be assigned to")


def _promoted(first: Scalar | TupleType, second: Scalar | TupleType) -> Scalar | TupleType:
    """Common type of a member of two tuples."""
    return joined(first, second) if isinstance(first, Scalar) else first  # type: ignore[arg-type]


def _is_not_unrolled(node: ast.For) -> bool:
    """Whether a loop contains loops, long calls, early exits or many operations."""
    parts = [inside for statement in node.body for inside in ast.walk(statement)]
    operations = sum(isinstance(one, (ast.BinOp, ast.Subscript, ast.Call)) for one in parts)
    if operations > _MOST_OPERATIONS:
        return True
    ways_out = (ast.For, ast.While, ast.Break, ast.Continue, ast.Return)
    return any(isinstance(one, ways_out) or _is_long_call(one) for one in parts)


def _is_long_call(node: ast.AST) -> bool:
    """Whether a node calls a kernel, apart from scalar, lane and field-interpolation calls."""
    if not isinstance(node, ast.Call):
        return False
    called = node.func
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
    return name not in _SHORT


def _assigned(tree: ast.FunctionDef) -> set[str]:
    """Variables that a function assigns."""
    return {
        node.id
        for node in ast.walk(tree)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }


def _as_read(target: ast.expr) -> ast.expr:
    """Assignment target as an expression in load context."""
    copied = ast.parse(ast.unparse(target), mode="eval").body
    for node in ast.walk(copied):
        node.lineno = target.lineno  # type: ignore[attr-defined]
    return copied

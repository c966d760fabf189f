"""JavaScript in double precision, for CPU computations of a page.

Tuples are arrays, tables are objects with flat ``values`` and a ``shape``. A lane is one
wavelength; the host calls functions for each wavelength, of which a table of lanes has the values
``at``, ``at + step``, …. All functions are exported.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any, ClassVar, Final

import numpy as np

from airlight.kernel.cube_root import cube_root
from airlight.render.gpu.emit.dialect import Dialect, Named
from airlight.render.gpu.emit.shader_types import (
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
    Value,
)

_RESERVED: Final = """
    arguments await break case catch class const continue debugger default delete do else enum eval
    export extends false finally for function if implements import in instanceof interface let new
    null package private protected public return static super switch this throw true try typeof
    undefined var void while with yield Math Number Float64Array Infinity NaN
"""


class JavaScript(Dialect):
    """JavaScript: functions of an ES module."""

    name = "JavaScript"
    reserved = frozenset(re.findall(r"\w+", _RESERVED))
    mathematics: ClassVar[dict[Any, str]] = {
        one: f"Math.{one.__name__}" for one in (
            math.sqrt, math.exp, math.log, math.log2, math.sin, math.cos, math.tan, math.acos,
            math.asin, math.atan, math.atan2, math.floor, np.floor, math.hypot, math.expm1, abs,
            min, max, pow,
        )
    } | {math.isfinite: "Number.isFinite", cube_root: "Math.cbrt"}  # fmt: skip
    unrolls = False
    largest = math.inf
    writes_tables = True

    def type_name(self, kind: Scalar | LocalArray | TupleType | ShaderTable) -> str:
        return kind.name

    def declared(self, name: str, kind: Scalar | LocalArray | TupleType) -> str:
        if isinstance(kind, LocalArray):
            return f"const {name} = new Float64Array({kind.size});"
        return f"let {name};"

    def let(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        return f"const {name} = {text};"

    def variable(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        return f"let {name} = {text};"

    def head(
        self, name: str, parameters: Sequence[Named], result: Scalar | TupleType | None
    ) -> str:
        return f"export function {name}({', '.join(one for one, _ in parameters)}) {{"

    def struct(self, kind: TupleType) -> str:
        return ""

    def tuple_expr(self, kind: TupleType, parts: Sequence[str]) -> str:
        return f"[{', '.join(parts)}]"

    def part(self, text: str, index: int, kind: TupleType | None = None) -> str:
        return f"{text}[{index}]"

    def convert(self, text: str, wanted: Scalar) -> str:
        return {I32: f"Math.trunc({text})", F32: f"Number({text})", VEC4: text}[wanted]

    def select(self, test: str, yes: str, no: str) -> str:
        return f"({test} ? {yes} : {no})"

    def at_run_time(self, value: Value) -> bool:
        return not isinstance(value, (Constant, ConstantFunction, StructValue))

    def element(self, table: ShaderTable, index: str) -> str:
        if table.spectral:
            index = f"{index} * {table.name}.step + {table.name}.at"
        return f"{table.name}.values[{index}]"

    def length(self, table: str, axis: str) -> str:
        return f"{table}.shape[{axis}]"

    def quotient(self, first: str, second: str) -> str:
        return f"Math.floor({first} / {second})"

    def modulo(self, first: str, second: str) -> str:
        return f"({first} - {second} * Math.floor({first} / {second}))"


JAVASCRIPT: Final = JavaScript()

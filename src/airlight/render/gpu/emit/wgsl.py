"""WGSL, the language of WebGPU."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import ClassVar, Final

from airlight.render.gpu.emit.dialect import Named, ShaderDialect
from airlight.render.gpu.emit.shader_types import (
    VEC3,
    LocalArray,
    Scalar,
    ShaderTable,
    TupleType,
)
from airlight.render.gpu.emit.single_precision import MATHEMATICS

_RESERVED: Final = """
    abs acos all angle_of any arc_cosine arc_sine arc_tangent array asin atan atan2 bool break
    case ceil clamp const continue cos cosine cross cubed default degrees discard distance do dot
    else enum exp exp2 f16 f32 false field floor fn for fract i32 if in inout input int float
    inverse inverseSqrt layout length let log log2 loop main max min mix mod normalize out output
    override pow precision radians reflect refract return round sample sampler select shared sign
    sin sine smooth sqrt squared step struct switch tan texture trunc true u32 uniform var vec4f
    while active centroid common floor_div floor_mod filter half fixed image interface packed
    partition public static superp target template this union unsigned using volatile highp lowp
    mediump flat buffer texel patch
"""


class Wgsl(ShaderDialect):
    """WGSL: arrays are passed as pointers, tuples are structs."""

    name = "WGSL"
    reserved = frozenset(re.findall(r"\w+", _RESERVED))
    mathematics = MATHEMATICS
    integer_functions: ClassVar[str] = """\
fn floor_div(a: i32, b: i32) -> i32 {
  let towards_zero = a / b;
  return select(towards_zero, towards_zero - 1, towards_zero * b != a && (a < 0) != (b < 0));
}
fn floor_mod(a: i32, b: i32) -> i32 { return a - b * floor_div(a, b); }
"""
    triangle: ClassVar[str] = """\
@vertex
fn full_screen_triangle(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  let x = select(-1.0, 3.0, index == 1u);
  let y = select(-1.0, 3.0, index == 2u);
  return vec4f(x, y, 0.0, 1.0);
}
"""

    def type_name(self, kind: Scalar | LocalArray | TupleType | ShaderTable) -> str:
        if isinstance(kind, LocalArray):
            return f"array<{kind.element.name}, {kind.size}>"
        return "vec3f" if kind == VEC3 else kind.name

    def declared(self, name: str, kind: Scalar | LocalArray | TupleType) -> str:
        return f"var {name}: {self.type_name(kind)};"

    def let(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        return f"let {name} = {text};"

    def variable(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        return f"var {name} = {text};"

    def head(
        self, name: str, parameters: Sequence[Named], result: Scalar | TupleType | None
    ) -> str:
        written = [
            f"{one}: ptr<function, {self.type_name(kind)}>"
            if isinstance(kind, LocalArray)
            else f"{one}: {self.type_name(kind)}"
            for one, kind in parameters
        ]
        arrow = "" if result is None else f" -> {self.type_name(result)}"
        return f"fn {name}({', '.join(written)}){arrow} {{"

    def struct(self, kind: TupleType) -> str:
        parts = ", ".join(f"v{i}: {self.type_name(item)}" for i, item in enumerate(kind.items))
        return f"struct {kind.name} {{ {parts} }}\n"

    def tuple_expr(self, kind: TupleType, parts: Sequence[str]) -> str:
        return f"{self.type_name(kind)}({', '.join(parts)})"

    def convert(self, text: str, wanted: Scalar) -> str:
        return f"{wanted.name}({text})"

    def select(self, test: str, yes: str, no: str) -> str:
        return f"select({no}, {yes}, {test})"

    def unused(self, text: str) -> str:
        return f"_ = {text};"

    def array_argument(self, text: str) -> str:
        return f"&{text}"

    def array(self, name: str, *, is_argument: bool) -> str:
        return f"(*{name})" if is_argument else name

    def fetch(self, texture: str, index: str, shift: int) -> str:
        place = f"{index} & {(1 << shift) - 1}, {index} >> {shift}"
        return f"textureLoad({texture}, vec2i({place}), 0)"

    def fetch_image(self, texture: str, row: str, column: str) -> str:
        return f"textureLoad({texture}, vec2i({column}, {row}), 0)"

    def fetch_volume(self, texture: str, x: str, y: str, z: str) -> str:
        return f"textureLoad({texture}, vec3i({x}, {y}, {z}), 0)"

    def image_length(self, texture: str, axis: str) -> str:
        return f"i32(textureDimensions({texture}, 0)[1 - {axis}])"

    def texture_name(self, name: str, group: int, binding: int) -> str:
        return name

    def texture(self, name: str, group: int, binding: int) -> str:
        return f"@group({group}) @binding({binding}) var {name}: texture_2d<f32>;\n"

    def uniforms(
        self, name: str, fields: Sequence[str | tuple[str, int]], group: int, binding: int
    ) -> str:
        kind = name.capitalize()
        members = "".join(
            f"  {one}: vec4f,\n"
            if isinstance(one, str)
            else f"  {one[0]}: array<vec4f, {one[1]}>,\n"
            for one in fields
        )
        place = f"@group({group}) @binding({binding})"
        return f"struct {kind} {{\n{members}}}\n{place} var<uniform> {name}: {kind};\n"

    def fragment(self, name: str, targets: int, body: Sequence[str], results: Sequence[str]) -> str:
        lines = "".join(f"  {line}\n" for line in body)
        head = f"@fragment\nfn {name}(@builtin(position) at: vec4f) ->"
        if targets == 1:
            return f"{head} @location(0) vec4f {{\n{lines}  return {results[0]};\n}}\n"
        layers = "".join(f"  @location({i}) v{i}: vec4f,\n" for i in range(targets))
        kind = f"Targets_{name}"
        return (
            f"struct {kind} {{\n{layers}}}\n"
            f"{head} {kind} {{\n{lines}  return {kind}({', '.join(results)});\n}}\n"
        )

    def module(self, parts: Sequence[str]) -> str:
        return "\n".join(parts)


class WgslOfModule(Wgsl):
    """WGSL whose arrays are variables of the module, which fields of any depth can name.

    Sums of harmonics are unrolled: Mesa's software renderer counts all turns of a march.
    """

    module_arrays = True
    whole = 16

    def in_module(self, name: str, kind: LocalArray) -> str:
        return f"var<private> {name}: {self.type_name(kind)};"


WGSL: Final = Wgsl()
WGSL_OF_MODULE: Final = WgslOfModule()

"""GLSL ES 3.00, the language of WebGL2.

GLSL passes arrays by value, which compilers handle slowly (Mesa took 264 s for the sky-view LUT).
Arrays are therefore global variables, and functions are specialised for them. This is equivalent,
as no function is recursive and every array is written before it is read.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import ClassVar, Final

from airlight.render.gpu.emit.dialect import PLAIN_NAMES, Named, ShaderDialect
from airlight.render.gpu.emit.shader_types import (
    VEC4,
    LocalArray,
    Scalar,
    ShaderTable,
    TupleType,
)
from airlight.render.gpu.emit.single_precision import MATHEMATICS

#: GLSL ES 3.00, 3.6 "Keywords" and those names of 8 "Built-in Functions" that a shader might use
#: for its own functions; redefining one is an error.
_RESERVED: Final = """
    const uniform layout centroid flat smooth break continue do for while switch case default if
    else in out inout float int void bool true false invariant discard return mat2 mat3 mat4 vec2
    vec3 vec4 ivec2 ivec3 ivec4 bvec2 bvec3 bvec4 uint uvec2 uvec3 uvec4 lowp mediump highp
    precision sampler2D struct attribute varying coherent volatile restrict readonly writeonly
    resource atomic_uint noperspective patch sample subroutine common partition active asm class
    union enum typedef template this goto inline noinline public static extern external interface
    long short double half fixed unsigned superp input output filter sizeof cast namespace using
    image buffer shared radians degrees sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh
    pow exp log exp2 log2 sqrt inversesqrt abs sign floor trunc round roundEven ceil fract mod modf
    min max clamp mix step smoothstep isnan isinf length distance dot cross normalize faceforward
    reflect refract transpose inverse determinant any all not equal texture texelFetch main texel
    angle_of arc_cosine arc_sine arc_tangent cosine cubed sine squared floor_div floor_mod
"""


class Glsl(ShaderDialect):
    """GLSL ES 3.00; a shader has one entry point, textures are named after their bindings."""

    name = "GLSL ES 3.00"
    reserved = frozenset(re.findall(r"\w+", _RESERVED))
    mathematics = MATHEMATICS
    module_arrays = True
    integer_functions: ClassVar[str] = """\
int floor_div(int a, int b) {
  int towards_zero = a / b;
  return towards_zero * b != a && (a < 0) != (b < 0) ? towards_zero - 1 : towards_zero;
}
int floor_mod(int a, int b) { return a - b * floor_div(a, b); }
"""
    triangle: ClassVar[str] = """\
#version 300 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
"""

    def type_name(self, kind: Scalar | LocalArray | TupleType | ShaderTable) -> str:
        if isinstance(kind, LocalArray):
            return f"{self.type_name(kind.element)}[{kind.size}]"
        return PLAIN_NAMES.get(kind, kind.name)

    def declared(self, name: str, kind: Scalar | LocalArray | TupleType) -> str:
        if isinstance(kind, LocalArray):
            return f"{self.type_name(kind.element)} {name}[{kind.size}];"
        return f"{self.type_name(kind)} {name};"

    def let(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        return f"{self.type_name(kind)} {name} = {text};"

    def variable(self, name: str, kind: Scalar | TupleType, text: str) -> str:
        return self.let(name, kind, text)

    def head(
        self, name: str, parameters: Sequence[Named], result: Scalar | TupleType | None
    ) -> str:
        written = ", ".join(f"{self.type_name(kind)} {one}" for one, kind in parameters)
        return f"{'void' if result is None else self.type_name(result)} {name}({written}) {{"

    def struct(self, kind: TupleType) -> str:
        parts = " ".join(f"{self.type_name(item)} v{i};" for i, item in enumerate(kind.items))
        return f"struct {kind.name} {{ {parts} }};\n"

    def tuple_expr(self, kind: TupleType, parts: Sequence[str]) -> str:
        return f"{self.type_name(kind)}({', '.join(parts)})"

    def convert(self, text: str, wanted: Scalar) -> str:
        return f"{PLAIN_NAMES[wanted]}({text})"

    def select(self, test: str, yes: str, no: str) -> str:
        return f"({test} ? {yes} : {no})"

    def fetch(self, texture: str, index: str, shift: int) -> str:
        place = f"{index} & {(1 << shift) - 1}, {index} >> {shift}"
        return f"texelFetch({texture}, ivec2({place}), 0)"

    def fetch_image(self, texture: str, row: str, column: str) -> str:
        return f"texelFetch({texture}, ivec2({column}, {row}), 0)"

    def fetch_volume(self, texture: str, x: str, y: str, z: str) -> str:
        return f"texelFetch({texture}, ivec3({x}, {y}, {z}), 0)"

    def image_length(self, texture: str, axis: str) -> str:
        return f"textureSize({texture}, 0)[1 - {axis}]"

    def texture_name(self, name: str, group: int, binding: int) -> str:
        return f"texture_{group}_{binding}"

    def texture(self, name: str, group: int, binding: int) -> str:
        return f"uniform highp sampler2D {self.texture_name(name, group, binding)};\n"

    def uniforms(
        self, name: str, fields: Sequence[str | tuple[str, int]], group: int, binding: int
    ) -> str:
        vector = self.type_name(VEC4)
        members = "".join(
            f"  {vector} {one};\n" if isinstance(one, str) else f"  {vector} {one[0]}[{one[1]}];\n"
            for one in fields
        )
        return f"layout(std140) uniform {name.capitalize()} {{\n{members}}} {name};\n"

    def fragment(self, name: str, targets: int, body: Sequence[str], results: Sequence[str]) -> str:
        outs = "".join(f"layout(location = {i}) out vec4 target_{i};\n" for i in range(targets))
        lines = "".join(f"  {line}\n" for line in body)
        ends = "".join(f"  target_{i} = {one};\n" for i, one in enumerate(results))
        return f"{outs}void main() {{\n  vec4 at = gl_FragCoord;\n{lines}{ends}}}\n"

    def module(self, parts: Sequence[str]) -> str:
        head = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
        return head + "\n".join(parts)


GLSL: Final = Glsl()

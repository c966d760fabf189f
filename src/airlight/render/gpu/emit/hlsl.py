"""HLSL of shader model 5 and later, the language of Direct3D, Unreal and Unity.

Functions and textures for inclusion in a host shader, without entry points. Arrays are global
variables, as in GLSL.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import ClassVar, Final

from airlight.render.gpu.emit.dialect import Named, ShaderDialect
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    VEC3,
    VEC4,
    LocalArray,
    Scalar,
    ShaderTable,
    TupleType,
)
from airlight.render.gpu.emit.single_precision import MATHEMATICS

_NAMES: Final = {F32: "float", I32: "int", BOOL: "bool", VEC4: "float4", VEC3: "float3"}

#: HLSL's keywords, reserved words and those intrinsic functions that a shader might redefine.
_RESERVED: Final = """
    AppendStructuredBuffer asm asm_fragment BlendState bool break Buffer ByteAddressBuffer case
    cbuffer centroid class column_major compile compile_fragment CompileShader const continue
    ComputeShader ConsumeStructuredBuffer default DepthStencilState discard do double DomainShader
    dword else export extern false float for fxgroup GeometryShader groupshared half Hullshader if
    in inline inout InputPatch int interface line lineadj linear LineStream matrix min16float
    namespace nointerpolation noperspective NULL out OutputPatch packoffset pass pixelfragment
    PixelShader point PointStream precise RasterizerState return register row_major sample sampler
    SamplerState shared snorm stateblock static string struct switch tbuffer technique texture
    Texture1D Texture2D Texture3D true typedef triangle TriangleStream uint uniform unorm unsigned
    vector vertexfragment VertexShader void volatile while auto catch char const_cast delete
    dynamic_cast enum explicit friend goto long mutable new operator private protected public
    reinterpret_cast short signed sizeof static_cast template this throw try typename union using
    virtual abs acos all any asin atan atan2 ceil clamp cos cosh cross degrees determinant distance
    dot exp exp2 floor fmod frac isfinite isinf isnan length lerp log log10 log2 mad max min modf
    mul normalize pow radians rcp reflect refract round rsqrt saturate sign sin sincos sinh
    smoothstep sqrt step tan tanh transpose trunc texel angle_of arc_cosine arc_sine arc_tangent
    cosine cubed sine squared floor_div floor_mod main fixed image smooth
"""


class Hlsl(ShaderDialect):
    """HLSL: structs are built by functions, as the language has no constructors."""

    name = "HLSL"
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
float4 main(uint vertex : SV_VertexID) : SV_Position {
  return float4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
"""

    def type_name(self, kind: Scalar | LocalArray | TupleType | ShaderTable) -> str:
        if isinstance(kind, LocalArray):
            return f"{self.type_name(kind.element)}[{kind.size}]"
        return _NAMES.get(kind, kind.name)

    def declared(self, name: str, kind: Scalar | LocalArray | TupleType) -> str:
        if isinstance(kind, LocalArray):  # a variable of the module; without static, a constant
            return f"static {self.type_name(kind.element)} {name}[{kind.size}];"
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
        items = [(f"v{i}", self.type_name(item)) for i, item in enumerate(kind.items)]
        parts = " ".join(f"{of} {one};" for one, of in items)
        given = ", ".join(f"{of} {one}" for one, of in items)
        filled = " ".join(f"made.{one} = {one};" for one, _ in items)
        return (
            f"struct {kind.name} {{ {parts} }};\n"
            f"{kind.name} make_{kind.name}({given}) "
            f"{{ {kind.name} made; {filled} return made; }}\n"
        )

    def tuple_expr(self, kind: TupleType, parts: Sequence[str]) -> str:
        made = _NAMES.get(kind, f"make_{kind.name}")
        return f"{made}({', '.join(parts)})"

    def convert(self, text: str, wanted: Scalar) -> str:
        return f"(({_NAMES[wanted]})({text}))"

    def select(self, test: str, yes: str, no: str) -> str:
        return f"({test} ? {yes} : {no})"

    def fetch(self, texture: str, index: str, shift: int) -> str:
        place = f"{index} & {(1 << shift) - 1}, {index} >> {shift}"
        return f"{texture}.Load(int3({place}, 0))"

    def fetch_image(self, texture: str, row: str, column: str) -> str:
        return f"{texture}.Load(int3({column}, {row}, 0))"

    def fetch_volume(self, texture: str, x: str, y: str, z: str) -> str:
        return f"{texture}.Load(int4({x}, {y}, {z}, 0))"

    def image_length(self, texture: str, axis: str) -> str:
        return f"length_of({texture}, {axis})"

    def texture_name(self, name: str, group: int, binding: int) -> str:
        return name

    def texture(self, name: str, group: int, binding: int) -> str:
        return f"Texture2D<float4> {name} : register(t{binding}, space{group});\n"

    def uniforms(
        self, name: str, fields: Sequence[str | tuple[str, int]], group: int, binding: int
    ) -> str:
        members = "".join(
            f"  float4 {one};\n" if isinstance(one, str) else f"  float4 {one[0]}[{one[1]}];\n"
            for one in fields
        )
        kind = name.capitalize()
        place = f"register(b{binding}, space{group})"
        return f"struct {kind} {{\n{members}}};\nConstantBuffer<{kind}> {name} : {place};\n"

    def fragment(self, name: str, targets: int, body: Sequence[str], results: Sequence[str]) -> str:
        outs = "".join(f"  float4 v{i} : SV_Target{i};\n" for i in range(targets))
        lines = "".join(f"  {line}\n" for line in body)
        ends = "".join(f"  targets.v{i} = {one};\n" for i, one in enumerate(results))
        kind = f"Targets_{name}"
        return (
            f"struct {kind} {{\n{outs}}};\n{kind} {name}(float4 at : SV_Position) {{\n{lines}"
            f"  {kind} targets;\n{ends}  return targets;\n}}\n"
        )

    def module(self, parts: Sequence[str]) -> str:
        head = (
            "int length_of(Texture2D<float4> image, int axis) {\n  uint width, height;\n"
            "  image.GetDimensions(width, height);\n"
            "  return (int)(axis == 0 ? height : width);\n}\n"
        )
        return head + "\n".join(parts)


HLSL: Final = Hlsl()

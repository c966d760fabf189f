"""The passes of the solver as data, and their shaders.

A pass fills one flat texture with the texels of one function of ``solver_rays``, ``solver_light``,
``solver_packing`` or ``solver_mixing``. What it reads is named here; a host, in Python or in a
browser, needs the list of passes, the shaders and the numbers of ``solver_plan``, and no physics.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Final, Literal

from airlight.gpu.device.fragment_pass import wgsl
from airlight.gpu.emit.emitter import Emitter
from airlight.gpu.emit.shader_types import I32, VEC4, Bundle, Table, Value
from airlight.gpu.solver import light, mixing, packing, rays
from airlight.gpu.solver.tables import (
    SCALARS,
    SPECTRA,
    sizes_in_shader,
    table_reader,
    tables_in_shader,
    uniform_fields,
)
from airlight.solvers.moments.stopping import PASS_IMAGES

#: How a texture is read: four wavelengths a texel, or number by number.
View = Literal["lanes", "numbers"]

#: Images of the light, the last first.
IMAGES: Final = tuple(f"image_{i}" for i in range(PASS_IMAGES))


@dataclass(frozen=True)
class Reading:
    """A texture that a pass reads.

    Attributes
    ----------
    texture : str
        By its name in the plan.
    view : View
        How.
    from_sky : bool
        Whether reading begins at the irradiances of the ground in a packed field.
    """

    texture: str
    view: View = "lanes"
    from_sky: bool = False


@dataclass(frozen=True)
class SolverPass:
    """One pass.

    Attributes
    ----------
    name : str
        Also of its shader.
    function : callable
        Its arguments are ``index``, those of ``givens``, then the readings.
    target : str
        The texture that it fills.
    givens : tuple of str
        Of ``sizes``, ``tables``, ``first_point``, ``weights``, ``images``.
    readings : tuple of Reading
        In the order of the function's arguments.
    spanned : bool
        Whether it runs once for each span of radii.
    """

    name: str
    function: Any
    target: str
    givens: tuple[str, ...] = ("sizes", "tables")
    readings: tuple[Reading, ...] = ()
    spanned: bool = False


_ALONG: Final = ("sizes", "tables", "first_point")

#: Once for a solve: what does not change from order to order, and the first order.
ONCE: Final = (
    SolverPass("strength", rays.strength, "strengths"),
    SolverPass("factor", rays.factor, "factors"),
    SolverPass("share", rays.share, "shares"),
    SolverPass("reflection", rays.reflection, "reflections"),
    SolverPass("projection", rays.projection, "projections"),
    SolverPass("depth", rays.depth, "depths", _ALONG, spanned=True),
    SolverPass(
        "radiance_once", light.radiance_once, "radiances", _ALONG,
        (Reading("shares"), Reading("strengths"), Reading("reflections"), Reading("depths")),
        spanned=True,
    ),
    SolverPass("azimuthal", light.azimuthal, "azimuthals", readings=(Reading("radiances"),)),
    SolverPass(
        "gathered_moment", light.gathered_moment, "first", ("sizes",),
        (Reading("projections", "numbers"), Reading("azimuthals")),
    ),
)  # fmt: skip
#: A light as the next sweep and a march read it.
PACK: Final = (
    SolverPass("highest", packing.highest, "heights", ("sizes",), (Reading("light", "numbers"),)),
    SolverPass("floor", packing.floor, "floors", ("sizes",), (Reading("heights", "numbers"),)),
    SolverPass(
        "refined", packing.refined, "fine",
        readings=(Reading("light", "numbers"), Reading("floors", "numbers")),
    ),
    SolverPass(
        "highest_level", packing.highest_level, "level_heights", ("sizes",),
        (Reading("fine", "numbers"),),
    ),
    SolverPass(
        "node_scale", packing.node_scale, "scales",
        readings=(Reading("fine", "numbers"), Reading("level_heights", "numbers")),
    ),
    SolverPass(
        "packed", packing.packed, "packed", ("sizes",), (Reading("fine"), Reading("scales"))
    ),
)  # fmt: skip
#: One more order: from the packed light to its image.
SWEEP: Final = (
    SolverPass(
        "row", light.row, "rows", _ALONG, (Reading("factors"), Reading("packed")), spanned=True
    ),
    SolverPass(
        "radiance_again", light.radiance_again, "radiances", _ALONG,
        (
            Reading("shares"), Reading("rows"), Reading("reflections"),
            Reading("packed", from_sky=True),
        ),
        spanned=True,
    ),
    SolverPass("azimuthal", light.azimuthal, "azimuthals", readings=(Reading("radiances"),)),
    SolverPass(
        "gathered_onto", light.gathered_onto, "image", ("sizes",),
        (Reading("projections", "numbers"), Reading("azimuthals"), Reading("first")),
    ),
    SolverPass("mean", mixing.mean, "means", ("sizes",), (Reading("image"), Reading("light"))),
)  # fmt: skip
#: The next guess, from the last images and the host's weights.
MIX: Final = (
    SolverPass("sound", mixing.sound, "sounds", ("sizes", "weights", "images:numbers")),
    SolverPass(
        "next_guess", mixing.next_guess, "light", ("sizes", "weights", "images:lanes"),
        (Reading("sounds"),),
    ),
)  # fmt: skip
PASSES: Final = {one.name: one for one in (*ONCE, *PACK, *SWEEP, *MIX)}


def _reader(name: str, texture: str, view: View, from_sky: bool = False) -> str:
    start = " + i32(solve.measures[3])" if from_sky else ""
    if view == "lanes":
        body = f"textureLoad({texture}, texel_place(index{start}), 0)"
        return f"fn read_{name}(index: i32) -> vec4f {{ return {body}; }}\n"
    body = f"textureLoad({texture}, texel_place(index >> 2u), 0)[index & 3]"
    return f"fn read_{name}(index: i32) -> f32 {{ return {body}; }}\n"


def _weights_reader(spectral: bool) -> str:
    if spectral:
        return "fn read_weights(index: i32) -> vec4f { return mix.weights[index]; }\n"
    return "fn read_weights(index: i32) -> f32 { return mix.weights[index >> 2u][index & 3]; }\n"


@cache
def shader(name: str) -> str:
    """The WGSL of a pass: bindings, emitted functions, entry point ``fill``.

    Parameters
    ----------
    name : str
        One of ``PASSES``.
    """
    one = PASSES[name]
    readers: list[str] = []
    textures: list[str] = []
    arguments: list[Value] = [I32]
    handed: list[str] = []
    uses_mix = False
    for given in one.givens:
        kind, _, view = given.partition(":")
        if kind == "sizes":
            arguments.append(sizes_in_shader())
        elif kind == "tables":
            arguments.append(tables_in_shader())
        elif kind == "first_point":
            arguments.append(I32)
            handed.append("i32(span.texels.z)")
        elif kind == "weights":
            uses_mix = True
            spectral = name == "next_guess"
            arguments.append(Table("weights", 1, spectral))
            readers.append(_weights_reader(spectral))
        else:
            spectral = view == "lanes"
            arguments.append(Bundle({image: Table(image, 1, spectral) for image in IMAGES}))
            for image in IMAGES:
                textures.append(image)
                readers.append(_reader(image, image, "lanes" if spectral else "numbers"))
    parameters = one.function.py_func.__code__.co_varnames[len(arguments) :]
    for parameter, reading in zip(parameters, one.readings, strict=False):
        label = f"{parameter}_table"
        arguments.append(Table(label, 1, reading.view == "lanes"))
        readers.append(_reader(label, reading.texture, reading.view, reading.from_sky))
        if reading.texture not in textures:
            textures.append(reading.texture)
    emitter = Emitter()
    made = emitter.add(one.function, *arguments)
    body = emitter.module()
    used = [table for table in (*SCALARS, *SPECTRA) if f"_{table}(" in body]
    if any(table in SCALARS for table in used):
        textures.append("scalars")
    if any(table in SPECTRA for table in used):
        textures.append("spectra")
    fields = "\n".join(f"  {field}: vec4f," for field in uniform_fields())
    lines = [
        f"struct Solve {{\n{fields}\n}}",
        "struct Span { texels: vec4f }",
        "@group(0) @binding(0) var<uniform> solve: Solve;",
        "@group(0) @binding(1) var<uniform> span: Span;",
    ]
    if uses_mix:
        lines.append(f"struct Mix {{ weights: array<vec4f, {PASS_IMAGES + 2}> }}")
        lines.append("@group(0) @binding(2) var<uniform> mix: Mix;")
    lines += [
        f"@group(0) @binding({number}) var {texture}: texture_2d<f32>;"
        for number, texture in enumerate(textures, start=3)
    ]
    lines.append(
        "fn texel_place(index: i32) -> vec2i { return vec2i(index & 2047, index >> 11u); }"
    )
    lines += [table_reader(table) for table in used] + readers
    rest = "".join(f", {one}" for one in handed)
    if made.result == VEC4:
        filled = f"{made.name}(index{rest})"
    else:  # four numbers a texel
        filled = f"vec4f({', '.join(f'{made.name}(4 * index + {k}{rest})' for k in range(4))})"
    lines += [body, f"fn texel(index: i32) -> vec4f {{ return {filled}; }}"]
    return "\n".join(lines) + "\n" + wgsl("flat_texel")

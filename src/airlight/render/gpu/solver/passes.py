"""Solver passes as data, and their shaders.

A pass fills one or two flat textures by a kernel of ``rays``, ``light``, ``packing`` or ``mixing``.
A host in Python or a browser needs only this list, the shaders and the ``plan``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Final, Literal

from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import (
    F32,
    FLAT_WIDTH,
    I32,
    VEC4,
    ShaderTable,
    StructValue,
    TupleType,
    Value,
)
from airlight.render.gpu.emit.texture_table import TextureTable
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.solver import light, mixing, packing, rays
from airlight.render.gpu.solver.tables import SOLVE, GridSizes, Tables
from airlight.solver.moments.harmonics import POLARISED
from airlight.solver.moments.stopping import PASS_ITERATES

#: Element types of an input texture: four wavelengths a texel, or scalars.
View = Literal["lanes", "numbers"]

#: Iterates of the light, the latest first.
ITERATES: Final = tuple(f"iterate_{i}" for i in range(PASS_ITERATES))


@dataclass(frozen=True)
class TextureInput:
    """Input texture of a pass.

    Attributes
    ----------
    texture : str
        Name in the plan.
    view : View
        Element type: vectors of four wavelengths, or scalars.
    from_sky : bool
        Whether index 0 is the ground's irradiance in a packed field.
    axes : tuple of str
        Lengths of the axes after the first: fields of ``GridSizes`` or numbers, and sums of both.
    """

    texture: str
    view: View = "lanes"
    from_sky: bool = False
    axes: tuple[str, ...] = ()


@dataclass(frozen=True)
class SolverPass:
    """Pass of the solver.

    Attributes
    ----------
    name : str
        Name of the pass and of its shader.
    function : callable
        Kernel of one texel; arguments: ``index``, ``host_inputs``, then ``texture_inputs``.
    targets : tuple of str
        Target textures of equal size, one for each result of the function; at most two, as some
        browsers limit a texel of all targets to 32 bytes.
    host_inputs : tuple of str
        Names from ``sizes``, ``tables``, ``first_point``, ``weights``, ``iterates``.
    texture_inputs : tuple of TextureInput
        Input textures in the order of the function's arguments.
    spanned : bool
        Whether the pass runs once per radius range.
    """

    name: str
    function: Any
    targets: tuple[str, ...]
    host_inputs: tuple[str, ...] = ("sizes", "tables")
    texture_inputs: tuple[TextureInput, ...] = ()
    spanned: bool = False


_ALONG: Final = ("sizes", "tables", "first_point")
_ROWS: Final = TextureInput("rows", axes=("sun_angles", f"degree + {2 + POLARISED}"))

#: Passes that run once per solve: ray optics and the first order.
ONCE: Final = (
    SolverPass("strength", rays.strength, ("strengths",)),
    SolverPass("factor", rays.factor, ("factors",)),
    SolverPass("share", rays.share, ("shares",)),
    SolverPass("transmittance", rays.transmittance, ("throughs",)),
    SolverPass("bounce", rays.bounce, ("bounces",), texture_inputs=(TextureInput("throughs"),)),
    SolverPass("projection", rays.projection, ("projections",)),
    SolverPass("depth", rays.depth, ("depths",), _ALONG, spanned=True),
    SolverPass(
        "radiance_once", light.radiance_once, ("radiances", "stokes_qs"), _ALONG,
        (
            TextureInput("shares"), TextureInput("strengths", axes=("constituents + 1",)),
            TextureInput("throughs"), TextureInput("depths", axes=("directions",)),
        ),
        spanned=True,
    ),
    SolverPass(
        "azimuthal_once", light.azimuthal_once, ("azimuthals",),
        texture_inputs=(TextureInput("radiances"), TextureInput("stokes_qs")),
    ),
    SolverPass(
        "gathered_moment", light.gathered_moment, ("first",), ("sizes",),
        (TextureInput("projections", "numbers"), TextureInput("azimuthals")),
    ),
)  # fmt: skip
#: Passes that pack a radiance field for the next sweep and for a march.
PACK: Final = (
    SolverPass(
        "highest", packing.highest, ("heights",), ("sizes",), (TextureInput("light", "numbers"),)
    ),
    SolverPass(
        "floor", packing.floor, ("floors",), ("sizes",), (TextureInput("heights", "numbers"),)
    ),
    SolverPass(
        "refined", packing.refined, ("fine",),
        texture_inputs=(TextureInput("light", "numbers"), TextureInput("floors", "numbers")),
    ),
    SolverPass(
        "highest_level", packing.highest_level, ("level_heights",), ("sizes",),
        (TextureInput("fine", "numbers"),),
    ),
    SolverPass(
        "node_scale", packing.node_scale, ("scales",),
        texture_inputs=(TextureInput("fine", "numbers"), TextureInput("level_heights", "numbers")),
    ),
    SolverPass(
        "packed", packing.packed, ("packed",), ("sizes",),
        (TextureInput("fine"), TextureInput("scales")),
    ),
)  # fmt: skip
#: Passes of a sweep: from the packed field to the next iterate.
SWEEP: Final = (
    SolverPass(
        "row", light.row, ("rows",), _ALONG,
        (
            TextureInput("factors", axes=("terms + 1",)),
            TextureInput("packed", axes=("sun_angles", "terms + 1")),
        ),
        spanned=True,
    ),
    SolverPass(
        "radiance_again", light.radiance_again, ("radiances",), _ALONG,
        (
            TextureInput("shares"), _ROWS, TextureInput("bounces"),
            TextureInput("packed", from_sky=True, axes=("sun_angles", "2")),
        ),
        spanned=True,
    ),
    SolverPass(
        "polarised_again", light.polarised_again, ("stokes_qs", "stokes_us"), _ALONG,
        (TextureInput("shares"), _ROWS), spanned=True,
    ),
    SolverPass(
        "azimuthal", light.azimuthal, ("azimuthals",),
        texture_inputs=(
            TextureInput("radiances"), TextureInput("stokes_qs"), TextureInput("stokes_us"),
        ),
    ),
    SolverPass(
        "gathered_onto", light.gathered_onto, ("iterate",), ("sizes",),
        (TextureInput("projections", "numbers"), TextureInput("azimuthals"), TextureInput("first")),
    ),
    SolverPass(
        "mean", mixing.mean, ("means",), ("sizes",),
        (TextureInput("iterate"), TextureInput("light")),
    ),
)  # fmt: skip
#: Passes of the Anderson step, with weights from the host.
MIX: Final = (
    SolverPass("sound", mixing.sound, ("sounds",), ("sizes", "weights", "iterates:numbers")),
    SolverPass(
        "next_guess",
        mixing.next_guess,
        ("light",),
        ("sizes", "weights", "iterates:lanes"),
        (TextureInput("sounds"),),
    ),
)
PASSES: Final = {one.name: one for one in (*ONCE, *PACK, *SWEEP, *MIX)}


def _input_table(name: str, one: TextureInput) -> TextureTable:
    """Table of a kernel argument in an input texture."""
    start = SOLVE.uniform("received").text if one.from_sky else ""
    spectral = one.view == "lanes"
    axes = tuple(_length(axis) for axis in one.axes)
    return TextureTable(
        name, one.texture, 1 + len(axes), spectral, start, by_number=not spectral, axes=axes
    )


def _length(axis: str) -> str:
    """Length of an axis of ``TextureInput`` as an expression of floats."""
    terms = axis.split(" + ")
    return " + ".join(
        SOLVE.uniform(one).text if one in GridSizes._fields else f"{one}.0" for one in terms
    )


def _weights_reader(dialect: ShaderDialect, spectral: bool) -> str:
    text = "mix.weights[index]" if spectral else "mix.weights[index >> 2][index & 3]"
    kind = VEC4 if spectral else F32
    return dialect.function("read_weights", [("index", I32)], kind, [text])


@cache
def shader(name: str, dialect: ShaderDialect = WGSL) -> str:
    """Shader of a pass: bindings, emitted functions, entry point ``fill``.

    Parameters
    ----------
    name : str
        Name from ``PASSES``.
    dialect : ShaderDialect
        Shading language.
    """
    one = PASSES[name]
    tables: list[TextureTable] = []
    arguments: list[Value] = [I32]
    handed: list[str] = []
    readers: list[str] = []
    for given in one.host_inputs:
        kind, _, view = given.partition(":")
        if kind == "sizes":
            arguments.append(SOLVE.struct_value(GridSizes))
        elif kind == "tables":
            arguments.append(SOLVE.struct_value(Tables))
        elif kind == "first_point":
            arguments.append(I32)
            handed.append(dialect.uniform("span.texels.z", I32))
        elif kind == "weights":
            spectral = name == "next_guess"
            arguments.append(ShaderTable("weights", 1, spectral))
            readers.append(_weights_reader(dialect, spectral))
        else:
            as_read: View = "lanes" if view == "lanes" else "numbers"
            iterates = [
                _input_table(iterate, TextureInput(iterate, as_read)) for iterate in ITERATES
            ]
            arguments.append(StructValue({iterate.name: iterate.table for iterate in iterates}))
            tables += iterates
    parameters = one.function.py_func.__code__.co_varnames[len(arguments) :]
    for parameter, reading in zip(parameters, one.texture_inputs, strict=False):
        tables.append(_input_table(f"{parameter}_table", reading))
        arguments.append(tables[-1].table)
    emitter = Emitter(dialect)
    made = emitter.add(one.function, *arguments)
    body = emitter.module()
    tables += SOLVE.read_by(body)
    textures = list(dict.fromkeys(table.texture for table in tables))
    lines = [
        SOLVE.text(dialect),
        dialect.uniforms("span", ["texels"], 0, 1),
    ]
    if readers:
        lines.append(dialect.uniforms("mix", [("weights", PASS_ITERATES + 2)], 0, 2))
    slots = {texture: slot for slot, texture in enumerate(textures, start=3)}
    lines += [dialect.texture(texture, 0, slot) for texture, slot in slots.items()]
    for table in tables:
        texture = dialect.texture_name(table.texture, 0, slots[table.texture])
        readers.append(table.reader(dialect, texture))
    rest = "".join(f", {text}" for text in handed)
    count = len(one.targets)
    found, filled = made.result, f"{made.name}(index{rest})"
    if not isinstance(found, TupleType) and found != VEC4:  # four numbers a texel
        numbers = ", ".join(f"{made.name}(4 * index + {k}{rest})" for k in range(4))
        found, filled = VEC4, f"{dialect.type_name(VEC4)}({numbers})"
    values = ["value"] if count == 1 else [dialect.part("value", k) for k in range(count)]
    filled = dialect.let("value", found, filled)
    return dialect.module([*lines, *readers, body, _entry(dialect, filled, values)])


def _entry(dialect: ShaderDialect, filled: str, values: list[str]) -> str:
    """Entry point that fills a range of texels of flat textures."""
    x, y = dialect.convert("at.x", I32), dialect.convert("at.y", I32)
    body = [
        dialect.let("number", I32, f"{y} * {FLAT_WIDTH} + {x}"),
        dialect.let("first", I32, dialect.uniform("span.texels.x", I32)),
        dialect.let("last", I32, dialect.uniform("span.texels.y", I32) + " - 1"),
        # Discarded invocations may continue: they must not follow rays that do not exist.
        dialect.let("index", I32, "min(max(number, first), last)"),
        filled,
        "if (number != index) {",
        "  discard;",
        "}",
    ]
    return dialect.fragment("fill", len(values), body, values)

"""Shaders of rendering: sky-view LUT and pixels, with textures, functions and entry points.

They are independent of the planet, as sizes are uniforms.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitted import Emitted
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import (
    F32,
    FLAT_WIDTH,
    I32,
    VEC4,
    Constant,
    ConstantFunction,
    LocalArray,
    StructValue,
)
from airlight.render.gpu.emit.uniform_struct import Fixed, UniformStruct
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.picture.uniforms import CHANNELS, FRAME
from airlight.render.pixels.bare_body import BareBody, BodyFrame, body_coverage, body_light
from airlight.render.pixels.ground import GROUND_VALUES
from airlight.render.pixels.pixel import (
    FrameTables,
    ViewUniforms,
    oblate_light,
    pixel_light,
)
from airlight.render.pixels.pixel_transmittance import pixel_transmittance
from airlight.render.pixels.render_tables import MAX_CONSTITUENTS, MAX_POINTS, MAX_TERMS
from airlight.render.pixels.samples import light_of_centre, sampled_light
from airlight.render.pixels.scene_disc import scene_disc, small_disc
from airlight.render.pixels.sky_view_lut import Observer, mirrored_texel, sky_view_texel
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.solver.moments.march_tables import MarchTables, spectral_sizes, workspace_sizes

#: Angular distance from the star that no pixel exceeds. [rad]
_NO_REACH: Final = 4.0


@dataclass(frozen=True, eq=False)
class Shader:
    """Shader with its language, textures and entry points.

    Attributes
    ----------
    name : str
        Name of the shader.
    dialect : ShaderDialect
        Shading language.
    functions : str
        Declarations shared by all entry points: uniforms, textures and functions.
    entries : dict from str to str
        Text of each entry point, a fragment function.
    textures : tuple of str
        Textures in binding order, after the uniforms.
    emitter : Emitter
        Emitter of its functions.
    struct : UniformStruct
        Its uniforms and tables.
    """

    name: str
    dialect: ShaderDialect
    functions: str
    entries: dict[str, str]
    textures: tuple[str, ...]
    emitter: Emitter
    struct: UniformStruct = FRAME

    @property
    def text(self) -> str:
        """Source with all entry points, for languages that allow several."""
        return self.dialect.module([self.functions, *self.entries.values()])

    def entry_text(self, entry: str) -> str:
        """Source with one entry point.

        Parameters
        ----------
        entry : str
            Name from ``entries``.
        """
        return self.dialect.module([self.functions, self.entries[entry]])


def assembled(
    name: str, entries: dict[str, str], emitter: Emitter, struct: UniformStruct = FRAME
) -> Shader:
    """Shader from its entry points, their emitted functions and the tables that these read.

    Parameters
    ----------
    entries : dict from str to str
        Source of each entry point.
    emitter : Emitter
        Emitter of the functions that the entry points call.
    struct : UniformStruct
        Uniforms and tables that they read.
    """
    dialect = emitter.dialect
    assert isinstance(dialect, ShaderDialect)
    body = emitter.module()
    tables = struct.read_by("\n".join([body, *entries.values()]))
    textures = tuple(dict.fromkeys(table.texture for table in tables))
    slots = {texture: slot for slot, texture in enumerate(textures, start=1)}
    lines = [struct.text(dialect)]
    lines += [dialect.texture(texture, 0, slot) for texture, slot in slots.items()]
    for table in tables:
        texture = dialect.texture_name(table.texture, 0, slots[table.texture])
        lines.append(table.reader(dialect, texture))
    functions = "\n".join([*lines, body])
    return Shader(name, dialect, functions, entries, textures, emitter, struct)


@cache
def sky_air_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Sky-view LUT shader: path radiance, and radiance of a white Lambert ground behind it.

    Parameters
    ----------
    dialect : ShaderDialect
        Shading language.
    """
    return _sky_shader(dialect, "sky_air", "air_texel", (0, 1), air=True)


@cache
def sky_peaks_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Sky-view LUT shader: single scattering by separated constituents, without phase function."""
    return _sky_shader(dialect, "sky_peaks", "peaks_texel", (2, 3), peaks=True)


@cache
def sky_polarised_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Sky-view LUT shader: I + Q and I + U of the path radiance."""
    return _sky_shader(
        dialect, "sky_polarised", "polarised_texel", (4, 5), air=True, polarised=True
    )


def _sky_shader(
    dialect: ShaderDialect,
    name: str,
    function: str,
    layers: tuple[int, int],
    *,
    air: bool = False,
    peaks: bool = False,
    polarised: bool = False,
) -> Shader:
    emitter = Emitter(dialect)
    made = emitter.add(
        sky_view_texel, I32, I32, _whole_window(), Constant(air), Constant(peaks),
        Constant(polarised), FRAME.struct_value(Observer), FRAME.struct_value(MarchTables),
        march_workspace(emitter),
        name=function,
    )  # fmt: skip
    return _lut_shader(emitter, name, made, layers)


def _lut_shader(emitter: Emitter, name: str, made: Emitted, layers: tuple[int, ...]) -> Shader:
    """Shader of the texels of some layers, from the function that fills one."""
    dialect = emitter.dialect
    assert isinstance(dialect, ShaderDialect)
    columns = dialect.uniform(FRAME.uniform("sky_columns").text, I32)
    places = ("number % columns", "number / columns")
    x, y = dialect.convert("at.x", I32), dialect.convert("at.y", I32)
    body = [
        dialect.let("columns", I32, columns),
        dialect.let("number", I32, f"{y} * {FLAT_WIDTH} + {x}"),
        *filled_by(made, places, dialect),
    ]
    results = [f"work_radiance[{layer}]" for layer in layers]
    entry = dialect.fragment(name, len(layers), body, results)
    return assembled(name, {name: entry}, emitter)


@cache
def sky_mirrored_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Sky-view LUT shader: mean sky that the sea mirrors, from the table in the layer ``air``."""
    emitter = Emitter(dialect)
    view = FRAME.struct_value(ViewUniforms)
    made = emitter.add(
        mirrored_texel,
        I32,
        I32,
        _whole_window(),
        view.fields["sky_air"],
        FRAME.struct_value(Observer),
        FRAME.struct_value(MarchTables),
        march_workspace(emitter),
        name="texel_of_sea",
    )
    return _lut_shader(emitter, "sky_mirrored", made, (0,))


def march_workspace(emitter: Emitter) -> StructValue:
    """March workspace of one line of sight, for the emitter.

    Parameters
    ----------
    emitter : Emitter
        Emitter of the shader.
    """
    numbers = workspace_sizes(MAX_CONSTITUENTS, MAX_POINTS, MAX_TERMS)
    arrays = {name: LocalArray(size) for name, size in numbers.items()}
    arrays |= {name: LocalArray(n, VEC4) for name, n in spectral_sizes(MAX_CONSTITUENTS).items()}
    return StructValue(
        {name: emitter.module_array(f"work_{name}", kind) for name, kind in arrays.items()}
    )


def filled_by(made: Emitted, arguments: Sequence[str], dialect: ShaderDialect) -> list[str]:
    """Statements that declare arrays and call a function that fills them.

    Parameters
    ----------
    made : Emitted
        Function whose other parameters are arrays.
    """
    declared, call = called(made, arguments, dialect)
    return [*declared, f"{call};"]


def called(
    made: Emitted, arguments: Sequence[str], dialect: ShaderDialect
) -> tuple[list[str], str]:
    """Declarations of the arrays of a function, and its call; arguments of ``filled_by``."""
    handed = [one for several in made.argument_lists(dialect) for one in several]
    arrays = [(name, kind) for name, kind in handed if isinstance(kind, LocalArray)]
    given = [*arguments, *(dialect.array_argument(name) for name, _ in arrays)]
    declared = [dialect.declared(name, kind) for name, kind in arrays]
    return declared, f"{made.name}({', '.join(given)})"


def _whole_window() -> StructValue:
    """``SkyViewWindow`` of the complete LUT, for the emitter."""
    columns, rows, first = FRAME.uniform("sky_columns"), FRAME.uniform("sky_rows"), Constant(0)
    values = (columns, rows, first, columns, first, rows, first, rows)
    return StructValue(dict(zip(SkyViewWindow._fields, values, strict=True)))


@cache
def picture_shader(
    exact: bool, fixed: Fixed = (), oblate: bool = False, dialect: ShaderDialect = WGSL
) -> Shader:
    """Shader of linear radiance of pixels, from the sky-view LUT or marched.

    Parameters
    ----------
    exact : bool
        Whether every pixel is marched.
    fixed : tuple of (str, value)
        Integer and boolean uniforms bound as constants; otherwise a software GPU evaluates both
        sides of every branch.
    oblate : bool
        Whether pixels are those of an oblate planet from outside the air, all marched.
    """
    # a shader of rows without an edge has no loop over samples
    once = dict(fixed).get("samples") == 1 and not dict(fixed).get("edges", True)
    light = oblate_light if oblate else pixel_light
    lines, emitter = _of_pixels(light, exact, once, fixed, dialect)
    return linear_shader("picture", "linear_picture", lines, emitter)


@cache
def small_disc_shader(fixed: Fixed, dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the disc of a star smaller than two pixels, behind the air.

    Parameters
    ----------
    fixed : tuple of (str, value)
        Argument of ``picture_shader``.
    """
    lines, emitter = _of_pixels(small_disc, False, True, fixed, dialect)
    return linear_shader("disc", "disc_of_star", lines, emitter)


@cache
def disc_shader(fixed: Fixed, dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the disc of a star, behind the air and a body.

    Parameters
    ----------
    fixed : tuple of (str, value)
        Argument of ``body_shader``.
    """
    emitter = Emitter(dialect)
    frame, columns = _body_frame(emitter, fixed)
    result = emitter.module_array("result", LocalArray(1, VEC4))
    made = emitter.add(scene_disc, F32, F32, frame, columns, result, name="disc_in_pixel")
    lines = filled_by(made, position(), dialect)
    return linear_shader("disc", "disc_of_star", lines, emitter)


def linear_shader(
    name: str, entry: str, lines: list[str], emitter: Emitter, struct: UniformStruct = FRAME
) -> Shader:
    """Shader of the linear sRGB of pixels from their spectral radiance.

    Parameters
    ----------
    name, entry : str
        Names of the shader and of its entry point.
    lines : list of str
        Statements that fill ``result``.
    emitter, struct :
        Arguments of ``assembled``.
    """
    dialect = emitter.dialect
    assert isinstance(dialect, ShaderDialect)
    light = f"{dialect.type_name(VEC4)}({', '.join(CHANNELS)}, 1.0)"
    lines += [dialect.let(one, F32, f"dot(result[0], frame.{one})") for one in CHANNELS]
    return assembled(name, {entry: dialect.fragment(entry, 1, lines, [light])}, emitter, struct)


@cache
def transmittance_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the transmittance of the air by channel, for light of the star's colour.

    The fourth channel is 0.
    """
    lines, emitter = _of_pixels(pixel_transmittance, False, True, (), dialect)
    vector = dialect.type_name(VEC4)
    lines += [
        dialect.let(one, F32, f"dot(result[0], {own}) / dot({vector}(1.0, 1.0, 1.0, 1.0), {own})")
        for one, own in ((name, f"frame.{name}") for name in CHANNELS)
    ]
    entry = dialect.fragment("transmittance", 1, lines, [f"{vector}({', '.join(CHANNELS)}, 0.0)"])
    return assembled("transmittance", {"transmittance": entry}, emitter)


def _of_pixels(
    light: Callable[..., Any], exact: bool, once: bool, fixed: Fixed, dialect: ShaderDialect
) -> tuple[list[str], Emitter]:
    """Statements that call ``pixel_light`` or the like for a fragment, and their emitter."""
    emitter = Emitter(dialect)
    return call_of_light(emitter, light, exact, once, fixed, march_workspace(emitter)), emitter


def call_of_light(
    emitter: Emitter,
    light: Callable[..., Any],
    exact: bool,
    once: bool,
    fixed: Fixed,
    work: StructValue,
) -> list[str]:
    """Statements that fill ``result`` with the light of a fragment.

    Parameters
    ----------
    emitter : Emitter
        Emitter of the shader.
    light : inlined function
        ``pixel_light`` or the like.
    exact, fixed :
        Arguments of ``picture_shader``.
    once : bool
        Whether the pixel has one sample.
    work : StructValue
        Workspace.
    """
    dialect = emitter.dialect
    assert isinstance(dialect, ShaderDialect)
    places = ("color", "result") if once else ("color", "total", "result")
    kinds = {"color": LocalArray(GROUND_VALUES)}
    arrays = [emitter.module_array(n, kinds.get(n, LocalArray(1, VEC4))) for n in places]
    made = emitter.add(
        light_of_centre if once else sampled_light,
        F32, F32, ConstantFunction(light), Constant(exact),
        StructValue(dict(zip(FrameTables._fields, (
            Constant(_NO_REACH), _whole_window(), *(
                FRAME.struct_value(one, fixed) for one in (Observer, ViewUniforms, MarchTables)
            ),
        ), strict=True))),
        work, *arrays, name="light_of_pixel",
    )  # fmt: skip
    return filled_by(made, position(), dialect)


def position() -> tuple[str, str]:
    """Column and row of a fragment in the frame."""
    places = (("x", "first_column"), ("y", "first_row"))
    column, row = (f"at.{at} + {FRAME.uniform(name).text}" for at, name in places)
    return column, row


@cache
def body_shader(cover: bool, fixed: Fixed, dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the light of a body without air, or of its coverage.

    Parameters
    ----------
    cover : bool
        Whether the coverage is rendered.
    fixed : tuple of (str, value)
        Choices of ``BareBody`` and the camera, bound as constants.
    """
    emitter = Emitter(dialect)
    frame, columns = _body_frame(emitter, fixed)
    vector, name = dialect.type_name(VEC4), "coverage" if cover else "light_of_body"
    color = emitter.module_array("color", LocalArray(4))
    if cover:
        made = emitter.add(body_coverage, F32, F32, frame, columns, color, name="body_in_pixel")
        parts = ["seen"] * 4
    else:
        made = emitter.add(body_light, F32, F32, frame, columns, color, name="body_in_pixel")
        own = [FRAME.uniform(f"body_color_{axis}").text for axis in "xyz"]
        parts = [*(f"{dialect.part('seen', i)} * {one}" for i, one in enumerate(own)), "0.0"]
    lines, call = called(made, position(), dialect)
    assert made.result is not None
    lines.append(dialect.let("seen", made.result, call))
    entry = dialect.fragment(name, 1, lines, [f"{vector}({', '.join(parts)})"])
    return assembled(name, {name: entry}, emitter)


def _body_frame(emitter: Emitter, fixed: Fixed) -> tuple[StructValue, LocalArray]:
    """``BodyFrame`` for the emitter, and the columns along a line of sight."""
    kinds = (ViewUniforms, BareBody, Observer, MarchTables)
    values = (FRAME.struct_value(one, fixed) for one in kinds)
    frame = StructValue(dict(zip(BodyFrame._fields, values, strict=True)))
    return frame, emitter.module_array("columns", LocalArray(MAX_CONSTITUENTS))

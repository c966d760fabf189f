"""Complete shaders: textures, emitted functions and entry points of each.

They do not depend on the planet: sizes are uniforms.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Final

from airlight.gpu.device.flat import FLAT_WIDTH
from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.emitter import Emitter
from airlight.gpu.emit.shader_types import (
    F32,
    I32,
    VEC4,
    Bundle,
    Constant,
    LocalArray,
    TupleType,
    Value,
)
from airlight.gpu.emit.texture_table import TextureTable
from airlight.gpu.emit.wgsl import WGSL
from airlight.gpu.picture.uniforms import CHANNELS, struct_text, uniform
from airlight.optics.reflection import Reflection
from airlight.pixels.pixel import Display, Screen, displayed, pixel_light
from airlight.pixels.shown import FIELD_TABLES, SCALAR_TABLES, SPECTRAL_TABLES, Shown
from airlight.pixels.sky_table import Observer, sky_texel

#: Uniforms whose values are known when a shader is written.
Fixed = tuple[tuple[str, int | bool], ...]

#: Textures of a shader, after the uniforms.
TEXTURES: Final = ("scalars", "spectra", "fields", "ground", "air", "behind", "first", "second")
#: Layers of the table of the sky, by their names in ``Screen``.
_LAYERS: Final = {
    "sky_air": "air", "sky_ground": "behind", "sky_first": "first", "sky_second": "second",
}  # fmt: skip


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
        Part common to all its entry points: uniforms, textures and functions.
    entries : dict from str to str
        Text of each entry point, a fragment function.
    textures : tuple of str
        Textures that it reads, from ``TEXTURES``.
    emitter : Emitter
        Emitter with its functions and their sources.
    """

    name: str
    dialect: ShaderDialect
    functions: str
    entries: dict[str, str]
    textures: tuple[str, ...]
    emitter: Emitter

    @property
    def text(self) -> str:
        """Shader with all its entry points, for a language that allows several."""
        return self.dialect.module([self.functions, *self.entries.values()])

    def entry_text(self, entry: str) -> str:
        """Shader with one entry point.

        Parameters
        ----------
        entry : str
            Name from ``entries``.
        """
        return self.dialect.module([self.functions, self.entries[entry]])


@cache
def tables() -> dict[str, TextureTable]:
    """Tables of the shaders, by name."""
    found = {}
    for texture, ranks, spectral in (
        ("scalars", SCALAR_TABLES, False),
        ("spectra", dict.fromkeys(SPECTRAL_TABLES, 1), True),
        ("fields", dict.fromkeys(FIELD_TABLES, 1), True),
        ("ground", {"levels": 2, "texels": 1}, False),
    ):
        for name, rank in ranks.items():
            where = f"frame.table_{name}"
            found[name] = TextureTable(
                name, texture, rank, spectral, f"{where}.x", where, 1, pair=rank == 4
            )
    layers = {name: TextureTable(name, texture, 1, True) for name, texture in _LAYERS.items()}
    return found | layers


def _bundle(kind: Any, fixed: Fixed = ()) -> Bundle:
    """Bundle of a NamedTuple, each field a table, a layer or a uniform of the shader."""
    fields: dict[str, Value] = {}
    known = dict(fixed)
    for name in kind._fields:
        if (kind, name) == (Shown, "ground"):
            fields[name] = _bundle(Reflection, fixed)
        elif name in known:
            fields[name] = Constant(known[name])
        elif name in tables():
            fields[name] = tables()[name].table
        else:
            fields[name] = uniform(name)
    return Bundle(fields)


@cache
def light(fixed: Fixed = ()) -> Bundle:
    """Solution, for the emitter.

    Parameters
    ----------
    fixed : tuple
        Names and values that are bound when the shader is written.
    """
    return _bundle(Shown, fixed)


@cache
def observer(fixed: Fixed = ()) -> Bundle:
    """Observer, for the emitter.

    Parameters
    ----------
    fixed : tuple
        Constants as in ``light``.
    """
    return _bundle(Observer, fixed)


@cache
def screen(fixed: Fixed = ()) -> Bundle:
    """Camera, for the emitter.

    Parameters
    ----------
    fixed : tuple
        Constants as in ``light``.
    """
    return _bundle(Screen, fixed)


@cache
def display(fixed: Fixed = ()) -> Bundle:
    """Tone map and encoding, for the emitter.

    Parameters
    ----------
    fixed : tuple
        Constants as in ``light``.
    """
    return _bundle(Display, fixed)


def assembled(
    name: str, entries: dict[str, str], textures: tuple[str, ...], emitter: Emitter
) -> Shader:
    """Assemble a shader from its entry points and the functions that were emitted for them.

    Parameters
    ----------
    name : str
        Name of the shader.
    entries : dict from str to str
        Text of its entry points.
    textures : tuple of str
        Textures that the shader reads, in the order of its bindings.
    emitter : Emitter
        Emitter with the functions that the entry points call, in a shading language.
    """
    dialect = emitter.dialect
    assert isinstance(dialect, ShaderDialect)
    lines = [struct_text(dialect)]
    lines += [dialect.texture(one, 0, i) for i, one in enumerate(textures, start=1)]
    for table in tables().values():
        if table.texture in textures:
            slot = textures.index(table.texture) + 1
            lines.append(table.reader(dialect, dialect.texture_name(table.texture, 0, slot)))
    functions = "\n".join([*lines, emitter.module()])
    return Shader(name, dialect, functions, entries, textures, emitter)


@cache
def sky_air_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the air's own light and that of a white ground behind it, a line of sight a texel.

    Parameters
    ----------
    dialect : ShaderDialect
        Shading language.
    """
    return _sky_shader(dialect, "sky_air", "air_texel", (0, 1), gathers=True, peaks=False)


@cache
def sky_peaks_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of single scattering by the two peaked constituents, without phase functions.

    Parameters
    ----------
    dialect : ShaderDialect
        Shading language.
    """
    return _sky_shader(dialect, "sky_peaks", "peaks_texel", (2, 3), gathers=False, peaks=True)


def _sky_shader(
    dialect: ShaderDialect,
    name: str,
    function: str,
    layers: tuple[int, int],
    *,
    gathers: bool,
    peaks: bool,
) -> Shader:
    emitter = Emitter(dialect)
    found = emitter.module_array("found", LocalArray(4, VEC4))
    emitter.add(
        sky_texel, I32, I32, I32, I32, Constant(gathers), Constant(peaks), observer(), light(),
        found, name=function,
    )  # fmt: skip
    columns, rows = (dialect.uniform(uniform(one).text, I32) for one in ("sky_columns", "sky_rows"))
    places = ("number % columns", "number / columns", "columns", rows)
    x, y = dialect.converted("at.x", I32), dialect.converted("at.y", I32)
    body = [
        dialect.kept("columns", I32, columns),
        dialect.kept("number", I32, f"{y} * {FLAT_WIDTH} + {x}"),
        *_filled("found", found, function, places, dialect),
    ]
    entry = dialect.fragment(name, 2, body, [f"found[{layer}]" for layer in layers])
    return assembled(name, {name: entry}, TEXTURES[:3], emitter)


def _filled(
    name: str, array: LocalArray, function: str, places: tuple[str, ...], dialect: ShaderDialect
) -> list[str]:
    """Statements in which a function fills an array."""
    if array.variable:
        return [f"{function}({', '.join(places)});"]
    handed = ", ".join([*places, dialect.array_argument(name)])
    return [dialect.declared(name, array), f"{function}({handed});"]


@cache
def picture_shader(exact: bool, fixed: Fixed = (), dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of a pixel's light and its display: from the table, or by its own march.

    Parameters
    ----------
    exact : bool
        Whether each pixel is marched.
    fixed : tuple of (str, value)
        Integers and switches of the uniforms that are known, bound instead of read: a software
        device evaluates both sides of every branch.
    dialect : ShaderDialect
        Shading language.
    """
    emitter = Emitter(dialect)
    found = emitter.module_array("found", LocalArray(1, VEC4))
    emitter.add(
        pixel_light, F32, F32, Constant(exact), observer(fixed), screen(fixed), light(fixed),
        found, name="light_of_pixel",
    )  # fmt: skip
    shown = emitter.add(displayed, F32, F32, F32, display(fixed), name="displayed").result
    assert isinstance(shown, TupleType)
    row = f"at.y + {uniform('first_row').text}"
    lines = [
        *_filled("found", found, "light_of_pixel", ("at.x", row), dialect),
        *(dialect.kept(one, F32, f"dot(found[0], frame.{one})") for one in CHANNELS),
    ]
    vector = f"{dialect.type_name(VEC4)}({{}}, 1.0)"
    parts = [dialect.part("seen", i) for i in range(3)]
    entries = {
        "linear_picture": dialect.fragment(
            "linear_picture", 1, lines, [vector.format(", ".join(CHANNELS))]
        ),
        "shown_picture": dialect.fragment(
            "shown_picture",
            1,
            [*lines, dialect.kept("seen", shown, f"displayed({', '.join(CHANNELS)})")],
            [vector.format(", ".join(parts))],
        ),
    }
    return assembled("picture", entries, TEXTURES[: 4 if exact else 8], emitter)


def all_shaders() -> tuple[Shader, ...]:
    """All shaders of the pictures."""
    return (sky_air_shader(), sky_peaks_shader(), picture_shader(False), picture_shader(True))

"""The shaders, whole: what each reads, the functions emitted for it, and its entry points.

They do not depend on the planet: sizes stand in the uniforms.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Final

from airlight.gpu.device.flat import FLAT_WIDTH
from airlight.gpu.emit.dialect import ShaderDialect
from airlight.gpu.emit.emitter import Emitter
from airlight.gpu.emit.shader_types import F32, I32, VEC4, Bundle, Constant, Room, Several, Value
from airlight.gpu.emit.texture_table import TextureTable
from airlight.gpu.emit.wgsl import WGSL
from airlight.gpu.picture.uniforms import CHANNELS, struct_text, uniform
from airlight.pixels.pixel import Display, Screen, displayed, pixel_light
from airlight.pixels.shown import FIELD_TABLES, SCALAR_TABLES, SPECTRAL_TABLES, Shown
from airlight.pixels.sky_table import Observer, sky_texel

#: Numbers of the uniforms that are known when a shader is written.
Fixed = tuple[tuple[str, int | bool], ...]

#: The textures of a shader, after the uniforms.
TEXTURES: Final = ("scalars", "spectra", "fields", "ground", "air", "behind", "first", "second")
#: Layers of the table of the sky by the names that ``Screen`` has for them.
_LAYERS: Final = {
    "sky_air": "air", "sky_ground": "behind", "sky_first": "first", "sky_second": "second",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Shader:
    """A shader and what it needs.

    Attributes
    ----------
    name : str
    dialect : ShaderDialect
        Its language.
    functions : str
        What all its entry points need: uniforms, textures and functions.
    entries : dict from str to str
        Entry points: a fragment function each.
    textures : tuple of str
        What it reads, from ``TEXTURES``.
    emitter : Emitter
        Knows the functions and where they come from.
    """

    name: str
    dialect: ShaderDialect
    functions: str
    entries: dict[str, str]
    textures: tuple[str, ...]
    emitter: Emitter

    @property
    def text(self) -> str:
        """The shader with all its entry points, for a language that allows several."""
        return self.dialect.module([self.functions, *self.entries.values()])

    def entry_text(self, entry: str) -> str:
        """The shader with one entry point.

        Parameters
        ----------
        entry : str
            One of ``entries``.
        """
        return self.dialect.module([self.functions, self.entries[entry]])


@cache
def tables() -> dict[str, TextureTable]:
    """Each table of the shaders."""
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
    """A NamedTuple of which the shader finds each field in tables, layers or uniforms."""
    fields: dict[str, Value] = {}
    known = dict(fixed)
    for name in kind._fields:
        if name in known:
            fields[name] = Constant(known[name])
        elif name in tables():
            fields[name] = tables()[name].table
        else:
            fields[name] = uniform(name)
    return Bundle(fields)


@cache
def light(fixed: Fixed = ()) -> Bundle:
    """The solution, for the emitter.

    Parameters
    ----------
    fixed : tuple
        Names and numbers that are bound when the shader is written.
    """
    return _bundle(Shown, fixed)


@cache
def observer(fixed: Fixed = ()) -> Bundle:
    """Who looks, for the emitter.

    Parameters
    ----------
    fixed : tuple
        As in ``light``.
    """
    return _bundle(Observer, fixed)


@cache
def screen(fixed: Fixed = ()) -> Bundle:
    """The camera, for the emitter.

    Parameters
    ----------
    fixed : tuple
        As in ``light``.
    """
    return _bundle(Screen, fixed)


@cache
def display(fixed: Fixed = ()) -> Bundle:
    """Tone map and encoding, for the emitter.

    Parameters
    ----------
    fixed : tuple
        As in ``light``.
    """
    return _bundle(Display, fixed)


def assembled(
    name: str, entries: dict[str, str], textures: tuple[str, ...], emitter: Emitter
) -> Shader:
    """A shader of its entry points and the functions that were emitted for them.

    Parameters
    ----------
    name : str
        Of the shader.
    entries : dict from str to str
        Its entry points.
    textures : tuple of str
        What the shader reads, in the order of its bindings.
    emitter : Emitter
        With the functions that the entry points call; in a language of shaders.
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
    """The air's own light and that of a white ground behind it, a texel a line of sight.

    Parameters
    ----------
    dialect : ShaderDialect
        The language.
    """
    return _sky_shader(dialect, "sky_air", "air_texel", (0, 1), gathers=True, peaks=False)


@cache
def sky_peaks_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """What the two peaked constituents scatter once, without their phase functions.

    Parameters
    ----------
    dialect : ShaderDialect
        The language.
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
    found = emitter.module_array("found", Room(4, VEC4))
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
    name: str, array: Room, function: str, places: tuple[str, ...], dialect: ShaderDialect
) -> list[str]:
    """Statements that let a function fill an array."""
    if array.variable:
        return [f"{function}({', '.join(places)});"]
    handed = ", ".join([*places, dialect.array_argument(name)])
    return [dialect.declared(name, array), f"{function}({handed});"]


@cache
def picture_shader(exact: bool, fixed: Fixed = (), dialect: ShaderDialect = WGSL) -> Shader:
    """A pixel's light and what a display shows of it: from the table, or by its own march.

    Parameters
    ----------
    exact : bool
        Whether each pixel has a march of its own.
    fixed : tuple of (str, value)
        Whole numbers and switches of the uniforms that are known, in place of what stands there:
        a software device works out all sides of every choice.
    dialect : ShaderDialect
        The language.
    """
    emitter = Emitter(dialect)
    found = emitter.module_array("found", Room(1, VEC4))
    emitter.add(
        pixel_light, F32, F32, Constant(exact), observer(fixed), screen(fixed), light(fixed),
        found, name="light_of_pixel",
    )  # fmt: skip
    shown = emitter.add(displayed, F32, F32, F32, display(fixed), name="displayed").result
    assert isinstance(shown, Several)
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
    """Every shader of the pictures."""
    return (sky_air_shader(), sky_peaks_shader(), picture_shader(False), picture_shader(True))

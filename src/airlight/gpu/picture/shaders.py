"""The shaders, whole: what each reads, the functions emitted for it, and its entry points.

They do not depend on the planet: sizes stand in the uniforms.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Final

from airlight.gpu.device.fragment_pass import wgsl
from airlight.gpu.emit.emitter import Emitter
from airlight.gpu.emit.shader_types import F32, I32, VEC4, Bundle, Constant, Room, Table, Value
from airlight.gpu.picture.uniforms import struct_text, table_text, uniform
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
        Of its file.
    text : str
        WGSL.
    entries : tuple of str
        Its fragment functions.
    textures : tuple of str
        What it reads, from ``TEXTURES``.
    emitter : Emitter
        Knows the functions and where they come from.
    """

    name: str
    text: str
    entries: tuple[str, ...]
    textures: tuple[str, ...]
    emitter: Emitter


@cache
def tables() -> dict[str, tuple[Table, str]]:
    """Each table, and the texture that it stands in."""
    found = {name: (Table(name, rank), "scalars") for name, rank in SCALAR_TABLES.items()}
    found |= {name: (Table(name, 1, True), "spectra") for name in SPECTRAL_TABLES}
    found |= {name: (Table(name, 1, True), "fields") for name in FIELD_TABLES}
    return found | {"levels": (Table("levels", 2), "ground"), "texels": (Table("texels"), "ground")}


def _bundle(kind: Any, fixed: Fixed = ()) -> Bundle:
    """A NamedTuple of which the shader finds each field in tables, layers or uniforms."""
    fields: dict[str, Value] = {}
    known = dict(fixed)
    for name in kind._fields:
        if name in known:
            fields[name] = Constant(known[name])
        elif name in tables():
            fields[name] = tables()[name][0]
        elif name in _LAYERS:
            fields[name] = Table(name, 1, True)
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
    name: str, entries: tuple[str, ...], textures: tuple[str, ...], emitter: Emitter
) -> Shader:
    """A shader of a file of entry points and the functions that were emitted for it.

    Parameters
    ----------
    name : str
        Of the file in ``gpu/wgsl``.
    entries : tuple of str
        Its entry points.
    textures : tuple of str
        What the shader reads, in the order of its bindings.
    emitter : Emitter
        With the functions that the entry points call.
    """
    lines = [struct_text()]
    for i, texture in enumerate(textures):
        lines.append(f"@group(0) @binding({i + 1}) var {texture}: texture_2d<f32>;\n")
    lines += [table_text(table, where) for table, where in tables().values() if where in textures]
    lines += [
        f"fn read_{layer}(index: i32) -> vec4f {{\n"
        f"  return textureLoad({texture}, vec2i(index & 2047, index >> 11), 0);\n}}\n"
        for layer, texture in _LAYERS.items()
        if texture in textures
    ]
    text = "\n".join([*lines, emitter.module(), wgsl(name)])
    return Shader(name, text, entries, textures, emitter)


@cache
def sky_air_shader() -> Shader:
    """The air's own light and that of the ground behind it, a texel a line of sight."""
    return _sky_shader("sky_air", "air_texel", gathers=True, peaks=False)


@cache
def sky_peaks_shader() -> Shader:
    """What peaked constituents scatter once, without their phase functions."""
    return _sky_shader("sky_peaks", "peaks_texel", gathers=False, peaks=True)


def _sky_shader(name: str, function: str, *, gathers: bool, peaks: bool) -> Shader:
    emitter = Emitter()
    emitter.add(
        sky_texel, I32, I32, I32, I32, Constant(gathers), Constant(peaks), observer(), light(),
        Room(4, VEC4), name=function,
    )  # fmt: skip
    return assembled(name, (name,), TEXTURES[:3], emitter)


@cache
def picture_shader(exact: bool, fixed: Fixed = ()) -> Shader:
    """A pixel's light and what a display shows of it: from the table, or by its own march.

    Parameters
    ----------
    exact : bool
        Whether each pixel has a march of its own.
    fixed : tuple of (str, value)
        Whole numbers and switches of the uniforms that are known, in place of what stands there:
        a software device works out all sides of every choice.
    """
    emitter = Emitter()
    emitter.add(
        pixel_light, F32, F32, Constant(exact), observer(fixed), screen(fixed), light(fixed),
        Room(1, VEC4), name="light_of_pixel",
    )  # fmt: skip
    emitter.add(displayed, F32, F32, F32, display(fixed), name="displayed")
    return assembled(
        "picture", ("linear_picture", "shown_picture"), TEXTURES[: 4 if exact else 8], emitter
    )


def all_shaders() -> tuple[Shader, ...]:
    """Every shader of the pictures."""
    return (sky_air_shader(), sky_peaks_shader(), picture_shader(False), picture_shader(True))

"""Shaders of the display passes: glare, exposure, tone map and encoding."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from airlight.image.added_light import added_texel, covering_texel, layered_texel
from airlight.image.displayed import Display, displayed
from airlight.image.glare import coarser_texel, glared_texel, spread_texel
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import F32, I32, VEC4, StructValue, TupleType, Value
from airlight.render.gpu.emit.uniform_struct import Fixed
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.picture.shaders import (
    Shader,
    assembled,
    body_shader,
    disc_shader,
    picture_shader,
    sky_air_shader,
    sky_mirrored_shader,
    sky_peaks_shader,
    sky_polarised_shader,
    small_disc_shader,
    transmittance_shader,
)
from airlight.render.gpu.picture.uniforms import FRAME, Lens


@cache
def coarser_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the next coarser level of the glare pyramid.

    Parameters
    ----------
    dialect : ShaderDialect
        Shading language.
    """
    return _level_shader("coarser", coarser_texel, ("level",), (), dialect)


@cache
def spread_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the light spread by a level and all coarser ones."""
    return _level_shader(
        "spread", spread_texel, ("level", "coarser"), ("level_share", "level_more"), dialect
    )


@cache
def added_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of the sum of two frames of linear radiance."""
    return _level_shader("added", added_texel, ("picture", "level"), (), dialect)


@cache
def layered_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of a layer of air in front of a frame of linear radiance."""
    return _level_shader("layered", layered_texel, ("picture", "level", "coarser"), (), dialect)


@cache
def covering_shader(dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of a body without air in front of a frame of linear radiance."""
    return _level_shader("covering", covering_texel, ("picture", "level", "coarser"), (), dialect)


def _level_shader(
    name: str,
    function: Callable[..., Any],
    tables: tuple[str, ...],
    uniforms: tuple[str, ...],
    dialect: ShaderDialect,
) -> Shader:
    """Shader with one entry point: a kernel of tables, row, column and uniforms."""
    emitter = Emitter(dialect)
    lens = FRAME.struct_value(Lens)
    text = _called(emitter, function, lens, tables, uniforms)
    return assembled(name, {name: dialect.fragment(name, 1, [], [text])}, emitter)


def _called(
    emitter: Emitter,
    function: Callable[..., Any],
    lens: StructValue,
    tables: tuple[str, ...],
    uniforms: tuple[str, ...],
) -> str:
    """Call of a kernel of tables, row, column and uniforms."""
    dialect = emitter.dialect
    given: list[Value] = [lens.fields[one] for one in tables]
    values = [FRAME.uniform(one) for one in uniforms]
    made = emitter.add(function, *given, I32, I32, *values)
    places = [dialect.convert(f"at.{axis}", I32) for axis in "yx"]
    texts = [dialect.uniform(one.text, one.scalar) for one in values]
    return f"{made.name}({', '.join([*places, *texts])})"


@cache
def display_shader(fixed: Fixed = (), dialect: ShaderDialect = WGSL) -> Shader:
    """Shader of displayed values from linear radiance and glare."""
    emitter = Emitter(dialect)
    light = _called(
        emitter,
        glared_texel,
        FRAME.struct_value(Lens),
        ("picture", "coarser"),
        ("glare", "glare_total", "circle"),
    )
    display = FRAME.struct_value(Display, fixed)
    shown = emitter.add(displayed, F32, F32, F32, F32, F32, display, name="displayed")
    assert isinstance(shown.result, TupleType)
    lines = [
        dialect.let("light", VEC4, light),
        dialect.let("seen", shown.result, f"{shown.name}(light.x, light.y, light.z, at.x, at.y)"),
    ]
    parts = [dialect.part("seen", i) for i in range(3)]
    entry = f"{dialect.type_name(VEC4)}({', '.join(parts)}, 1.0)"
    return assembled(
        "display", {"shown_picture": dialect.fragment("shown_picture", 1, lines, [entry])}, emitter
    )


def all_shaders() -> tuple[Shader, ...]:
    """All shaders of rendering and display."""
    return (
        sky_air_shader(),
        sky_peaks_shader(),
        sky_polarised_shader(),
        sky_mirrored_shader(),
        picture_shader(False),
        picture_shader(True),
        picture_shader(True, (), True),
        transmittance_shader(),
        body_shader(False, ()),
        body_shader(True, ()),
        disc_shader(()),
        small_disc_shader(()),
        coarser_shader(),
        spread_shader(),
        added_shader(),
        layered_shader(),
        covering_shader(),
        display_shader(),
    )

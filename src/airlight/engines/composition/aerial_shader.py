"""Shader functions of aerial perspective in WGSL and GLSL, with the parameters of one table."""

from __future__ import annotations

from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.engines.composition.aerial_reading import (
    AerialTables,
    air_radiance,
    air_transmittance,
    sky_radiance,
)
from airlight.kernel.shader_fields import Always, InTexture, shader_fields
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import F32, Constant, StructValue, Value
from airlight.render.gpu.emit.texture_table import TextureTable

#: Textures by the names to which a host binds them, in the order of the files.
TEXTURES = ("air_light", "air_extinction", "air_sky", "air_star")


def aerial_shader(aerial: AerialPerspective, dialect: ShaderDialect) -> str:
    """Source of ``air_radiance``, ``air_transmittance`` and ``sky_radiance`` for a host shader.

    The host declares the textures of ``TEXTURES`` by their names, as flat textures of four
    channels, ``FLAT_WIDTH`` texels wide. Nothing else is bound: numbers are constants of the text.

    Parameters
    ----------
    aerial : AerialPerspective
        Tables.
    dialect : ShaderDialect
        ``WGSL`` or ``GLSL``.
    """
    emitter = Emitter(dialect)
    tables = StructValue(bound_tables(aerial.tables))
    for function in (air_radiance, air_transmittance, sky_radiance):
        emitter.add(function, F32, F32, F32, F32, tables, name=function.__name__)
    readers = [TextureTable(name, name, spectral=True).reader(dialect, name) for name in TEXTURES]
    return "\n".join([_about(aerial), *readers, emitter.module()])


def bound_tables(tables: AerialTables) -> dict[str, Value]:
    """Tables, and their parameters as constants, for the emitter."""
    fields: dict[str, Value] = {}
    for one in shader_fields(AerialTables):
        if isinstance(one.mark, InTexture):
            fields[one.name] = TextureTable(one.name, one.name, spectral=True).table
        elif isinstance(one.mark, Always):
            fields[one.name] = Constant(one.mark.value)
        else:
            fields[one.name] = Constant(getattr(tables, one.name))
    return fields


def _about(aerial: AerialPerspective) -> str:
    scene, tables = aerial.scene, aerial.tables
    return f"""\
// Aerial perspective by airlight: observer at {scene.altitude:g} m, star {scene.sun_zenith:g} deg \
from the zenith.
// Textures {", ".join(TEXTURES)}, declared by the host, are read texel by texel, without a sampler.
//   air_radiance(x, y, z, distance)       light of the air before a point; red, green, blue
//   air_transmittance(x, y, z, distance)  share of the point's own light that comes through
//   sky_radiance(x, y, z, pixel)          sky or ground behind everything, with the star's disc
// x, y, z: unit vector, x level towards the star, z up, either y. distance: metres, from \
{tables.nearest:g} to {tables.farthest:g}.
// pixel: radians that a pixel spans. Colours: linear sRGB; 1 is white facing the star without air.
"""

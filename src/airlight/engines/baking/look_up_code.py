"""Look-up code for Bruneton's tables in GLSL, WGSL and HLSL, with test vectors.

Emitted from the kernels of ``solver.tables.texture_reading``. A host declares the textures by name,
three-dimensional for scattering and two-dimensional otherwise, in the order of EXR files and
manifest; all parameters are constants. Texels are fetched without samplers, in any float format.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.bake import Baked
from airlight.engines.baking.table_errors import peaked_positions
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.hlsl import HLSL
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    F32,
    I32,
    VEC4,
    Constant,
    ShaderTable,
    StructValue,
    Value,
)
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.solver.tables.bruneton import BrunetonLayout
from airlight.solver.tables.layout import Positions
from airlight.solver.tables.texture_reading import (
    TextureShape,
    ends_on_ground,
    irradiance_at,
    light_at,
    phase_at,
    scattering_at,
    transmittance_at,
)

FloatArray = NDArray[np.float64]

#: Languages by file name.
DIALECTS: Final[dict[str, ShaderDialect]] = {
    "look_up.glsl": GLSL,
    "look_up.wgsl": WGSL,
    "look_up.hlsl": HLSL,
}
#: Name of the texture of the phase functions, and stride of their nodes in it.
PHASES: Final = "phase_functions"
PHASE_STEP: Final = 4
#: Number of test vectors, and seed.
_VECTORS: Final = 256
_SEED: Final = 7
_COLOURS: Final = 3
#: Tables that no function uses.
NOT_READ: Final = ("higher-order",)
_SIGHT: Final = ("r", "mu", "mu_s", "nu")


def has_look_up(baked: Baked) -> bool:
    """Whether look-up code exists for tables: Bruneton's, at three wavelengths."""
    layout = baked.tables["scattering"].layout
    return isinstance(layout, BrunetonLayout) and len(baked.about["wavelengths_nm"]) == _COLOURS


def texture_name(table: str) -> str:
    """Name of a table's texture in shaders.

    Examples
    --------
    >>> texture_name("single-fine-dust-1-6-um")
    'single_fine_dust_1_6_um'
    """
    return table.replace("-", "_")


def phase_texture(baked: Baked) -> NDArray[np.float32]:
    """Phase functions as a texture, shape (functions, nodes, nl). [sr⁻¹]"""
    values = baked.light.phases.values[..., ::PHASE_STEP]
    return np.ascontiguousarray(np.moveaxis(values, 1, 2), np.float32)


def look_up_code(baked: Baked, dialect: ShaderDialect) -> str:
    """Functions ``air_radiance``, ``transmittance_to_top``, ``sky_irradiance``, ``ends_on_ground``.

    Parameters
    ----------
    baked : Baked
        Tables for which ``has_look_up``.
    """
    emitter = Emitter(dialect)
    shape = _shape(baked)
    bundle = StructValue({name: Constant(value) for name, value in shape._asdict().items()})
    phases = ShaderTable(PHASES, spectral=True)
    ray: tuple[Value, ...] = (F32, F32, F32, F32, BOOL)
    given = ", ".join((*_SIGHT, "to_ground"))
    emitter.add(ends_on_ground, F32, F32, bundle, name="ends_on_ground")
    parts: list[str] = []
    for row, name in enumerate(_of_light(baked)):
        table = ShaderTable(texture_name(name), spectral=True)
        scale = Constant(baked.tables[name].scale)
        if baked.light.packing == "combined":
            found = emitter.add(scattering_at, table, *ray, bundle, name="stored_light")
            parts.append(f"{found.name}({given})")
            continue
        given_too = (phases, *ray, Constant(row), scale, bundle)
        found = emitter.add(light_at, table, *given_too, name=f"light_of_{table.name}")
        parts.append(f"{found.name}({given})")
    for name, function in (
        ("transmittance", transmittance_at),
        ("irradiance", irradiance_at),
    ):
        table = ShaderTable(name, spectral=True)
        wanted = {"transmittance": "transmittance_to_top", "irradiance": "sky_irradiance"}[name]
        emitter.add(
            function, table, F32, F32, Constant(baked.tables[name].scale), bundle, name=wanted
        )
    lines = [" + ".join(parts)]
    if baked.light.packing == "combined":
        lines = _combined(baked, emitter, phases, bundle, parts[0])
    parameters = [*((name, F32) for name in _SIGHT), ("to_ground", BOOL)]
    return "\n".join(
        [
            _about(baked),
            *_readers(baked, shape, dialect),
            emitter.module(),
            dialect.function("air_radiance", parameters, VEC4, lines),
        ]
    )


def vectors_of(baked: Baked) -> dict[str, Any]:
    """Test vectors: inputs and results of the functions by the look-up in Python.

    Inputs are in single precision, with directions dense near the sun and the horizon.
    """
    layout = baked.tables["scattering"].layout
    shell = (layout.bottom_radius, layout.top_radius)
    drawn = peaked_positions(*shell, _VECTORS, _SEED)
    exact = [
        np.asarray(np.asarray(one, np.float32), float)
        for one in (drawn.r, drawn.mu, drawn.mu_s, drawn.nu)
    ]
    exact[0] = np.clip(exact[0], *shell)
    r, mu, mu_s, nu = exact
    positions = Positions(r, mu, mu_s, nu, drawn.to_ground)
    arguments = {
        "air_radiance": (*exact, drawn.to_ground),
        "transmittance_to_top": (exact[0], exact[1]),
        "sky_irradiance": (exact[0], exact[2]),
    }
    ends = Positions.of(*exact, bottom_radius=shell[0])
    results = {
        "air_radiance": baked.light.relative_radiance(positions),
        "transmittance_to_top": baked.tables["transmittance"].at(ends),
        "sky_irradiance": baked.tables["irradiance"].at(positions),
    }
    inputs = {
        "air_radiance": [*_SIGHT, "to_ground"],
        "transmittance_to_top": ["r", "mu"],
        "sky_irradiance": ["r", "mu_s"],
    }
    return {
        "format": "airlight test vectors 1",
        "about": "results of the functions of look_up.* by Python, from the values as stored; "
        "single precision and the phase functions' texture cost up to 1e-3",
        "functions": {
            name: {
                "inputs": inputs[name],
                "arguments": [list(row) for row in zip(*(x.tolist() for x in given), strict=True)],
                "results": results[name].tolist(),
            }
            for name, given in arguments.items()
        },
    }


def _of_light(baked: Baked) -> list[str]:
    """Names of the scattering tables, in the order of their phase functions."""
    if baked.light.packing == "combined":
        return ["scattering"]
    return ["scattering", *baked.light.phases.names[1:]]


def _shape(baked: Baked) -> TextureShape:
    layout = baked.tables["scattering"].layout
    assert isinstance(layout, BrunetonLayout)
    rows, columns = baked.tables["transmittance"].layout.shape
    levels, heights = baked.tables["irradiance"].layout.shape
    return TextureShape(
        bottom=layout.bottom_radius, top=layout.top_radius, lowest=layout.grid.lowest,
        radii=layout.radii, views=layout.views, sun_angles=layout.sun_angles, angles=layout.angles,
        rows=rows, columns=columns, levels=levels, heights=heights,
        nodes=phase_texture(baked).shape[1],
    )  # fmt: skip


def _readers(baked: Baked, shape: TextureShape, dialect: ShaderDialect) -> list[str]:
    """Functions that read a texel of each texture by its index in memory."""
    readers = []
    for name in _of_light(baked):
        width, height = shape.angles * shape.sun_angles, shape.views
        lines = [
            dialect.let("x", I32, f"index % {width}"),
            dialect.let("y", I32, f"(index / {width}) % {height}"),
            dialect.let("z", I32, f"index / {width * height}"),
            dialect.fetch_volume(texture_name(name), "x", "y", "z"),
        ]
        readers.append(
            dialect.function(f"read_{texture_name(name)}", [("index", I32)], VEC4, lines)
        )
    images = {"transmittance": shape.columns, "irradiance": shape.heights, PHASES: shape.nodes}
    for name, width in images.items():
        lines = [
            dialect.let("x", I32, f"index % {width}"),
            dialect.let("y", I32, f"index / {width}"),
            dialect.fetch_image(name, "y", "x"),
        ]
        readers.append(dialect.function(f"read_{name}", [("index", I32)], VEC4, lines))
    return readers


def _combined(
    baked: Baked, emitter: Emitter, phases: ShaderTable, bundle: StructValue, stored: str
) -> list[str]:
    """Lines of ``air_radiance`` for particles in alpha, whose colours are restored."""
    dialect = emitter.dialect
    assert isinstance(dialect, ShaderDialect)
    smooth, *particles = (
        emitter.add(phase_at, phases, F32, Constant(row), bundle, name=f"phase_of_{name}").name
        for row, name in enumerate(baked.light.phases.names)
    )
    vector, ref = dialect.type_name(VEC4), "xyz"[baked.light.reference]
    scale = f"{np.float32(baked.tables['scattering'].scale):.9e}"
    lines = [dialect.let("both", VEC4, f"{stored} * {scale}")]
    if not particles:
        return [*lines, f"both * {smooth}(nu)"]
    colours = ", ".join(f"{np.float32(one):.9e}" for one in (*baked.light.colours, 0.0))
    ratio = [f"restored.{one}" if one != ref else "1.0" for one in "xyz"]
    return [
        *lines,
        dialect.let("restored", VEC4, f"both / max(both.{ref}, 1e-30) * {vector}({colours})"),
        dialect.let("ratio", VEC4, f"{vector}({', '.join(ratio)}, 0.0)"),
        f"both * {smooth}(nu) + ratio * both.w * {particles[0]}(nu)",
    ]


def _about(baked: Baked) -> str:
    newline = "\n"
    tables = [
        f"//   {texture_name(name)}: "
        + " x ".join(
            f"{' and '.join(axes)}" for axes in baked.tables[name].layout.texture_axes if axes
        )
        for name in (*_of_light(baked), "transmittance", "irradiance")
    ]
    nm = ", ".join(f"{one:g}" for one in baked.about["wavelengths_nm"])
    return f"""\
// Look-ups of the tables of {baked.about["planet"]} by airlight, at {nm} nm.
// Textures of four channels, declared by the host and read texel by texel (width x height x depth;
// of two axes that share one the second runs fastest; row 0 and slice 0 are the ground):
{newline.join(tables)}
//   {PHASES}: sin(theta/2) x {", ".join(baked.light.phases.names)}
// Functions:
//   air_radiance(r, mu, mu_s, nu, to_ground)  path radiance per irradiance of the star, 1/sr
//   transmittance_to_top(r, mu)               0 for rays that meet the ground
//   sky_irradiance(r, mu_s)                   of level ground, per irradiance of the star
//   ends_on_ground(r, mu)                     passed as to_ground
// r: metres from the planet's centre; mu, mu_s, nu: cosines of the zenith angles of view and sun,
// and of the angle between them. Behind the air: ground * transmittance + radiance.
"""

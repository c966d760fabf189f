"""Picture with a painted sky, for test pages that need no planet."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3, combined, dot
from airlight.image.white_balance import WHITE_BALANCES
from airlight.kernel.lanes import LANES, load
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.shader_types import F32, FLAT_WIDTH, I32, VEC4
from airlight.render.gpu.emit.texture_table import TextureTable
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.picture.uniforms import CHANNELS, FRAME, LAYERS
from airlight.render.pixels.pixel import ViewUniforms
from airlight.viewer.browser.tables_text import as_text, deflated
from airlight.viewer.browser.web_shaders import CORNERS

#: Number of columns of the sky-view LUT.
COLUMNS = 16
COLORS = np.linspace(0.05, 1.0, 4 * COLUMNS, dtype=np.float32).reshape(COLUMNS, 4)
PAINT = (0.25, 0.5, 0.75, 1.0)


def painted(index, fields):
    """Column of the painted sky: the same passes, small enough to be checked by hand."""
    return load(fields, LANES * (index % 16))


def looked_at(px, py, view, air):
    """Picture of it by a camera."""
    slope = math.tan(0.5 * view.field_of_view)
    x = (2.0 * px / view.width - 1.0) * slope
    y = (1.0 - 2.0 * py / view.height) * slope * view.height / view.width
    ray = combined(Vec3(x, y, 1.0), view.right, view.up, view.forward)
    height = ray.z / math.sqrt(dot(ray, ray))
    column = min(max(int((0.5 + 0.5 * height) * 16.0), 0), 15)
    return load(air, LANES * column)


def shader_in(dialect: ShaderDialect) -> tuple[str, dict[str, str]]:
    """Shared shader code, and each entry point."""
    tables = [TextureTable(name, name, 1, True) for name in ("fields", "air")]
    fields, air = (one.table for one in tables)
    emitter = Emitter(dialect)
    emitter.add(painted, I32, fields)
    emitter.add(looked_at, F32, F32, FRAME.struct_value(ViewUniforms), air)
    parts = [FRAME.text(dialect)]
    for slot, one in enumerate([*tables, FRAME.tables["picture"]], start=1):
        parts.append(dialect.texture(one.texture, 0, slot))
        parts.append(one.reader(dialect, dialect.texture_name(one.texture, 0, slot)))
    vector = dialect.type_name(VEC4)
    sky = f"painted({dialect.convert('at.x', I32)}) * frame.red"
    seen = "looked_at(at.x, at.y).rgb"
    place = [dialect.convert(f"at.{axis}", I32) for axis in "yx"]
    light = f"read_picture({', '.join(place)}).rgb"
    exposed = f"{FRAME.uniform('exposure').text} * {light}"
    entries = {
        "sky_air": dialect.fragment("sky_air", 2, [], [sky, sky]),
        "linear_picture": dialect.fragment("linear_picture", 1, [], [f"{vector}({seen}, 1.0)"]),
        "shown_picture": dialect.fragment("shown_picture", 1, [], [f"{vector}({exposed}, 1.0)"]),
    }
    return "\n".join([*parts, emitter.module()]), entries


def shader() -> dict[str, Any]:
    """Shaders of the painted sky in both languages."""
    functions, entries = shader_in(GLSL)
    glsl = {name: GLSL.module([functions, entry]) for name, entry in entries.items()}
    functions, entries = shader_in(WGSL)
    wgsl = WGSL.module([WGSL.triangle, functions, *entries.values()])
    return {"wgsl": wgsl, "glsl": {CORNERS: GLSL.triangle, **glsl}}


def program() -> dict[str, Any]:
    """Counterpart of ``viewer.browser.package.program``."""
    where = FRAME.layout()
    places = {name: [start, 1] for name, start in where["numbers"].items()}
    places |= {f"table_{name}": [start, 4] for name, start in where["tables"].items()}

    def one(name: str, entry: str, reads: dict[str, str], *targets: tuple[str, int, int]) -> Any:
        made = [
            {"name": n, "format": "rgba32float", "width": width, "height": height}
            for n, width, height in targets
        ]
        return {"name": name, "shader": "painted", "entry": entry, "vertex": CORNERS,
                "uniforms": "0/0", "reads": reads, "targets": made}  # fmt: skip

    def second(targets: list[tuple[str, int, int]]) -> list[tuple[str, int, int]]:
        return [(f"{name}_2", width, height) for name, width, height in targets]

    sky = [(name, FLAT_WIDTH, 1) for name in LAYERS[:2]]
    peaks = [(name, FLAT_WIDTH, 1) for name in LAYERS[2:4]]
    polarised = [(name, FLAT_WIDTH, 1) for name in LAYERS[4:6]]
    mirrored = [(name, FLAT_WIDTH, 1) for name in LAYERS[6:]]
    return {
        "plan": {
            "layout": places,
            "size": where["floats"],
            "passes": [
                one("sky_air", "sky_air", {"0/1": "fields"}, *sky),
                one("sky_peaks", "sky_air", {"0/1": "fields"}, *peaks),
                one("sky_polarised", "sky_air", {"0/1": "fields"}, *polarised),
                one("sky_mirrored", "sky_air", {"0/1": "fields"}, *mirrored),
                one("metering", "linear_picture", {"0/2": "air"}, ("metering", 64, 64)),
                one("picture", "linear_picture", {"0/2": "air"}, ("picture", 1, 1)),
                one("sky_air_2", "sky_air", {"0/1": "fields"}, *second(sky)),
                one("sky_peaks_2", "sky_air", {"0/1": "fields"}, *second(peaks)),
                one("sky_polarised_2", "sky_air", {"0/1": "fields"}, *second(polarised)),
                one("sky_mirrored_2", "sky_air", {"0/1": "fields"}, *second(mirrored)),
                # the sky of the first light stands for the sum of both
                *(
                    one(f"{name}_{part}", "linear_picture", {"0/2": air}, (target, 1, 1))
                    for name in ("metering", "picture")
                    for part, air, target in (
                        ("1", "air", f"{name}_1"),
                        ("2", "air_2", f"{name}_2"),
                        ("sum", "air", name),
                    )
                ),
                one("display", "shown_picture", {"0/3": "picture"}),
            ],
        },
        "shaders": {"painted": shader()},
        "sky": {"full": [64, 64], "medium": [64, 32], "quick": [64, 16]},
        "layers": list(LAYERS),
        "metering": 64,
        "filter_exposure": 1.0,
        "projections": {"perspective": [1e-3, 170.0]},
        "display": {"encoding": 0.0},
        "primaries": ["srgb", "display-p3"],
        "white_balances": list(WHITE_BALANCES),
        "orders": {"all": 2, "single": 1, "multiple": 0},
        "view_uniforms": {"tone_map": {"path": "display.tone_map", "options": ["hable"]}},
        "xyz": [[0.4, 0.2, 0.0], [0.4, 0.7, 0.1], [0.2, 0.1, 0.9]],
        "efficacy": 683.0,
    }


def solution(paint: tuple[float, ...] = PAINT) -> dict[str, Any]:
    """Counterpart of ``viewer.browser.package.solution_package``, with tables as text."""
    return {
        "uniforms": {
            "separated_1": -1.0,
            "star_radius": 0.0,
            **dict.fromkeys((*(f"lamp_{one}" for one in CHANNELS), "airglow", "skyglow"), 0.0),
            **{f"{one}_{i}": x for one in CHANNELS for i, x in enumerate(paint)},
        },
        "second": {
            "irradiance": [1.0] * 4,
            "moon": {"albedo": [0.1] * 4, "weights": [1.0] * 12},
            "stars": [
                {
                    "temperature": temperature,
                    "irradiance": [1.0] * 4,
                    "weights": [1.0] * 12,
                    "darkening": [1.0] * 24,
                }
                for temperature in (1500.0, 40000.0)
            ],
        },
        "tables": {"fields": {"format": "rgba32float", "data": as_text(COLORS)}},
        "ground": None,
        "radius": 6360e3,
        "thickness": 60e3,
        "flattening": 0.0,
        "star": 0.0,
        "star_white": [0.3127, 0.329],
        "geometry": None,
    }


def page() -> dict[str, Any]:
    """Data embedded in a page."""
    fixed = program()
    return {**fixed, "shaders": deflated(json.dumps(fixed["shaders"])), **solution()}


def picture(
    axes: NDArray[np.float64], width: int, height: int, field_of_view: float, exposure: float
) -> NDArray[np.float64]:
    """Same picture in NumPy: 0 to 1, shape (height, width, 3)."""
    slope = np.tan(0.5 * np.radians(field_of_view))
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * slope
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * slope * height / width
    rays = axes[2] + x[None, :, None] * axes[0] + y[:, None, None] * axes[1]
    up = rays[..., 2] / np.linalg.norm(rays, axis=2)
    column = np.clip((0.5 + 0.5 * up) * COLUMNS, 0, COLUMNS - 1).astype(int)
    colors = (COLORS * np.array(PAINT))[column][..., :3]
    return np.clip(2.0**exposure * colors, 0.0, 1.0)

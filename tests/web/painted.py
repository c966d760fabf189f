"""A picture with a painted sky: what the pages of the tests show where no planet is needed."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.gpu.emit.translated import entry_points, translated
from airlight.gpu.picture.uniforms import layout, struct_text
from airlight.viewer.browser.tables_text import as_text, deflated

SHADERS = Path(__file__).parent / "shaders"
#: Columns of the table of the sky.
COLUMNS = 16
COLORS = np.linspace(0.05, 1.0, 4 * COLUMNS, dtype=np.float32).reshape(COLUMNS, 4)
PAINT = (0.25, 0.5, 0.75, 1.0)
#: Where the first line of a shader asks for the struct of uniforms.
UNIFORMS = "//UNIFORMS\n"


def text(name: str) -> str:
    """The WGSL of a shader of the tests."""
    found = (SHADERS / f"{name}.wgsl").read_text(encoding="utf-8")
    return found.replace(UNIFORMS, struct_text())


def shader(name: str) -> dict[str, Any]:
    """A shader of the tests in both languages."""
    wgsl = text(name)
    glsl = {entry: translated(name, entry, wgsl, SHADERS) for _, entry in entry_points(wgsl)}
    return {"wgsl": wgsl, "glsl": glsl}


def program() -> dict[str, Any]:
    """What ``viewer.package.program`` gives for a planet."""
    where = layout()
    places = {name: [start, 1] for name, start in where["numbers"].items()}
    places |= {f"table_{name}": [start, 4] for name, start in where["tables"].items()}

    def one(name: str, entry: str, reads: dict[str, str], *targets: tuple[str, int, int]) -> Any:
        made = [
            {"name": n, "format": "rgba32float", "width": width, "height": height}
            for n, width, height in targets
        ]
        return {"name": name, "shader": "painted", "entry": entry, "vertex": "corners",
                "uniforms": "0/0", "reads": reads, "targets": made}  # fmt: skip

    sky = [(name, 2048, 1) for name in ("air", "behind")]
    peaks = [(name, 2048, 1) for name in ("first", "second")]
    return {
        "plan": {
            "layout": places,
            "size": where["floats"],
            "passes": [
                one("sky_air", "sky_air", {"0/1": "fields"}, *sky),
                one("sky_peaks", "sky_air", {"0/1": "fields"}, *peaks),
                one("glance", "linear_picture", {"0/2": "air"}, ("glance", 64, 64)),
                one("picture", "shown_picture", {"0/2": "air"}),
            ],
        },
        "shaders": {"painted": shader("painted")},
        "sky": {"full": [64, 64], "medium": [64, 32], "quick": [64, 16]},
        "glance": 64,
        "projections": {"perspective": [1e-3, 170.0]},
        "tone_maps": {"hable": 0.18},
        "encodings": ["srgb"],
        "orders": {"all": 2, "single": 1, "multiple": 0},
        "luminance": [0.2, 0.7, 0.1],
        "xyz": [[0.4, 0.2, 0.0], [0.4, 0.7, 0.1], [0.2, 0.1, 0.9]],
        "efficacy": 683.0,
    }


def solution(paint: tuple[float, ...] = PAINT) -> dict[str, Any]:
    """What ``viewer.package.planet_tables`` gives for a planet, as text."""
    return {
        "uniforms": {"first_peak": -1.0, **{f"red_{i}": x for i, x in enumerate(paint)}},
        "tables": {"fields": {"format": "rgba32float", "data": as_text(COLORS)}},
        "ground": None,
        "radius": 6360e3,
        "thickness": 60e3,
        "star": 0.0,
        "paths": None,
    }


def page() -> dict[str, Any]:
    """What a page carries of it."""
    fixed = program()
    return {**fixed, "shaders": deflated(json.dumps(fixed["shaders"])), **solution()}


def picture(
    axes: NDArray[np.float64], width: int, height: int, field_of_view: float, exposure: float
) -> NDArray[np.float64]:
    """The same in NumPy: 0 to 1, shape (height, width, 3)."""
    slope = np.tan(0.5 * np.radians(field_of_view))
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * slope
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * slope * height / width
    rays = axes[2] + x[None, :, None] * axes[0] + y[:, None, None] * axes[1]
    up = rays[..., 2] / np.linalg.norm(rays, axis=2)
    column = np.clip((0.5 + 0.5 * up) * COLUMNS, 0, COLUMNS - 1).astype(int)
    colors = (COLORS * np.array(PAINT))[column][..., :3]
    return np.clip(2.0**exposure * colors, 0.0, 1.0)

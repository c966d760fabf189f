"""A picture with a painted sky: what the pages of the tests show where no planet is needed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.gpu.translated import entry_points, translated
from airlight.viewer.tables_text import as_text

SHADERS = Path(__file__).parent / "shaders"
#: Columns of the table of the sky.
COLUMNS = 16
COLORS = np.linspace(0.05, 1.0, 4 * COLUMNS, dtype=np.float32).reshape(COLUMNS, 4)
PAINT = (0.25, 0.5, 0.75, 1.0)


def shader(name: str) -> dict[str, Any]:
    """A shader of the tests in both languages."""
    wgsl = (SHADERS / f"{name}.wgsl").read_text(encoding="utf-8")
    glsl = {entry: translated(name, entry, wgsl, SHADERS) for _, entry in entry_points(wgsl)}
    return {"wgsl": wgsl, "glsl": glsl}


def description() -> dict[str, Any]:
    """As ``web/picture.js`` takes it."""
    target = {"name": "sky", "format": "rgba32float", "width": COLUMNS, "height": 1}
    common = {"shader": "painted", "vertex": "corners", "uniforms": "0/0"}
    fields = ("camera_right", "camera_up", "camera_forward", "frame", "display", "paint")
    return {
        "plan": {
            "layout": {name: [4 * index, 4] for index, name in enumerate(fields)},
            "size": 4 * len(fields),
            "passes": [
                {**common, "name": "sky", "entry": "fill", "reads": {"0/1": "colors"},
                 "targets": [target]},
                {**common, "name": "picture", "entry": "picture", "reads": {"0/2": "sky"},
                 "targets": []},
            ],
        },
        "shaders": {"painted": shader("painted")},
        "tables": {"colors": {"format": "rgba32float", "data": as_text(COLORS)}},
        "uniforms": {"paint": list(PAINT)},
        "fields_of_view": {"perspective": [1e-3, 170.0]},
        "grey": {"hable": 0.18},
        "luminance": [0.2, 0.7, 0.1],
        "radius": 6360e3,
    }  # fmt: skip


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

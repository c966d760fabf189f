"""Files of a bake as a host of its look-up code reads them: textures from EXR, test vectors."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from airlight.image.exr import read_exr_channels

#: Functions in the order in which the tests' shaders call them, and their arguments' number.
FUNCTIONS = {"air_radiance": 5, "transmittance_to_top": 2, "sky_irradiance": 2}


def textures(folder: Path) -> dict[str, np.ndarray]:
    """Textures by their names in shaders, shape (depth, height, width, 4) or (height, width, 4)."""
    said = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    found = {}
    for name, texture in said["look_up"]["textures"].items():
        file = "phase-functions.exr" if name == "phase functions" else f"{name}.exr"
        channels = read_exr_channels(folder / file)
        height, width = channels["R"].shape
        texels = np.zeros((height, width, 4), np.float32)
        for k, one in enumerate("RGBA"):
            if one in channels:
                texels[..., k] = channels[one]
        depth = said["tables"][name]["texture"]["depth"] if name in said["tables"] else 1
        found[texture] = texels.reshape(depth, -1, width, 4) if depth > 1 else texels
    return found


def vectors(folder: Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Arguments of all functions in one row each, (n, 9), and results (n, 3) by function."""
    said: dict[str, Any] = json.loads((folder / "test_vectors.json").read_text(encoding="utf-8"))
    rows = [np.array(said["functions"][name]["arguments"], float) for name in FUNCTIONS]
    results = {name: np.array(said["functions"][name]["results"]) for name in FUNCTIONS}
    return np.concatenate(rows, axis=1).astype(np.float32), results


def calls(argument: str, above_half: str) -> list[str]:
    """Call of each function, its numbers written as ``argument`` of their indices in a row."""
    written, start = [], 0
    for name, count in FUNCTIONS.items():
        given = [argument.format(start + k) for k in range(count)]
        if name == "air_radiance":
            given[-1] = above_half.format(given[-1])
        written.append(f"{name}({', '.join(given)})")
        start += count
    return written

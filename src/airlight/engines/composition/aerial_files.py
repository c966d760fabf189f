"""Aerial perspective on disk: textures of half floats, shader functions, and a JSON manifest.

Textures are files of RGBA half floats, little-endian, row by row: format ``rgba16float`` of WebGPU,
``RGBA16F`` of WebGL2. ``air.wgsl`` and ``air.glsl`` read them.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any, Final

import numpy as np

from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.engines.composition.aerial_shader import TEXTURES, aerial_shader
from airlight.files.atomic_folder import atomic_folder
from airlight.files.manifest import MANIFEST, fingerprint, write_manifest
from airlight.files.provenance import version
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.emit.wgsl import WGSL

#: Format named in the manifest.
FORMAT: Final = "airlight aerial perspective 1"
_SHADERS: Final = ((WGSL, "air.wgsl"), (GLSL, "air.glsl"))
#: Names of the files beside the manifest, as patterns.
FILES: Final = ("*.bin", *(name for _, name in _SHADERS))
_CHANNELS: Final = 4


def write_aerial(
    folder: str | Path,
    aerial: AerialPerspective,
    about: dict[str, str] | None = None,
    *,
    overwrite: bool = False,
) -> Path:
    """Write the tables of aerial perspective with their shader functions and manifest.

    Parameters
    ----------
    folder : str or Path
        New or empty folder, or one with such tables, which are replaced.
    about : dict, optional
        Metadata for the manifest.
    overwrite : bool
        Whether to replace files of these names that airlight did not write or that were modified.

    Raises
    ------
    FileError
        If the folder holds other files, or cannot be written to; it is then unchanged.

    Examples
    --------
    ::

        solution = airlight.solve(airlight.load_planet("earth"), wavelengths=range(410, 700, 19))
        scene = airlight.Scene(altitude=500.0, sun_zenith=66.0)
        write_aerial("air", AerialPerspective.fill(solution, scene))
    """
    with atomic_folder(folder, FORMAT, FILES, overwrite=overwrite) as part:
        textures: dict[str, Any] = {}
        for name in TEXTURES:
            file = part / f"{name}.bin"
            texels = _flat(getattr(aerial.tables, name))
            file.write_bytes(texels.tobytes())
            textures[name] = {
                "width": FLAT_WIDTH,
                "height": texels.shape[0],
                "texels": len(getattr(aerial.tables, name)),
                "format": "rgba16float",
                "files": {file.name: fingerprint(file)},
            }
        shaders: dict[str, Any] = {}
        for dialect, file_name in _SHADERS:
            file = part / file_name
            file.write_text(aerial_shader(aerial, dialect), encoding="utf-8")
            shaders[dialect.name] = {"files": {file_name: fingerprint(file)}}
        write_manifest(part, _manifest(aerial, about or {}, textures, shaders))
    return Path(folder) / MANIFEST


def _flat(values: np.ndarray) -> np.ndarray:
    """Texels of four channels as a flat texture, shape (height, FLAT_WIDTH, 4), half floats."""
    texels = values[:, :_CHANNELS]
    height = -(-texels.shape[0] // FLAT_WIDTH)
    out = np.zeros((height * FLAT_WIDTH, _CHANNELS), "<f2")
    out[: texels.shape[0]] = texels
    return out.reshape(height, FLAT_WIDTH, _CHANNELS)


def _manifest(
    aerial: AerialPerspective,
    about: dict[str, str],
    textures: dict[str, Any],
    shaders: dict[str, Any],
) -> dict[str, Any]:
    tables, scene = aerial.tables, aerial.scene
    return {
        "format": FORMAT,
        "airlight": version(),
        **about,
        "altitude_m": scene.altitude,
        "sun_zenith_deg": scene.sun_zenith,
        "nearest_m": tables.nearest,
        "farthest_m": tables.farthest,
        "star_angular_radius_rad": tables.star_radius,
        "unit": "1: white Lambert surface that faces the star without air; linear sRGB",
        "radiance_of_1_W_m-2_sr-1": aerial.scale.tolist(),
        "frame": "x level towards the star, z up; y is used by its size alone",
        "textures": textures,
        "shaders": shaders,
        "errors": asdict(aerial.errors),
    }

"""Textures of CosmoScout VR's Bruneton model, and the look-up of its shaders in NumPy.

Textures are TIFF files of three 32-bit floats, row 0 first: transmittance over (mu, r), illuminance
over (mu_s, r), scattering over (nu and mu_s, mu, r) with a page for each r, phase functions over
the angle.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import AirlightError, FileError
from airlight.files.input_files import read_text

FloatArray = NDArray[np.float64]

METADATA: Final = "metadata.json"
SCENE: Final = "scene.json"
PHASE: Final = "phase.tif"
TRANSMITTANCE: Final = "transmittance.tif"
ILLUMINANCE: Final = "indirect_illuminance.tif"
MULTIPLE: Final = "multiple_scattering.tif"
SINGLE: Final = "single_aerosols_scattering.tif"
DEVIATION: Final = "theta_deviation.tif"


def require_tifffile() -> Any:
    """Module tifffile, which is an optional dependency."""
    try:
        import tifffile
    except ImportError as error:
        raise AirlightError(
            "files for CosmoScout need tifffile: pip install 'airlight[engines]'"
        ) from error
    return tifffile


def write_texture(path: Path, values: FloatArray) -> None:
    """Write a texture as CosmoScout's preprocessor does: RGB, 32-bit floats, one strip per row.

    Parameters
    ----------
    values : array, shape (height, width, 3) or (depth, height, width, 3)
        Values; a page for each depth.
    """
    tifffile = require_tifffile()
    pages = np.asarray(values, np.float32)
    pages = pages[None] if pages.ndim == 3 else pages
    with tifffile.TiffWriter(path) as writer:
        for page in pages:
            writer.write(
                np.ascontiguousarray(page),
                photometric="rgb",
                planarconfig="contig",
                rowsperstrip=1,
                compression=None,
                metadata=None,
                contiguous=False,
            )


def read_texture(path: Path) -> FloatArray:
    """Texture of a TIFF file, shape (depth, height, width, 3)."""
    tifffile = require_tifffile()
    try:
        with tifffile.TiffFile(path) as file:
            pages = [page.asarray() for page in file.pages]
    except (OSError, ValueError, struct.error, tifffile.TiffFileError) as error:
        raise FileError(path, f"cannot be read: {error}") from error
    shapes = {page.shape for page in pages}
    if len(shapes) != 1 or len(pages[0].shape) != 3 or pages[0].shape[-1] != 3:
        raise FileError(path, "is not a texture: its pages need three channels and a common size")
    return np.asarray(np.stack(pages), np.float64)


def texel_angles(count: int) -> FloatArray:
    """Scattering angles of the texel centres of a phase function, (count,). [deg]

    The shader's coordinate is the angle over 180°.
    """
    return 180.0 * (np.arange(count) + 0.5) / count


@dataclass(frozen=True, eq=False, kw_only=True)
class CosmoScoutTables:
    """Textures of one planet.

    Attributes
    ----------
    bottom_radius, top_radius : float
        Radii of the scene. [m]
    metadata : dict
        Content of ``metadata.json``.
    phase : array, shape (2, angles, 3)
        Phase functions that multiply ``multiple`` and ``single``. [sr⁻¹]
    transmittance, illuminance : array, shape (height, width, 3)
        Transmittance to space [1], and diffuse horizontal illuminance [lx].
    multiple, single : array, shape (depth, height, width, 3)
        Luminance over phase functions. [cd m⁻² sr]
    deviation : array, shape (height, width, 3) or None
        Refraction angle of rays to space [rad], and altitude of their lowest point [m].
    """

    bottom_radius: float
    top_radius: float
    metadata: dict[str, Any]
    phase: FloatArray
    transmittance: FloatArray
    illuminance: FloatArray
    multiple: FloatArray
    single: FloatArray
    deviation: FloatArray | None

    @classmethod
    def read(cls, folder: str | Path) -> CosmoScoutTables:
        """Read a folder."""
        root = Path(folder)
        try:
            metadata, scene = (json.loads(read_text(root / name)) for name in (METADATA, SCENE))
            (atmosphere,) = scene["plugins"]["csp-atmospheres"]["atmospheres"].values()
            radius = float(scene["airlight"]["radius"])
            bottom = radius + float(atmosphere["bottomAltitude"])
            top = radius + float(atmosphere["topAltitude"])
        except (FileError, ValueError, KeyError, TypeError, RecursionError) as error:
            raise FileError(root, f"is not a folder for CosmoScout: {error}") from error
        return cls(
            bottom_radius=bottom,
            top_radius=top,
            metadata=metadata,
            phase=read_texture(root / PHASE)[0],
            transmittance=read_texture(root / TRANSMITTANCE)[0],
            illuminance=read_texture(root / ILLUMINANCE)[0],
            multiple=read_texture(root / MULTIPLE),
            single=read_texture(root / SINGLE),
            deviation=read_texture(root / DEVIATION)[0] if metadata["refraction"] else None,
        )

    def sky_luminance(
        self, r: FloatArray, mu: FloatArray, mu_s: FloatArray, nu: FloatArray
    ) -> FloatArray:
        """Path luminance along lines of sight in the shell, shape (n, 3). [cd m⁻²]

        Parameters
        ----------
        r, mu, mu_s, nu : array, shape (n,)
            Radius [m]; cosines of the zenith angles of view and sun, and of the angle between them
            [1].
        """
        to_ground = (mu < 0.0) & (r * r * (mu * mu - 1.0) + self.bottom_radius**2 >= 0.0)
        angle, sun, view, high = self._coordinates(r, mu, mu_s, nu, to_ground)
        count = int(self.metadata["scatteringTextureNuSize"])
        at = angle * (count - 1)
        first = np.floor(at)
        share = (at - first)[:, None]
        parts = []
        for table in (self.multiple, self.single):
            low, up = (
                _sampled(table, (first + step + sun) / count, view, high) for step in (0.0, 1.0)
            )
            parts.append(low * (1.0 - share) + up * share)
        u = np.arccos(np.clip(nu, -1.0, 1.0)) / np.pi
        rows = [
            _sampled(self.phase[None], u, np.full_like(u, row), np.full_like(u, 0.5))
            for row in (0.0, 1.0)
        ]
        return parts[0] * rows[0] + parts[1] * rows[1]

    def through(self, r: FloatArray, mu: FloatArray) -> FloatArray:
        """Transmittance to space of rays that miss the ground, shape (n, 3). [1]"""
        u, v = self._transmittance_coordinates(r, mu)
        return _sampled(self.transmittance[None], u, v, np.full_like(u, 0.5))

    def refraction_angle(self, r: FloatArray, mu: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Refraction angle of rays to space [rad], and altitude of their lowest point [m], (n,)."""
        if self.deviation is None:
            return np.zeros(r.shape), np.zeros(r.shape)
        u, v = self._transmittance_coordinates(r, mu)
        values = _sampled(self.deviation[None], u, v, np.full_like(u, 0.5))
        return values[:, 0], values[:, 1]

    def sky_illuminance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """Diffuse horizontal illuminance, shape (n, 3). [lx]"""
        height, width, _ = self.illuminance.shape
        x_r = (r - self.bottom_radius) / (self.top_radius - self.bottom_radius)
        u, v = _centred(0.5 * mu_s + 0.5, width), _centred(x_r, height)
        return _sampled(self.illuminance[None], u, v, np.full_like(u, 0.5))

    def _transmittance_coordinates(
        self, r: FloatArray, mu: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        height, width, _ = self.transmittance.shape
        whole, rho = self._whole, self._rho(r)
        d = self._to_top(r, mu)
        least, most = self.top_radius - r, rho + whole
        x_mu = (d - least) / np.maximum(most - least, 1e-9)
        return _centred(x_mu, width), _centred(rho / whole, height)

    def _coordinates(
        self, r: FloatArray, mu: FloatArray, mu_s: FloatArray, nu: FloatArray, to_ground: Any
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        depth, height, width, _ = self.multiple.shape
        suns = width // int(self.metadata["scatteringTextureNuSize"])
        bottom, top, whole, rho = self.bottom_radius, self.top_radius, self._whole, self._rho(r)
        along = r * mu
        root = along * along - r * r + bottom * bottom
        down = -along - np.sqrt(np.maximum(root, 0.0))
        span = rho - (r - bottom)
        x = np.where(span > 0.0, (down - (r - bottom)) / np.maximum(span, 1e-9), 0.0)
        below = 0.5 - 0.5 * _centred(x, height // 2)
        up = -along + np.sqrt(np.maximum(root + whole * whole, 0.0))
        above = 0.5 + 0.5 * _centred((up - top + r) / (rho + whole - top + r), height // 2)
        lowest = np.cos(float(self.metadata["maxSunZenithAngle"]))
        ground = np.full_like(mu_s, bottom)
        span_s, least = whole - (top - bottom), top - bottom
        a = (self._to_top(ground, mu_s) - least) / span_s
        limit = (self._to_top(ground, np.full_like(mu_s, lowest)) - least) / span_s
        sun = _centred(np.maximum(1.0 - a / limit, 0.0) / (1.0 + a), suns)
        return (
            0.5 * (nu + 1.0),
            sun,
            np.where(to_ground, below, above),
            _centred(rho / whole, depth),
        )

    @property
    def _whole(self) -> float:
        """Length of a horizontal ray from the ground to the top. [m]"""
        return float(np.sqrt(self.top_radius**2 - self.bottom_radius**2))

    def _rho(self, r: FloatArray) -> FloatArray:
        """Distance to the horizon. [m]"""
        return np.asarray(np.sqrt(np.maximum(r * r - self.bottom_radius**2, 0.0)))

    def _to_top(self, r: FloatArray, mu: FloatArray) -> FloatArray:
        root = r * r * (mu * mu - 1.0) + self.top_radius**2
        return np.asarray(np.maximum(-r * mu + np.sqrt(np.maximum(root, 0.0)), 0.0))


def _centred(x: Any, count: int) -> FloatArray:
    """Texture coordinate that maps x = 0 and 1 to the centres of the first and last texel. [1]"""
    return np.asarray(0.5 / count + np.asarray(x) * (1.0 - 1.0 / count))


def _sampled(texture: FloatArray, u: FloatArray, v: FloatArray, w: FloatArray) -> FloatArray:
    """Linear texture look-up, clamped to the edge, shape (n, channels)."""
    out = np.zeros((u.size, texture.shape[-1]))
    cells = []
    for coordinate, size in zip((w, v, u), texture.shape[:3], strict=True):
        at = np.clip(coordinate * size - 0.5, 0.0, size - 1.0)
        low = np.minimum(at.astype(int), max(size - 2, 0))
        cells.append((low, np.minimum(low + 1, size - 1), at - low))
    for corner in range(8):
        index, weight = [], np.ones(u.size)
        for axis, (low, high, share) in enumerate(cells):
            up = bool(corner >> axis & 1)
            index.append(high if up else low)
            weight = weight * (share if up else 1.0 - share)
        out += weight[:, None] * texture[tuple(index)]
    return out

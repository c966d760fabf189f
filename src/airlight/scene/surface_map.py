"""Map of the ground: colour by latitude and longitude, at the resolution of a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import FileError

_DATA = Path(__file__).parent / "data"
#: Suffix of packaged maps: ``earth`` is in ``data/earth-albedo.jpg``.
_SUFFIX = "-albedo.jpg"


@dataclass(frozen=True, kw_only=True, eq=False)
class SurfaceMap:
    """Linear colours on an equirectangular grid, at full size and halved repeatedly.

    Row 0 touches the north pole, column 0 the meridian of 180° west; pixel (i, j) has its centre
    at latitude 90° - (i + ½)·180°/h and longitude -180° + (j + ½)·360°/w.

    Parameters
    ----------
    name : str
        Name or path by which it was loaded.
    levels : tuple of array, each shape (h, w, 3)
        Linear sRGB reflectance in [0, 1], float32; each level holds 2 x 2 means of the previous
        level.
    """

    name: str
    levels: tuple[NDArray[np.float32], ...]

    @property
    def mean_rgb(self) -> NDArray[np.float64]:
        """Mean over the sphere's area, shape (3,), which a solver uses for the whole ground. [1]"""
        full = self.levels[0]
        edges = np.sin(np.linspace(0.5 * math.pi, -0.5 * math.pi, full.shape[0] + 1))
        bands = 0.5 * (edges[:-1] - edges[1:])
        return np.asarray(bands @ full.mean(axis=1, dtype=np.float64))

    @cached_property
    def flat(self) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
        """All levels one after another, as ``map_color`` reads them.

        Returns
        -------
        levels : array, shape (n, 3)
            Start, height and width of each.
        texels : array, flat
            Linear sRGB reflectance. [1]
        """
        starts = np.cumsum([0, *(one.size for one in self.levels[:-1])])
        shapes = [(at, *one.shape[:2]) for at, one in zip(starts, self.levels, strict=True)]
        return np.array(shapes, float), np.concatenate([one.reshape(-1) for one in self.levels])

    def level(self, footprint: ArrayLike) -> NDArray[np.float64]:
        """Level whose pixels are as large as the footprint of a picture's pixel.

        Parameters
        ----------
        footprint : array, shape (...)
            Angle that the pixel covers on the ground, seen from the planet's centre. [rad]

        Returns
        -------
        array, shape (...)
            Level: 0 for the full map, one more for each halving; not rounded. [1]
        """
        texel = math.pi / self.levels[0].shape[0]
        ratio = np.maximum(np.asarray(footprint, dtype=np.float64) / texel, 1.0)
        return np.asarray(np.minimum(np.log2(ratio), len(self.levels) - 1.0))

    def sample(
        self, latitude: ArrayLike, longitude: ArrayLike, level: ArrayLike = 0.0
    ) -> NDArray[np.float32]:
        """Colours between the pixels, bilinear, without a seam in longitude.

        Parameters
        ----------
        latitude, longitude : array, shape (...)
            Geocentric coordinates, north and east positive; any turn of longitude. [deg]
        level : array, shape (...)
            Level as returned by ``level``; the nearest one is read. [1]

        Returns
        -------
        array, shape (..., 3)
            Linear sRGB reflectance. [1]
        """
        lat, lon, depth = np.broadcast_arrays(
            np.asarray(latitude, dtype=np.float64),
            np.asarray(longitude, dtype=np.float64),
            np.clip(np.rint(level), 0, len(self.levels) - 1).astype(np.intp),
        )
        out = np.empty((*lat.shape, 3), dtype=np.float32)
        for index in np.unique(depth):
            asked = depth == index
            out[asked] = _bilinear(self.levels[index], lat[asked], lon[asked])
        return out


def _bilinear(
    texels: NDArray[np.float32], latitude: NDArray[np.float64], longitude: NDArray[np.float64]
) -> NDArray[np.float32]:
    height, width = texels.shape[:2]
    y = np.clip((90.0 - latitude) / 180.0 * height - 0.5, 0.0, height - 1.0)
    x = (longitude + 180.0) / 360.0 * width - 0.5
    row, column = np.floor(y), np.floor(x)
    down = (y - row).astype(np.float32)[..., np.newaxis]
    right = (x - column).astype(np.float32)[..., np.newaxis]
    top = row.astype(np.intp)
    bottom = np.minimum(top + 1, height - 1)
    west = column.astype(np.intp) % width
    east = (west + 1) % width
    upper = texels[top, west] + (texels[top, east] - texels[top, west]) * right
    lower = texels[bottom, west] + (texels[bottom, east] - texels[bottom, west]) * right
    return np.asarray(upper + (lower - upper) * down)


def from_pixels(name: str, pixels: NDArray[np.uint8]) -> SurfaceMap:
    """Make a map from the pixels of an sRGB picture.

    Parameters
    ----------
    name : str
        Name kept in the map.
    pixels : array, shape (h, w, 3)
        sRGB-encoded reflectance, 255 for 1.

    Returns
    -------
    SurfaceMap
        Map in linear colours, with all its levels.
    """
    from airlight.color.encoding import srgb_decode

    table = np.asarray(srgb_decode(np.arange(256) / 255.0), dtype=np.float32)
    levels = [table[pixels]]
    while levels[-1].shape[0] % 2 == 0 and levels[-1].shape[1] % 2 == 0:
        fine = levels[-1]
        upper, lower = fine[0::2], fine[1::2]
        levels.append(0.25 * (upper[:, 0::2] + upper[:, 1::2] + lower[:, 0::2] + lower[:, 1::2]))
    return SurfaceMap(name=name, levels=tuple(levels))


def map_file(name: str) -> Path:
    """File of a map, which may be missing: of a packaged map, or the path itself.

    Examples
    --------
    >>> map_file("earth").name
    'earth-albedo.jpg'
    """
    packaged = _DATA / f"{name}{_SUFFIX}"
    return packaged if "/" not in name and packaged.is_file() else Path(name)


@cache
def surface_map(name: str) -> SurfaceMap:
    """Load a map by name or by file; it is read once.

    Parameters
    ----------
    name : str
        Name of a map that ships with airlight (``earth``), or path of an equirectangular picture in
        sRGB.

    Returns
    -------
    SurfaceMap
        Map with ``mean_rgb``, ``level`` and ``sample``.

    Raises
    ------
    FileError
        If there is no such map, or the file is not a picture.
    """
    from PIL import Image, UnidentifiedImageError

    file = map_file(name)
    try:
        with Image.open(file) as picture:
            pixels = np.asarray(picture.convert("RGB"))
    except FileNotFoundError as error:
        known = ", ".join(sorted(p.name.removesuffix(_SUFFIX) for p in _DATA.glob(f"*{_SUFFIX}")))
        raise FileError(name, f"there is no such map of the ground (known: {known})") from error
    except (OSError, UnidentifiedImageError, Image.DecompressionBombError) as error:
        raise FileError(file, f"cannot be read as a picture: {error}") from error
    return from_pixels(name, pixels)

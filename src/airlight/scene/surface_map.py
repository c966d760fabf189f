"""Ground map: reflectance and water fraction by latitude and longitude, with mip levels."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import FileError
from airlight.image.texels import CHANNELS, DECODED, decoded_texels
from airlight.planets.map_picture import MAPS, map_pixels, packaged_map
from airlight.scene.map_cache import cached_levels
from airlight.scene.map_grain import Grain, grain_of
from airlight.scene.map_levels import Levels, empty_levels, fill_levels, level_views, reduced

#: Suffix of packaged maps: ``earth`` is in ``data/earth-albedo.jpg``.
_SUFFIX = "-albedo.jpg"
#: Largest stored map; with its levels it fits a texture of 4096 by 8191 texels. [pixel]
MOST_TEXELS: Final = 25_000_000
#: Step between the texels from which the colour of water is taken.
_SPARSE: Final = 8


@dataclass(frozen=True, kw_only=True, eq=False)
class SurfaceMap:
    """Linear sRGB reflectance and water fraction on an equirectangular grid, with mip levels.

    Row 0 touches the north pole, column 0 the meridian of 180° west; pixel (i, j) has its centre
    at latitude 90° - (i + ½)·180°/h and longitude -180° + (j + ½)·360°/w.

    Parameters
    ----------
    name : str
        Name or path by which it was loaded.
    rows, columns : int
        Size of the full map.
    flat : array, shape (4·n,)
        Texels of ``airlight.image.texels``: sRGB reflectance and water fraction, of all levels in
        the layout of ``map_color``.
    """

    name: str
    rows: int
    columns: int
    flat: NDArray[np.uint8]

    @cached_property
    def levels(self) -> tuple[NDArray[np.uint8], ...]:
        """Views of the levels, each shape (h, w, 4), with half the rows of the previous one."""
        return level_views(self.flat, self.rows, self.columns)

    @property
    def mean_rgb(self) -> NDArray[np.float64]:
        """Mean reflectance over the sphere, shape (3,), for the solver. [1]"""
        return self._mean[:3]

    @property
    def mean_water(self) -> float:
        """Mean water fraction over the sphere. [1]"""
        return float(self._mean[3])

    @cached_property
    def _mean(self) -> NDArray[np.float64]:
        return self.mean(0)

    def mean(self, level: int) -> NDArray[np.float64]:
        """Mean reflectance and water fraction over the sphere, shape (4,). [1]

        Parameters
        ----------
        level : int
            Level that is averaged; coarser levels are faster, but their texels are rounded.
        """
        edges = np.sin(np.linspace(0.5 * math.pi, -0.5 * math.pi, len(self.levels[level]) + 1))
        bands = 0.5 * (edges[:-1] - edges[1:])
        return np.asarray(bands @ self.zonal(level))

    def zonal(self, level: int) -> NDArray[np.float64]:
        """Means along latitudes of reflectance and water fraction, north first, shape (h, 4). [1]

        Parameters
        ----------
        level : int
            Argument of ``mean``.
        """
        full = self.levels[level]
        rows = [DECODED[c][full[..., c]].mean(axis=1, dtype=np.float64) for c in range(CHANNELS)]
        return np.stack(rows, axis=-1)

    @cached_property
    def water_rgb(self) -> NDArray[np.float64]:
        """Mean reflectance of the texels that are all water, shape (3,); black without any. [1]"""
        texels = self.levels[0][::_SPARSE, ::_SPARSE]
        wet = decoded_texels(texels[texels[..., 3] == 255])[:, :3]
        return np.asarray(wet.mean(axis=0, dtype=np.float64)) if len(wet) else np.zeros(3)

    @cached_property
    def grain(self) -> Grain:
        """Contrast of the land at the smallest scales of the map."""
        return grain_of(self.levels)

    def level(self, footprint: ArrayLike) -> NDArray[np.float64]:
        """Mip level whose texels match a pixel footprint.

        Parameters
        ----------
        footprint : array, shape (...)
            Angle that the pixel covers on the ground, seen from the planet's centre. [rad]

        Returns
        -------
        array, shape (...)
            Level: 0 for the full map, one more for each halving; not rounded. [1]
        """
        texel = math.pi / self.rows
        ratio = np.maximum(np.asarray(footprint, dtype=np.float64) / texel, 1.0)
        return np.asarray(np.minimum(np.log2(ratio), len(self.levels) - 1.0))

    def sample(
        self, latitude: ArrayLike, longitude: ArrayLike, level: ArrayLike = 0.0
    ) -> NDArray[np.float32]:
        """Bilinear reflectance and water fraction, periodic in longitude.

        Parameters
        ----------
        latitude, longitude : array, shape (...)
            Geocentric coordinates, north and east positive; any turn of longitude. [deg]
        level : array, shape (...)
            Level as returned by ``level``; the nearest one is read. [1]

        Returns
        -------
        array, shape (..., 4)
            Linear sRGB reflectance and water fraction. [1]
        """
        lat, lon, depth = np.broadcast_arrays(
            np.asarray(latitude, dtype=np.float64),
            np.asarray(longitude, dtype=np.float64),
            np.clip(np.rint(level), 0, len(self.levels) - 1).astype(np.intp),
        )
        out = np.empty((*lat.shape, CHANNELS), dtype=np.float32)
        for index in np.unique(depth):
            asked = depth == index
            out[asked] = _bilinear(self.levels[index], lat[asked], lon[asked])
        return out


def _bilinear(
    texels: NDArray[np.uint8], latitude: NDArray[np.float64], longitude: NDArray[np.float64]
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
    corners = [(top, west), (top, east), (bottom, west), (bottom, east)]
    a, b, c, d = (decoded_texels(texels[corner]) for corner in corners)
    upper, lower = a + (b - a) * right, c + (d - c) * right
    return np.asarray(upper + (lower - upper) * down)


def from_pixels(
    name: str, pixels: NDArray[np.uint8], water: NDArray[np.uint8] | None = None
) -> SurfaceMap:
    """Map from sRGB pixels.

    Parameters
    ----------
    pixels : array, shape (h, w, 3)
        sRGB-encoded reflectance, 255 for 1.
    water : array, shape (h, w), optional
        Water fraction, linear, 255 for 1; by default no water.

    Returns
    -------
    SurfaceMap
        Map with all its levels, reduced to ``MOST_TEXELS`` if it is larger.
    """
    return SurfaceMap(name=name, **levels_of(pixels, water)._asdict())


def levels_of(pixels: NDArray[np.uint8], water: NDArray[np.uint8] | None = None) -> Levels:
    """Mip levels from sRGB pixels.

    Parameters
    ----------
    pixels, water : array
        Arguments of ``from_pixels``.

    Returns
    -------
    Levels
        Its size, that of ``map_size``, and its texels.
    """
    rows, columns = map_size(*pixels.shape[:2])
    flat = empty_levels(rows, columns)
    levels = level_views(flat, rows, columns)
    packed_texels(pixels, water, levels[0])
    fill_levels(levels)
    return Levels(rows, columns, flat)


def map_size(rows: int, columns: int) -> tuple[int, int]:
    """Size of the map of an image, limited to ``MOST_TEXELS``.

    Examples
    --------
    >>> map_size(1000, 2000), map_size(6000, 12000)
    ((1000, 2000), (3535, 7070))
    """
    if rows * columns <= MOST_TEXELS:
        return rows, columns
    most = math.isqrt(MOST_TEXELS // 2)
    return most, 2 * most


def packed_texels(
    pixels: NDArray[np.uint8],
    water: NDArray[np.uint8] | None = None,
    out: NDArray[np.uint8] | None = None,
) -> NDArray[np.uint8]:
    """Texels of a map at ``map_size``, shape (m, n, 4).

    Parameters
    ----------
    out : array, shape (m, n, 4), optional
        Receives the texels, and is returned.
    """
    if out is None:
        out = np.empty((*map_size(*pixels.shape[:2]), CHANNELS), np.uint8)
    rows, columns = out.shape[:2]
    same = pixels.shape[:2] == (rows, columns)
    texels = out if same else np.empty((*pixels.shape[:2], CHANNELS), np.uint8)
    texels[..., :3] = pixels
    texels[..., 3] = 0 if water is None else water
    return out if same else reduced(texels, rows, columns, out)


def map_file(name: str) -> Path:
    """Path of a map, packaged or a file, which may not exist.

    Examples
    --------
    >>> map_file("earth").name
    'earth-albedo.jpg'
    """
    return packaged_map(name, _SUFFIX)


def water_file(name: str) -> Path:
    """Path of the water mask of a map, ``NAME-water.png``, which may not exist.

    Examples
    --------
    >>> water_file("earth").name, water_file("maps/ocean.jpg").name
    ('earth-water.png', 'ocean-water.png')
    """
    file = map_file(name)
    return file.with_name(f"{file.stem.removesuffix('-albedo')}-water.png")


@cache
def surface_map(name: str) -> SurfaceMap:
    """Map by name or path, cached.

    Parameters
    ----------
    name : str
        Name of a packaged map (``earth``), or path of an equirectangular sRGB image. A grey image
        of the same size and name, with ``-water.png`` at the end, holds the water fraction, linear.

    Returns
    -------
    SurfaceMap
        Map with ``mean_rgb``, ``level`` and ``sample``.

    Raises
    ------
    FileError
        If the map does not exist, ``map_pixels`` rejects a file, or the sizes differ.
    """
    pictures = map_file(name), water_file(name)
    levels = cached_levels(Path(__file__), pictures, lambda: _decoded(name, *pictures))
    return SurfaceMap(name=name, **levels._asdict())


def _decoded(name: str, file: Path, beside: Path) -> Levels:
    """Decoded map of a file, with its water mask if any."""
    try:
        pixels = map_pixels(file)
    except FileNotFoundError as error:
        known = ", ".join(sorted(p.name.removesuffix(_SUFFIX) for p in MAPS.glob(f"*{_SUFFIX}")))
        raise FileError(name, f"unknown ground map (known: {known})") from error
    water = map_pixels(beside, grey=True) if beside.is_file() else None
    if water is not None and water.shape != pixels.shape[:2]:
        height, width = pixels.shape[:2]
        raise FileError(beside, f"has another size; allowed: {width} x {height}, that of {file}")
    return levels_of(pixels, water)

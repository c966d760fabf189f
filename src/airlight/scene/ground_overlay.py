"""Ground overlay: city lights, and clouds above the map.

The overlay is a separate map with the radiance of city lights relative to the brightest cities in
its colours, and cloud cover in its fourth channel.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.image.texels import CHANNELS
from airlight.planets.cloud_cover import cloud_pixels
from airlight.planets.map_picture import map_pixels
from airlight.scene.map_cache import cached_levels
from airlight.scene.map_levels import Levels
from airlight.scene.surface_map import SurfaceMap, levels_of, packed_texels

_DATA = Path(__file__).parent / "data"
#: Suffix of packaged lights: ``earth`` is in ``data/earth-lights.jpg``.
_SUFFIX: Final = "-lights.jpg"
#: Luminance for a map value of 1: 1e-7 W cm⁻² sr⁻¹ between 0.5 and 0.9 µm, as seen by VIIRS over
#: the centre of large towns (Elvidge et al. 2017, Int. J. Remote Sens. 38, 5860: up to some 1e-7,
#: suburbs 1e-8, villages 1e-9), at 200 lm/W, between sodium lamps and warm white LEDs. [cd m⁻²]
TOWN_LUMINANCE: Final = 0.2
#: Black-body temperature of the colour of the lamps. [K]
LAMP_TEMPERATURE: Final = 2700.0
#: Rows upsampled together.
_BAND: Final = 256


def lights_file(name: str) -> Path:
    """Path of a city-lights map, packaged or a file, which may not exist.

    Examples
    --------
    >>> lights_file("earth").name
    'earth-lights.jpg'
    """
    packaged = _DATA / f"{name}{_SUFFIX}"
    return packaged if "/" not in name and packaged.is_file() else Path(name)


@cache
def ground_overlay(lights: str | None, clouds: str | None = None) -> SurfaceMap | None:
    """Overlay of city lights and clouds, cached.

    Parameters
    ----------
    lights : str or None
        Name of packaged city lights (``earth``), or path of an equirectangular image, whose
        luminance is used.
    clouds : str or None
        Path of an equirectangular image of cloud cover, linear. If the sizes differ, the smaller
        image is enlarged.

    Returns
    -------
    SurfaceMap or None
        Map with the radiance of city lights in its colours, 1 for the brightest cities, and cloud
        cover in the fourth channel; None without both.

    Raises
    ------
    FileError
        If the file does not exist, or ``map_pixels`` rejects it.
    """
    if lights is None and clouds is None:
        return None
    files = lights_file(lights) if lights else None, Path(clouds) if clouds else None
    levels = cached_levels(Path(__file__), files, lambda: _decoded(lights, clouds))
    return SurfaceMap(name=f"{lights}, {clouds}", **levels._asdict())


def _decoded(lights: str | None, clouds: str | None) -> Levels:
    lamps = None if lights is None else _lamp_pixels(lights)
    cover = None if clouds is None else cloud_pixels(clouds)
    if lamps is None:
        assert cover is not None
        lamps = np.zeros_like(cover)
    if cover is not None and cover.shape != lamps.shape:
        lamps, cover = _of_one_size(lamps, cover)
    return levels_of(_grey(lamps), cover)


def _lamp_pixels(lights: str) -> NDArray[np.uint8]:
    try:
        return map_pixels(lights_file(lights), grey=True)
    except FileNotFoundError as error:
        known = ", ".join(sorted(p.name.removesuffix(_SUFFIX) for p in _DATA.glob(f"*{_SUFFIX}")))
        raise FileError(lights, f"unknown city-lights map (known: {known})") from error


def _grey(values: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.broadcast_to(values[..., None], (*values.shape, CHANNELS - 1))


def _of_one_size(
    lamps: NDArray[np.uint8], cover: NDArray[np.uint8]
) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """Both maps at the size of the larger map."""
    lamps = packed_texels(_grey(lamps))[..., 0]
    cover = packed_texels(_grey(np.zeros_like(cover)), cover)[..., CHANNELS - 1]
    rows, columns = max(lamps.shape, cover.shape)
    return enlarged(lamps, rows, columns), enlarged(cover, rows, columns)


def enlarged(values: NDArray[np.uint8], rows: int, columns: int) -> NDArray[np.uint8]:
    """Bilinear enlargement of an equirectangular map, periodic in longitude.

    Parameters
    ----------
    values : array of uint8, shape (h, w)
        Pixels.
    rows, columns : int
        New size, no smaller.

    Returns
    -------
    array of uint8, shape (rows, columns)
        Pixels.

    Examples
    --------
    >>> enlarged(np.array([[0, 200]], np.uint8), 2, 4)
    array([[ 50,  50, 150, 150],
           [ 50,  50, 150, 150]], dtype=uint8)
    """
    height, width = values.shape
    if (height, width) == (rows, columns):
        return values
    y = np.clip((np.arange(rows) + 0.5) * height / rows - 0.5, 0.0, height - 1.0)
    x = (np.arange(columns) + 0.5) * width / columns - 0.5
    top, west = y.astype(np.intp), np.floor(x).astype(np.intp)
    down, right = (y - top)[:, None], x - west
    out = np.empty((rows, columns), np.uint8)
    for first in range(0, rows, _BAND):
        band = slice(first, first + _BAND)
        upper, lower = values[top[band]], values[np.minimum(top[band] + 1, height - 1)]
        level = (1.0 - down[band]) * upper + down[band] * lower
        out[band] = np.rint(
            (1.0 - right) * level[:, west % width] + right * level[:, (west + 1) % width]
        )
    return out

"""Ground overlay: city lights, relief, and clouds above the map.

The overlay is a separate map with the radiance of city lights relative to the brightest cities in
its first channel, height in its second, and cloud cover in its fourth.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.image.encoding import srgb_encode
from airlight.image.texels import CHANNELS
from airlight.planets.cloud_cover import cloud_file, cloud_pixels
from airlight.planets.map_picture import MAPS, map_pixels, packaged_map
from airlight.scene.map_cache import cached_levels
from airlight.scene.map_levels import Levels
from airlight.scene.surface_map import SurfaceMap, levels_of, map_size, packed_texels

#: Suffix of packaged lights: ``earth`` is in ``data/earth-lights.jpg``.
_SUFFIX: Final = "-lights.jpg"
#: Suffix of packaged heights: ``earth`` is in ``data/earth-relief.png``.
_RELIEF: Final = "-relief.png"
#: Luminance for a map value of 1, the mean of a texel of 10 km: with it the zenith has 19.0 mag per
#: square arcsecond over the observatory of Vienna, measured are up to 19.25 (Puschnig, Posch &
#: Uttenthaler 2014, JQSRT 139, 64). At 200 lm/W, between sodium lamps and warm white LEDs, it is
#: 4e-8 W cm⁻² sr⁻¹ between 0.5 and 0.9 µm; VIIRS sees up to some 1e-7 in pixels of 0.5 km in the
#: centre of large towns (Elvidge et al. 2017, Int. J. Remote Sens. 38, 5860). [cd m⁻²]
TOWN_LUMINANCE: Final = 0.085
#: Black-body temperature of the colour of the lamps: high-pressure sodium, of 2000 to 2100 K, with
#: some white ones. [K]
LAMP_TEMPERATURE: Final = 2250.0
#: sRGB codes of heights from their linear ones: lowlands, which are smooth, get most of the steps.
_HEIGHT_CODES: Final = np.rint(255.0 * srgb_encode(np.arange(256) / 255.0)).astype(np.uint8)
#: Rows upsampled together.
_BAND: Final = 256


def lights_file(name: str) -> Path:
    """Path of a city-lights map, packaged or a file, which may not exist.

    Examples
    --------
    >>> lights_file("earth").name
    'earth-lights.jpg'
    """
    return packaged_map(name, _SUFFIX)


def relief_file(name: str) -> Path:
    """Path of a map of heights, packaged or a file, which may not exist.

    Examples
    --------
    >>> relief_file("earth").name
    'earth-relief.png'
    """
    return packaged_map(name, _RELIEF)


@cache
def ground_overlay(
    lights: str | None, clouds: str | None = None, relief: str | None = None
) -> SurfaceMap | None:
    """Overlay of city lights, clouds and heights, cached.

    Parameters
    ----------
    lights : str or None
        Name of packaged city lights (``earth``), or path of an equirectangular image, whose
        luminance is used.
    clouds : str or None
        Name of packaged clouds (``earth``), or path of an equirectangular image of cloud cover,
        linear.
    relief : str or None
        Name of packaged heights (``earth``), or path of an equirectangular image of them, linear.
        If sizes differ, smaller images are enlarged.

    Returns
    -------
    SurfaceMap or None
        Map with the radiance of city lights in its first channel, 1 for the brightest cities,
        height in the second, 1 for ``scene.relief.HIGHEST``, and cloud cover in the fourth; None
        without any.

    Raises
    ------
    FileError
        If a file does not exist, or ``map_pixels`` rejects it.
    """
    if lights is None and clouds is None and relief is None:
        return None
    files = (
        lights_file(lights) if lights else None,
        cloud_file(clouds) if clouds else None,
        relief_file(relief) if relief else None,
    )
    levels = cached_levels(Path(__file__), files, lambda: _decoded(lights, clouds, relief))
    return SurfaceMap(name=f"{lights}, {clouds}, {relief}", **levels._asdict())


def _decoded(lights: str | None, clouds: str | None, relief: str | None) -> Levels:
    parts = (
        None if lights is None else _grey_pixels(lights, _SUFFIX, "city-lights map"),
        None if relief is None else _HEIGHT_CODES[_grey_pixels(relief, _RELIEF, "map of heights")],
        None if clouds is None else cloud_pixels(clouds),
    )
    given = [None if one is None else _reduced(one) for one in parts]
    rows, columns = max(one.shape for one in given if one is not None)
    lamps, heights, cover = (
        np.zeros((rows, columns), np.uint8) if one is None else enlarged(one, rows, columns)
        for one in given
    )
    return levels_of(np.dstack([lamps, heights, np.zeros_like(lamps)]), cover)


def _grey_pixels(name: str, suffix: str, kind: str) -> NDArray[np.uint8]:
    try:
        return map_pixels(packaged_map(name, suffix), grey=True)
    except FileNotFoundError as error:
        known = ", ".join(sorted(p.name.removesuffix(suffix) for p in MAPS.glob(f"*{suffix}")))
        raise FileError(name, f"unknown {kind} (known: {known})") from error


def _reduced(values: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Values of one channel at ``map_size``."""
    if values.shape == map_size(*values.shape):
        return values
    grey = np.broadcast_to(values[..., None], (*values.shape, CHANNELS - 1))
    return packed_texels(grey, values)[..., CHANNELS - 1]


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

"""Cloud cover from the picture of a planet file: pixels and mean."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.planets.map_picture import map_pixels, packaged_map

#: Suffix of packaged clouds: ``earth`` is in ``earth-clouds.jpg``.
_SUFFIX = "-clouds.jpg"


def cloud_file(clouds: str) -> Path:
    """Path of a picture of clouds, packaged or a file, which may not exist.

    Examples
    --------
    >>> cloud_file("earth").name, cloud_file("./earth").name
    ('earth-clouds.jpg', 'earth')
    """
    return packaged_map(clouds, _SUFFIX)


def cloud_pixels(clouds: str) -> NDArray[np.uint8]:
    """Read a picture of clouds.

    Parameters
    ----------
    clouds : str
        Name of packaged clouds (``earth``), or path of an equirectangular picture; colours are
        converted to grey.

    Returns
    -------
    array of uint8, shape (h, w)
        Cloud cover, linear; 255 is full cover.
    """
    try:
        return map_pixels(cloud_file(clouds), grey=True)
    except FileNotFoundError as error:
        reason = "does not exist; expected a picture of clouds, earth, or an empty string for none"
        raise FileError(clouds, reason) from error


@cache
def mean_cover(clouds: str) -> float:
    """Area-weighted mean cloud cover, used by solvers for the whole ground; cached.

    Parameters
    ----------
    clouds : str
        Argument of ``cloud_pixels``.
    """
    rows = cloud_pixels(clouds).mean(axis=1, dtype=np.float64) / 255.0
    edges = np.sin(np.linspace(0.5 * np.pi, -0.5 * np.pi, rows.size + 1))
    return min(float(0.5 * (edges[:-1] - edges[1:]) @ rows), 1.0)

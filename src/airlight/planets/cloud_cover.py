"""Cover of clouds from the picture that a planet file names: its pixels, and their mean."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.planets.map_picture import map_pixels


def cloud_pixels(clouds: str) -> NDArray[np.uint8]:
    """Read a picture of clouds.

    Parameters
    ----------
    clouds : str
        Path of an equirectangular picture; of a coloured one the brightness counts.

    Returns
    -------
    array of uint8, shape (h, w)
        Cover, linear, 255 for 1.

    Raises
    ------
    FileError
        If there is no such file, or ``map_pixels`` refuses it.
    """
    try:
        return map_pixels(Path(clouds), grey=True)
    except FileNotFoundError as error:
        raise FileError(clouds, "does not exist") from error


@cache
def mean_cover(clouds: str) -> float:
    """Mean cover over the sphere's area, which solvers use for the whole ground; it is read once.

    Parameters
    ----------
    clouds : str
        Argument of ``cloud_pixels``.

    Returns
    -------
    float
        Mean of the rows, each weighted by its area, 0 to 1. [1]
    """
    rows = cloud_pixels(clouds).mean(axis=1, dtype=np.float64) / 255.0
    edges = np.sin(np.linspace(0.5 * np.pi, -0.5 * np.pi, rows.size + 1))
    return min(float(0.5 * (edges[:-1] - edges[1:]) @ rows), 1.0)

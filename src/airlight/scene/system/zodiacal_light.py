"""Zodiacal light: sunlight that dust between the planets scatters."""

from __future__ import annotations

import math
from functools import cache
from importlib import resources
from typing import Final

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

#: Pole of the ecliptic in the frame of the J2000 equator: obliquity 23.43928°. [1]
_OBLIQUITY: Final = math.radians(23.43928)
ECLIPTIC_POLE: Final = (0.0, -math.sin(_OBLIQUITY), math.cos(_OBLIQUITY))
#: Spectral radiance of 1 S10, stars of V = 10 like the sun per square degree, at 500 nm.
#: [1e-8 W m⁻² sr⁻¹ µm⁻¹; Leinert et al. 1998, A&AS 127, 1, section 2]
_S10: Final = 1.28
#: Exponent of the brightness over the distance from the sun. [Leinert et al. 1998, section 8.3]
_DISTANCE: Final = -2.3


def zodiacal_light(directions: FloatArray, sun: FloatArray, distance: float = 1.0) -> FloatArray:
    """Brightness of the zodiacal light seen from the ecliptic plane, in S10, shape (n,).

    Linear in the table of Leinert et al. (1998), smooth and symmetric to the ecliptic; the tilt of
    the dust's own plane, 2°, and the seasons, a tenth, are left out. Within 15° of the sun, where
    the table ends, the light is that of the nearest latitude which has a number.

    Parameters
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the frame of the J2000 equator. [1]
    sun : array, shape (3,)
        Direction of the sun in that frame. [1]
    distance : float
        Distance from the sun. [au]

    References
    ----------
    Leinert et al. (1998), A&AS 127, 1, Table 17.

    Examples
    --------
    >>> across = np.array([[0.0, 1.0, 0.0]]) @ [[1, 0, 0], [0, 0.9174821, 0.3977769], [0, 0, 0]]
    >>> zodiacal_light(across, np.array([1.0, 0.0, 0.0])).round()  # Table 16: 202 S10
    array([202.])
    """
    longitudes, latitudes, brightness = zodiacal_table(distance)
    pole = np.array(ECLIPTIC_POLE)
    rise = directions @ pole
    latitude = np.degrees(np.arcsin(np.clip(np.abs(rise), 0.0, 1.0)))
    flat = sun - (sun @ pole) * pole
    along = directions @ flat
    across = directions @ np.cross(pole, flat)
    longitude = np.degrees(np.arctan2(np.abs(across), along))
    row, down = _cell(longitude, longitudes)
    column, right = _cell(latitude, latitudes)
    near = brightness[row, column] * (1.0 - right) + brightness[row, column + 1] * right
    far = brightness[row + 1, column] * (1.0 - right) + brightness[row + 1, column + 1] * right
    return np.asarray(near * (1.0 - down) + far * down)


def zodiacal_table(distance: float = 1.0) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Longitudes from the sun and latitudes [deg], and brightness in S10 over both.

    Parameters
    ----------
    distance : float
        Distance from the sun. [au]
    """
    longitudes, latitudes, brightness = _table()
    return longitudes, latitudes, brightness * distance**_DISTANCE


def _cell(values: FloatArray, nodes: FloatArray) -> tuple[npt.NDArray[np.intp], FloatArray]:
    """Index of the node below each value, and share of the way to the next one."""
    below = np.clip(np.searchsorted(nodes, values, side="right") - 1, 0, nodes.size - 2)
    return below, np.clip((values - nodes[below]) / (nodes[below + 1] - nodes[below]), 0.0, 1.0)


@cache
def _table() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Longitudes from the sun and latitudes [deg], and brightness in S10 over both."""
    file = resources.files("airlight.scene.system") / "data" / "zodiacal-light.csv"
    lines = [one for one in file.read_text(encoding="utf-8").splitlines() if one[:1] != "#"]
    latitudes = np.array([float(one) for one in lines[0].split(",")[1:]])
    rows = np.array([[float(one) for one in line.split(",")] for line in lines[1:]])
    brightness = rows[:, 1:] / _S10
    for row in brightness:
        row[np.isnan(row)] = row[np.isfinite(row)][0]
    return rows[:, 0], latitudes, brightness

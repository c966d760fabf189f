"""Face of the Moon: reflectance of its disc as it is seen, from the packaged map."""

from __future__ import annotations

import math
from functools import cache, lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.scene.surface_map import surface_map

FloatArray = NDArray[np.float64]

#: Name of the map.
MOON_MAP: Final = "moon"
#: Rows and columns of the finest and of the coarsest level.
_FINEST: Final = 512
_COARSEST: Final = 4
#: Step of the angles of faces that are kept. [deg]
_STEP: Final = 0.2


def moon_face(turn: float, latitude: float, longitude: float) -> FloatArray:
    """Reflectance of the Moon's disc over the mean of its near side, linear sRGB.

    Angles are rounded to 0.2 degrees, a hundredth of which is seen on the disc.

    Parameters
    ----------
    turn : float
        Position angle of the bright limb from the Moon's north, clockwise. [deg]
    latitude, longitude : float
        Selenographic coordinates of the centre of the disc, north and east positive. [deg]

    Returns
    -------
    array, shape (rows, columns, 3)
        Pyramid as for ``LightSource.face``. [1]
    """
    steps = (round(one / _STEP) for one in (math.remainder(turn, 360.0), latitude, longitude))
    return _face(*steps)


@lru_cache(maxsize=4)
def _face(turn: int, latitude: int, longitude: int) -> FloatArray:
    level = _disc(_STEP * turn, _STEP * latitude, _STEP * longitude, _FINEST) / near_side_mean()
    levels = []
    while len(level) >= _COARSEST:
        levels.append(np.pad(level, ((0, 0), (0, _FINEST - len(level)), (0, 0))))
        half = len(level) // 2
        level = level.reshape(half, 2, half, 2, 3).mean(axis=(1, 3))
    face = np.concatenate(levels)
    face.flags.writeable = False
    return face


@cache
def near_side_mean() -> FloatArray:
    """Mean reflectance of the near side's disc, without libration, shape (3,). [1]"""
    size = 256
    disc = _disc(0.0, 0.0, 0.0, size)
    x = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    inside = x[:, None] ** 2 + x**2 < 1.0
    return np.asarray(disc[inside].mean(axis=0))


def _disc(turn: float, latitude: float, longitude: float, size: int) -> FloatArray:
    """Reflectance of the disc, continued beyond its limb, shape (size, size, 3). [1]"""
    grid = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    aside, toward = np.meshgrid(grid, -grid)
    outside = np.maximum(np.hypot(aside, toward) / 0.9999, 1.0)
    aside, toward = aside / outside, toward / outside
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    north, east = toward * c - aside * s, toward * s + aside * c
    near = np.sqrt(1.0 - north**2 - east**2)
    b, l = math.radians(latitude), math.radians(longitude)
    out = near * math.cos(b) - north * math.sin(b)
    x, y = out * math.cos(l) - east * math.sin(l), out * math.sin(l) + east * math.cos(l)
    z = near * math.sin(b) + north * math.cos(b)
    picture = surface_map(MOON_MAP)
    places = np.degrees(np.arcsin(np.clip(z, -1.0, 1.0))), np.degrees(np.arctan2(y, x))
    return np.asarray(picture.sample(*places, picture.level(2.0 / size))[..., :3], float)

"""Cumulonimbus: a tower of thermals whose top spreads as an anvil of ice.

The anvil is nearly even above, at the level of neutral buoyancy, and lets the tower overshoot. It
reaches farther downwind, thins outwards and frays to fibres along the wind. Its constants are by
eye, also that its ice is a tenth of the tower's.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.heaps import CONGESTUS, heap_extinction
from airlight.clouds.power_law_field import power_law_field

FloatArray = NDArray[np.float64]

#: Cover of the clouds below the anvil over all. [1]
_BELOW: Final = 0.3
#: Length of the anvil over that of a circle, and distance of its middle from the tower over its
#: radius. [1]
_LONG: Final = 1.25
_DOWNWIND: Final = 0.4
#: Height of the upper side over that of the cloud; depth near the edge, and in addition at the
#: tower. [1]
_EVEN: Final = 0.9
_THIN: Final = 0.07
_DEEP: Final = 0.22
#: Standard deviation of the height of the upper side, and its fall at the edge, over that of the
#: cloud. [1]
_WAVES: Final = 0.015
_SAG: Final = 0.06
#: Displacement of the edge by lobes, and by fibres, over the radius. [1]
_LOBES: Final = 0.12
_FRAYED: Final = 0.07
#: Length of fibres over their width, and standard deviation of the logarithm of their ice. [1]
_FIBRES: Final = 7.0
_CONTRAST: Final = 0.5
#: Extinction over that of the tower at the same height. [1]
_ICE: Final = 0.1


def storm_extinction(
    grid: CloudGrid, random: np.random.Generator, *, cell: float, cover: float, shear: float
) -> FloatArray:
    """Relative extinction of a tower, smaller clouds beside it, and its anvil. [1]

    Parameters
    ----------
    grid, random, cell, cover, shear
        See ``heaps.heap_extinction``.
    """
    towers = heap_extinction(
        grid, random, cell=cell, cover=_BELOW * cover, shear=shear, shape=CONGESTUS
    )
    high = (towers * grid.heights**2).sum(axis=2)
    east, north = np.unravel_index(int(high.argmax()), high.shape)
    radius = np.sqrt(cover / np.pi) * grid.size
    x, y = (_from(place, grid) / radius for place in (int(east), int(north)))
    near = np.hypot(x[:, None], y[None, :])
    across = np.hypot((x[:, None] - _DOWNWIND) / _LONG, y[None, :] * _LONG)
    lobes = power_law_field(grid, random, slope=-3.0, longest=radius)
    fibres = power_law_field(grid, random, longest=radius, stretch=_FIBRES)
    out = across - _LOBES * lobes - _FRAYED * fibres * across
    edge = np.quantile(np.where(high > 0.0, out.min() - 1.0, out), cover)
    inwards = np.maximum(edge - out, 0.01 if cover == 1.0 else 0.0)
    depth = grid.depth * (_THIN * np.minimum(4.0 * inwards, 1.0) + _DEEP * np.exp(-4.0 * near))
    ice = _ICE * np.exp(_CONTRAST * fibres) * np.minimum(2.0 * inwards, 1.0)
    upper = _EVEN + _WAVES * lobes - _SAG * (1.0 - np.minimum(2.0 * inwards, 1.0)) ** 2
    above = grid.depth * np.minimum(upper, 1.0)[..., None] - grid.heights
    inside = np.minimum(above, depth[..., None] - above) / grid.level + 0.5
    anvil = np.clip(inside, 0.0, 1.0) * grid.heights ** (2.0 / 3.0) * ice[..., None]
    return np.asarray(np.maximum(towers, anvil))


def _from(column: int, grid: CloudGrid) -> FloatArray:
    """Distances of columns along a side from one of them, through the nearest face. [m]"""
    apart = (np.arange(grid.columns) - column + grid.columns // 2) % grid.columns
    return np.asarray((apart - grid.columns // 2) * grid.spacing)

"""Nodes of the moments of the radiance: radii and sun elevations.

Radii are even in the distance to the horizon (Bruneton's mapping), with more of them where the air
is thick (``levels``). Sun elevations crowd around the terminator: elevation = w·sinh(t) - e with t
even, where w and e are 0.6 and 0.3 of the dip of the horizon seen from the top of the shell (6° and
3° for Earth), so that every planet gets its own grid.
"""

from __future__ import annotations

from math import acos, asinh, degrees, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined, vectorized
from airlight.mappings.transmittance import altitude_coordinate
from airlight.solvers.moments.levels import Depths, place_levels

FloatArray = NDArray[np.float64]

#: Entries of the table that finds the index of a sun cosine in the grid.
_LOOKUP = 8192


class Grid(NamedTuple):
    """Nodes of a solution.

    Attributes
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top. [m]
    radii : array, shape (r,)
        Radii from the ground to the top. [m]
    sun_cosines : array, shape (s,)
        Sun cosines from -1 to 1. [1]
    row : array, shape (4097,)
        Fractional index into ``radii`` at even steps of the square root of altitude over the
        shell's thickness. [1]
    place : array, shape (8193,)
        Fractional index into ``sun_cosines`` at even steps of mu_s from -1 to 1. [1]
    """

    bottom_radius: float
    top_radius: float
    radii: FloatArray
    sun_cosines: FloatArray
    row: FloatArray
    place: FloatArray


def make_grid(
    bottom_radius: float, top_radius: float, radii: int, suns: int, depths: Depths
) -> tuple[Grid, int]:
    """Make the grid of a shell.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top. [m]
    radii, suns : int
        Numbers of nodes; thick air gets more radii.
    depths : Depths
        Depths at even steps of the square root of altitude, from the ground to the top.

    Returns
    -------
    grid : Grid
    parts : int
        Step, in radii of the grid, between those at which light is gathered.
    """
    dip = degrees(acos(bottom_radius / top_radius))
    width, shift = 0.6 * dip, 0.3 * dip
    first, last = asinh((shift - 90.0) / width), asinh((shift + 90.0) / width)
    t = np.linspace(first, last, suns)
    elevation = width * np.sinh(t) - shift
    sun_cosines = np.sin(np.radians(elevation))
    sun_cosines[0], sun_cosines[-1] = -1.0, 1.0
    wanted = np.degrees(np.arcsin(np.linspace(-1.0, 1.0, _LOOKUP + 1)))
    place = (np.arcsinh((wanted + shift) / width) - first) / (last - first) * (suns - 1)
    even = vectorized(altitude_coordinate)(
        bottom_radius + depths.altitude, bottom_radius, top_radius
    )
    levels = place_levels(even, depths, radii)
    r = bottom_radius + levels.altitudes
    r[0], r[-1] = bottom_radius, top_radius
    grid = Grid(
        float(bottom_radius),
        float(top_radius),
        r,
        sun_cosines,
        levels.row,
        np.clip(place, 0.0, suns - 1.0),
    )
    return grid, levels.parts


@inlined
def radius_index(q, bottom, top, row):
    """Fractional index of a radius in the grid."""
    fraction = min(max((q - bottom) / (top - bottom), 0.0), 1.0)
    x = sqrt(fraction) * (row.size - 1)
    k = min(int(x), row.size - 2)
    return row[k] + (row[k + 1] - row[k]) * (x - k)

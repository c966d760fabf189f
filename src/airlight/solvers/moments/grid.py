"""Where the moments of the radiance are kept: radii and sun elevations.

Radii are even in the distance to the horizon (Bruneton's mapping); where the air is thick, half of
them are even in scattering optical depth instead, so that a low haze is not all between two. Sun
elevations crowd around the terminator: elevation = w·sinh(t) - e with t even, where w and e are
0.6 and 0.3 of the dip of the horizon seen from the top of the shell (6° and 3° for Earth), so that
every planet gets a grid of its own.
"""

from __future__ import annotations

from math import acos, asinh, degrees, exp, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined, vectorized
from airlight.mappings.transmittance import altitude_coordinate

FloatArray = NDArray[np.float64]

#: Scattering optical depth about which radii begin to follow the air. [1]
_THICK: Final = 1.5
#: Entries of the table that finds the place of a sun cosine in the grid.
_LOOKUP = 8192


class Grid(NamedTuple):
    """The nodes of a solution.

    Attributes
    ----------
    bottom_radius, top_radius : float
        [m]
    radii : array, shape (r,)
        From the ground to the top. [m]
    sun_cosines : array, shape (s,)
        From -1 to 1. [1]
    row : array, shape (4097,)
        Index into ``radii``, with its fraction, of even steps of the square root of altitude over
        the shell's thickness. [1]
    place : array, shape (8193,)
        Index into ``sun_cosines``, with its fraction, of even steps of mu_s from -1 to 1. [1]
    """

    bottom_radius: float
    top_radius: float
    radii: FloatArray
    sun_cosines: FloatArray
    row: FloatArray
    place: FloatArray


def make_grid(
    bottom_radius: float, top_radius: float, radii: int, suns: int, depth: FloatArray
) -> Grid:
    """The grid of a shell with so many radii and sun elevations.

    Parameters
    ----------
    bottom_radius, top_radius : float
        [m]
    radii, suns : int
        Numbers of nodes.
    depth : array, shape (4097,)
        Scattering optical depth between the ground and even steps of the square root of altitude,
        ascending from 0. [1]
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
    altitude = (top_radius - bottom_radius) * np.linspace(0.0, 1.0, depth.size) ** 2
    even = vectorized(altitude_coordinate)(bottom_radius + altitude, bottom_radius, top_radius)
    thick = 0.5 * (1.0 - exp(-((depth[-1] / _THICK) ** 2)))
    coordinate = (1.0 - thick) * even
    if depth[-1] > 0.0:
        coordinate += thick * depth / depth[-1]
    coordinate /= coordinate[-1]
    r = bottom_radius + np.interp(np.linspace(0.0, 1.0, radii), coordinate, altitude)
    r[0], r[-1] = bottom_radius, top_radius
    row = np.interp(coordinate, np.linspace(0.0, 1.0, radii), np.arange(radii, dtype=float))
    return Grid(
        float(bottom_radius),
        float(top_radius),
        r,
        sun_cosines,
        row,
        np.clip(place, 0.0, suns - 1.0),
    )


@inlined
def row_of(q, bottom, top, row):
    """Index of a radius in the grid, with its fraction."""
    fraction = min(max((q - bottom) / (top - bottom), 0.0), 1.0)
    x = sqrt(fraction) * (row.size - 1)
    k = min(int(x), row.size - 2)
    return row[k] + (row[k + 1] - row[k]) * (x - k)

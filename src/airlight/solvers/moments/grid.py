"""Where the moments of the radiance are kept: radii and sun elevations.

Radii are even in the distance to the horizon (Bruneton's mapping). Sun elevations crowd around the
terminator: elevation = w·sinh(t) - e with t even, where w and e are 0.6 and 0.3 of the dip of the
horizon seen from the top of the shell (6° and 3° for Earth), so that every planet gets a grid of
its own.
"""

from __future__ import annotations

from math import acos, asinh, degrees
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.mappings.transmittance import radius_from_coordinate
from airlight.kernel import vectorized

FloatArray = NDArray[np.float64]

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
    place : array, shape (8193,)
        Index into ``sun_cosines``, with its fraction, of even steps of mu_s from -1 to 1. [1]
    """

    bottom_radius: float
    top_radius: float
    radii: FloatArray
    sun_cosines: FloatArray
    place: FloatArray


def make_grid(bottom_radius: float, top_radius: float, radii: int, suns: int) -> Grid:
    """The grid of a shell with so many radii and sun elevations."""
    dip = degrees(acos(bottom_radius / top_radius))
    width, shift = 0.6 * dip, 0.3 * dip
    first, last = asinh((shift - 90.0) / width), asinh((shift + 90.0) / width)
    t = np.linspace(first, last, suns)
    elevation = width * np.sinh(t) - shift
    sun_cosines = np.sin(np.radians(elevation))
    sun_cosines[0], sun_cosines[-1] = -1.0, 1.0
    wanted = np.degrees(np.arcsin(np.linspace(-1.0, 1.0, _LOOKUP + 1)))
    place = (np.arcsinh((wanted + shift) / width) - first) / (last - first) * (suns - 1)
    x = np.linspace(0.0, 1.0, radii)
    r = vectorized(radius_from_coordinate)(x, bottom_radius, top_radius)
    r[0], r[-1] = bottom_radius, top_radius
    return Grid(
        float(bottom_radius), float(top_radius), r, sun_cosines, np.clip(place, 0.0, suns - 1.0)
    )

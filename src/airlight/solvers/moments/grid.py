"""Nodes of the moments of the radiance: radii and sun elevations.

Radii are even in the distance to the horizon (Bruneton's mapping), with more of them where the air
is thick (``levels``). Sun elevations e crowd around the terminator, by 1/sqrt(w² + (e + s)²) nodes
in a degree, where w and s are 0.6 and 0.3 of the dip of the horizon seen from the top of the shell
(6° and 3° for Earth), so that every planet gets its own grid. Far in the shadow, where no light is
left, they are sparser; by day they are not as sparse as that, for there light is a curved function
of the elevation. Measurements: docs/decisions/0001-moments-in-the-twilight.md,
docs/decisions/0073-deep-twilight.md.
"""

from __future__ import annotations

from math import acos, asinh, degrees
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import vectorized
from airlight.mappings.transmittance import altitude_coordinate
from airlight.solvers.moments.levels import Depths, radial_grid

FloatArray = NDArray[np.float64]

#: Width and depth below the horizon of the dense nodes, over the horizon's dip.
_WIDTH: Final = 0.6
_SHIFT: Final = 0.3
#: Part of the nodes that is left in the shadow, and depths below the horizon, over its dip, between
#: which they thin out.
_SHADOW: Final = 0.2
_LEAVES: Final = (2.0, 3.0)
#: E-folds by which light fades below the horizon while the sun sinks by its dip: 9 to 12 on Earth
#: from 96° to 110°, 6 to 10 on Titan. Half of them in one step, at most.
_FADES: Final = 10.0
_STEEPEST: Final = 3.0
#: By day the nodes are never sparser than the terminator's are at this elevation. [deg]
_DAY: Final = 45.0
#: Elevations at which the density is summed.
_SAMPLES: Final = 8193
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
    first_nodes : array, shape (CELLS + 1,)
        Index of the first altitude node of each cell, see ``altitude_nodes``. [1]
    row : array, shape (n,)
        Fractional index into ``radii`` at the altitude nodes. [1]
    place : array, shape (8193,)
        Fractional index into ``sun_cosines`` at even steps of mu_s from -1 to 1. [1]
    """

    bottom_radius: float
    top_radius: float
    radii: FloatArray
    sun_cosines: FloatArray
    first_nodes: FloatArray
    row: FloatArray
    place: FloatArray


def make_grid(
    bottom_radius: float,
    top_radius: float,
    radii: int,
    sun_angles: int,
    depths: Depths,
    first_nodes: FloatArray,
) -> tuple[Grid, int]:
    """Make the grid of a shell.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top. [m]
    radii, sun_angles : int
        Numbers of nodes; thick air gets more radii.
    depths : Depths
        Depths at the altitude nodes.
    first_nodes : array, shape (CELLS + 1,)
        Index of the first altitude node of each cell. [1]

    Returns
    -------
    grid : Grid
    refinement : int
        Step, in radii of the grid, between those at which light is gathered.
    """
    dip = degrees(acos(bottom_radius / top_radius))
    elevation, index = sun_indices(dip, sun_angles)
    nodes = np.interp(np.arange(sun_angles, dtype=float), index, elevation)
    nodes[0], nodes[-1] = -90.0, 90.0
    wanted = np.degrees(np.arcsin(np.linspace(-1.0, 1.0, _LOOKUP + 1)))
    # Light does not fade evenly before the densest nodes.
    dusk = nodes[nodes >= -_SHIFT * dip][0]
    place = np.where(
        wanted < dusk,
        fading_places(wanted, nodes, _FADES / dip),
        np.interp(wanted, elevation, index),
    )
    even = vectorized(altitude_coordinate)(
        bottom_radius + depths.altitude, bottom_radius, top_radius
    )
    levels = radial_grid(even, depths, radii)
    r = bottom_radius + levels.altitudes
    r[0], r[-1] = bottom_radius, top_radius
    grid = Grid(
        float(bottom_radius),
        float(top_radius),
        r,
        np.sin(np.radians(nodes)),
        first_nodes,
        levels.row,
        place,
    )
    return grid, levels.refinement


def sun_indices(dip: float, sun_angles: int) -> tuple[FloatArray, FloatArray]:
    """Fractional indices of the nodes at many sun elevations.

    Parameters
    ----------
    dip : float
        Dip of the horizon, seen from the top of the shell. [deg]
    sun_angles : int
        Number of nodes.

    Returns
    -------
    elevation : array, shape (n,)
        Elevations, ascending from -90 to 90. [deg]
    index : array, shape (n,)
        Fractional indices, ascending from 0 to sun angles - 1. [1]
    """
    width, shift = _WIDTH * dip, _SHIFT * dip
    t = np.linspace(asinh((shift - 90.0) / width), asinh((shift + 90.0) / width), _SAMPLES)
    elevation = width * np.sinh(t) - shift
    elevation[0], elevation[-1] = -90.0, 90.0
    begin, end = _LEAVES
    shadow = 1.0 - (1.0 - _SHADOW) * _smooth((-elevation / dip - begin) / (end - begin))
    # Per step of t, in which the terminator's own nodes are even.
    density = np.hypot(shadow, _smooth(elevation / dip) * width * np.cosh(t) / _DAY)
    steps = 0.5 * (density[1:] + density[:-1])
    index = np.concatenate([[0.0], np.cumsum(steps)])
    return elevation, index * ((sun_angles - 1) / index[-1])


def fading_places(elevation: FloatArray, nodes: FloatArray, rate: float) -> FloatArray:
    r"""Places at which interpolation as ratios is exact for light that fades at a given rate.

    With h half the logarithm of the light at the upper node over that at the lower, and x the share
    of the step in elevation, the share of the step in the grid is

    .. math:: \frac{\sinh xh}{\sinh xh + \sinh (1 - x)h}

    where lerp(M·s)/lerp(s), with s = 1/sqrt(M), is the exponential between the two nodes.

    Parameters
    ----------
    elevation : array, shape (n,)
        Sun elevations from the first node to the last. [deg]
    nodes : array, shape (s,)
        Sun elevations of the nodes, ascending. [deg]
    rate : float
        E-folds of the light in a degree of the sun's elevation. [1/deg]

    Returns
    -------
    array, shape (n,)
        Fractional indices into ``nodes``. [1]
    """
    node = np.clip(np.searchsorted(nodes, elevation, side="right") - 1, 0, nodes.size - 2)
    step = np.diff(nodes)
    x = (elevation - nodes[node]) / step[node]
    half = np.minimum(0.5 * rate * step, _STEEPEST)[node]
    done, left = np.sinh(x * half), np.sinh((1.0 - x) * half)
    return np.asarray(node + done / (done + left))


def _smooth(x: FloatArray) -> FloatArray:
    """0 below 0, 1 above 1, and a smooth step between."""
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x * x * (3.0 - 2.0 * x))

"""Nodes of the moments of the radiance: radii and sun elevations.

Radii are even in the distance to the horizon (Bruneton's mapping), denser in optically thick media
(``levels``). The density of sun elevations e peaks at the terminator, as 1/sqrt(w² + (e + s)²) per
degree, where w and s are 0.6 and 0.3 of the dip of the horizon at the top of the shell (6° and 3°
for Earth). It is lower deep in the shadow, where no light is left, and has a lower bound by day,
where radiance is a curved function of elevation.
"""

from __future__ import annotations

from math import acos, asinh, degrees
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.transmittance import altitude_coordinate
from airlight.kernel import vectorized
from airlight.solver.moments.levels import Depths, radial_grid

FloatArray = NDArray[np.float64]

#: Width, and depth below the horizon, of the peak in node density, over the dip of the horizon.
_WIDTH: Final = 0.6
_SHIFT: Final = 0.3
#: Reduction of the node density in the shadow, and elevations below the horizon, over its dip,
#: between which it sets in.
_SHADOW: Final = 0.2
_LEAVES: Final = (2.0, 3.0)
#: Decay of radiance below the horizon, in e-folds per dip of the horizon: 9 to 12 on Earth from 96°
#: to 110°, 6 to 10 on Titan. At most half of them per step.
_FADES: Final = 10.0
_STEEPEST: Final = 3.0
#: By day the node density is at least that of the terminator's peak at this elevation. [deg]
_DAY: Final = 45.0
#: Elevations of the quadrature of the node density.
_SAMPLES: Final = 8193
#: Entries of the look-up table from sun cosine to index in the grid.
_LOOKUP = 8192


class MomentsGrid(NamedTuple):
    """Nodes of a solution in radius and sun elevation.

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
) -> tuple[MomentsGrid, int]:
    """Grid of a shell, and its refinement.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top. [m]
    radii, sun_angles : int
        Numbers of nodes; optically thick media get more radii.
    depths : Depths
        Optical depths at the altitude nodes.
    first_nodes : array, shape (CELLS + 1,)
        Index of the first altitude node of each cell. [1]

    Returns
    -------
    grid : MomentsGrid
    refinement : int
        Step, in radii of the grid, between those at which light is gathered.
    """
    dip = degrees(acos(bottom_radius / top_radius))
    elevation, index = sun_indices(dip, sun_angles)
    nodes = np.interp(np.arange(sun_angles, dtype=float), index, elevation)
    nodes[0], nodes[-1] = -90.0, 90.0
    elevations = np.degrees(np.arcsin(np.linspace(-1.0, 1.0, _LOOKUP + 1)))
    # The decay is not exponential before the densest nodes.
    dusk = nodes[nodes >= -_SHIFT * dip][0]
    place = np.where(
        elevations < dusk,
        fading_places(elevations, nodes, _FADES / dip),
        np.interp(elevations, elevation, index),
    )
    even = vectorized(altitude_coordinate)(
        bottom_radius + depths.altitude, bottom_radius, top_radius
    )
    levels = radial_grid(even, depths, radii)
    r = bottom_radius + levels.altitudes
    r[0], r[-1] = bottom_radius, top_radius
    grid = MomentsGrid(
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
    """Fractional node index as a function of sun elevation.

    Parameters
    ----------
    dip : float
        Dip of the horizon, seen from the top of the shell. [deg]

    Returns
    -------
    elevation : array, shape (n,)
        Elevations, ascending from -90 to 90. [deg]
    index : array, shape (n,)
        Fractional indices, ascending from 0 to ``sun_angles`` - 1. [1]
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
    r"""Fractional indices for which rational interpolation is exact for an exponential decay.

    With h half the logarithm of the ratio of upper to lower node value, and x the fraction of the
    step in elevation, the fraction of the step in the grid is

    .. math:: \frac{\sinh xh}{\sinh xh + \sinh (1 - x)h}

    for which lerp(M·s)/lerp(s), s = 1/sqrt(M), is the exponential between the two nodes.

    Parameters
    ----------
    elevation : array, shape (n,)
        Sun elevations from the first node to the last. [deg]
    nodes : array, shape (s,)
        Sun elevations of the nodes, ascending. [deg]
    rate : float
        Decay rate with sun elevation. [1/deg]

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
    """Smoothstep: 0 below 0, 1 above 1."""
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x * x * (3.0 - 2.0 * x))

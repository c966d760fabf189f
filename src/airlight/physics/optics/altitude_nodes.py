r"""Altitude nodes of tabulated profiles: even in the square root of altitude, finer in thin layers.

The shell is divided into ``CELLS`` cells that are even in :math:`\sqrt{h/H}`, h the altitude and H
the thickness of the shell. A cell in which a profile changes by more than a small fraction of its
maximum is divided evenly, in the same coordinate, into as many steps as needed; slowly varying
profiles have one step per cell. The array ``first`` holds the index of the first node of each cell,
so that look-up needs no search.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.kernel import compiled_loop, inlined

FloatArray = npt.NDArray[np.float64]

#: Number of cells. The linear interpolation error is below 1e-5 for a scale height of a hundredth
#: of the shell's thickness.
CELLS: Final = 4096
#: Largest change of a profile from node to node, over its maximum. [1]
_CHANGE: Final = 0.03
#: Smallest number of nodes over the narrower side of a jump.
_JUMP_NODES: Final = 256
#: Largest number of steps of a cell.
_MOST_STEPS: Final = 4096


def altitude_nodes(edges: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Index of the first node of each cell, and that of the last node.

    Parameters
    ----------
    edges : array, shape (nc, ns + 1)
        Altitudes where segments meet, as in ``DensitySegments``. [m]
    coefficients : array, shape (nc, ns, 4)
        Coefficients of ``segment_density``.

    Returns
    -------
    array, shape (CELLS + 1,)
        Whole numbers, ascending from 0. [1]
    """
    thickness = float(edges[0, -1])
    cells = thickness * np.linspace(0.0, 1.0, CELLS + 1) ** 2
    steps = np.ones(CELLS)
    for own, rows in zip(edges, coefficients, strict=True):
        _refine(own, rows, cells, steps)
    counts = np.minimum(np.ceil(steps), _MOST_STEPS)
    return np.concatenate([[0.0], np.cumsum(counts)])


@compiled_loop
def _refine(edges, rows, cells, steps):
    """Increase the numbers of steps of the cells as required by a profile."""
    low, high, most = np.zeros(len(rows)), np.zeros(len(rows)), 1e-300
    for s in range(len(rows)):
        a, b, c, d = rows[s]
        width = edges[s + 1] - edges[s]
        if width > 0.0:
            low[s] = max(a + d, 0.0)
            high[s] = max(a * exp(b * width) + c * width + d, 0.0)
            most = max(most, low[s], high[s])
    # Pieces between neighbouring ends of cells or segments: in each the slope is monotone.
    cell, before, bottom = 0, -1, 0.0
    for s in range(len(rows)):
        width = edges[s + 1] - edges[s]
        if width <= 0.0:
            continue
        a, b, c, d = rows[s]
        if before >= 0 and abs(low[s] - high[before]) > _CHANGE * most:
            narrower = np.inf
            for k in (before, s):
                if max(low[k], high[k]) > _CHANGE * most:
                    narrower = min(narrower, edges[k + 1] - edges[k])
            at = cell if cells[cell] < edges[s] else max(cell - 1, 0)
            height = cells[at + 1] - cells[at]
            steps[at] = max(steps[at], _JUMP_NODES * height / narrower)
        before = s
        while True:
            top = min(cells[cell + 1], edges[s + 1])
            for altitude in (bottom, top):
                grown = a * exp(b * (altitude - edges[s]))
                if grown + c * (altitude - edges[s]) + d > 0.0:
                    change = abs(grown * b + c) * (cells[cell + 1] - cells[cell])
                    steps[cell] = max(steps[cell], change / (_CHANGE * most))
            bottom = top
            if top == cells[cell + 1] and cell < CELLS - 1:
                cell += 1
            if top == edges[s + 1]:
                break


def node_altitudes(first: FloatArray, thickness: float) -> FloatArray:
    """Altitudes of the nodes, ascending from 0 to the thickness, shape (n,). [m]

    Parameters
    ----------
    first : array, shape (CELLS + 1,)
        Array from ``altitude_nodes``. [1]
    thickness : float
        Thickness of the shell. [m]
    """
    index = np.arange(first[-1] + 1.0)
    x = np.interp(index, first, np.linspace(0.0, 1.0, first.size))
    return np.asarray(thickness * x * x)


@inlined
def altitude_node(radius, bottom_radius, thickness, first):
    """Node below a radius, and fraction of the step to the next.

    Parameters
    ----------
    radius, bottom_radius, thickness : float
        Radii of the point and of the ground, and thickness of the shell. [m]
    first : array, shape (CELLS + 1,)
        Array from ``altitude_nodes``. [1]

    Returns
    -------
    node : int
    fraction : float
        In the square root of altitude. [1]
    """
    altitude = min(max((radius - bottom_radius) / thickness, 0.0), 1.0)
    x = sqrt(altitude) * (first.size - 1)
    cell = min(int(x), first.size - 2)
    begin = first[cell]
    steps = first[cell + 1] - begin
    along = (x - cell) * steps
    step = min(int(along), int(steps) - 1)
    return int(begin) + step, along - step


@inlined
def node_value(radius, bottom_radius, top_radius, first, values):
    """Value at a radius, linear between altitude nodes.

    Parameters
    ----------
    radius, bottom_radius, top_radius : float
        Radii of the point, of the ground and of the top. [m]
    first : array, shape (CELLS + 1,)
        Array from ``altitude_nodes``. [1]
    values : array, shape (n,)
        Values at the nodes.
    """
    node, fraction = altitude_node(radius, bottom_radius, top_radius - bottom_radius, first)
    return values[node] + (values[node + 1] - values[node]) * fraction

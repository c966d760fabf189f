"""Optical depth along a ray at one wavelength, and its inverse.

A ray has one or two legs, separated by its tangent point; on a leg ``r = low + y²``, with y the
variable of Gauss-Legendre panels, as in ``geometry.path``. The running integrals of a panel give
the optical depth at its points; between them it is inverted by safeguarded Newton steps on a
three-point rule that begins at the nearer point.

Extinction is tabulated over the square root of altitude, with errors below 1e-6 of its value at the
ground; panels end at discontinuities of a profile and, in thick media, at its breakpoints. Columns
are integrated.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.without_refcount import without_refcount

FloatArray = NDArray[np.float64]

#: Relative distance from the tangent point below which a leg starts there; see ``geometry.path``.
BESIDE: Final = 0.02
#: Optical depth above which a panel is bisected at the current solution, until it is thinner.
_THICK: Final = 6.0
#: Three-point Gauss-Legendre on [0, 1].
_THREE: Final = (0.11270166537925831, 0.5, 0.8872983346207417)
_GAUSS_WEIGHTS: Final = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)


class Extinction(NamedTuple):
    """Extinction at one wavelength, and the division of rays into panels.

    Attributes
    ----------
    bottom, top : float
        Radii of the ground and of the top. [m]
    table : array, shape (m,)
        Extinction at even steps of the square root of altitude over thickness. [m⁻¹]
    cuts : array, shape (j,)
        Radii at which panels end, ascending. [m]
    panels : int
        Number of panels of a leg between two cuts.
    nodes, weights, running : array, shapes (n,), (n,), (n, n)
        Quadrature rule of a panel.
    """

    bottom: float
    top: float
    table: FloatArray
    cuts: FloatArray
    panels: int
    nodes: FloatArray
    weights: FloatArray
    running: FloatArray


class Trace(NamedTuple):
    """A traced ray.

    Attributes
    ----------
    panels : array, shape (p, 6)
        Lowest radius of the leg, half the chord there, -1 or 1 for descending or ascending,
        y at start and end, and optical depth.
    values : array, shape (p, n)
        Optical depth per unit of the panel variable, 0 to 1, at its points.
    again : array, shape (n,)
        Workspace.
    """

    panels: FloatArray
    values: FloatArray
    again: FloatArray


def most_panels(extinction: Extinction) -> int:
    """Largest number of panels of a ray."""
    return 2 * (extinction.cuts.size + 1) * extinction.panels


def new_trace(extinction: Extinction) -> Trace:
    """Workspace of one ray."""
    panels, nodes = most_panels(extinction), extinction.nodes.size
    return Trace(np.empty((panels, 6)), np.empty((panels, nodes)), np.empty(nodes))


@inlined
def extinction_at(altitude, table, scale):
    """Extinction from the table; ``scale`` is (m - 1)/sqrt(thickness). [m⁻¹]"""
    x = min(sqrt(max(altitude, 0.0)) * scale, table.size - 1.0)
    node = min(int(x), table.size - 2)
    f = x - node
    return table[node] + (table[node + 1] - table[node]) * f


@inlined
def per_y(y, low, offset, bottom, table, scale):
    """Tabulated value at y times ds/dy: for extinction, optical depth per y."""
    square = y * y
    away = sqrt(offset * offset + square * (2.0 * low + square))
    slope = 2.0 * y * (low + square) / away if away > 0.0 else sqrt(2.0 * low)
    return extinction_at(low - bottom + square, table, scale) * slope


@inlined
def _fill(low, offset, start, end, extinction, values):
    """Fill the values of a panel, per unit of its variable; returns its optical depth."""
    table, bottom = extinction.table, extinction.bottom
    nodes, weights = extinction.nodes, extinction.weights
    scale = (table.size - 1) / sqrt(extinction.top - bottom)
    width = abs(end - start)
    total = 0.0
    for k in range(nodes.size):
        y = start + (end - start) * nodes[k]
        value = width * per_y(y, low, offset, bottom, table, scale)
        values[k] = value
        total += value * weights[k]
    return total


@inlined
def _leg(start_r, end_r, tangent, sign, extinction, path, count):
    """Add the panels of a leg; returns the number of panels, and the leg's optical depth."""
    cuts = extinction.cuts
    high, low = max(start_r, end_r), min(start_r, end_r)
    offset = 0.0
    if low - tangent <= BESIDE * (high - tangent):
        low = min(tangent, low)
    else:
        offset = sqrt((low - tangent) * (low + tangent))
    y_start = sqrt(max(start_r - low, 0.0))
    y_end = sqrt(max(end_r - low, 0.0))
    depth = 0.0
    pieces = cuts.size + 1
    for piece in range(pieces):
        # Pieces between cuts, in their order along the ray.
        at = piece if sign > 0.0 else pieces - 1 - piece
        floor_r = cuts[at - 1] if at > 0 else 0.0
        ceiling_r = cuts[at] if at < cuts.size else 1e300
        lower = max(min(start_r, end_r), floor_r)
        upper = min(high, ceiling_r)
        if upper <= lower and pieces > 1:
            continue
        if pieces == 1:
            first, last = y_start, y_end
        else:
            y_lower, y_upper = sqrt(max(lower - low, 0.0)), sqrt(max(upper - low, 0.0))
            first, last = (y_lower, y_upper) if sign > 0.0 else (y_upper, y_lower)
        for part in range(extinction.panels):
            panel = path.panels[count]
            panel[0], panel[1], panel[2] = low, offset, sign
            panel[3] = first + (last - first) * part / extinction.panels
            panel[4] = first + (last - first) * (part + 1) / extinction.panels
            panel[5] = _fill(low, offset, panel[3], panel[4], extinction, path.values[count])
            depth += panel[5]
            count += 1
    return count, depth


@inlined
def _legs(r, mu, rises, end, extinction, path):
    """Add the panels of one or two legs up to a radius; returns their number, and the depth."""
    tangent = r * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    count, depth = 0, 0.0
    low = r
    if mu < 0.0:
        low = max(tangent, extinction.bottom) if rises else end
        count, depth = _leg(r, low, tangent, -1.0, extinction, path, count)
    if rises:
        count, more = _leg(low, end, tangent, 1.0, extinction, path, count)
        depth += more
    return count, depth


@compiled_loop
def trace_optical_depth(r, mu, to_ground, extinction, path):
    """Panels of a ray, and its optical depth.

    Parameters
    ----------
    r, mu : float
        Start of the ray. [m], [1]
    to_ground : bool
        Whether the ray ends on the ground rather than at the top.
    path : Trace
        Receives the panels.

    Returns
    -------
    count : int
        Number of panels.
    depth : float
        Optical depth of the ray. [1]
    """
    extinction, path = without_refcount((extinction, path))
    end = extinction.bottom if to_ground else extinction.top
    return _legs(r, mu, not to_ground, end, extinction, path)


@compiled_loop
def trace_part(r, mu, rises, end, extinction, path):
    """Panels of a part of a ray, and its optical depth, as ``trace_optical_depth``.

    Parameters
    ----------
    r, mu : float
        Start of the ray. [m], [1]
    rises : bool
        Whether the part ends on the ascending leg.
    end : float
        Radius at the end. [m]
    """
    extinction, path = without_refcount((extinction, path))
    return _legs(r, mu, rises, end, extinction, path)


@compiled_loop
def place_at_depth(depth, count, extinction, path):
    """Point at which a traced ray reaches an optical depth.

    Parameters
    ----------
    depth : float
        Optical depth, below that of the whole ray. [1]
    extinction : Extinction
        Extinction of ``trace_optical_depth``.
    count, path : int, Trace
        Result and output of ``trace_optical_depth``.

    Returns
    -------
    panel : int
        Index of the panel.
    t : float
        Panel variable, 0 to 1.
    """
    extinction, path = without_refcount((extinction, path))
    table, bottom = extinction.table, extinction.bottom
    nodes, running = extinction.nodes, extinction.running
    scale = (table.size - 1) / sqrt(extinction.top - bottom)
    n = nodes.size
    at = 0
    rest = depth
    while at < count - 1 and rest > path.panels[at, 5]:
        rest -= path.panels[at, 5]
        at += 1
    panel = path.panels[at]
    low, offset = panel[0], panel[1]
    start, end, whole = panel[3], panel[4], panel[5]
    panel_end = end
    values = path.values[at]
    while True:
        # The first point beyond the depth.
        before, after = 0.0, whole
        upper = n
        for k in range(n):
            so_far = 0.0
            for j in range(n):
                so_far += running[k, j] * values[j]
            so_far = max(so_far, before)
            if so_far > rest:
                after = so_far
                upper = k
                break
            before = so_far
        if whole <= _THICK or upper >= n - 2:
            break
        # The quadrature error is relative to the total: a shorter panel is more accurate at its
        # start.
        end = start + (end - start) * nodes[upper + 1]
        values = path.again
        whole = _fill(low, offset, start, end, extinction, values)
        if whole <= rest:
            break
    left = start + (end - start) * (nodes[upper - 1] if upper > 0 else 0.0)
    right = start + (end - start) * (nodes[upper] if upper < n else 1.0)
    width = abs(right - left)
    slope_left = per_y(left, low, offset, bottom, table, scale)
    slope_right = per_y(right, low, offset, bottom, table, scale)
    target = max(rest - before, 0.0)
    # Initial value for a density linear between the points, scaled to the depth between them.
    x = 0.5
    mean = 0.5 * (slope_left + slope_right) * width
    if mean > 0.0 and after > before:
        fraction = min(target / (after - before), 1.0)
        a, b = slope_left * width / mean, slope_right * width / mean
        x = 2.0 * fraction / (a + sqrt(max(a * a + 2.0 * (b - a) * fraction, 1e-300)))
        x = min(max(x, 0.0), 1.0)
    y = left + (right - left) * x
    for _ in range(2):
        step = abs(y - left)
        found = 0.0
        for j in range(3):
            between = left + (y - left) * _THREE[j]
            found += _GAUSS_WEIGHTS[j] * per_y(between, low, offset, bottom, table, scale)
        missing = target - step * found
        slope = per_y(y, low, offset, bottom, table, scale)
        if abs(missing) <= 1e-5 * (after - before) or slope <= 0.0:
            break
        x = min(max(x + missing / (slope * width), 0.0), 1.0)
        y = left + (right - left) * x
    length = panel_end - start
    return at, (y - start) / length if length != 0.0 else 0.0


@compiled_loop
def point_at(panel, t, r, mu, extinction):
    """Point of a panel.

    Parameters
    ----------
    panel : array, shape (6,)
        Panel of a ``Trace``.
    t : float
        Panel variable, 0 to 1.
    r, mu, extinction : float, float, Extinction
        Arguments of ``trace_optical_depth``.

    Returns
    -------
    distance : float
        Distance from the start of the ray. [m]
    extinction : float
        Extinction at the point, as used for optical depths. [m⁻¹]
    slope : float
        Optical depth per unit of the panel variable.
    """
    table = extinction.table
    scale = (table.size - 1) / sqrt(extinction.top - extinction.bottom)
    low, offset = panel[0], panel[1]
    y = panel[3] + (panel[4] - panel[3]) * t
    square = y * y
    away = sqrt(offset * offset + square * (2.0 * low + square))
    per_y = 2.0 * y * (low + square) / away if away > 0.0 else sqrt(2.0 * low)
    found = extinction_at(low - extinction.bottom + square, table, scale)
    distance = -r * mu + panel[2] * away
    return distance, found, found * per_y * abs(panel[4] - panel[3])


@compiled_loop
def depth_within(at, t, base, before, extinction, path):
    """Optical depth from a panel's start to a point next to one of its rule's points.

    Parameters
    ----------
    at, t : int, float
        Index of the panel, and panel variable.
    base : int
        Index of the rule's point just below t; -1 is the panel's start.
    """
    table = extinction.table
    scale = (table.size - 1) / sqrt(extinction.top - extinction.bottom)
    panel = path.panels[at]
    first = extinction.nodes[base] if base >= 0 else 0.0
    width = panel[4] - panel[3]
    found = 0.0
    for j in range(3):
        y = panel[3] + width * (first + (t - first) * _THREE[j])
        found += _GAUSS_WEIGHTS[j] * per_y(y, panel[0], panel[1], extinction.bottom, table, scale)
    return before + found * abs(width) * (t - first)

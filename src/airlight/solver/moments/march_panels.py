"""Panels of a line of sight: ends, quadrature points, and columns up to each point.

Restricted Python, as in ``march``. One panel is stored at a time, so that a GPU thread, which runs
one line, needs little memory.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from airlight.geometry.path import (
    insert_edge,
    panel_leg,
    panel_point,
    place_edges,
    shadow_edges,
)
from airlight.geometry.refraction import refraction_angle, turned
from airlight.geometry.shell import meets_ground, radius_along
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, largest
from airlight.physics.optics.altitude_nodes import altitude_node
from airlight.solver.moments.source import transmittance_columns
from airlight.solver.tables.column_ratios import columns_to_top
from airlight.solver.tables.columns import THICK, split_at_profile_edges

#: A line is steep if its length over the shell's thickness is less, and in full daylight if the
#: star's zenith cosine is larger at both ends. The error of eight points is then below 1e-3.
STEEP = 4.0
#: Length over the shell's thickness above which a line grazes the densest layers.
GRAZING = 9.0
FULL_DAY = 0.1
#: Transmittance below which a panel is not computed. [1]
MIN_TRANSMITTANCE = 1e-7
#: Numbers of edges, per panel of a leg, beyond which a panel needs fewer points; with four on steep
#: lines of Neptune 95 % are within 1e-3.
SOME_EDGES = 6
MANY_EDGES = 10
#: By day, multiple scattering is neglected at points whose scattering is below this fraction of
#: their line's, over the number of points; in total less than this fraction, and some 2 % of it for
#: an exponential profile.
FAINT = 5e-3


class PanelPoint(NamedTuple):
    """Point of a panel.

    Attributes
    ----------
    q, t, mu : float
        Radius, distance from the start [m], and cosine of the line's zenith angle. [1]
    angle : float
        Refraction angle from the start. [rad]
    scatters : float
        Largest scattering of any wavelength, times the weight. [1]
    weight : float
        Weight of the point in its line. [m]
    """

    q: float
    t: float
    mu: float
    angle: float
    scatters: float
    weight: float


@inlined
def place_panel(r, mu, panel, count, rule, tables, work):
    """Quadrature points of a panel: positions [m], weights [m] and densities [1].

    Parameters
    ----------
    r, mu : float
        Radius of the line's start [m]; cosine of its zenith angle there. [1]
    panel, count : int
        Index of the panel, and number of edges of the line.
    rule : int
        Start of the quadrature in ``tables.rules``.
    tables, work : MarchTables, MarchWorkspace
        Tables of the solution; the workspace receives distance, radius, weight and density.
    """
    n = int(tables.rules[rule])
    descending, low, offset, first, last = panel_leg(
        r, mu, work.edges[panel], work.edges[panel + 1], work.edges[count - 1]
    )
    for k in range(n):
        work.distance[k], work.radius[k], slope = panel_point(
            -r * mu, descending, low, offset, first, last, tables.rules[rule + 1 + k]
        )
        work.weight[k] = slope * tables.rules[rule + 1 + n + k]
        node, fraction = altitude_node(
            work.radius[k], tables.bottom, tables.top - tables.bottom, tables.first_nodes
        )
        for c in range(tables.constituents):
            below = tables.density[node, c]
            work.density[c * n + k] = below + (tables.density[node + 1, c] - below) * fraction


@inlined
def panel_columns(rule, tables, work):
    """Columns up to each point of a panel, from ``work.columns_so_far`` on, and over the panel. [m]

    Parameters
    ----------
    rule, tables, work :
        Arguments of ``place_panel``; the workspace receives columns, and ``before`` those up to the
        panel's end.
    """
    n = int(tables.rules[rule])
    for c in range(tables.constituents):
        for k in range(n):
            work.amounts[c * n + k] = work.density[c * n + k] * work.weight[k]
        for k in range(n):
            running = 0.0
            for j in range(n):
                coefficient = tables.rules[rule + 1 + 2 * n + k * n + j]
                running += coefficient * work.amounts[c * n + j]
            # The running integral of a steep profile may be negative by rounding.
            work.columns[c * n + k] = work.columns_so_far[c] + max(running, 0.0)
        for k in range(n):
            work.columns_so_far[c] += work.amounts[c * n + k]


@inlined
def is_transparent(tables, work):
    """Whether the transmittance to the next panel exceeds ``MIN_TRANSMITTANCE`` anywhere."""
    most = np.float32(0.0)
    for at in range(0, tables.lanes, LANES):
        transmittance = transmittance_columns(
            work.columns_so_far, lane_view(tables.scaled_extinction, at), tables.constituents
        )
        most = max(most, largest(transmittance))
    return most > MIN_TRANSMITTANCE


@inlined
def columns_along(r, mu, count, rule, tables, work):
    """Columns of a whole line, and distances to optical depths 0.5, 3 and 12.

    Parameters
    ----------
    r, mu, count, rule, tables, work :
        Arguments of ``place_panel``; the workspace receives totals, and cuts: 0 for a depth that is
        not reached.

    Returns
    -------
    float
        Largest optical depth of any wavelength. [1]
    """
    n = int(tables.rules[rule])
    for c in range(tables.constituents):
        work.columns_total[c] = 0.0
    for which in range(3):
        work.cuts[which] = 0.0
    reached, at = 0.0, 0.0
    for panel in range(count - 1):
        place_panel(r, mu, panel, count, rule, tables, work)
        for k in range(n):
            depth = reached
            for c in range(tables.constituents):
                amount = work.density[c * n + k] * work.weight[k]
                work.columns_total[c] += amount
                depth += tables.strongest[c] * amount
            if depth > reached:
                for which in range(3):
                    target = 0.5 if which == 0 else (3.0 if which == 1 else 12.0)
                    if reached < target and depth >= target:
                        work.cuts[which] = at + (work.distance[k] - at) * (target - reached) / (
                            depth - reached
                        )
            reached, at = depth, work.distance[k]
    return reached


@inlined
def columns_to_space(r, mu, tables, out):
    """Columns from a point to space, for a ray that misses the ground, into ``out`` (nc,). [m]

    Parameters
    ----------
    r, mu : float
        Radius of the point [m] and zenith cosine of the ray there [1].
    tables, out :
        Arguments of ``march``, and workspace.
    """
    columns_to_top(
        r,
        mu,
        tables.bottom,
        tables.top,
        tables.first_nodes,
        tables.column_rows,
        tables.columns,
        out,
    )


@inlined
def columns_between(r, mu, length, tables, work):
    """Columns of a line from the column table.

    The error is 1e-3 of the columns of the whole ray, the cost a tenth of ``columns_along``.

    Parameters
    ----------
    r, mu, length, tables, work :
        Arguments of ``place_panels``; the workspace receives totals.

    Returns
    -------
    float
        Largest optical depth of any wavelength. [1]
    """
    bottom, top = tables.bottom, tables.top
    end = min(max(radius_along(r, mu, length), bottom), top)
    mu_end = min(max((r * mu + length) / end, -1.0), 1.0)
    # The table holds rays that miss the ground.
    low, low_mu, high, high_mu = r, mu, end, mu_end
    if meets_ground(r, mu, bottom):
        low, low_mu, high, high_mu = end, -mu_end, r, -mu
    columns_to_space(low, low_mu, tables, work.columns_total)
    columns_to_space(high, high_mu, tables, work.columns_to_sun_low)
    depth = 0.0
    for c in range(tables.constituents):
        work.columns_total[c] = max(work.columns_total[c] - work.columns_to_sun_low[c], 0.0)
        depth += tables.strongest[c] * work.columns_total[c]
    return depth


@inlined
def place_panels(r, mu, mu_s, nu, length, tables, work):
    """Panels of a line, their quadrature, and columns before the first: 0.

    A panel of n points integrates exp(-τ) well while τ over it stays below about n²/8. Where the
    whole line is thicker, panels end at optical depths 0.5, 3 and 12, found from first columns and
    once more from the better ones.

    Parameters
    ----------
    r, mu, mu_s, nu, length, tables, work :
        As in ``Segment`` and ``march``; the workspace receives edges, totals and columns so far.

    Returns
    -------
    count, rule : int
        Number of edges, and start of the quadrature in ``tables.rules``.
    faint : float
        Multiple scattering is neglected at points that scatter less. [1]
    """
    first_cut, second_cut = shadow_edges(r, mu, mu_s, nu, tables.bottom)
    count = place_edges(r, mu, length, tables.panels, first_cut, second_cut, work.edges)
    count = split_at_profile_edges(r, mu, tables.bottom, tables.ends, work.edges, count)
    end = min(mu_s, (r * mu_s + length * nu) / radius_along(r, mu, length))
    slant = length / (tables.top - tables.bottom)
    day = end > FULL_DAY
    kind = 1 if slant < GRAZING or count > SOME_EDGES * tables.panels else 2
    if day and slant < STEEP:
        kind = 3 if count > MANY_EDGES * tables.panels else 0
    elif count > MANY_EDGES * tables.panels:
        kind = 0
    rule = int(tables.rules[kind])
    if columns_between(r, mu, length, tables, work) > THICK:
        for _attempt in range(2):
            if columns_along(r, mu, count, rule, tables, work) <= THICK:
                break
            for which in range(3):
                count = insert_edge(work.edges, count, work.cuts[which])
    scatters, faint = 0.0, 0.0
    for c in range(tables.constituents):
        scatters += tables.brightest[c] * work.columns_total[c]
        work.columns_so_far[c] = 0.0
    if day:
        faint = FAINT * min(scatters, 1.0) / (int(tables.rules[rule]) * (count - 1))
    return count, rule, faint


@inlined
def panel_place(k, n, r, mu, tables, work):
    """``PanelPoint`` k of n of a panel, with its densities and columns in the workspace.

    Parameters
    ----------
    k, n : int
        Index of the point, and number of points of the panel.
    r, mu, tables, work :
        As in ``Segment`` and ``march``; the workspace receives density and depths of the point.
    """
    q = min(max(work.radius[k], tables.bottom), tables.top)
    t = work.distance[k]
    mu_q = min(max((r * mu + t) / q, -1.0), 1.0)
    scatters, angle = 0.0, 0.0
    for c in range(tables.constituents):
        work.point_density[c] = work.density[c * n + k]
        work.depths[c] = work.columns[c * n + k]
        scatters += tables.brightest[c] * work.density[c * n + k]
    if tables.refraction_strength > 0.0:
        angle = refraction_angle(
            r, mu, tables.refraction_strength, work.columns[(tables.constituents - 1) * n + k]
        )
    weight = work.weight[k]
    return PanelPoint(q, t, mu_q, angle, scatters * weight, weight)


@inlined
def star_place(point, r, mu_s, nu, tables):
    """Cosines of the star's zenith angle at a point, and between star and ray there. [1]

    Parameters
    ----------
    point : PanelPoint
        Point of the line.
    r, mu_s, nu, tables :
        As in ``Segment`` and ``march``.
    """
    mu_sq, nu_q = min(max((r * mu_s + point.t * nu) / point.q, -1.0), 1.0), nu
    if tables.refraction_strength > 0.0:
        mu_sq, nu_q = turned(point.mu, mu_sq, nu, point.angle)
        mu_sq = min(max(mu_sq, -1.0), 1.0)
    return mu_sq, nu_q

"""March along one line of sight, for a device that runs one line a thread.

It has the same edges, points and sources as ``solvers.moments.march``, panel by panel, so that
only the points of one panel are stored. It is restricted Python: the emitter translates it to
WGSL, Numba runs it in the tests.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.geometry.bending import bend_angle, level_light, star_points, turned
from airlight.geometry.path import (
    MAX_EDGES,
    insert_edge,
    panel_leg,
    panel_point,
    place_edges,
    shadow_edges,
)
from airlight.geometry.shell import radius_along
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, load, splat, store
from airlight.pixels.shown import MOST_CONSTITUENTS
from airlight.solvers.moments.grid import radius_index
from airlight.solvers.moments.harmonics import directed_functions
from airlight.solvers.moments.march import FAINT, FULL_DAY, GRAZING, STEEP
from airlight.solvers.moments.source import (
    gathered_light,
    level_sky,
    level_star,
    scattered_star,
    star_at,
    through_columns,
)
from airlight.solvers.moments.sweep import sun_index
from airlight.tables.column_ratios import columns_to_top
from airlight.tables.columns import THICK, cut_at_corners, density_index

#: Largest number of points of a panel, and number of harmonics up to degree 24.
MOST_POINTS = 24
MOST_TERMS = 325
_WORKSPACE = MOST_CONSTITUENTS * MOST_POINTS
#: Numbers of edges beyond which a line needs fewer points a panel.
SOME_EDGES = 6
MANY_EDGES = 10


@inlined
def panel_columns(rule, light, amounts, before, columns):
    """Columns up to each point of a panel, added to ``before``, and over the whole panel. [m]

    ``amounts`` holds density times weight of each point, one constituent after another.

    Parameters
    ----------
    rule : int
        Start of the quadrature in ``light.rules``.
    light : Shown
        Tables of the solution.
    amounts : array, shape (c·p,)
        Density times weight. [m]
    before : array, shape (c,)
        Columns up to the panel; updated to those up to its end. [m]
    columns : array, shape (c·p,)
        Receives the columns. [m]
    """
    n = int(light.rules[rule])
    for c in range(light.constituents):
        for k in range(n):
            running = 0.0
            for j in range(n):
                share = light.rules[rule + 1 + 2 * n + k * n + j]
                running += share * amounts[c * MOST_POINTS + j]
            columns[c * MOST_POINTS + k] = before[c] + max(running, 0.0)
        for k in range(n):
            before[c] += amounts[c * MOST_POINTS + k]


@inlined
def place_panel(r, mu, start, end, length, rule, light, distance, radius, weight, density):
    """Points of a panel: positions [m], weights [m] and densities [1].

    Parameters
    ----------
    r, mu : float
        Radius of the line's start [m]; cosine of its zenith angle there. [1]
    start, end, length : float
        Start and end of the panel, from the line's start, and length of the line. [m]
    rule, light : int, Shown
        Arguments of ``panel_columns``.
    distance, radius, weight : array, shape (p,)
        Receive the distances from the line's start, the radii and the weights. [m]
    density : array, shape (c·p,)
        Receives the densities. [1]
    """
    n = int(light.rules[rule])
    descending, low, beside, first, last = panel_leg(r, mu, start, end, length)
    for k in range(n):
        distance[k], radius[k], slope = panel_point(
            -r * mu, descending, low, beside, first, last, light.rules[rule + 1 + k]
        )
        weight[k] = slope * light.rules[rule + 1 + n + k]
        node, share = density_index(
            radius[k], light.bottom, light.top - light.bottom, light.density.shape[0]
        )
        for c in range(light.constituents):
            here = light.density[node, c]
            density[c * MOST_POINTS + k] = here + (light.density[node + 1, c] - here) * share


@inlined
def columns_along(r, mu, edges, count, rule, light, totals, cuts):
    """Columns of a whole line, and distances of optical depths 0.5, 3 and 12. [m]

    Parameters
    ----------
    r, mu : float
        Arguments of ``place_panel``.
    edges : array, shape (MAX_EDGES,)
        Ends of the panels, of which the first ``count`` are used. [m]
    count : int
        Number of edges.
    rule, light : int, Shown
        Arguments of ``panel_columns``.
    totals : array, shape (c,)
        Receives the columns. [m]
    cuts : array, shape (3,)
        Receives the distances from the line's start; 0 for a depth that is not reached. [m]

    Returns
    -------
    float
        Largest optical depth of any wavelength. [1]
    """
    distance, radius, weight = np.empty(MOST_POINTS), np.empty(MOST_POINTS), np.empty(MOST_POINTS)
    density = np.empty(_WORKSPACE)
    n = int(light.rules[rule])
    for c in range(light.constituents):
        totals[c] = 0.0
    cuts[0] = 0.0
    cuts[1] = 0.0
    cuts[2] = 0.0
    reached, at = 0.0, 0.0
    for panel in range(count - 1):
        place_panel(
            r, mu, edges[panel], edges[panel + 1], edges[count - 1], rule, light, distance, radius,
            weight, density,
        )  # fmt: skip
        for k in range(n):
            depth = reached
            for c in range(light.constituents):
                amount = density[c * MOST_POINTS + k] * weight[k]
                totals[c] += amount
                depth += light.strongest[c] * amount
            if depth > reached:
                for which in range(3):
                    wanted = 0.5 if which == 0 else (3.0 if which == 1 else 12.0)
                    if reached < wanted and depth >= wanted:
                        cuts[which] = at + (distance[k] - at) * (wanted - reached) / (
                            depth - reached
                        )
            reached, at = depth, distance[k]
    return reached


@inlined
def march_line(r, mu, mu_s, nu, length, orders, gathers, peaks, phase, light, totals, result):
    """Light of a stretch of air towards its start, per irradiance of the star.

    Parameters
    ----------
    r, mu : float
        Radius of the start, inside the shell, and zenith cosine. [m], [1]
    mu_s, nu : float
        Cosines of the star's zenith angle at the start, and between line and star. [1]
    length : float
        Length, to the ground or to the top. [m]
    orders : int
        1: the star's light scattered once; 0: all other light; 2: both.
    gathers, peaks : bool
        Constants: whether light scattered before is added, and whether the peaked constituents
        are, without their phase functions.
    phase : array, shape (nc·w,)
        Phase functions; 0 for constituents kept separate. [sr⁻¹]
    light : Shown
        Tables of the solution.
    totals : array, shape (nc,)
        Receives the columns of the stretch. [m]
    result : array, shape (4·w,)
        Receives the air's radiance [sr⁻¹], its transmittance [1], and the single scattering by
        the two peaked constituents, without their phase functions [1].
    """
    bottom, top = light.bottom, light.top
    edges = np.empty(MAX_EDGES)
    distance, radius, weight = np.empty(MOST_POINTS), np.empty(MOST_POINTS), np.empty(MOST_POINTS)
    density, columns = np.empty(_WORKSPACE), np.empty(_WORKSPACE)
    amounts = np.empty(_WORKSPACE)
    before = np.empty(MOST_CONSTITUENTS)
    rho, depths = np.empty(MOST_CONSTITUENTS, np.float32), np.empty(MOST_CONSTITUENTS, np.float32)
    here, there = np.empty(MOST_CONSTITUENTS), np.empty(MOST_CONSTITUENTS)
    cuts = np.empty(3)
    functions = np.empty(MOST_TERMS, np.float32)
    first_cut, second_cut = shadow_edges(r, mu, mu_s, nu, bottom)
    count = place_edges(r, mu, length, 1, first_cut, second_cut, edges)
    count = cut_at_corners(r, mu, bottom, light.ends, edges, count)
    end = min(mu_s, (r * mu_s + length * nu) / radius_along(r, mu, length))
    slant = length / (top - bottom)
    day = end > FULL_DAY
    kind = 1 if slant < GRAZING or count > SOME_EDGES else 2
    if (day and slant < STEEP) or count > MANY_EDGES:
        kind = 0
    rule = int(light.rules[kind])
    n = int(light.rules[rule])
    for _attempt in range(2):
        if columns_along(r, mu, edges, count, rule, light, totals, cuts) <= THICK:
            break
        for which in range(3):
            count = insert_edge(edges, count, cuts[which])
    scatters = 0.0
    for c in range(light.constituents):
        scatters += light.brightest[c] * totals[c]
        before[c] = 0.0
    faint = FAINT * min(scatters, 1.0) if day else 0.0
    air, first, second = splat(0.0), splat(0.0), splat(0.0)
    block = LANES * (1 + (light.degree + 1) * (light.degree + 2) // 2)
    for panel in range(count - 1):
        place_panel(
            r, mu, edges[panel], edges[panel + 1], edges[count - 1], rule, light, distance, radius,
            weight, density,
        )  # fmt: skip
        for c in range(light.constituents):
            for k in range(n):
                amounts[c * MOST_POINTS + k] = density[c * MOST_POINTS + k] * weight[k]
        panel_columns(rule, light, amounts, before, columns)
        for k in range(n):
            q = min(max(radius[k], bottom), top)
            t = distance[k]
            mu_q = min(max((r * mu + t) / q, -1.0), 1.0)
            mu_sq = min(max((r * mu_s + t * nu) / q, -1.0), 1.0)
            nu_q = nu
            depth = 0.0
            for c in range(light.constituents):
                rho[c] = density[c * MOST_POINTS + k]
                depths[c] = columns[c * MOST_POINTS + k]
                depth += light.brightest[c] * rho[c]
            if light.bend > 0.0:
                angle = bend_angle(r, mu, light.bend, depths[light.constituents - 1])
                mu_sq, nu_q = turned(mu_q, mu_sq, nu, angle)
                mu_sq = min(max(mu_sq, -1.0), 1.0)
            through = through_columns(
                depths, light.extinction, light.constituents, LANES, 0
            ) * np.float32(weight[k])
            if orders != 0:
                seen, low, high = star_points(q, mu_sq, bottom, top, light.star_radius, light.lift)
                if seen > 0.0:
                    columns_to_top(q, low, bottom, top, light.columns, here)
                    if high > low:
                        columns_to_top(q, high, bottom, top, light.columns, there)
                    star = through * star_at(
                        seen, here, there, high > low, light.extinction, light.constituents, LANES,
                        0,
                    )  # fmt: skip
                    if peaks:
                        if light.first_peak >= 0:
                            first = (
                                first
                                + star
                                * load(light.scattering, LANES * light.first_peak)
                                * rho[light.first_peak]
                            )
                        if light.second_peak >= 0:
                            second = (
                                second
                                + star
                                * load(light.scattering, LANES * light.second_peak)
                                * rho[light.second_peak]
                            )
                    else:
                        air = air + star * scattered_star(
                            rho, light.scattering, phase, light.constituents, LANES, 0
                        )
            if gathers and orders != 1 and depth * weight[k] >= faint:
                spread = (1.0 - mu_q) * (1.0 + mu_q) * (1.0 - mu_sq) * (1.0 + mu_sq)
                step = (nu_q - mu_q * mu_sq) / sqrt(max(spread, 1e-24))
                directed_functions(
                    mu_q,
                    min(max(step, -1.0), 1.0),
                    (light.degree, light.start, light.ahead, light.back),
                    functions,
                )
                x = radius_index(q, bottom, top, light.row)
                row = min(int(x), light.radii - 2)
                f = np.float32(x - row)
                x = sun_index(mu_sq, light.place)
                place = min(int(x), light.suns - 2)
                e = np.float32(x - place)
                g = np.float32(1.0) - f
                h = np.float32(1.0) - e
                near = (row * light.suns + place) * block
                air = air + through * gathered_light(
                    rho, light.moments, light.field, functions, near,
                    near + light.suns * block, block, g * h, g * e, f * h, f * e,
                    light.degree, light.constituents, LANES, 0,
                )  # fmt: skip
    for c in range(light.constituents):
        totals[c] = before[c]
    store(result, 0, air)
    store(result, LANES, through_columns(before, light.extinction, light.constituents, LANES, 0))
    store(result, 2 * LANES, first)
    store(result, 3 * LANES, second)


@inlined
def ground_received(mu_s, orders, light, room):
    """Irradiance of level ground, per irradiance of the star, into ``room``.

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle on the ground. [1]
    orders : int
        Orders as in ``march_line``.
    light : Shown
        Tables of the solution.
    room : array, shape (w,)
        Receives the irradiance. [1]
    """
    bottom, top = light.bottom, light.top
    below, above = np.empty(MOST_CONSTITUENTS), np.empty(MOST_CONSTITUENTS)
    received = splat(0.0)
    if orders != 0:
        from_low, from_high, low, high = level_light(
            bottom, mu_s, bottom, top, light.star_radius, light.lift
        )
        if from_low + from_high > 0.0:
            columns_to_top(bottom, low, bottom, top, light.columns, below)
            columns_to_top(bottom, high, bottom, top, light.columns, above)
            received = level_star(
                below, above, from_low, from_high, light.extinction, light.constituents, LANES, 0
            )
    if orders != 1:
        x = sun_index(mu_s, light.place)
        place = min(int(x), light.suns - 2)
        received = received + level_sky(light.sky, place, x - place, LANES, 0)
    store(room, 0, received)

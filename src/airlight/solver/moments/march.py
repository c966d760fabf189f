"""Ray march: radiance along a line of sight from a solution's moments.

Single scattering uses the exact phase function and the exact shadow; the multiple-scattering source
comes from the moments. All wavelengths are marched together, so that geometry is evaluated once per
point.

Restricted Python, shared by all backends: Numba compiles it for groups of eight wavelengths, the
emitter translates it to shaders, whose single group is a texel.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from airlight.geometry.refraction import star_points
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import LANES, lane_view, splat
from airlight.physics.optics.altitude_nodes import node_value
from airlight.solver.moments.forward_peak import (
    add_peaks,
    peak_fraction,
    peak_gain,
    reset_peaks,
)
from airlight.solver.moments.harmonics import directed_functions
from airlight.solver.moments.march_panels import (
    columns_to_space,
    is_transparent,
    panel_columns,
    panel_place,
    place_panel,
    place_panels,
    star_place,
)
from airlight.solver.moments.ray_optics import sun_index
from airlight.solver.moments.source import (
    direct_beam,
    field_node,
    multiple_scattering_source,
    polarised_ratio_columns,
    polarised_scattering_source,
    single_scattering_source,
    transmittance_columns,
)
from airlight.solver.stokes_frame import VERTICAL, star_plane
from airlight.solver.tables.ring_shadow import ring_shade


class StarPlane(NamedTuple):
    """Turn from the plane of line and star to the frame of ``stokes_frame``.

    Attributes
    ----------
    cosine, sine : float
        Results of ``star_plane``. [1]
    """

    cosine: float
    sine: float


@inlined
def march(segment, orders, terms, tables, work, result):
    """Path radiance and transmittance of a segment, per irradiance of the star.

    Parameters
    ----------
    segment : Segment
        Segment of a line of sight.
    orders : int
        1: single scattering; 0: multiple scattering and reflected diffuse light; 2: both.
    terms : MarchTerms
        Terms to compute.
    tables : MarchTables
        Tables of the solution.
    work : MarchWorkspace
        Workspace with the phase functions; elements F₁₂ of the phase matrices if ``polarised``; 0
        for constituents kept separate. Its totals receive the columns of the segment. [m]
    result : array, shape (4, w), or (6, w) if ``polarised``
        Receives path radiance [sr⁻¹], delta-M scaled transmittance [1], single scattering by the
        two separated constituents without their phase functions [1], and Q and U in the frame of
        ``stokes_frame`` [sr⁻¹].
    """
    r, mu, mu_s, nu = segment.r, segment.mu, segment.mu_s, segment.nu
    turn_cosine, turn_sine = 1.0, 0.0
    if terms.polarised:
        turn_cosine, turn_sine = star_plane(mu, mu_s, nu)
    plane = StarPlane(turn_cosine, turn_sine)
    count, rule, faint = place_panels(r, mu, mu_s, nu, segment.length, tables, work)
    n = int(tables.rules[rule])
    for at in range(0, tables.lanes, LANES):
        found = lane_view(result, at)
        found[0], found[2], found[3] = splat(0.0), splat(0.0), splat(0.0)
        if terms.polarised:
            found[4], found[5] = splat(0.0), splat(0.0)
    reset_peaks(tables, work)
    for panel in range(count - 1):
        points = n
        if tables.culls_opaque > 0 and not is_transparent(tables, work):
            points = 0
        place_panel(r, mu, panel, count, rule, tables, work)
        panel_columns(rule, tables, work)
        for k in range(points):
            point = panel_place(k, n, r, mu, tables, work)
            add_point(point, segment, orders, terms, faint, plane, tables, work, result)
    for c in range(tables.constituents):
        work.columns_total[c] = work.columns_so_far[c]
    for at in range(0, tables.lanes, LANES):
        found = lane_view(result, at)
        found[1] = transmittance_columns(
            work.columns_total, lane_view(tables.scaled_extinction, at), tables.constituents
        )
    if tables.broadened and orders != 0:
        broaden_peaks(segment.half_sine, terms, tables, work, result)


@inlined
def broaden_peaks(half_sine, terms, tables, work, result):
    """Broaden the forward peaks of single scattering on a line; arguments as in ``march``."""
    for at in range(0, tables.lanes, LANES):
        found, sums = lane_view(result, at), lane_view(work.peaks, at)
        more = peak_gain(half_sine, tables, work, at)
        if terms.air:
            found[0] += more * sums[0]
        if terms.peaks and tables.separated_1 >= 0:
            found[2] *= np.float32(1.0) + more * peak_fraction(tables.separated_1, tables, at)
        if terms.peaks and tables.separated_2 >= 0:
            found[3] *= np.float32(1.0) + more * peak_fraction(tables.separated_2, tables, at)


@inlined
def add_point(point, segment, orders, terms, faint, plane, tables, work, result):
    """Add the source of one point of a panel to the result; further arguments as in ``march``.

    Parameters
    ----------
    point : PanelPoint
        Point of the panel.
    faint : float
        Multiple scattering is neglected if the point scatters less. [1]
    plane : StarPlane
        Plane of line and star.
    """
    mu_sq, nu_q = star_place(point, segment.r, segment.mu_s, segment.nu, tables)
    weight = point.weight * ring_shade_on(point.t, segment, tables)
    seen, spread = 0.0, False
    if orders != 0:
        seen, spread = star_columns(point.q, mu_sq, tables, work)
    gathers = terms.air and orders != 1 and point.scatters >= faint
    row, sun, f, e = 0, 0, 0.0, 0.0
    if terms.air and gathers:
        row, sun, f, e = field_place(point.q, point.mu, mu_sq, nu_q, tables, work)
    for at in range(0, tables.lanes, LANES):
        found, extinction = lane_view(result, at), lane_view(tables.scaled_extinction, at)
        transmittance = transmittance_columns(
            work.depths, extinction, tables.constituents
        ) * np.float32(weight)
        polarised_ratio = splat(1.0)
        if terms.polarised and orders != 1:
            polarised_ratio = polarised_ratio_columns(
                work.depths, lane_view(tables.polarised_moments, at), tables.constituents
            )
        if seen > 0.0:
            star = transmittance * direct_beam(
                seen,
                work.columns_to_sun_low,
                work.columns_to_sun_high,
                spread,
                extinction,
                tables.constituents,
            )
            add_star(star, terms, lane_view(work.phase, at), tables, work, at, found)
            if tables.broadened:
                add_peaks(
                    star, np.float32(1.0), spread, lane_view(work.phase, at), tables, work, at
                )
            if terms.polarised:
                add_polarised_star(polarised_ratio * star, plane, tables, work, at, found)
        if terms.air and gathers:
            node = field_node(row, sun, np.float32(f), np.float32(e))
            found[0] += transmittance * multiple_scattering_at(node, tables, work, at)
            if terms.polarised:
                add_polarised_light(
                    polarised_ratio * transmittance, point.mu, node, tables, work, at, found
                )


@inlined
def ring_shade_on(t, segment, tables):
    """Transmittance of the rings between a point of a segment and the star. [1]

    Parameters
    ----------
    t : float
        Distance of the point from the start. [m]
    segment, tables :
        Arguments of ``march``.
    """
    left, ring = 1.0, segment.ring
    if tables.rings.ringed:
        square = max(ring.square + t * (2.0 * ring.rise + t), 1.0)
        along, height = ring.along + t * segment.nu, ring.height + t * ring.slope
        left = ring_shade(
            square, along, height, ring.sun, tables.star_radius, ring.blur, tables.rings
        )
    return left


@inlined
def star_columns(q, mu_s, tables, work):
    """Visible part of the star at a point, and columns towards it, in the workspace. [m]

    Parameters
    ----------
    q, mu_s : float
        Radius of the point [m]; cosine of the star's zenith angle there. [1]
    tables, work : MarchTables, MarchWorkspace
        Arguments of ``march``; the workspace receives the columns to the star's two points.

    Returns
    -------
    seen : float
        Visible part, from ``star_points``. [1]
    spread : bool
        Whether two points represent the star.
    """
    seen, low, high = star_points(
        q, mu_s, tables.bottom, tables.top, tables.star_radius, tables.refraction_table
    )
    if seen > 0.0:
        columns_to_space(q, low, tables, work.columns_to_sun_low)
        if high > low:
            columns_to_space(q, high, tables, work.columns_to_sun_high)
    return seen, high > low


@inlined
def add_star(star, terms, phase, tables, work, at, result):
    """Add single scattering at a point to the path radiance and to the peaks.

    Parameters
    ----------
    star : lanes
        Direct irradiance at the point, times its weight and the transmittance to the start of the
        line. [m]
    phase : lanes, shape (nc,)
        Phase functions. [sr⁻¹]
    terms, tables, work, result :
        Arguments of ``march``; the result as lanes.
    at : int
        Index of the first lane.
    """
    scattering = lane_view(tables.scattering, at)
    if terms.air:
        result[0] += star * single_scattering_source(
            work.point_density, scattering, phase, tables.constituents
        )
    if terms.peaks and tables.separated_1 >= 0:
        c = tables.separated_1
        result[2] += star * scattering[c] * work.point_density[c]
    if terms.peaks and tables.separated_2 >= 0:
        c = tables.separated_2
        result[3] += star * scattering[c] * work.point_density[c]


@inlined
def add_polarised_star(star, plane, tables, work, at, result):
    """Add Q and U of single scattering at a point; arguments as in ``add_star``, ``add_point``."""
    once = star * single_scattering_source(
        work.point_density,
        lane_view(tables.scattering, at),
        lane_view(work.phase_f12, at),
        tables.constituents,
    )
    result[4] += once * np.float32(plane.cosine)
    result[5] += once * np.float32(plane.sine)


@inlined
def add_polarised_light(transmittance, mu, node, tables, work, at, result):
    """Add Q and U of multiple scattering at a point.

    Parameters
    ----------
    transmittance : lanes
        Transmittance from the point times its weight. [m]
    mu : float
        Cosine of the line's zenith angle at the point. [1]
    node, tables, work, at :
        Arguments of ``multiple_scattering_at``.
    result : lanes, shape (6,)
        Result of a march.
    """
    stokes_q, stokes_u = polarised_scattering_source(
        work.point_density,
        lane_view(tables.polarised_moments, at),
        lane_view(tables.field, at),
        mu,
        work.azimuth[0],
        node,
        tables.degree,
        tables.constituents,
    )
    result[4] += transmittance * stokes_q
    result[5] += transmittance * stokes_u


@kernel
def line_azimuth(mu, mu_s, nu):
    """Cosine of a line's azimuth from the star; for vertical lines see ``stokes_frame``. [1]

    Parameters
    ----------
    mu, mu_s, nu : float
        Cosines of the line's and of the star's zenith angle, and between line and star. [1]

    Examples
    --------
    >>> line_azimuth(0.0, 0.0, -1.0)  # looking away from the star
    -1.0
    """
    spread = (1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s)
    cosine = 1.0
    if spread > 1e-24 and (1.0 - mu) * (1.0 + mu) > VERTICAL:
        cosine = min(max((nu - mu * mu_s) / sqrt(spread), -1.0), 1.0)
    return cosine


@inlined
def field_place(q, mu, mu_s, nu, tables, work):
    """Position of a point in the field, with the harmonics of the line in the workspace.

    Parameters
    ----------
    q, mu, mu_s, nu : float
        Radius of the point [m]; cosines of the line's and of the star's zenith angle there, and
        between line and star. [1]
    tables, work : MarchTables, MarchWorkspace
        Arguments of ``march``; the workspace receives functions and azimuth.

    Returns
    -------
    row, sun : int
        Indices of the radius and of the sun elevation before the point in the field.
    f, e : float
        Fractions of the steps to the next radius and to the next sun angle. [1]
    """
    work.azimuth[0] = line_azimuth(mu, mu_s, nu)
    directed_functions(
        mu,
        work.azimuth[0],
        (tables.degree, tables.start, tables.ahead, tables.back),
        work.functions,
    )
    x = node_value(q, tables.bottom, tables.top, tables.first_nodes, tables.row)
    row = min(int(x), tables.radii - 2)
    y = sun_index(mu_s, tables.place)
    sun = min(int(y), tables.sun_angles - 2)
    return row, sun, x - row, y - sun


@inlined
def multiple_scattering_at(node, tables, work, at):
    """Multiple-scattering source at a point, from lane ``at`` on. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    node : FieldNode
        Place in the field, from the results of ``field_place`` in single precision.
    tables, work : MarchTables, MarchWorkspace
        Arguments of ``march``, after ``field_place``.
    """
    return multiple_scattering_source(
        work.point_density,
        lane_view(tables.moments, at),
        lane_view(tables.polarised_moments, at),
        lane_view(tables.field, at),
        work.functions,
        node,
        tables.degree,
        tables.constituents,
    )

"""Ray march through a moon's shadow on the atmosphere.

The march is that of ``moments.march`` with three differences: direct irradiance at a point is
multiplied by the visible fraction of the star there; multiple scattering is that of the unshadowed
solution times the same fraction, plus the correction of ``ShadowTables``; and panels end at the
umbra. There is no symmetry about the star's vertical plane.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.occulted_star import apparent_discs, table_place, visible_fractions
from airlight.geometry.path import insert_edge
from airlight.geometry.refraction import refraction_angle
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, lane_view, load, maximum, splat, store
from airlight.physics.optics.reflection import diffuse_reflectance, direct_reflectance
from airlight.solver.eclipsed.shadow_tables import (
    ShadowTables,
    ShadowWorkspace,
    deviation,
    direction_functions,
    new_shadow_workspace,
    place_in_shadow,
    sky_deviation,
)
from airlight.solver.moments.forward_peak import add_peaks, peak_gain, reset_peaks
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march import (
    add_star,
    field_place,
    multiple_scattering_at,
    star_columns,
)
from airlight.solver.moments.march_panels import (
    panel_columns,
    panel_place,
    place_panel,
    place_panels,
)
from airlight.solver.moments.march_tables import (
    MarchTables,
    MarchTerms,
    MarchWorkspace,
    new_workspace,
)
from airlight.solver.moments.source import (
    between,
    direct_beam,
    field_node,
    transmittance_columns,
)

#: Component of the radiance: with the local shadow, correction of multiple scattering, or both.
LOCAL_SHADOW: Final = 0
SCATTERING_CORRECTION: Final = 1
TOTAL: Final = 2
#: Distances from the axis, in widths of the grid's middle, at which panels end.
_CUTS: Final = (1.0, 2.0, 5.0)


class EclipsedLine(NamedTuple):
    """Line of sight in the frame of the shadow.

    Attributes
    ----------
    x, y, z : float
        Start, in the optical radius. [m]
    u, v, w : float
        Direction. [1]
    length : float
        Length, to the ground or to the top. [m]
    half_sine : float
        sin(θ/2) of the angle to the apparent star, for which the phase functions are given. [1]
    """

    x: float
    y: float
    z: float
    u: float
    v: float
    w: float
    length: float
    half_sine: float


class Eclipse(NamedTuple):
    """Unshadowed solution and shadow, with the workspaces of a thread.

    Attributes
    ----------
    tables, work : MarchTables, MarchWorkspace
        Tables of the unshadowed solution; workspace, whose totals receive the columns of a line
        [m].
    shadow, scratch : ShadowTables, ShadowWorkspace
        Shadow, and its workspace.
    """

    tables: MarchTables
    work: MarchWorkspace
    shadow: ShadowTables
    scratch: ShadowWorkspace


def new_eclipse(tables: MarchTables, shadow: ShadowTables) -> Eclipse:
    """Tables, with new workspaces."""
    return Eclipse(tables, new_workspace(tables), shadow, new_shadow_workspace(shadow))


@inlined
def start_cosines(line, star):
    """Radius of a line's start [m], cosines of zenith angles and of the angle to the star. [1]

    Parameters
    ----------
    line : EclipsedLine
    star : OccultedStar

    Returns
    -------
    r, mu, mu_s, nu : float
    """
    r = sqrt(line.x * line.x + line.y * line.y + line.z * line.z)
    mu = (line.x * line.u + line.y * line.v + line.z * line.w) / r
    mu_s = (line.x * star.star_x + line.y * star.star_y + line.z * star.star_z) / r
    nu = line.u * star.star_x + line.v * star.star_y + line.w * star.star_z
    return r, min(max(mu, -1.0), 1.0), min(max(mu_s, -1.0), 1.0), min(max(nu, -1.0), 1.0)


@inlined
def split_at_umbra(line, shadow, edges, count):
    """Add panel edges where a line crosses cylinders around the shadow's axis.

    Parameters
    ----------
    line : EclipsedLine
    edges, count :
        Arguments of ``insert_edge``.

    Returns
    -------
    int
        Number of edges.
    """
    u, v = line.u, line.v
    across = u * u + v * v
    if across < 1e-12:
        return count
    a, b = line.x - shadow.axis / shadow.star.scale, line.y
    nearest = -(a * u + b * v) / across
    least = max(a * a + b * b - nearest * nearest * across, 0.0)
    for k in range(len(_CUTS) + 1):
        radius = shadow.umbra if k == 0 else _CUTS[k - 1] * shadow.middle
        if k == 1 and shadow.umbra > 0.5 * shadow.middle:
            continue
        radius /= shadow.star.scale
        if radius * radius > least:
            half = sqrt((radius * radius - least) / across)
            count = insert_edge(edges, count, nearest - half)
            count = insert_edge(edges, count, nearest + half)
    return count


@inlined
def visible_star_fraction(x, y, z, shadow, scratch):
    """Visible fraction of the star at a point, less the offset, to ``scratch.seen``. [1]

    Parameters
    ----------
    x, y, z : float
        Point in the frame of the shadow, optical. [m]
    """
    separation, size = apparent_discs(x, y, z, shadow.star)
    row, node, e, f = table_place(separation, size, shadow.star)
    for at in range(0, shadow.star.lanes, LANES):
        part = splat(1.0)
        if row == -2:
            part = splat(0.0)
        elif row >= 0:
            part = visible_fractions(row, node, e, f, shadow.star, at)
        store(scratch.seen, at, part - load(scratch.offset, at))


@inlined
def refracted_point(line, t, q, mu, angle):
    """Point of a refracted line, from the straight one. [m]

    Parameters
    ----------
    line : EclipsedLine
    t, q, mu, angle : float
        Distance, radius, zenith cosine and refraction angle as in ``panel_place``.
    """
    x, y, z = line.x + t * line.u, line.y + t * line.v, line.z + t * line.w
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    if angle == 0.0 or sine < 1e-9:
        return x, y, z
    keep, turn = cos(angle), sin(angle) * q / sine
    keep -= turn * mu / q
    return keep * x + turn * line.u, keep * y + turn * line.v, keep * z + turn * line.w


@compiled_loop
def march_eclipsed(line, kind, phase, eclipse, result):
    """Path radiance and transmittance of a segment, per irradiance of the unshadowed star.

    Parameters
    ----------
    line : EclipsedLine
    kind : int
        ``LOCAL_SHADOW``, ``SCATTERING_CORRECTION`` or ``TOTAL``. For the first, ``scratch.offset``
        is subtracted from the visible fraction of the star.
    phase : array, shape (nc, w)
        Phase functions. [sr⁻¹]
    eclipse : Eclipse
    result : array, shape (2, w)
        Receives path radiance [sr⁻¹] and transmittance [1].
    """
    tables, work, shadow, scratch = eclipse
    r, mu, mu_s, nu = start_cosines(line, shadow.star)
    count, rule, _ = place_panels(r, mu, mu_s, nu, line.length, tables, work)
    count = split_at_umbra(line, shadow, work.edges, count)
    n = int(tables.rules[rule])
    if kind != LOCAL_SHADOW:
        direction_functions(line.u, line.v, line.w, shadow, scratch)
    for at in range(0, tables.lanes, LANES):
        found = lane_view(result, at)
        found[0] = splat(0.0)
    reset_peaks(tables, work)
    for panel in range(count - 1):
        place_panel(r, mu, panel, count, rule, tables, work)
        panel_columns(rule, tables, work)
        for k in range(n):
            point = panel_place(k, n, r, mu, tables, work)
            _add_point(line, (r, mu_s, nu), point, kind, phase, eclipse, result)
    for c in range(tables.constituents):
        work.columns_total[c] = work.columns_so_far[c]
    for at in range(0, tables.lanes, LANES):
        found, sums = lane_view(result, at), lane_view(work.peaks, at)
        found[1] = transmittance_columns(
            work.columns_total, lane_view(tables.scaled_extinction, at), tables.constituents
        )
        if tables.broadened and kind != SCATTERING_CORRECTION:
            found[0] += peak_gain(line.half_sine, tables, work, at) * sums[0]


@inlined
def _add_point(line, start, point, kind, phase, eclipse, result):
    """Add the source of one point of a panel.

    Parameters
    ----------
    line, kind, phase, eclipse, result :
        Arguments of ``march_eclipsed``.
    start : tuple of float
        Radius of the start, and cosines of the star's zenith angle there and to the line.
    point : PanelPoint
        Point of the panel.
    """
    tables, work, shadow, scratch = eclipse
    star = shadow.star
    r, mu_s, nu = start
    q, t, mu_q, angle = point.q, point.t, point.mu, point.angle
    px, py, pz = refracted_point(line, t, q, mu_q, angle)
    mu_sq = min(max((px * star.star_x + py * star.star_y + pz * star.star_z) / q, -1.0), 1.0)
    # The line is rotated with its point: cosine to the star as in ``refraction.turned``.
    nu_q = nu
    if angle != 0.0:
        sine = sqrt(max((1.0 - mu_q) * (1.0 + mu_q), 1e-18))
        straight = min(max((r * mu_s + t * nu) / q, -1.0), 1.0)
        across = (nu - mu_q * straight) / sine
        nu_q = mu_q * mu_sq + sine * (cos(angle) * across - sin(angle) * straight)
    inside = kind != LOCAL_SHADOW and place_in_shadow(
        px, py, pz, q, tables.bottom, tables.top, shadow, scratch
    )
    seen, spread = 0.0, False
    if kind != SCATTERING_CORRECTION:
        visible_star_fraction(px, py, pz, shadow, scratch)
        seen, spread = star_columns(q, mu_sq, tables, work)
    if kind == SCATTERING_CORRECTION and not inside:
        return
    row, sun, f, e = field_place(q, mu_q, mu_sq, nu_q, tables, work)
    node = field_node(row, sun, np.float32(f), np.float32(e))
    terms = MarchTerms(True, False, False)
    for at in range(0, tables.lanes, LANES):
        found, extinction = lane_view(result, at), lane_view(tables.scaled_extinction, at)
        transmittance = transmittance_columns(
            work.depths, extinction, tables.constituents
        ) * np.float32(point.weight)
        source = splat(0.0)
        if kind != SCATTERING_CORRECTION:
            part = load(scratch.seen, at)
            source = multiple_scattering_at(node, tables, work, at) * part
            if seen > 0.0:
                arriving = transmittance * direct_beam(
                    seen,
                    work.columns_to_sun_low,
                    work.columns_to_sun_high,
                    spread,
                    extinction,
                    tables.constituents,
                )
                phases = lane_view(phase, at)
                add_star(part * arriving, terms, phases, tables, work, at, found)
                if tables.broadened:
                    add_peaks(arriving, part, spread, phases, tables, work, at)
        if inside:
            field = lane_view(tables.field, at)
            scale, mean = between(field, node, 0), between(field, node, 1)
            mean = maximum(mean / scale * work.functions[0], splat(0.0))
            source = source + mean * deviation(
                work.point_density,
                lane_view(tables.moments, at),
                tables.constituents,
                shadow,
                scratch,
                at,
            )
            if kind == TOTAL:
                source = maximum(source, splat(0.0))
        found[0] += transmittance * source


@compiled_loop
def eclipsed_ground_light(x, y, z, kind, eclipse):
    """Horizontal irradiance of the ground per that of the unshadowed star, to ``work.irradiance``.

    Parameters
    ----------
    x, y, z : float
        Point of the ground in the frame of the shadow, optical. [m]
    kind, eclipse :
        Arguments of ``march_eclipsed``; the workspace receives direct and diffuse irradiance [1].
    """
    tables, work, shadow, scratch = eclipse
    star = shadow.star
    q = sqrt(x * x + y * y + z * z)
    mu_s = min(max((x * star.star_x + y * star.star_y + z * star.star_z) / q, -1.0), 1.0)
    ground_light(mu_s, 2, tables, work)
    visible_star_fraction(x, y, z, shadow, scratch)
    inside = kind != LOCAL_SHADOW and place_in_shadow(
        x, y, z, tables.bottom, tables.bottom, tables.top, shadow, scratch
    )
    for at in range(0, tables.lanes, LANES):
        received, part = lane_view(work.irradiance, at), splat(0.0)
        if kind != SCATTERING_CORRECTION:
            part = load(scratch.seen, at)
        received[0] *= part
        if inside:
            part = part + sky_deviation(shadow, scratch, at)
            if kind == TOTAL:
                part = maximum(part, splat(0.0))
        received[1] *= part


@inlined
def end_on_ground(line, eclipse):
    """Point of the ground at the end of a line, and cosine of the zenith angle of reflection.

    Parameters
    ----------
    line, eclipse :
        Arguments of ``march_eclipsed``, after it: ``work.columns_total`` has those of the line.

    Returns
    -------
    px, py, pz : float
        Point in the frame of the shadow, optical. [m]
    mu_r : float
        Cosine. [1]
    """
    tables, work, shadow, _ = eclipse
    r, mu, _, _ = start_cosines(line, shadow.star)
    slant = min(max((r * mu + line.length) / tables.bottom, -1.0), 1.0)
    angle = 0.0
    if tables.refraction_strength > 0.0:
        angle = refraction_angle(
            r, mu, tables.refraction_strength, work.columns_total[tables.constituents - 1]
        )
    px, py, pz = refracted_point(line, line.length, tables.bottom, slant, angle)
    return px, py, pz, max(-slant, 0.0)


@inlined
def line_eclipsed(line, to_ground, kind, phase, eclipse, result):
    """Radiance of a whole line of sight, including the ground.

    Parameters
    ----------
    line, kind, phase, eclipse, result :
        Arguments of ``march_eclipsed``.
    to_ground : bool
        Whether the line ends on the ground.
    """
    march_eclipsed(line, kind, phase, eclipse, result)
    if to_ground:
        tables, work, shadow, _ = eclipse
        px, py, pz, mu_r = end_on_ground(line, eclipse)
        eclipsed_ground_light(px, py, pz, kind, eclipse)
        star = shadow.star
        mu_s = (px * star.star_x + py * star.star_y + pz * star.star_z) / tables.bottom
        nu = line.u * star.star_x + line.v * star.star_y + line.w * star.star_z
        for at in range(0, tables.lanes, LANES):
            received, found = lane_view(work.irradiance, at), lane_view(result, at)
            direct = received[0] * direct_reflectance(tables.ground, at, max(mu_s, 0.0), mu_r, nu)
            sky = received[1] * diffuse_reflectance(tables.ground, at, mu_r)
            found[0] += found[1] * (direct + sky) * INVERSE_PI

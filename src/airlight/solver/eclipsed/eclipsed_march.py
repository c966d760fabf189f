"""Ray march through a moon's shadow on the atmosphere.

The march is that of ``moments.march`` with three differences: direct irradiance at a point is
multiplied by the visible fraction of the star there; multiple scattering is that of the unshadowed
solution times the same fraction, plus the correction of ``ShadowTables``; and panels end at the
umbra. There is no symmetry about the star's vertical plane.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import Final

import numpy as np

from airlight.geometry.occulted_star import apparent_discs, table_place, visible_fractions
from airlight.geometry.path import insert_edge
from airlight.geometry.refraction import refraction_angle
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, lane_view, load, maximum, splat, store
from airlight.physics.optics.reflection import diffuse_reflectance, direct_reflectance
from airlight.solver.eclipsed.shadow_tables import (
    deviation,
    direction_functions,
    place_in_shadow,
    sky_deviation,
)
from airlight.solver.moments.forward_peak import add_peaks, peak_gain, reset_peaks
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march import field_place, multiple_scattering_at, star_columns
from airlight.solver.moments.march_panels import panel_columns, place_panel, place_panels
from airlight.solver.moments.source import (
    between,
    direct_beam,
    single_scattering_source,
    transmittance_columns,
)

#: Component of the radiance: with the local shadow, correction of multiple scattering, or both.
LOCAL_SHADOW: Final = 0
SCATTERING_CORRECTION: Final = 1
TOTAL: Final = 2
#: Distances from the axis, in widths of the grid's middle, at which panels end.
_CUTS: Final = (1.0, 2.0, 5.0)


@inlined
def split_at_umbra(x, y, u, v, length, shadow, edges, count):
    """Add panel edges where a line crosses cylinders around the shadow's axis.

    Parameters
    ----------
    x, y, u, v : float
        Components normal to the axis: of the start, in the optical radius [m], and of the direction
        [1].
    length : float
        Length of the line. [m]
    edges, count :
        Arguments of ``insert_edge``.

    Returns
    -------
    int
        Number of edges.
    """
    across = u * u + v * v
    if across < 1e-12:
        return count
    a, b = x - shadow.axis / shadow.star.scale, y
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
def refracted_point(x, y, z, u, v, w, q, mu, angle):
    """Point of a refracted line, from that of the straight one. [m]

    Parameters
    ----------
    x, y, z : float
        Point of the straight line. [m]
    u, v, w : float
        Direction of the straight line. [1]
    q, mu : float
        Radius of the point [m], and cosine of the line's zenith angle there [1].
    angle : float
        Refraction angle up to the point. [rad]
    """
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    if angle == 0.0 or sine < 1e-9:
        return x, y, z
    keep, turn = cos(angle), sin(angle) * q / sine
    keep -= turn * mu / q
    return keep * x + turn * u, keep * y + turn * v, keep * z + turn * w


@compiled_loop
def march_eclipsed(
    x, y, z, u, v, w, half_sine, length, kind, phase, tables, shadow, work, scratch, result
):  # fmt: skip
    """Path radiance and transmittance of a segment, per irradiance of the unshadowed star.

    Parameters
    ----------
    x, y, z : float
        Start in the frame of the shadow, in the optical radius. [m]
    u, v, w : float
        Direction. [1]
    half_sine : float
        sin(θ/2) of the angle to the apparent star, for which the phase functions are given. [1]
    length : float
        Length, to the ground or to the top. [m]
    kind : int
        ``LOCAL_SHADOW``, ``SCATTERING_CORRECTION`` or ``TOTAL``. For the first, ``scratch.offset``
        is subtracted from the visible fraction of the star.
    phase : array, shape (nc, w)
        Phase functions. [sr⁻¹]
    tables, work : MarchTables, MarchWorkspace
        Tables of the unshadowed solution; workspace, whose totals receive the columns of the
        segment [m].
    shadow, scratch : ShadowTables, ShadowWorkspace
        Shadow, and its workspace.
    result : array, shape (2, w)
        Receives path radiance [sr⁻¹] and transmittance [1].
    """
    r = sqrt(x * x + y * y + z * z)
    star = shadow.star
    mu = min(max((x * u + y * v + z * w) / r, -1.0), 1.0)
    mu_s = min(max((x * star.star_x + y * star.star_y + z * star.star_z) / r, -1.0), 1.0)
    nu = min(max(u * star.star_x + v * star.star_y + w * star.star_z, -1.0), 1.0)
    count, rule, _ = place_panels(r, mu, mu_s, nu, length, tables, work)
    count = split_at_umbra(x, y, u, v, length, shadow, work.edges, count)
    n = int(tables.rules[rule])
    if kind != LOCAL_SHADOW:
        direction_functions(u, v, w, shadow, scratch)
    for c in range(tables.constituents):
        work.columns_so_far[c] = 0.0
    for at in range(0, tables.lanes, LANES):
        found = lane_view(result, at)
        found[0] = splat(0.0)
    reset_peaks(tables, work)
    for panel in range(count - 1):
        place_panel(r, mu, panel, count, rule, tables, work)
        panel_columns(rule, tables, work)
        for k in range(n):
            _add_point(
                x, y, z, u, v, w, r, mu, mu_s, nu, k, n, kind, phase, tables, shadow, work, scratch,
                result,
            )  # fmt: skip
    for c in range(tables.constituents):
        work.columns_total[c] = work.columns_so_far[c]
    for at in range(0, tables.lanes, LANES):
        found, sums = lane_view(result, at), lane_view(work.peaks, at)
        found[1] = transmittance_columns(
            work.columns_total, lane_view(tables.scaled_extinction, at), tables.constituents
        )
        if tables.broadened and kind != SCATTERING_CORRECTION:
            found[0] += peak_gain(half_sine, tables, work, at) * sums[0]


@inlined
def _add_point(
    x, y, z, u, v, w, r, mu, mu_s, nu, k, n, kind, phase, tables, shadow, work, scratch, result
):  # fmt: skip
    """Add the source of one point of a panel; arguments as in ``march_eclipsed``."""
    q = min(max(work.radius[k], tables.bottom), tables.top)
    t = work.distance[k]
    star = shadow.star
    mu_q = min(max((r * mu + t) / q, -1.0), 1.0)
    for c in range(tables.constituents):
        work.point_density[c] = work.density[c * n + k]
        work.depths[c] = work.columns[c * n + k]
    angle = 0.0
    if tables.refraction_strength > 0.0:
        angle = refraction_angle(
            r, mu, tables.refraction_strength, work.columns[(tables.constituents - 1) * n + k]
        )
    px, py, pz = refracted_point(x + t * u, y + t * v, z + t * w, u, v, w, q, mu_q, angle)
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
    f, e = np.float32(f), np.float32(e)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    for at in range(0, tables.lanes, LANES):
        found, extinction = lane_view(result, at), lane_view(tables.scaled_extinction, at)
        transmittance = transmittance_columns(
            work.depths, extinction, tables.constituents
        ) * np.float32(work.weight[k])
        source, total = splat(0.0), found[0]
        if kind != SCATTERING_CORRECTION:
            part = load(scratch.seen, at)
            source = multiple_scattering_at(row, sun, f, e, tables, work, at) * part
            if seen > 0.0:
                arriving = transmittance * direct_beam(
                    seen, work.columns_to_sun_low, work.columns_to_sun_high, spread, extinction,
                    tables.constituents,
                )  # fmt: skip
                phases = lane_view(phase, at)
                total = total + part * arriving * single_scattering_source(
                    work.point_density,
                    lane_view(tables.scattering, at),
                    phases,
                    tables.constituents,
                )
                if tables.broadened:
                    add_peaks(arriving, part, spread, phases, tables, work, at)
        if inside:
            field = lane_view(tables.field, at)
            scale = between(field, row, sun, 0, g * h, g * e, f * h, f * e)
            mean = between(field, row, sun, 1, g * h, g * e, f * h, f * e)
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
        found[0] = total + transmittance * source


@compiled_loop
def eclipsed_ground_light(x, y, z, kind, tables, shadow, work, scratch):
    """Horizontal irradiance of the ground per that of the unshadowed star, to ``work.irradiance``.

    Parameters
    ----------
    x, y, z : float
        Point of the ground in the frame of the shadow, optical. [m]
    kind, tables, shadow, work, scratch :
        Arguments of ``march_eclipsed``; the workspace receives direct and diffuse irradiance [1].
    """
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
def end_on_ground(x, y, z, u, v, w, length, tables, work):
    """Point of the ground at the end of a line, and cosine of the zenith angle of reflection.

    Parameters
    ----------
    x, y, z, u, v, w, length, tables, work :
        Arguments of ``march_eclipsed``, after it: ``work.columns_total`` has those of the line.

    Returns
    -------
    px, py, pz : float
        Point in the frame of the shadow, optical. [m]
    mu_r : float
        Cosine. [1]
    """
    r = sqrt(x * x + y * y + z * z)
    mu = min(max((x * u + y * v + z * w) / r, -1.0), 1.0)
    slant = min(max((r * mu + length) / tables.bottom, -1.0), 1.0)
    angle = 0.0
    if tables.refraction_strength > 0.0:
        angle = refraction_angle(
            r, mu, tables.refraction_strength, work.columns_total[tables.constituents - 1]
        )
    px, py, pz = refracted_point(
        x + length * u, y + length * v, z + length * w, u, v, w, tables.bottom, slant, angle
    )
    return px, py, pz, max(-slant, 0.0)


@inlined
def line_eclipsed(
    x, y, z, u, v, w, half_sine, length, to_ground, kind, phase, tables, shadow, work, scratch,
    result,
):  # fmt: skip
    """Radiance of a whole line of sight, including the ground.

    Parameters
    ----------
    x, y, z, u, v, w, half_sine, length, kind, phase, tables, shadow, work, scratch, result :
        Arguments of ``march_eclipsed``.
    to_ground : bool
        Whether the line ends on the ground.
    """
    march_eclipsed(
        x, y, z, u, v, w, half_sine, length, kind, phase, tables, shadow, work, scratch, result
    )
    if to_ground:
        px, py, pz, mu_r = end_on_ground(x, y, z, u, v, w, length, tables, work)
        eclipsed_ground_light(px, py, pz, kind, tables, shadow, work, scratch)
        star = shadow.star
        mu_s = (px * star.star_x + py * star.star_y + pz * star.star_z) / tables.bottom
        nu = u * star.star_x + v * star.star_y + w * star.star_z
        for at in range(0, tables.lanes, LANES):
            received, found = lane_view(work.irradiance, at), lane_view(result, at)
            direct = received[0] * direct_reflectance(tables.ground, at, max(mu_s, 0.0), mu_r, nu)
            sky = received[1] * diffuse_reflectance(tables.ground, at, mu_r)
            found[0] += found[1] * (direct + sky) * INVERSE_PI

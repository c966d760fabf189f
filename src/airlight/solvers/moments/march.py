"""Radiance along a line of sight, from a solution's moments: for queries and pictures.

The line itself is integrated; nothing is ever the difference of two large numbers. Single
scattering of the star uses the exact phase function and the exact shadow; light scattered before
comes from the moments. All wavelengths are marched together: factors of geometry alone are computed
once per point.

Restricted Python, the same for CPU and GPU: Numba compiles it for all wavelengths, in groups
of eight lanes, and the emitter for a device, whose one group is a texel.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.geometry.bending import bend_angle, star_points, turned
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import LANES, load, splat, store
from airlight.optics.altitude_nodes import node_value
from airlight.solvers.moments.forward_peak import (
    add_peaks,
    peak_fraction,
    peak_gain,
    reset_peaks,
)
from airlight.solvers.moments.harmonics import POLARISED, directed_functions
from airlight.solvers.moments.march_panels import (
    is_transparent,
    panel_columns,
    place_panel,
    place_panels,
)
from airlight.solvers.moments.ray_optics import sun_index
from airlight.solvers.moments.source import (
    direct_beam,
    multiple_scattering_source,
    polarised_ratio_columns,
    polarised_scattering_source,
    single_scattering_source,
    transmittance_columns,
)
from airlight.solvers.stokes_frame import VERTICAL, star_plane
from airlight.tables.column_ratios import columns_to_top

#: By day, the light scattered before is left out at points that scatter less than this part of
#: their line, over the number of its points: less than that altogether. Where the air thins
#: exponentially it is some 2 % of that, however many points there are.
FAINT = 5e-3


@inlined
def march(
    r, mu, mu_s, nu, half_sine, length, orders, air, peaks, polarised, phase, phase_f12, light,
    work, result,
):  # fmt: skip
    """Light of a stretch of air towards its start, per irradiance of the star.

    Parameters
    ----------
    r, mu : float
        Radius of the start, inside the shell, and zenith cosine. [m], [1]
    mu_s, nu : float
        Cosines of the star's zenith angle at the start, and between line and star. [1]
    half_sine : float
        sin(θ/2) of the angle to the apparent star, for which the phase functions are given. [1]
    length : float
        Length, to the ground or to the top. [m]
    orders : int
        1: the star's light scattered once; 0: all other light; 2: both.
    air, peaks, polarised : bool
        Whether the air's radiance is found, single scattering by the peaked constituents, and Q and
        U of the air's light. Constants in a shader.
    phase, phase_f12 : array, shape (nc·w,)
        Phase functions, and elements F₁₂ of the phase matrices; 0 for constituents kept separate.
        [sr⁻¹]
    light, work : MarchTables, MarchWorkspace
        Tables of the solution; workspace, whose totals receive the columns of the stretch [m].
    result : array, shape (4·w,), or (6·w,) if ``polarised``
        Receives the air's radiance [sr⁻¹], its transmittance, with forward peaks counted as
        unscattered [1], the single scattering by the two peaked constituents, without their
        phase functions [1], and Q and U in the frame of ``stokes_frame``. [sr⁻¹]
    """
    turn_cosine, turn_sine = 1.0, 0.0
    if polarised:
        turn_cosine, turn_sine = star_plane(mu, mu_s, nu)
    count, rule, day = place_panels(r, mu, mu_s, nu, length, light, work)
    n = int(light.rules[rule])
    scatters = 0.0
    for c in range(light.constituents):
        scatters += light.brightest[c] * work.columns_total[c]
        work.columns_so_far[c] = 0.0
    faint = FAINT * min(scatters, 1.0) / (n * (count - 1)) if day else 0.0
    for at in range(0, light.lanes, LANES):
        store(result, at, splat(0.0))
        store(result, 2 * light.lanes + at, splat(0.0))
        store(result, 3 * light.lanes + at, splat(0.0))
        if polarised:
            store(result, 4 * light.lanes + at, splat(0.0))
            store(result, 5 * light.lanes + at, splat(0.0))
    reset_peaks(light, work)
    for panel in range(count - 1):
        points = n
        if light.hides > 0 and not is_transparent(light, work):
            points = 0
        place_panel(r, mu, panel, count, rule, light, work)
        panel_columns(rule, light, work)
        for k in range(points):
            add_point(
                r, mu, mu_s, nu, k, n, orders, air, peaks, polarised, faint, turn_cosine,
                turn_sine, phase, phase_f12, light, work, result,
            )  # fmt: skip
    for c in range(light.constituents):
        work.columns_total[c] = work.columns_so_far[c]
    for at in range(0, light.lanes, LANES):
        transmittance = transmittance_columns(
            work.columns_total, light.scaled_extinction, light.constituents, light.lanes, at
        )
        store(result, light.lanes + at, transmittance)
    if light.widened and orders != 0:
        widen(half_sine, air, peaks, light, work, result)


@inlined
def widen(half_sine, air, peaks, light, work, result):
    """Widen the forward peaks of a line's light scattered once; arguments as in ``march``."""
    for at in range(0, light.lanes, LANES):
        more = peak_gain(half_sine, light, work, at)
        if air:
            store(result, at, load(result, at) + more * load(work.peaks, at))
        if peaks and light.separated_1 >= 0:
            factor = np.float32(1.0) + more * peak_fraction(light.separated_1, light, at)
            store(result, 2 * light.lanes + at, load(result, 2 * light.lanes + at) * factor)
        if peaks and light.separated_2 >= 0:
            factor = np.float32(1.0) + more * peak_fraction(light.separated_2, light, at)
            store(result, 3 * light.lanes + at, load(result, 3 * light.lanes + at) * factor)


@inlined
def add_point(
    r, mu, mu_s, nu, k, n, orders, air, peaks, polarised, faint, turn_cosine, turn_sine, phase,
    phase_f12, light, work, result,
):  # fmt: skip
    """Add the light of one point of a panel to the result of a march.

    Parameters
    ----------
    r, mu, mu_s, nu, orders, air, peaks, polarised, phase, phase_f12, light, work, result :
        Arguments of ``march``.
    turn_cosine, turn_sine : float
        Results of ``star_plane``. [1]
    k, n : int
        Index of the point, and number of points of the panel.
    faint : float
        Light scattered before is left out if the point scatters less. [1]
    """
    q = min(max(work.radius[k], light.bottom), light.top)
    t = work.distance[k]
    mu_q = min(max((r * mu + t) / q, -1.0), 1.0)
    mu_sq = min(max((r * mu_s + t * nu) / q, -1.0), 1.0)
    nu_q = nu
    scatters = 0.0
    for c in range(light.constituents):
        work.point_density[c] = work.density[c * n + k]
        work.depths[c] = work.columns[c * n + k]
        scatters += light.brightest[c] * work.density[c * n + k]
    if light.bend > 0.0:
        angle = bend_angle(r, mu, light.bend, work.columns[(light.constituents - 1) * n + k])
        mu_sq, nu_q = turned(mu_q, mu_sq, nu, angle)
        mu_sq = min(max(mu_sq, -1.0), 1.0)
    seen, spread = 0.0, False
    if orders != 0:
        seen, spread = star_columns(q, mu_sq, light, work)
    gathers = air and orders != 1 and scatters * work.weight[k] >= faint
    near, block, f, e = 0, 0, 0.0, 0.0
    if air and gathers:
        near, block, f, e = field_place(q, mu_q, mu_sq, nu_q, light, work)
    for at in range(0, light.lanes, LANES):
        transmittance = transmittance_columns(
            work.depths, light.scaled_extinction, light.constituents, light.lanes, at
        ) * np.float32(work.weight[k])
        polarised_ratio = splat(1.0)
        if polarised and orders != 1:
            polarised_ratio = polarised_ratio_columns(
                work.depths, light.polarised_phase, light.constituents, light.lanes, at
            )
        if seen > 0.0:
            star = transmittance * direct_beam(
                seen, work.columns_to_sun_low, work.columns_to_sun_high, spread,
                light.scaled_extinction, light.constituents, light.lanes, at,
            )  # fmt: skip
            add_star(star, air, peaks, phase, light, work, at, result)
            if light.widened:
                add_peaks(star, np.float32(1.0), spread, phase, light, work, at)
            if polarised:
                add_polarised_star(
                    polarised_ratio * star,
                    turn_cosine,
                    turn_sine,
                    phase_f12,
                    light,
                    work,
                    at,
                    result,
                )
        if air and gathers:
            source = transmittance * multiple_scattering_at(
                near, block, np.float32(f), np.float32(e), light, work, at
            )
            store(result, at, load(result, at) + source)
            if polarised:
                add_polarised_light(
                    polarised_ratio * transmittance, mu_q, near, block, np.float32(f),
                    np.float32(e), light, work, at, result,
                )  # fmt: skip


@inlined
def star_columns(q, mu_s, light, work):
    """Visible part of the star at a point, with the columns towards it in the workspace. [m]

    Parameters
    ----------
    q, mu_s : float
        Radius of the point [m]; cosine of the star's zenith angle there. [1]
    light, work : MarchTables, MarchWorkspace
        Arguments of ``march``; the workspace receives here and there.

    Returns
    -------
    seen : float
        Visible part, from ``star_points``. [1]
    spread : bool
        Whether two points represent the star.
    """
    bottom, top = light.bottom, light.top
    seen, low, high = star_points(q, mu_s, bottom, top, light.star_radius, light.lift)
    if seen > 0.0:
        columns_to_top(
            q,
            low,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_low,
        )
        if high > low:
            columns_to_top(
                q,
                high,
                bottom,
                top,
                light.first_nodes,
                light.column_rows,
                light.columns,
                work.columns_to_sun_high,
            )
    return seen, high > low


@inlined
def add_star(star, air, peaks, phase, light, work, at, result):
    """Add the star's light scattered once at a point, to the air's radiance and to the peaks.

    Parameters
    ----------
    star : lanes
        Irradiance by the star at the point, times its weight, as transmitted to the line's start.
        [m]
    air, peaks, phase, light, work, result :
        Arguments of ``march``.
    at : int
        Index of the first lane.
    """
    if air:
        once = star * single_scattering_source(
            work.point_density, light.scattering, phase, light.constituents, light.lanes, at
        )
        store(result, at, load(result, at) + once)
    if peaks and light.separated_1 >= 0:
        c = light.separated_1
        once = star * load(light.scattering, light.lanes * c + at) * work.point_density[c]
        store(result, 2 * light.lanes + at, load(result, 2 * light.lanes + at) + once)
    if peaks and light.separated_2 >= 0:
        c = light.separated_2
        once = star * load(light.scattering, light.lanes * c + at) * work.point_density[c]
        store(result, 3 * light.lanes + at, load(result, 3 * light.lanes + at) + once)


@inlined
def add_polarised_star(star, turn_cosine, turn_sine, phase_f12, light, work, at, result):
    """Add Q and U of the star's light scattered once at a point; arguments as in ``add_point``."""
    once = star * single_scattering_source(
        work.point_density, light.scattering, phase_f12, light.constituents, light.lanes, at
    )
    stokes_q, stokes_u = 4 * light.lanes + at, 5 * light.lanes + at
    store(result, stokes_q, load(result, stokes_q) + once * np.float32(turn_cosine))
    store(result, stokes_u, load(result, stokes_u) + once * np.float32(turn_sine))


@inlined
def add_polarised_light(transmittance, mu, near, block, f, e, light, work, at, result):
    """Add Q and U of the light scattered before, scattered once more into the line at a point.

    Parameters
    ----------
    transmittance : lanes
        Transmittance from the point times its weight. [m]
    mu : float
        Cosine of the line's zenith angle at the point. [1]
    near, block, f, e, light, work, at :
        Arguments of ``multiple_scattering_at``.
    result : array, shape (6·w,)
        Result of a march.
    """
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    stokes_q, stokes_u = polarised_scattering_source(
        work.point_density, light.polarised_phase, light.field, mu, work.azimuth[0], near,
        near + light.suns * block, block, g * h, g * e, f * h, f * e, light.degree,
        light.constituents, light.lanes, at,
    )  # fmt: skip
    store(
        result, 4 * light.lanes + at, load(result, 4 * light.lanes + at) + transmittance * stokes_q
    )
    store(
        result, 5 * light.lanes + at, load(result, 5 * light.lanes + at) + transmittance * stokes_u
    )


@kernel
def line_azimuth(mu, mu_s, nu):
    """Cosine of a line's azimuth from the star; that of a vertical line in ``stokes_frame``. [1]

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
def field_place(q, mu, mu_s, nu, light, work):
    """Position of a point in the field, with the harmonics of the line in the workspace.

    Parameters
    ----------
    q, mu, mu_s, nu : float
        Radius of the point [m]; cosines of the line's and of the star's zenith angle there, and
        between line and star. [1]
    light, work : MarchTables, MarchWorkspace
        Arguments of ``march``; the workspace receives functions and azimuth.

    Returns
    -------
    near, block : int
        Index of the first value of the node before the point in the field, and number of values of
        a node.
    f, e : float
        Fractions of the steps to the next radius and to the next sun. [1]
    """
    work.azimuth[0] = line_azimuth(mu, mu_s, nu)
    directed_functions(
        mu,
        work.azimuth[0],
        (light.degree, light.start, light.ahead, light.back),
        work.functions,
    )
    x = node_value(q, light.bottom, light.top, light.first_nodes, light.row)
    row = min(int(x), light.radii - 2)
    y = sun_index(mu_s, light.place)
    sun = min(int(y), light.suns - 2)
    # A node holds a factor and the harmonics.
    block = light.lanes * (1 + (light.degree + 1) * (light.degree + 2) // 2 + POLARISED)
    return (row * light.suns + sun) * block, block, x - row, y - sun


@inlined
def multiple_scattering_at(near, block, f, e, light, work, at):
    """Light scattered before, scattered once more into the line, from lane ``at`` on. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    near, block, f, e : int, int, float, float
        Results of ``field_place``; the fractions in single precision.
    light, work : MarchTables, MarchWorkspace
        Arguments of ``march``, after ``field_place``.
    at : int
        Index of the first lane.
    """
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    return multiple_scattering_source(
        work.point_density, light.moments, light.polarised_phase, light.field, work.functions, near,
        near + light.suns * block, block, g * h, g * e, f * h, f * e, light.degree,
        light.constituents, light.lanes, at,
    )  # fmt: skip

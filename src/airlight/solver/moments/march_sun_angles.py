"""Ray march of lines of sight for many sun angles at once.

Texels of a table with the same radius and view share a line. Its points, the columns up to them and
the harmonics of its direction do not depend on the sun angle, and are computed once for all sun
angles with the same panels. Points and results are those of ``march``: the loop over sun angles is
inside that over points, and sums over the degrees of an azimuthal order precede those over orders.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, lane_view, load, maximum, splat, store
from airlight.kernel.threads import run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.physics.optics.altitude_nodes import node_value
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.forward_peak import add_peaks, peak_fraction, peak_gain
from airlight.solver.moments.harmonics import (
    EVEN,
    legendre_functions,
)
from airlight.solver.moments.march import line_azimuth, star_columns
from airlight.solver.moments.march_panels import (
    panel_columns,
    panel_place,
    place_panel,
    place_panels,
    star_place,
)
from airlight.solver.moments.march_tables import new_workspace
from airlight.solver.moments.packing import pack
from airlight.solver.moments.ray_optics import sun_index
from airlight.solver.moments.source import direct_beam, transmittance_columns
from airlight.solver.moments.sun_angle_workspace import (
    new_sun_angle_workspace,
)

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Lines of sight in one block of work.
_BLOCK: Final = 4096


class SunAngles(NamedTuple):
    """Lines of sight in the order of ``LinesOfSight``, all of shape (n,).

    Attributes
    ----------
    r, mu, mu_s, nu, length : array
        Fields of ``LinesOfSight``.
    half_sine : array
        sin(θ/2) of the angle to the apparent star, for which the phase functions are given. [1]
    """

    r: FloatArray
    mu: FloatArray
    mu_s: FloatArray
    nu: FloatArray
    length: FloatArray
    half_sine: FloatArray


def scattering_by_constituent(
    solution: MomentsSolution, lines: LinesOfSight, orders: int, *, delta_scaled: bool
) -> tuple[FloatArray, FloatArray]:
    """Path radiance, and single scattering by each constituent.

    Parameters
    ----------
    lines : LinesOfSight
        n lines of sight; neighbours with equal radius, view and length are marched together.
    orders : int
        As in ``MomentsSolution.radiance_per_irradiance``.
    delta_scaled : bool
        Whether single scattering is the solution's, with delta-M scaled extinction and broadened
        forward peaks; otherwise extinction and phase functions are unscaled.

    Returns
    -------
    light : array, shape (n, nl)
        Path radiance. [sr⁻¹]
    once : array, shape (n, nc, nl)
        Single scattering by each constituent, to be multiplied by its phase function. [1]
    """
    tables, geometry = solution.tables, solution.geometry
    lines = geometry.optical_lines(lines)
    seen = geometry.apparent_nu(lines)
    n, count, constituents = lines.r.size, solution.wavelengths.size, tables.constituents
    out, once = np.empty((n, count)), np.empty((n, constituents, count))
    half_sine = np.sqrt(np.maximum(0.5 * (1.0 - seen), 0.0))
    sights = SunAngles(lines.r, lines.mu, lines.mu_s, lines.nu, lines.length, half_sine)

    def run(index: int) -> None:
        rows = slice(index * _BLOCK, min((index + 1) * _BLOCK, n))
        phase = pack(geometry.medium.phase_function(seen[rows]))
        angles = SunAngles(*(values[rows] for values in sights))
        result = np.empty((len(phase), 1 + constituents, tables.lanes), np.float32)
        work, stars = new_workspace(tables), new_sun_angle_workspace(tables)
        _march_all(angles, orders, delta_scaled, phase, tables, work, stars, result)
        out[rows], once[rows] = result[:, 0, :count], result[:, 1:, :count]

    run_blocks(run, -(-n // _BLOCK))
    return out, once


@compiled_loop
def _march_all(angles, orders, delta_scaled, phase, tables, work, stars, out):
    angles, tables, work, stars = without_refcount((angles, tables, work, stars))
    r, mu, length = angles.r, angles.mu, angles.length
    has_unscaled = False
    if not delta_scaled:
        scaled, extinction = tables.scaled_extinction.reshape(-1), tables.extinction.reshape(-1)
        for k in range(scaled.size):
            has_unscaled = has_unscaled or scaled[k] != extinction[k]
    first = 0
    while first < r.size:
        last = first + 1
        while (
            last < r.size
            and last - first < stars.counts.size
            and r[last] == r[first]
            and mu[last] == mu[first]
            and length[last] == length[first]
        ):
            last += 1
        if length[first] > 0.0:
            light = orders, has_unscaled, delta_scaled
            _march_line(first, last, angles, light, phase, tables, work, stars, out)
        else:
            out[first:last] = 0.0
        first = last


@inlined
def _march_line(first, last, angles, light, phase, tables, work, stars, out):
    """March the line for the sun angles ``first`` to ``last``; arguments as in ``_march_all``."""
    count, r, mu = last - first, angles.r[first], angles.mu[first]
    orders, _, delta_scaled = light
    for index in range(count):
        star = first + index
        edges, rule, stars.faint[index] = place_panels(
            r, mu, angles.mu_s[star], angles.nu[star], angles.length[star], tables, work
        )
        stars.next[index], stars.counts[index], stars.rules[index] = 0, edges, rule
        for edge in range(edges):
            stars.edges[index, edge] = work.edges[edge]
        stars.columns_so_far[index] = 0.0
        stars.sums[index] = 0.0
    members = _next_panel(count, tables, stars)
    while members > 0:
        lead = stars.together[0]
        panel, edges, rule = stars.next[lead], stars.counts[lead], stars.rules[lead]
        for edge in range(edges):
            work.edges[edge] = stars.edges[lead, edge]
        for c in range(tables.constituents):
            work.columns_so_far[c] = stars.columns_so_far[lead, c]
        place_panel(r, mu, panel, edges, rule, tables, work)
        panel_columns(rule, tables, work)
        n = int(tables.rules[rule])
        for k in range(n):
            point = panel_place(k, n, r, mu, tables, work)
            _add_point(members, first, point, angles, light, phase, tables, work, stars)
        for member in range(members):
            index = stars.together[member]
            stars.next[index] += 1
            for c in range(tables.constituents):
                stars.columns_so_far[index, c] = work.columns_so_far[c]
        members = _next_panel(count, tables, stars)
    for index in range(count):
        star = first + index
        for at in range(0, tables.lanes, LANES):
            sums, peaks = lane_view(stars.sums, at), lane_view(work.peaks, at)
            result = lane_view(out, at)
            more = splat(0.0)
            if tables.broadened:
                for part in range(3):
                    peaks[part] = sums[index, 1 + part]
                more = peak_gain(angles.half_sine[star], tables, work, at)
            result[star, 0] = sums[index, 0]
            if tables.broadened and orders != 0:
                result[star, 0] += more * peaks[0]
            for c in range(tables.constituents):
                once = sums[index, 4 + c]
                if delta_scaled and tables.broadened:
                    once = once * (np.float32(1.0) + more * peak_fraction(c, tables, at))
                result[star, 1 + c] = once


@inlined
def _next_panel(count, tables, stars):
    """Nearest unmarched panel, and the sun angles that share it.

    Parameters
    ----------
    tables, stars : MarchTables, SunAngleWorkspace
        Tables of the solution; workspace, whose ``together`` receives the indices.

    Returns
    -------
    int
        Number of sun angles; 0 at the end of the line.
    """
    lead = -1
    for index in range(count):
        panel = stars.next[index]
        if panel < stars.counts[index] - 1 and (
            lead < 0 or stars.edges[index, panel] < stars.edges[lead, stars.next[lead]]
        ):
            lead = index
    if lead < 0:
        return 0
    start, end = stars.edges[lead, stars.next[lead]], stars.edges[lead, stars.next[lead] + 1]
    points = tables.rules[stars.rules[lead]]
    members = 0
    for index in range(lead, count):
        panel = stars.next[index]
        if (
            panel < stars.counts[index] - 1
            and stars.edges[index, panel] == start
            and stars.edges[index, panel + 1] == end
            and tables.rules[stars.rules[index]] == points
        ):
            stars.together[members] = index
            members += 1
    return members


@inlined
def _add_point(members, first, point, angles, light, phase, tables, work, stars):
    """Add the source of a ``PanelPoint`` to the sums of each sun angle."""
    constituents, r = tables.constituents, angles.r[first]
    q = point.q
    orders, has_unscaled, _ = light
    weight = np.float32(point.weight)
    for at in range(0, tables.lanes, LANES):
        extinction = lane_view(tables.scaled_extinction, at)
        transmittance = transmittance_columns(work.depths, extinction, constituents)
        store(stars.transmittance, at, transmittance * weight)
        if has_unscaled:
            extinction = lane_view(tables.extinction, at)
            transmittance = transmittance_columns(work.depths, extinction, constituents)
            store(stars.transmittance_once, at, transmittance * weight)
        scattering, element = lane_view(tables.scattering, at), lane_view(stars.scattering, at)
        for c in range(constituents):
            element[c] = scattering[c] * work.point_density[c]
    x = node_value(q, tables.bottom, tables.top, tables.first_nodes, tables.row)
    row = min(int(x), tables.radii - 2)
    f = np.float32(x - row)
    ready = False
    for member in range(members):
        index = stars.together[member]
        star = first + index
        mu_s, nu = angles.mu_s[star], angles.nu[star]
        mu_sq, nu_q = star_place(point, r, mu_s, nu, tables)
        seen, spread = star_columns(q, mu_sq, tables, work)
        if seen > 0.0:
            _add_star(seen, spread, index, light, phase[star], tables, work, stars)
        gathers = orders != 1 and point.scatters >= stars.faint[index]
        if gathers:
            if not ready:
                _place_direction(point.mu, tables, work, stars)
                ready = True
            y = sun_index(mu_sq, tables.place)
            sun = min(int(y), tables.sun_angles - 2)
            if not (stars.made[sun] and stars.made[sun + 1]):
                _add_degrees(row, sun, f, tables, stars)
            _add_multiple_scattering(
                sun, np.float32(y - sun), line_azimuth(point.mu, mu_sq, nu_q), index, tables, stars
            )


@inlined
def _add_star(seen, spread, index, light, phase, tables, work, stars):
    """Add single scattering at a point to the sums of a sun angle."""
    constituents = tables.constituents
    orders, has_unscaled, _ = light
    for at in range(0, tables.lanes, LANES):
        sums, peaks = lane_view(stars.sums, at), lane_view(work.peaks, at)
        scattering, phases = lane_view(stars.scattering, at), lane_view(phase, at)
        star = load(stars.transmittance, at) * direct_beam(
            seen,
            work.columns_to_sun_low,
            work.columns_to_sun_high,
            spread,
            lane_view(tables.scaled_extinction, at),
            constituents,
        )
        if orders != 0:
            source = splat(0.0)
            for c in range(constituents):
                source = source + scattering[c] * phases[c]
            sums[index, 0] += star * source
        if tables.broadened:
            for part in range(3):
                peaks[part] = sums[index, 1 + part]
            add_peaks(star, np.float32(1.0), spread, phases, tables, work, at)
            for part in range(3):
                sums[index, 1 + part] = peaks[part]
        if has_unscaled:
            star = load(stars.transmittance_once, at) * direct_beam(
                seen,
                work.columns_to_sun_low,
                work.columns_to_sun_high,
                spread,
                lane_view(tables.extinction, at),
                constituents,
            )
        for c in range(constituents):
            sums[index, 4 + c] += star * scattering[c]


@inlined
def _place_direction(mu, tables, work, stars):
    """Set the factors of a new point: Legendre functions of the ray times scattering moments."""
    degree = tables.degree
    terms = (degree, tables.start, tables.ahead, tables.back)
    legendre_functions(mu, terms, work.functions)
    for node in range(tables.sun_angles):
        stars.made[node] = False
    for at in range(0, tables.lanes, LANES):
        moments, polarised_moments = (
            lane_view(tables.moments, at),
            lane_view(tables.polarised_moments, at),
        )
        factors = lane_view(stars.factors, at)
        for l in range(degree + 1):
            strength = splat(0.0)
            for c in range(tables.constituents):
                strength = strength + moments[c, l] * work.point_density[c]
            for index in range(l * (l + 1) // 2, (l + 1) * (l + 2) // 2):
                factors[index] = strength * work.functions[index]
        beta_1 = splat(0.0)
        for c in range(tables.constituents):
            beta_1 = beta_1 + polarised_moments[c, 0] * work.point_density[c]
        last = (degree + 1) * (degree + 2) // 2
        for m in range(EVEN):
            factors[last + m] = beta_1 * work.functions[3 + m]


@inlined
def _add_degrees(row, sun, f, tables, stars):
    """Sum the field over degrees at two sun nodes, between two rows; f is the second's weight."""
    degree = tables.degree
    last = (degree + 1) * (degree + 2) // 2
    g = np.float32(1.0) - f
    for at in range(0, tables.lanes, LANES):
        factors, orders = lane_view(stars.factors, at), lane_view(stars.orders, at)
        field = lane_view(tables.field, at)
        for m in range(degree + 1):
            # Four independent sums.
            low, high, next_low, next_high = splat(0.0), splat(0.0), splat(0.0), splat(0.0)
            index = m * (m + 1) // 2 + m
            for l in range(m, degree + 1):
                factor = factors[index]
                low = low + factor * field[row, sun, 1 + index]
                high = high + factor * field[row + 1, sun, 1 + index]
                next_low = next_low + factor * field[row, sun + 1, 1 + index]
                next_high = next_high + factor * field[row + 1, sun + 1, 1 + index]
                index += l + 1
            if m < EVEN:
                factor = factors[last + m]
                low = low + factor * field[row, sun, 1 + last + m]
                high = high + factor * field[row + 1, sun, 1 + last + m]
                next_low = next_low + factor * field[row, sun + 1, 1 + last + m]
                next_high = next_high + factor * field[row + 1, sun + 1, 1 + last + m]
            orders[sun, m] = g * low + f * high
            orders[sun + 1, m] = g * next_low + f * next_high
        for node in range(sun, sun + 2):
            orders[node, degree + 1] = g * field[row, node, 0] + f * field[row + 1, node, 0]
    stars.made[sun] = True
    stars.made[sun + 1] = True


@inlined
def _add_multiple_scattering(sun, fraction, cosine, index, tables, stars):
    """Add multiple scattering at a point, between two sun nodes of the field, to a sum."""
    degree = tables.degree
    e = np.float32(fraction)
    h = np.float32(1.0) - e
    for at in range(0, tables.lanes, LANES):
        orders, sums = lane_view(stars.orders, at), lane_view(stars.sums, at)
        source = splat(0.0)
        earlier, multiple = cosine, 1.0  # cos (m - 1)φ and cos mφ
        for m in range(degree + 1):
            part = h * orders[sun, m] + e * orders[sun + 1, m]
            source = source + part * np.float32(multiple)
            earlier, multiple = multiple, 2.0 * cosine * multiple - earlier
        scale = h * orders[sun, degree + 1] + e * orders[sun + 1, degree + 1]
        # The truncated expansion may be negative where radiance nearly vanishes.
        sums[index, 0] += maximum(source / scale, 0.0) * load(stars.transmittance, at)

r"""Single scattering, and direct light reflected by the ground, by adaptive quadrature.

For a constituent i with relative density ρ_i

.. math:: S_i = \int_0^L \beta_i \rho_i(s)\, T(s)\, \langle T_\odot V_\odot \rangle(s)\, ds

and the radiance is Σ_i p_i(ν) S_i (Chandrasekhar 1960, Radiative Transfer, §7). Brackets are means
over the star's disc, see ``star_light``. Panels are bisected until each agrees with its halves to
1e-6 of the total; the remaining error is below 1e-5, and below 1e-4 where the direct beam grazes
the ground.
"""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import (
    MAX_EDGES,
    insert_edge,
    place_edges,
    place_nodes,
    ray_length,
    shadow_edges,
)
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import radius_along
from airlight.geometry.sun_disc import star_elevation
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.physics.optics.density_profile import relative_density
from airlight.physics.optics.reflection import cos_reflected, direct_reflectances
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.refracted_geometry import require_no_refraction
from airlight.solver.star_light import (
    PANELS,
    direct_irradiance,
    new_workspace,
    shell_optics,
    star_light,
    star_rules,
)
from airlight.solver.tables.columns import split_at_profile_edges

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Points per panel along the line of sight, and initial panels per leg.
_NODES: Final = 12
_PANELS: Final = 3
#: Largest difference between a panel and its halves, relative to the whole integral. [1]
_TOLERANCE: Final = 1e-6
#: Largest number of bisections of a panel.
_DEEPEST: Final = 12
#: Lines of sight per block of work.
_BLOCK: Final = 8


@compiled_loop
def _panel(ends, before, ray, rule, optics, workspace, scratch, column, out):
    """Contribution of a panel to ∫ ρ_i T <T V> ds, shape (nc, nl), and its columns, (nc,)."""
    r, mu, mu_s, nu = ray
    start, end = ends
    points, along, light = scratch
    nodes, weights, running = rule
    shell, _, density, extinction, _ = optics
    density_edges, coefficients, _ = density
    width = end - start
    n, constituents = nodes.size, column.size
    for k in range(n):
        altitude = radius_along(r, mu, start + width * nodes[k]) - shell[0]
        for i in range(constituents):
            points[i, k] = relative_density(altitude, density_edges[i], coefficients[i])
    for i in range(constituents):
        column[i] = 0.0
        for k in range(n):
            column[i] += width * weights[k] * points[i, k]
    out[:] = 0.0
    for k in range(n):
        s = start + width * nodes[k]
        q = radius_along(r, mu, s)
        mu_s_point = min(max((r * mu_s + s * nu) / q, -1.0), 1.0)
        if not star_light(q, mu_s_point, False, optics, workspace, light):
            continue
        for i in range(constituents):
            so_far = 0.0
            for j in range(n):
                so_far += running[k, j] * points[i, j]
            along[i] = before[i] + width * max(so_far, 0.0)
        for w in range(light.size):
            depth = 0.0
            for i in range(constituents):
                depth += along[i] * extinction[i, w]
            bright = width * weights[k] * exp(-depth) * light[w]
            for i in range(constituents):
                out[i, w] += points[i, k] * bright


@compiled_loop
def _cut_at_shadow(r, mu, mu_s, nu, bottom, star_radius, edges, count):
    """Add panel edges where the star begins to set, half sets and has set."""
    first, second = shadow_edges(r, mu, mu_s, nu, bottom)
    count = insert_edge(edges, count, first)
    count = insert_edge(edges, count, second)
    if star_radius <= 0.0:
        return count
    length = edges[count - 1]
    samples = 64
    for sign in range(2):
        level = star_radius if sign == 0 else -star_radius
        before = 0.0
        for k in range(samples + 3):
            s = length * k / samples
            if k > samples:  # a shadow that is crossed within one step
                s = first if k == samples + 1 else second
                if not 0.0 < s < length:
                    continue
            q = radius_along(r, mu, s)
            mu_s_point = min(max((r * mu_s + s * nu) / q, -1.0), 1.0)
            value = star_elevation(q, mu_s_point, bottom) - level
            if 0 < k <= samples and (value > 0.0) != (before > 0.0):
                low, high = length * (k - 1) / samples, s
                for _ in range(40):
                    middle = 0.5 * (low + high)
                    q = radius_along(r, mu, middle)
                    mu_s_point = min(max((r * mu_s + middle * nu) / q, -1.0), 1.0)
                    if (star_elevation(q, mu_s_point, bottom) - level > 0.0) == (before > 0.0):
                        low = middle
                    else:
                        high = middle
                count = insert_edge(edges, count, 0.5 * (low + high))
            before = value
    return count


@compiled_loop
def _scattered(lines, rule, optics, workspace, out):
    shell, star_radius, density, extinction, _ = optics
    all_r, all_mu, all_mu_s, all_nu, lengths = lines
    constituents, wavelengths = extinction.shape
    n = rule[0].size
    scratch = (np.empty((constituents, n)), np.empty(constituents), np.empty(wavelengths))
    edges = np.empty(MAX_EDGES)
    stack = np.empty((_DEEPEST + 2, 2))
    levels = np.empty(_DEEPEST + 2, np.int64)
    wholes = np.empty((_DEEPEST + 2, constituents, wavelengths))
    left, right = np.empty((constituents, wavelengths)), np.empty((constituents, wavelengths))
    before, middle_before = np.empty(constituents), np.empty(constituents)
    left_column, right_column = np.empty(constituents), np.empty(constituents)
    base = np.empty((MAX_EDGES, constituents, wavelengths))
    for ray_at in range(all_r.size):
        r, mu = all_r[ray_at], all_mu[ray_at]
        ray = (r, mu, all_mu_s[ray_at], all_nu[ray_at])
        whole = out[ray_at]
        whole[:] = 0.0
        if lengths[ray_at] <= 0.0:
            continue
        count = place_edges(r, mu, lengths[ray_at], _PANELS, 0.0, 0.0, edges)
        count = _cut_at_shadow(
            r, mu, all_mu_s[ray_at], all_nu[ray_at], shell[0], star_radius, edges, count
        )
        count = split_at_profile_edges(r, mu, shell[0], density[2], edges, count)
        before[:] = 0.0
        for panel in range(count - 1):
            ends = edges[panel], edges[panel + 1]
            _panel(ends, before, ray, rule, optics, workspace, scratch, left_column, base[panel])
            before += left_column
            whole += base[panel]
        allowed = _TOLERANCE * whole
        whole[:] = 0.0
        before[:] = 0.0
        for panel in range(count - 1):
            stack[0, 0], stack[0, 1] = edges[panel], edges[panel + 1]
            levels[0] = 0
            wholes[0] = base[panel]
            top = 0
            while top >= 0:
                start, end, level = stack[top, 0], stack[top, 1], levels[top]
                middle = 0.5 * (start + end)
                half = start, middle
                _panel(half, before, ray, rule, optics, workspace, scratch, left_column, left)
                middle_before[:] = before + left_column
                half = middle, end
                _panel(
                    half, middle_before, ray, rule, optics, workspace, scratch, right_column, right
                )
                good = True
                for i in range(constituents):
                    for w in range(wavelengths):
                        change = abs(left[i, w] + right[i, w] - wholes[top, i, w])
                        # A first estimate may have missed all the light, so its halves check it.
                        most = max(allowed[i, w], _TOLERANCE * whole[i, w])
                        good = good and change <= most
                if good or level >= _DEEPEST:
                    whole += left + right
                    before[:] = middle_before + right_column
                    top -= 1
                    continue
                stack[top, 0], stack[top, 1], levels[top] = middle, end, level + 1
                wholes[top] = right
                top += 1
                stack[top, 0], stack[top, 1], levels[top] = start, middle, level + 1
                wholes[top] = left


def single_scattering(
    medium: Medium,
    lines: LinesOfSight,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> FloatArray:
    """Single scattering by each constituent, without its phase function.

    Returns
    -------
    array, shape (n, nc, nl)
        ∫ scattering_i ρ_i T <T_sun V_sun> ds per irradiance of the star: factor of the phase
        function p_i(ν) in the radiance. [1]
    """
    require_no_refraction(medium, "single scattering by quadrature")
    constituents, wavelengths = medium.scattering.shape
    out = np.zeros((lines.r.size, constituents, wavelengths))
    arrays = (lines.r, lines.mu, lines.mu_s, lines.nu, lines.length)
    rule, optics = gauss_legendre(_NODES).as_tuple(), shell_optics(medium)

    def run(index: int) -> None:
        rows = slice(index * _BLOCK, (index + 1) * _BLOCK)
        _scattered(
            tuple(np.ascontiguousarray(one[rows]) for one in arrays),
            rule,
            optics,
            new_workspace(),
            out[rows],
        )

    run_blocks(
        run,
        -(-lines.r.size // _BLOCK),
        cancel=cancel,
        progress=progress,
        message="single scattering",
    )
    return np.asarray(out * medium.scattering)


@compiled_loop
def _ground_columns(all_r, all_mu, shell, density, rule, workspace, out):
    """Columns along lines of sight to the ground, integrated upwards."""
    edges, distance, radius, weight = workspace
    bottom, top = shell
    for k in range(all_r.size):
        r, mu = all_r[k], all_mu[k]
        length = ray_length(r, mu, bottom, top)
        # Upwards, points are dense where the atmosphere is.
        up = -(length + r * mu) / bottom
        count = place_edges(bottom, up, length, PANELS, 0.0, 0.0, edges)
        count = split_at_profile_edges(bottom, up, bottom, density[2], edges, count)
        points = place_nodes(bottom, up, edges, count, rule[0], rule[1], distance, radius, weight)
        for i in range(out.shape[1]):
            total = 0.0
            for at in range(points):
                total += weight[at] * relative_density(
                    radius[at] - bottom, density[0][i], density[1][i]
                )
            out[k, i] = total


def reflected_once(medium: Medium, lines: LinesOfSight) -> FloatArray:
    """Direct light reflected by the ground and transmitted to the observer.

    Parameters
    ----------
    medium : Medium
        Medium with the planet's ground, of its mean albedo.

    Returns
    -------
    array, shape (n, nl)
        Radiance per irradiance of the star: albedo/π T E_direct; 0 where the line does not end
        on the ground. [sr⁻¹]
    """
    out = np.zeros((lines.r.size, medium.wavelengths.size))
    hits = np.flatnonzero(lines.to_ground)
    if hits.size == 0:
        return out
    bottom = medium.bottom_radius
    r, mu, length = lines.r[hits], lines.mu[hits], lines.length[hits]
    column = np.empty((hits.size, medium.extinction.shape[0]))
    _ground_columns(
        r,
        mu,
        (bottom, medium.top_radius),
        medium.density.arrays,
        star_rules()[0],
        new_workspace(),
        column,
    )
    mu_s = np.clip((r * lines.mu_s[hits] + length * lines.nu[hits]) / bottom, -1.0, 1.0)
    direct = direct_irradiance(medium, np.full(hits.size, bottom), mu_s)
    factor = np.empty_like(direct)
    mu_r = vectorized(cos_reflected)(r, mu, bottom)
    direct_reflectances(medium.ground, mu_s, mu_r, lines.nu[hits], factor)
    out[hits] = factor / np.pi * np.exp(-(column @ medium.extinction)) * direct
    return out

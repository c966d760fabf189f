"""One sweep: from the moments of the light to those of the light scattered once more.

For each radius and each direction the radiance is a sum over the points of a ray, and the point's
source is a sum over the moments there. The factors of the ray alone, the Legendre functions and
the interpolation in radius, are contracted first, so that the inner loop over sun elevations and
azimuths only adds up N + 1 cosines. Eight wavelengths run in the lanes of one register.

Between grid nodes the moments are interpolated as ratios: with s = 1/sqrt(M_00) at each node, the
value is lerp(M·s)/lerp(s). It is exact at the nodes and, for M falling exponentially, at the
middle between them, and M_00 stays positive, which linear interpolation does not ensure in the
twilight, where M falls e-fold within a degree.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import (
    INVERSE_PI,
    LANES,
    exponential,
    folded,
    load,
    pair,
    splat,
    store,
)
from airlight.optics.reflection import Reflection, sky_factor
from airlight.solvers.moments.grid import radius_index
from airlight.solvers.moments.harmonics import (
    ELEMENTS,
    EVEN,
    POLARISED,
    legendre_functions,
    polarised_functions,
)
from airlight.solvers.moments.sent_light import (
    contracted,
    coupled_moments,
    first_register,
    odd_moment,
    sent_by_point,
)
from airlight.solvers.moments.star_places import place_stars

Float32Array = NDArray[np.float32]


class Air(NamedTuple):
    """Optics of eight wavelengths, flat, wavelengths in the lanes.

    Attributes
    ----------
    extinction : array, shape (nc·8,)
        Extinction after the removal of forward peaks. [m⁻¹]
    moments : array, shape (nc·(N + 1)·8,)
        Scattering coefficient times Legendre moment, both after that removal. [m⁻¹]
    ground : Reflection
        Reflection by the ground.
    star_radius : float
        Angular radius of the star. [rad]
    polarising : array, shape (nc·4·8,)
        Scattering coefficient times the elements of degree 2 that couple moments and even polarised
        moments, and that keep even and odd ones; by how much less Q and U are dimmed than I; see
        ``reduced_optics``. [m⁻¹]
    """

    extinction: Float32Array
    moments: Float32Array
    ground: Reflection
    star_radius: float
    polarising: Float32Array


class Azimuths(NamedTuple):
    """Midpoints of even steps of azimuth over half a turn.

    Attributes
    ----------
    cosines : array, shape (b,)
        cos φ. [1]
    multiples : array, shape (N + 1, b)
        cos mφ times the weight 2π/b in ∫ dφ over a whole turn. [rad]
    sines : array, shape (3, b)
        sin mφ times that weight. [rad]
    """

    cosines: NDArray[np.float64]
    multiples: Float32Array
    sines: Float32Array


@inlined
def sun_index(mu_s, place):
    """Fractional index of a sun cosine in the grid."""
    x = (mu_s + 1.0) * (0.5 * (place.size - 1))
    k = min(max(int(x), 0), place.size - 2)
    return place[k] + (place[k + 1] - place[k]) * (x - k)


@inlined
def optical_depth(columns, first, extinction, constituents):
    """Σ extinction·column of eight wavelengths; ``columns[first:]`` holds one row. [1]"""
    tau = splat(0.0)
    for c in range(constituents):
        tau = tau + load(extinction, LANES * c) * np.float32(columns[first + c])
    return tau


@inlined
def onward_light(columns, first, polarising, constituents):
    """Transmittance of Q and U over that of I, of eight wavelengths. [1]

    ``columns[first:]`` holds one row of columns; ``polarising`` of ``Air``.
    """
    more = splat(0.0)
    for c in range(constituents):
        more = more + load(polarising, LANES * (ELEMENTS * c + 3)) * np.float32(columns[first + c])
    return exponential(more)


@inlined
def strength_of(moments, amounts, point, l, degree, constituents):
    """Scattering by a point in one degree: Σ moments·amount of eight wavelengths. [1]"""
    strength = splat(0.0)
    for c in range(constituents):
        strength = strength + load(moments, LANES * (c * (degree + 1) + l)) * np.float32(
            amounts[point, c]
        )
    return strength


@inlined
def through_ray(extinction, totals, first, constituents):
    """Transmittance of a whole ray with the columns ``totals[first:]``. [1]"""
    return exponential(0.0 - optical_depth(totals, first, extinction, constituents))


@inlined
def leaving_at_end(ends, i, a, mu):
    """Cosine of the zenith angle at which a ray's light leaves the ground. [1]

    ``ends`` of ``Rays``. A star in the direction of the ray would be seen there at the opposite
    angle.
    """
    return max(0.0 - star_at_end(ends, i, a, mu, 1.0), 0.0)


@inlined
def star_at_end(ends, i, a, mu_s, nu):
    """Cosine of the star's zenith angle at the ground end of a ray; ``ends`` of ``Rays``. [1]"""
    return min(max(ends[i, a, 0] * mu_s + ends[i, a, 1] * nu, -1.0), 1.0)


@inlined
def sky_at(ground, mu_s, places, suns):
    """Irradiance of the ground by the light so far, from (s, E·s) per node. [1]"""
    x = sun_index(mu_s, places)
    column = min(int(x), suns - 2)
    f = np.float32(x - column)
    g = np.float32(1.0) - f
    low = column * 2 * LANES
    return (g * load(ground, low + LANES) + f * load(ground, low + 3 * LANES)) / (
        g * load(ground, low) + f * load(ground, low + 2 * LANES)
    )


@inlined
def star_from_ray(mu, mu_s, cosine):
    """Cosine between a ray and the star, from that of the azimuth between them. [1]"""
    sines = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0)) * sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    return min(max(mu * mu_s + sines * cosine, -1.0), 1.0)


@inlined
def project(moments_m, functions, weight, degree, base, out):
    """Add a ray's azimuth moments, times its Legendre functions, to the moments of a point."""
    for l in range(degree + 1):
        for m in range(l + 1):
            index = l * (l + 1) // 2 + m
            factor = np.float32(weight * functions[index])
            at = base + LANES * index
            store(out, at, load(out, at) + factor * load(moments_m, LANES * m))


@inlined
def project_polarised(azimuthal, mu, weight, base, out):
    """Add a ray's azimuth moments of Q and U to the polarised moments of a point.

    Parameters
    ----------
    azimuthal : array, shape (5·8,)
        Of Q with cos 0, cos φ and cos 2φ, of U with sin φ and sin 2φ.
    mu : float
        Cosine of the ray's zenith angle. [1]
    weight : float
        Weight of the ray in ∫ dmu. [1]
    base : int
        Index of the first polarised moment in ``out``, in lanes.
    """
    a0, a1, a2, b1, b2 = polarised_functions(mu)
    store(out, base, load(out, base) + np.float32(weight * a0) * load(azimuthal, 0))
    once = np.float32(weight * a1) * load(azimuthal, LANES)
    once = once + np.float32(weight * b1) * load(azimuthal, 3 * LANES)
    store(out, base + LANES, load(out, base + LANES) + once)
    twice = np.float32(weight * a2) * load(azimuthal, 2 * LANES)
    twice = twice + np.float32(weight * b2) * load(azimuthal, 4 * LANES)
    store(out, base + 2 * LANES, load(out, base + 2 * LANES) + twice)
    once = np.float32(weight * b1) * load(azimuthal, LANES)
    once = once + np.float32(weight * a1) * load(azimuthal, 3 * LANES)
    store(out, base + 3 * LANES, load(out, base + 3 * LANES) + once)
    twice = np.float32(weight * b2) * load(azimuthal, 2 * LANES)
    twice = twice + np.float32(weight * a2) * load(azimuthal, 4 * LANES)
    store(out, base + 4 * LANES, load(out, base + 4 * LANES) + twice)


@inlined
def add_polarised(azimuthal, multiples, sines, b, along, across):
    """Add Q and U of a ray at azimuth ``b`` to its azimuth moments; see ``project_polarised``."""
    for m in range(3):
        store(azimuthal, LANES * m, load(azimuthal, LANES * m) + multiples[m, b] * along)
    for m in range(1, 3):
        at = LANES * (2 + m)
        store(azimuthal, at, load(azimuthal, at) + sines[m, b] * across)


@inlined
def fill_rows(
    k, point, rays, air, expansion, grid, field, degree, functions, factors, rows, paired
):  # fmt: skip
    """Light that one point of a ray sends along it, under each sun, in ``rows``.

    Parameters
    ----------
    k, point : int
        Index of the point on its ray, and among all.
    rays, air, expansion, grid, field : arrays and tuples of ``sweep_radius``, borrowed
    degree : int
    functions, factors : array
        Workspace.
    rows : array
        Receives the nodes of ``sent_by_point``.
    paired : bool
        See ``first_register``; a constant.
    """
    extinction, moments, polarising = air
    ray_radii, mu_along, amounts, depths = rays
    bottom, top, levels, suns, rows_at = grid
    constituents = amounts.shape[1]
    orders, polar, sent = EVEN, POLARISED, POLARISED
    wide = degree + 1
    if paired:
        orders, polar, sent = 2, 4, 3
        wide = degree // 2 + 1
    terms = first_register(degree + 1, paired) + polar
    block = (1 + wide + sent) * LANES
    legendre_functions(mu_along[point], expansion, functions)
    through = exponential(0.0 - optical_depth(depths[point], 0, extinction, constituents))
    for l in range(degree + 1):
        strength = strength_of(moments, amounts, point, l, degree, constituents) * through
        index = l * (l + 1) // 2
        at = LANES * first_register(l, paired)
        if paired:
            for m in range(0, l, 2):
                both = pair(np.float32(functions[index + m]), np.float32(functions[index + m + 1]))
                store(factors, at + LANES // 2 * m, strength * both)
            if l % 2 == 0:
                both = pair(np.float32(functions[index + l]), np.float32(0.0))
                store(factors, at + LANES // 2 * l, strength * both)
        else:
            for m in range(l + 1):
                store(factors, at + LANES * m, strength * np.float32(functions[index + m]))
    last = ELEMENTS - 1
    coupling = through * strength_of(polarising, amounts, point, 0, last, constituents)
    keeping = through * strength_of(polarising, amounts, point, 1, last, constituents)
    turning = through * strength_of(polarising, amounts, point, 2, last, constituents)
    onward = onward_light(depths[point], 0, polarising, constituents)
    # The Legendre functions of degree 2.
    second_0, second_1, second_2 = functions[3], functions[4], functions[5]
    a0, a1, a2, b1, b2 = polarised_functions(mu_along[point])
    x = radius_index(ray_radii[point], bottom, top, rows_at)
    row = min(int(x), levels - 2)
    f = np.float32(x - row)
    g = np.float32(1.0) - f
    for j in range(suns):
        low = (row * suns + j) * (1 + terms) * LANES
        high = low + suns * (1 + terms) * LANES
        target = (k * suns + j) * block
        store(rows, target, g * load(field, low) + f * load(field, high))
        for m in range(wide):
            total = contracted(factors, 0, field, low, high, f, m, degree, paired)
            if m < orders:
                moment, here = coupled_moments(field, low, high, f, m, degree, paired)
                second = pair(np.float32(second_0), np.float32(second_1))
                even = pair(np.float32(a0), np.float32(a1))
                odd = pair(np.float32(0.0), np.float32(b1))
                if paired:
                    if m == 1:
                        second = pair(np.float32(second_2), np.float32(0.0))
                        even = pair(np.float32(a2), np.float32(0.0))
                        odd = pair(np.float32(b2), np.float32(0.0))
                else:
                    second, even, odd = splat(second_0), splat(a0), splat(0.0)
                    if m == 1:
                        second, even, odd = splat(second_1), splat(a1), splat(b1)
                    if m == 2:
                        second, even, odd = splat(second_2), splat(a2), splat(b2)
                total = total + coupling * here * second
                kept = onward * (coupling * moment + keeping * here)
                plane, slant = even * kept, odd * kept
                if paired or m > 0:
                    kept = onward * turning * odd_moment(field, low, high, f, m, degree, paired)
                    plane, slant = plane + odd * kept, slant + even * kept
                at = target + LANES * (1 + wide)
                store(rows, at + LANES * m, plane)
                if paired:  # U_1 in the second half, U_2 in the first
                    if m == 1:
                        slant = slant + load(rows, at + 2 * LANES)
                    store(rows, at + 2 * LANES, slant)
                elif m > 0:
                    store(rows, at + LANES * (EVEN - 1 + m), slant)
            store(rows, target + LANES * (1 + m), total)


@inlined
def _sweep(
    i, grid, rays, share, azimuths, air, expansion, field, ground, out, sky_out, paired
):  # fmt: skip
    """``sweep_radius``, or ``sweep_radius_of_few`` if ``paired``, a constant."""
    # Arrays are unpacked from their tuples once: in the loop each access would count references.
    bottom, top, radii, sun_cosines, rows_at, places = grid
    (
        all_mu,
        all_weights,
        all_flux,
        _,
        starts,
        totals,
        ends,
        ray_radii,
        mu_along,
        turns_along,
        amounts,
        depths,
    ) = rays
    cosines, multiples, sines = azimuths
    extinction, moments, surface, _, polarising = air
    suns = sun_cosines.size
    degree = multiples.shape[0] - 1
    turns = cosines.size
    harmonics = (degree + 1) * (degree + 2) // 2
    terms = harmonics + POLARISED
    constituents = totals.shape[2]
    angles = all_mu.shape[1]
    most = 1
    for a in range(angles):
        most = max(most, starts[i, a + 1] - starts[i, a])
    block = (degree + 2 + POLARISED) * LANES
    if paired:
        block = (degree // 2 + 5) * LANES
    rows = np.empty(most * suns * block, np.float32)
    functions = np.empty(harmonics)
    factors = np.empty(harmonics * LANES, np.float32)
    azimuthal = np.empty((degree + 1) * LANES, np.float32)
    polarised = np.empty(5 * LANES, np.float32)
    turned = np.empty(2 * most, np.float32)
    groups = -(-turns // LANES) * LANES
    around = np.empty(2 * groups, np.float32)
    for b in range(groups):
        cosine = cosines[min(b, turns - 1)]
        around[b] = np.float32(cosine)
        around[groups + b] = np.float32(sqrt((1.0 - cosine) * (1.0 + cosine)))
    table = np.empty(places.size, np.float32)
    for k in range(places.size):
        table[k] = np.float32(places[k])
    columns = np.empty(most * LANES, np.float32)
    shares = np.empty(most * LANES, np.float32)
    star_cosines = np.empty(most * LANES, np.float32)
    star_sines = np.empty(most * LANES, np.float32)
    along_rays = (ray_radii, mu_along, amounts, depths)
    optics = (extinction, moments, polarising)
    shell = (bottom, top, radii.size, suns, rows_at)
    out[:] = 0.0
    sky_out[:] = 0.0
    for a in range(angles):
        mu = all_mu[i, a]
        sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
        below = a < angles // 2
        first = starts[i, a]
        points = starts[i, a + 1] - first
        for k in range(points):
            fill_rows(
                k, first + k, along_rays, optics, expansion, shell, field, degree, functions,
                factors, rows, paired,
            )  # fmt: skip
            turned[2 * k] = np.float32(turns_along[first + k, 0] + turns_along[first + k, 1] * mu)
            turned[2 * k + 1] = np.float32(turns_along[first + k, 1] * sine)
        reflected = splat(0.0)
        if below:
            through = through_ray(extinction, totals[i, a], 0, constituents)
            factor = sky_factor(surface, 0, leaving_at_end(ends, i, a, mu))
            reflected = factor * INVERSE_PI * through
        legendre_functions(mu, expansion, functions)
        exact = load(share, LANES * (i * angles + a))
        for j in range(suns):
            mu_s = sun_cosines[j]
            sine_s = np.float32(sqrt((1.0 - mu_s) * (1.0 + mu_s)))
            azimuthal[:] = 0.0
            polarised[:] = 0.0
            for b in range(turns):
                lane = b % LANES
                if lane == 0:
                    place_stars(
                        turned, points, around, b, sine_s, np.float32(mu_s), table, suns, columns,
                        shares, star_cosines, star_sines,
                    )  # fmt: skip
                radiance, along, across = splat(0.0), splat(0.0), splat(0.0)
                for k in range(points):
                    at = LANES * k + lane
                    low = (k * suns + int(columns[at])) * block
                    light, plane, slant = sent_by_point(
                        rows, low, low + block, shares[at], star_cosines[at], star_sines[at],
                        degree, True, True, paired,
                    )  # fmt: skip
                    radiance = radiance + light
                    along = along + plane
                    across = across + slant
                if paired:
                    radiance, along, across = folded(radiance), folded(along), folded(across)
                radiance = exact * radiance
                add_polarised(polarised, multiples, sines, b, exact * along, exact * across)
                if below:
                    nu = star_from_ray(mu, mu_s, cosines[b])
                    mu_sg = star_at_end(ends, i, a, mu_s, nu)
                    radiance = radiance + reflected * sky_at(ground, mu_sg, places, suns)
                for m in range(degree + 1):
                    at = LANES * m
                    store(azimuthal, at, load(azimuthal, at) + multiples[m, b] * radiance)
            base = j * terms * LANES
            project(azimuthal, functions, all_weights[i, a], degree, base, out)
            base = base + harmonics * LANES
            project_polarised(polarised, mu, all_weights[i, a], base, out)
            if not below:
                at = LANES * j
                flux = np.float32(all_flux[i, a])
                store(sky_out, at, load(sky_out, at) + flux * load(azimuthal, 0))


@compiled_loop
def sweep_radius(i, grid, rays, share, azimuths, air, expansion, field, ground, out, sky_out):
    """Gather the light scattered once more at all sun elevations of one radius.

    Parameters
    ----------
    i : int
        Index of the radius.
    grid, rays, azimuths, air : Grid, Rays, Azimuths, Air
        Shell, its rays, and its optics.
    share : array, shape (r·a·8,)
        Factors from ``rays_in_sight``. [1]
    expansion : Harmonics
        Harmonics of the moments.
    field : array, shape (r·s·(1 + k)·8,)
        Moments so far, as (s, M·s) per node; see the head of this file.
    ground : array, shape (s·2·8,)
        Irradiance of the ground by the light so far, as (s, E·s) per node.
    out : array, shape (s·k·8,)
        Receives the moments at this radius.
    sky_out : array, shape (s·8,)
        Receives the irradiance of a level surface by the light from the upper half sphere.
    """
    _sweep(i, grid, rays, share, azimuths, air, expansion, field, ground, out, sky_out, False)


@compiled_loop
def sweep_radius_of_few(
    i, grid, rays, share, azimuths, air, expansion, field, ground, out, sky_out
):  # fmt: skip
    """``sweep_radius`` for at most four wavelengths, two moments in a register.

    Both halves of ``share`` and of ``air`` have the same wavelengths; ``field`` has pairs of
    moments, see ``packing.paired``.
    """
    _sweep(i, grid, rays, share, azimuths, air, expansion, field, ground, out, sky_out, True)

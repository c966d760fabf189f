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
from airlight.kernel.lanes import INVERSE_PI, LANES, exponential, load, splat, store
from airlight.optics.reflection import Reflection, sky_factor
from airlight.solvers.moments.grid import radius_index
from airlight.solvers.moments.harmonics import (
    POLARISED,
    legendre_functions,
    polarised_functions,
)

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
    polarising : array, shape (nc·2·8,)
        Scattering coefficient times the elements of degree 2 that couple moments and polarised
        moments, and polarised moments with each other; see ``reduced_optics``. [m⁻¹]
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
def strength_of(moments, amounts, point, l, degree, constituents):
    """Scattering by a point in one degree: Σ moments·amount of eight wavelengths. [1]"""
    strength = splat(0.0)
    for c in range(constituents):
        strength = strength + load(moments, LANES * (c * (degree + 1) + l)) * np.float32(
            amounts[point, c]
        )
    return strength


@inlined
def contracted(factors, first, field, low, high, f, m, degree):
    """Moments of one m, times the scattering by a point in each degree, between two radii.

    Parameters
    ----------
    factors : array
        Strength of each degree times Legendre function, (l, m) at l(l + 1)/2 + m from ``first`` on.
    first : int
        Index of the first factor, in lanes.
    field : array
        Field as in ``sweep_radius``.
    low, high : int
        Index of the nodes of the lower and the upper radius, in lanes.
    f : float32
        Weight of the upper radius. [1]
    m, degree : int
        Order of these moments, and highest degree.
    """
    g = np.float32(1.0) - f
    total = splat(0.0)
    for l in range(m, degree + 1):
        index = l * (l + 1) // 2 + m
        at = LANES * (1 + index)
        total = total + load(factors, first + LANES * index) * (
            g * load(field, low + at) + f * load(field, high + at)
        )
    return total


@inlined
def coupled_moments(field, low, high, f, m, degree):
    """Moments of degree 2 and order m that scattering couples, times s, between two radii.

    Results are that of the radiance and the polarised one; arguments as for ``contracted``.
    """
    g = np.float32(1.0) - f
    bright = LANES * (1 + POLARISED + m)
    at = LANES * (1 + (degree + 1) * (degree + 2) // 2 + m)
    return (
        g * load(field, low + bright) + f * load(field, high + bright),
        g * load(field, low + at) + f * load(field, high + at),
    )


@inlined
def star_from_point(turn, point, mu_s, nu):
    """Cosines of the star's zenith angle and between star and ray, at a point of a ray. [1]

    ``turn`` is that of ``Rays``; ``mu_s`` and ``nu`` belong to the start of the ray.
    """
    here = min(max(turn[point, 0] * mu_s + turn[point, 1] * nu, -1.0), 1.0)
    return here, turn[point, 2] * mu_s + turn[point, 3] * nu


@inlined
def azimuth_cosine(mu, mu_s, nu):
    """Cosine of the azimuth between a ray and the star, seen from a point of the ray. [1]"""
    spread = (1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s)
    return min(max((nu - mu * mu_s) / sqrt(max(spread, 1e-24)), -1.0), 1.0)


@inlined
def gathered(
    turn, mu_along, first, points, local, rows, mu_s, nu, places, suns, degree, bright, polarised
):
    """I, Q and U sent along a ray by its points, from light scattered before. [1]

    Parameters
    ----------
    turn, mu_along : array
        Arrays of ``Rays``.
    first, points : int
        Index of the ray's first point, and number of its points.
    local : int
        Index of the first of them in ``rows``.
    rows : array, shape (points·s·(5 + N)·8,)
        For each point and sun (s, A_0 s, … A_N s, e_0 s, e_1 s, e_2 s), A_m from ``contracted`` and
        e_m the polarised light of the point.
    mu_s, nu : float
        Cosines of the star at the start of the ray. [1]
    places : array
        Lookup table ``Grid.place``.
    suns, degree : int
        Number of sun elevations, and highest degree.
    bright, polarised : bool
        Whether I, and whether Q and U are found; constants. The others are 0.
    """
    block = (degree + 2 + POLARISED) * LANES
    radiance, along, across = splat(0.0), splat(0.0), splat(0.0)
    for k in range(points):
        mu_sk, nu_k = star_from_point(turn, first + k, mu_s, nu)
        x = sun_index(mu_sk, places)
        column = min(int(x), suns - 2)
        f = np.float32(x - column)
        g = np.float32(1.0) - f
        step = np.float32(azimuth_cosine(mu_along[first + k], mu_sk, nu_k))
        low = ((local + k) * suns + column) * block
        high = low + block
        scale = splat(1.0) / (g * load(rows, low) + f * load(rows, high))
        if bright:
            total = g * load(rows, low + LANES) + f * load(rows, high + LANES)
            before = np.float32(1.0)
            multiple = step
            for m in range(1, degree + 1):
                at = LANES * (1 + m)
                total = total + multiple * (g * load(rows, low + at) + f * load(rows, high + at))
                following = np.float32(2.0) * step * multiple - before
                before = multiple
                multiple = following
            radiance = radiance + total * scale
        if polarised:
            a0, a1, a2, b1, b2 = polarised_functions(mu_along[first + k])
            sine = sqrt(max((np.float32(1.0) - step) * (np.float32(1.0) + step), np.float32(0.0)))
            at = LANES * (2 + degree)
            even = g * load(rows, low + at) + f * load(rows, high + at)
            at = at + LANES
            once = g * load(rows, low + at) + f * load(rows, high + at)
            at = at + LANES
            twice = g * load(rows, low + at) + f * load(rows, high + at)
            double = np.float32(2.0) * step * step - np.float32(1.0)
            total = even * np.float32(a0) + once * np.float32(a1 * step)
            along = along + (total + twice * np.float32(a2 * double)) * scale
            total = once * np.float32(b1 * sine) + twice * np.float32(2.0 * b2 * sine * step)
            across = across + total * scale
    return radiance, along, across


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


@inlined
def add_polarised(azimuthal, multiples, sines, b, along, across):
    """Add Q and U of a ray at azimuth ``b`` to its azimuth moments; see ``project_polarised``."""
    for m in range(3):
        store(azimuthal, LANES * m, load(azimuthal, LANES * m) + multiples[m, b] * along)
    for m in range(1, 3):
        at = LANES * (2 + m)
        store(azimuthal, at, load(azimuthal, at) + sines[m, b] * across)


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
    most = 0
    for a in range(angles):
        most = max(most, starts[i, a + 1] - starts[i, a])
    block = (degree + 2 + POLARISED) * LANES
    rows = np.empty(max(most, 1) * suns * block, np.float32)
    functions = np.empty(harmonics)
    factors = np.empty(harmonics * LANES, np.float32)
    azimuthal = np.empty((degree + 1) * LANES, np.float32)
    polarised = np.empty(5 * LANES, np.float32)
    out[:] = 0.0
    sky_out[:] = 0.0
    for a in range(angles):
        mu = all_mu[i, a]
        below = a < angles // 2
        first = starts[i, a]
        points = starts[i, a + 1] - first
        for k in range(points):
            legendre_functions(mu_along[first + k], expansion, functions)
            through = exponential(
                0.0 - optical_depth(depths[first + k], 0, extinction, constituents)
            )
            for l in range(degree + 1):
                strength = strength_of(moments, amounts, first + k, l, degree, constituents)
                strength = strength * through
                for m in range(l + 1):
                    index = l * (l + 1) // 2 + m
                    store(factors, LANES * index, strength * np.float32(functions[index]))
            coupling = through * strength_of(polarising, amounts, first + k, 0, 1, constituents)
            keeping = through * strength_of(polarising, amounts, first + k, 1, 1, constituents)
            x = radius_index(ray_radii[first + k], bottom, top, rows_at)
            row = min(int(x), radii.size - 2)
            f = np.float32(x - row)
            g = np.float32(1.0) - f
            for j in range(suns):
                low = (row * suns + j) * (1 + terms) * LANES
                high = low + suns * (1 + terms) * LANES
                target = (k * suns + j) * block
                store(rows, target, g * load(field, low) + f * load(field, high))
                for m in range(degree + 1):
                    total = contracted(factors, 0, field, low, high, f, m, degree)
                    if m < POLARISED:
                        moment, here = coupled_moments(field, low, high, f, m, degree)
                        total = total + coupling * here * np.float32(functions[POLARISED + m])
                        at = target + LANES * (2 + degree + m)
                        store(rows, at, coupling * moment + keeping * here)
                    store(rows, target + LANES * (1 + m), total)
        reflected = splat(0.0)
        if below:
            through = through_ray(extinction, totals[i, a], 0, constituents)
            factor = sky_factor(surface, 0, leaving_at_end(ends, i, a, mu))
            reflected = factor * INVERSE_PI * through
        legendre_functions(mu, expansion, functions)
        exact = load(share, LANES * (i * angles + a))
        for j in range(suns):
            mu_s = sun_cosines[j]
            azimuthal[:] = 0.0
            polarised[:] = 0.0
            for b in range(turns):
                nu = star_from_ray(mu, mu_s, cosines[b])
                radiance, along, across = gathered(
                    turns_along, mu_along, first, points, 0, rows, mu_s, nu, places, suns, degree,
                    True, True,
                )  # fmt: skip
                radiance = exact * radiance
                add_polarised(polarised, multiples, sines, b, exact * along, exact * across)
                if below:
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

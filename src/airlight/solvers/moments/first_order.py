"""Light scattered once and sunlight reflected once: the start of the sweeps."""

from __future__ import annotations

from math import pi, sqrt
from typing import Final

import numpy as np

from airlight.geometry.bending import level_light, star_points
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, exponential, load, splat, store
from airlight.mappings.transmittance import altitude_coordinate, direction_coordinate
from airlight.optics.reflection import star_factor
from airlight.solvers.moments.harmonics import POLARISED, legendre_functions
from airlight.solvers.moments.sweep import (
    add_polarised,
    leaving_at_end,
    optical_depth,
    project,
    project_polarised,
    star_at_end,
    star_from_point,
    star_from_ray,
    through_ray,
)
from airlight.solvers.stokes_frame import star_plane

#: Phase function of isotropic scattering. [sr⁻¹]
ISOTROPIC: Final = 0.25 / pi
#: F₁₂ of degree 2 per (1 - ν²): 5/(4π) d²₀₂. [sr⁻¹]
_SECOND: Final = 5.0 * ISOTROPIC * sqrt(6.0) / 4.0


@inlined
def depth_towards(ratios, row, f, place, distance, extinction, constituents):
    """Optical depth from a point to the top of the shell, in a tabled direction. [1]

    Parameters
    ----------
    ratios : array, shape (radii, directions, nc, 2)
        Ratios of a ``ColumnTable``, from ``mean_density_ratios``.
    row, f : int, float
        Index of the radius below the point, and the point's fraction of the step above it.
    place : int
        Index of the direction.
    distance : float
        Distance to the top. [m]
    extinction : array, shape (nc·8,)
        Extinction coefficients. [m⁻¹]
    constituents : int
    """
    tau = splat(0.0)
    for c in range(constituents):
        scale = ratios[row, place, c, 0] * (1.0 - f) + ratios[row + 1, place, c, 0] * f
        scaled = ratios[row, place, c, 1] * (1.0 - f) + ratios[row + 1, place, c, 1] * f
        tau = tau + load(extinction, LANES * c) * np.float32(distance * scaled / scale)
    return tau


@inlined
def depth_in_row(ratios, q, place, bottom, top, extinction, constituents):
    """``depth_towards`` from a radius q; the directions are even in the distance to the top. [1]"""
    x = altitude_coordinate(q, bottom, top)
    row = min(int(x * (ratios.shape[0] - 1)), ratios.shape[0] - 2)
    f = x * (ratios.shape[0] - 1) - row
    shortest = top - q
    longest = (1.0 + x) * sqrt((top - bottom) * (top + bottom))
    distance = shortest + place * ((longest - shortest) / (ratios.shape[1] - 1))
    return depth_towards(ratios, row, f, place, distance, extinction, constituents)


@inlined
def through_row(depths, local, x, directions):
    """Transmittance of eight wavelengths between the directions of one row. [1]"""
    place = min(int(x), directions - 2)
    f = np.float32(x - place)
    at = LANES * (local * directions + place)
    return exponential(
        0.0 - ((np.float32(1.0) - f) * load(depths, at) + f * load(depths, at + LANES))
    )


@inlined
def direct_light(mu_s, bottom, top, star_radius, depths, local, directions, lift):
    """Irradiance of level ground by the star itself, per irradiance at the top. [1]

    Row ``local`` of ``depths`` is the ground's.
    """
    from_low, from_high, low, high = level_light(bottom, mu_s, bottom, top, star_radius, lift)
    x = direction_coordinate(bottom, low, bottom, top) * (directions - 1)
    light = through_row(depths, local, x, directions) * np.float32(from_low)
    x = direction_coordinate(bottom, high, bottom, top) * (directions - 1)
    return light + through_row(depths, local, x, directions) * np.float32(from_high)


@inlined
def fill_phases(moments, nu, degree, constituents, phases):
    """Compute the phase function times scattering coefficient of each constituent. [m⁻¹ sr⁻¹]"""
    for c in range(constituents):
        total = splat(0.0)
        before, value = 0.0, 1.0
        for l in range(degree + 1):
            total = total + load(moments, LANES * (c * (degree + 1) + l)) * np.float32(
                (2 * l + 1) * ISOTROPIC * value
            )
            following = ((2 * l + 1) * nu * value - l * before) / (l + 1)
            before, value = value, following
        store(phases, LANES * c, total)


@inlined
def fill_polarising(polarising, nu, constituents, phases):
    """Compute F₁₂ of degree 2 times scattering coefficient of each constituent. [m⁻¹ sr⁻¹]"""
    part = np.float32(_SECOND * (1.0 - nu) * (1.0 + nu))
    for c in range(constituents):
        store(phases, LANES * c, load(polarising, LANES * 2 * c) * part)


@inlined
def scattered_once(
    turn, radii, first, points, strong, strengths, phases, across, constituents, deep, depths,
    directions, mu_s, nu, bottom, top, star_radius, lift,
):  # fmt: skip
    """Light sent along a ray by its points, from the star's own. [sr⁻¹]

    Results are I, and Q in the frame of the plane through ray and star.

    Parameters
    ----------
    turn, radii : array
        Arrays ``turn`` and ``radius`` of ``Rays``.
    first, points : int
        Index of the ray's first point, and number of its points.
    strong, deep : int
        Index of the first of them in ``strengths`` and ``depths``.
    strengths : array, shape (points·nc·8,)
        Amount of each constituent at a point times the transmittance on the way from it. [m]
    phases, across : array, shape (nc·8,)
        Arrays from ``fill_phases`` and ``fill_polarising``. [m⁻¹ sr⁻¹]
    constituents : int
    depths : array, shape (points·directions·8,)
        Depths from ``depth_in_row``. [1]
    directions : int
    mu_s, nu : float
        Cosines of the star at the start of the ray. [1]
    bottom, top, star_radius, lift :
        As in ``star_points``.
    """
    radiance, polarised = splat(0.0), splat(0.0)
    for k in range(points):
        q = radii[first + k]
        mu_sk, _ = star_from_point(turn, first + k, mu_s, nu)
        seen, low, high = star_points(q, mu_sk, bottom, top, star_radius, lift)
        if seen <= 0.0:
            continue
        x = direction_coordinate(q, low, bottom, top) * (directions - 1)
        light = through_row(depths, deep + k, x, directions)
        if high > low:
            x = direction_coordinate(q, high, bottom, top) * (directions - 1)
            light = light + through_row(depths, deep + k, x, directions)
            light = light * np.float32(0.5)
        source, turned = splat(0.0), splat(0.0)
        for c in range(constituents):
            amount = load(strengths, LANES * ((strong + k) * constituents + c))
            source = source + load(phases, LANES * c) * amount
            turned = turned + load(across, LANES * c) * amount
        light = np.float32(seen) * light
        radiance = radiance + light * source
        polarised = polarised + light * turned
    return radiance, polarised


@compiled_loop
def first_order_radius(i, grid, rays, share, azimuths, air, expansion, columns, lift, out, sky_out):
    """Moments of the light scattered or reflected once, at all sun elevations of one radius.

    Parameters
    ----------
    i, grid, rays, share, azimuths, air, expansion, out, sky_out :
        As in ``sweep_radius``.
    columns : array, shape (radii, directions, nc, 2)
        Ratios of a ``ColumnTable``, from ``mean_density_ratios``.
    lift : array, shape (rows, columns, 2)
        Table from ``star_lift``. [1]
    """
    # Arrays are unpacked from their tuples once: in the loop each access would count references.
    bottom, top, _, sun_cosines, _, _ = grid
    (
        all_mu,
        all_weights,
        all_flux,
        _,
        starts,
        totals,
        ends,
        ray_radii,
        _,
        turns_along,
        amounts,
        depths,
    ) = rays
    cosines, multiples, sines = azimuths
    extinction, moments, surface, star_radius, polarising = air
    suns = sun_cosines.size
    degree = multiples.shape[0] - 1
    harmonics = (degree + 1) * (degree + 2) // 2
    terms = harmonics + POLARISED
    constituents = totals.shape[2]
    angles = all_mu.shape[1]
    most = 0
    for a in range(angles):
        most = max(most, starts[i, a + 1] - starts[i, a])
    directions = columns.shape[1]
    sun_depths = np.empty(max(most, 1) * directions * LANES, np.float32)
    ground_depths = np.empty(directions * LANES, np.float32)
    for d in range(directions):
        store(
            ground_depths,
            LANES * d,
            depth_in_row(columns, bottom, d, bottom, top, extinction, constituents),
        )
    strength = np.empty(max(most, 1) * constituents * LANES, np.float32)
    phase = np.empty(constituents * LANES, np.float32)
    across = np.empty(constituents * LANES, np.float32)
    functions = np.empty(harmonics)
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
            q = ray_radii[first + k]
            for d in range(directions):
                store(
                    sun_depths,
                    LANES * (k * directions + d),
                    depth_in_row(columns, q, d, bottom, top, extinction, constituents),
                )
            through = exponential(
                0.0 - optical_depth(depths[first + k], 0, extinction, constituents)
            )
            for c in range(constituents):
                store(
                    strength,
                    LANES * (k * constituents + c),
                    through * np.float32(amounts[first + k, c]),
                )
        through = splat(0.0)
        leaving = 0.0
        if below:
            through = through_ray(extinction, totals[i, a], 0, constituents)
            leaving = leaving_at_end(ends, i, a, mu)
        legendre_functions(mu, expansion, functions)
        exact = load(share, LANES * (i * angles + a))
        for j in range(suns):
            mu_s = sun_cosines[j]
            azimuthal[:] = 0.0
            polarised[:] = 0.0
            for b in range(cosines.size):
                nu = star_from_ray(mu, mu_s, cosines[b])
                fill_phases(moments, nu, degree, constituents, phase)
                fill_polarising(polarising, nu, constituents, across)
                radiance, plane = scattered_once(
                    turns_along, ray_radii, first, points, 0, strength, phase, across, constituents,
                    0, sun_depths, directions, mu_s, nu, bottom, top, star_radius, lift,
                )  # fmt: skip
                radiance, plane = exact * radiance, exact * plane
                cosine, sine = star_plane(mu, mu_s, nu)
                add_polarised(
                    polarised, multiples, sines, b, np.float32(cosine) * plane,
                    np.float32(sine) * plane,
                )  # fmt: skip
                if below:
                    mu_sg = star_at_end(ends, i, a, mu_s, nu)
                    factor = star_factor(surface, 0, mu_sg, leaving, nu)
                    radiance = radiance + factor * INVERSE_PI * through * direct_light(
                        mu_sg, bottom, top, star_radius, ground_depths, 0, directions, lift
                    )
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

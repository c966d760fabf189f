"""Passes of the direct solver: radiance of the first and of further orders, ground irradiance."""

from __future__ import annotations

from math import cos, exp, log, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import ray_length, shadow_edges
from airlight.geometry.shell import meets_ground
from airlight.geometry.sun_disc import mean_cosine
from airlight.kernel import compiled_loop, inlined
from airlight.physics.optics.reflection import (
    cos_reflected,
    diffuse_reflectance_at,
    direct_reflectance_at,
)
from airlight.solver.direct.layout import radius_of, sun_cell, sun_of
from airlight.solver.direct.line import (
    add_gathered,
    add_once,
    place_rows,
    prepare,
    star_columns,
)

FloatArray = NDArray[np.float64]

#: Smallest argument of the logarithm. [1]
_DARK = 1e-280


@compiled_loop
def first_pass(i, axes, directions, phases_at, air, line, lit_ground, out):
    """First-order radiance arriving at one radius: S⁽¹⁾ + D·T.

    Parameters
    ----------
    phases_at : tuple of arrays
        Result of ``phase_nodes``.
    lit_ground : array, shape (sun_angles, nl)
        D, the radiance of the ground by direct irradiance. [sr⁻¹]
    out : array, shape (sun_angles, nl, nz, na)
        Receives the radiance, per irradiance of the star. [sr⁻¹]
    """
    phase, which = phases_at
    zenith, azimuth = directions.zenith[i], directions.azimuth
    r = radius_of(i, axes)
    last = phase.shape[1] - 1
    phases, light = np.empty(which.size), np.empty(out.shape[1])
    for z in range(zenith.size):
        mu, sine = cos(zenith[z]), sin(zenith[z])
        length = ray_length(r, mu, axes.bottom, axes.top)
        for k in range(axes.sun_angles):
            mu_s = min(max(sun_of(k, axes), -1.0), 1.0)
            sun_sine = sqrt((1.0 - mu_s) * (1.0 + mu_s))
            for a in range(azimuth.size):
                nu = min(max(mu * mu_s + sine * sun_sine * cos(azimuth[a]), -1.0), 1.0)
                light[:] = 0.0
                if length > 0.0:
                    dark, dawn = shadow_edges(r, mu, mu_s, nu, axes.bottom)
                    count = prepare(r, mu, length, dark, dawn, air, line)
                    x = sqrt(max(0.5 - 0.5 * nu, 0.0)) * last
                    node = min(int(x), last - 1)
                    for q in range(phases.size):
                        low, high = phase[which[q], node], phase[which[q], node + 1]
                        phases[q] = low + (x - node) * (high - low)
                    add_once(r, mu_s, nu, count, phases, False, air, line, light)
                else:
                    line.transmittance[:] = 1.0
                if meets_ground(r, mu, axes.bottom):
                    ray = r, mu, mu_s, nu, length
                    add_ground(
                        ray, axes, lit_ground, True, False, air.ground, line.transmittance, light
                    )
                for l in range(light.size):
                    out[k, l, z, a] = light[l]


@compiled_loop
def next_pass(i, directions, table, air, line, lit_ground, by_star, out):
    """Radiance of the next order arriving at one radius: S⁽ᵏ⁾ + A⁽ᵏ⁾·T.

    Parameters
    ----------
    table : GatheredTable
        Gathered radiance G⁽ᵏ⁻¹⁾.
    lit_ground : array, shape (sun_angles, nl)
        Diffuse irradiance of the ground, with the reflection A⁽ᵏ⁾. [1]
    by_star : bool
        Whether ``lit_ground`` is direct irradiance.
    """
    axes = table.axes
    zenith, azimuth = directions.zenith[i], directions.azimuth
    r = radius_of(i, axes)
    light = np.empty(out.shape[1])
    for z in range(zenith.size):
        mu, sine = cos(zenith[z]), sin(zenith[z])
        length = ray_length(r, mu, axes.bottom, axes.top)
        count = 0
        line.transmittance[:] = 1.0
        if length > 0.0:
            count = prepare(r, mu, length, 0.0, 0.0, air, line)
            place_rows(r, mu, count, axes, line)
        to_ground = meets_ground(r, mu, axes.bottom)
        for k in range(axes.sun_angles):
            mu_s = min(max(sun_of(k, axes), -1.0), 1.0)
            sun_sine = sqrt((1.0 - mu_s) * (1.0 + mu_s))
            for a in range(azimuth.size):
                nu = min(max(mu * mu_s + sine * sun_sine * cos(azimuth[a]), -1.0), 1.0)
                light[:] = 0.0
                add_gathered(r, mu_s, nu, count, table, line, light)
                if to_ground:
                    ray = r, mu, mu_s, nu, length
                    add_ground(
                        ray,
                        axes,
                        lit_ground,
                        by_star,
                        table.logarithmic,
                        air.ground,
                        line.transmittance,
                        light,
                    )
                for l in range(light.size):
                    out[k, l, z, a] = light[l]


@compiled_loop
def add_ground(ray, axes, lit_ground, by_star, logarithmic, ground, transmittance, out):
    """Add the attenuated radiance of the ground at the end of a line of sight.

    Parameters
    ----------
    ray : tuple of float
        Coordinates r, mu, mu_s and nu of the start, and length. [m], [1], [1], [1], [m]
    axes : Layout
        Axes of the table.
    lit_ground : array, shape (sun_angles, nl)
        Irradiance of the ground. [1]
    by_star : bool
        Whether ``lit_ground`` is direct irradiance.
    logarithmic : bool
        Whether to interpolate the logarithm.
    ground : Reflection
        Reflectance of the ground.
    transmittance : array, shape (nl,)
        Transmittance of the line. [1]
    out : array, shape (nl,)
        Receives the radiance, per irradiance of the star. [sr⁻¹]
    """
    r, mu, mu_s, nu, length = ray
    mu_s_ground = min(max((r * mu_s + length * nu) / axes.bottom, -1.0), 1.0)
    s0, s1, e = sun_cell(mu_s_ground, axes)
    mu_r = cos_reflected(r, mu, axes.bottom)
    for l in range(out.size):
        low, high = lit_ground[s0, l], lit_ground[s1, l]
        if logarithmic and low > _DARK and high > _DARK:
            value = exp((1.0 - e) * log(low) + e * log(high))
        else:
            value = (1.0 - e) * low + e * high
        out[l] += transmittance[l] * reflected(ground, l, by_star, mu_s_ground, mu_r, nu) * value


@inlined
def reflected(ground, l, by_star, mu_s, mu_r, nu):
    """Radiance of the ground at one wavelength, per irradiance. [sr⁻¹]

    Parameters
    ----------
    by_star : bool
        Whether irradiance is direct rather than diffuse.
    mu_s, mu_r, nu : float
        Cosines of ``direct_reflectance``. [1]
    """
    if by_star:
        return direct_reflectance_at(ground, l, mu_s, mu_r, nu) / pi
    return diffuse_reflectance_at(ground, l, mu_r) / pi


@compiled_loop
def direct_light(r, mu_s, nested, air, line, out):
    """Direct horizontal irradiance, per irradiance of the star.

    Parameters
    ----------
    r, mu_s : float
        Radius, and zenith cosine of the star. [m], [1]
    nested : bool
        Whether the column is integrated by the rule rather than looked up.
    out : array, shape (nl,)
        Receives the irradiance. [1]
    """
    above = mean_cosine(mu_s, mu_s, air.star_radius)  # near the horizon the sine equals the angle
    out[:] = 0.0
    if above <= 0.0:
        return
    star_columns(r, mu_s, nested, air, line.edges, line.sun, line.columns)
    for l in range(out.size):
        tau = 0.0
        for c in range(line.columns.size):
            tau += air.extinction[c, l] * line.columns[c]
        out[l] = above * exp(-tau)


def sky_light(zenith: FloatArray, weights: FloatArray, incoming: FloatArray) -> FloatArray:
    """Ambient pass: diffuse horizontal irradiance of the ground.

    Parameters
    ----------
    zenith : array, shape (nz,)
        Zenith angles. [rad]
    weights : array, shape (nz, na)
        Solid angles. [sr]
    incoming : array, shape (sun_angles, nl, nz, na)
        Radiance of one order at the ground. [sr⁻¹]

    Returns
    -------
    array, shape (sun_angles, nl)
        Irradiance. [1]
    """
    cosine = np.maximum(np.cos(zenith), 0.0)
    return np.asarray(np.einsum("za,klza->kl", weights * cosine[:, None], incoming))

"""Optics of eight wavelengths along a ray, and projection of its radiance onto moments."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, exponential, load, splat, store
from airlight.optics.reflection import Reflection
from airlight.solvers.moments.harmonics import ELEMENTS, polarised_functions

Float32Array = NDArray[np.float32]


class ScaledOptics(NamedTuple):
    """Delta-M scaled optics of eight wavelengths, flat, one wavelength per lane.

    Attributes
    ----------
    extinction : array, shape (nc·8,)
        Scaled extinction. [m⁻¹]
    moments : array, shape (nc·(N + 1)·8,)
        Scattering coefficient times Legendre moment, both scaled. [m⁻¹]
    ground : Reflection
        Reflection by the ground.
    star_radius : float
        Angular radius of the star. [rad]
    polarised_moments : array, shape (nc·4·8,)
        Scattering coefficient times the coefficients β₁, α₂ and α₃ of degree 2; extinction of I
        less that of Q and U; see ``delta_m.delta_m_scaling``. [m⁻¹]
    """

    extinction: Float32Array
    moments: Float32Array
    ground: Reflection
    star_radius: float
    polarised_moments: Float32Array


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
    """Optical depth Σ extinction·column of eight wavelengths, from ``columns[first:]``. [1]"""
    tau = splat(0.0)
    for c in range(constituents):
        tau = tau + load(extinction, LANES * c) * np.float32(columns[first + c])
    return tau


@inlined
def polarised_transmittance_ratio(columns, first, polarised_moments, constituents):
    """Transmittance of Q and U over that of I, of eight wavelengths. [1]

    The columns are the row ``columns[first:]``; ``polarised_moments`` as in ``ScaledOptics``.
    """
    more = splat(0.0)
    for c in range(constituents):
        more = more + load(polarised_moments, LANES * (ELEMENTS * c + 3)) * np.float32(
            columns[first + c]
        )
    return exponential(more)


@inlined
def strength_of(moments, amounts, point, l, degree, constituents):
    """Scattering strength of a point in one degree: Σ moments·amount of eight wavelengths. [1]"""
    strength = splat(0.0)
    for c in range(constituents):
        strength = strength + load(moments, LANES * (c * (degree + 1) + l)) * np.float32(
            amounts[point, c]
        )
    return strength


@inlined
def transmittance_ray(extinction, totals, first, constituents):
    """Transmittance of a whole ray with the columns ``totals[first:]``. [1]"""
    return exponential(0.0 - optical_depth(totals, first, extinction, constituents))


@inlined
def mu_r_at_end(ends, i, a, mu):
    """Cosine of the zenith angle of reflection at the ground end of a ray; ``ends`` of ``Rays``.

    It is minus the zenith cosine, there, of a star in the direction of the ray. [1]
    """
    return max(0.0 - star_at_end(ends, i, a, mu, 1.0), 0.0)


@inlined
def star_at_end(ends, i, a, mu_s, nu):
    """Cosine of the star's zenith angle at the ground end of a ray; ``ends`` of ``Rays``. [1]"""
    return min(max(ends[i, a, 0] * mu_s + ends[i, a, 1] * nu, -1.0), 1.0)


@inlined
def sky_at(ground, mu_s, places, sun_angles):
    """Diffuse irradiance of the ground, interpolated from (s, E·s) per node. [1]"""
    x = sun_index(mu_s, places)
    column = min(int(x), sun_angles - 2)
    f = np.float32(x - column)
    g = np.float32(1.0) - f
    low = column * 2 * LANES
    return (g * load(ground, low + LANES) + f * load(ground, low + 3 * LANES)) / (
        g * load(ground, low) + f * load(ground, low + 2 * LANES)
    )


@inlined
def star_from_ray(mu, mu_s, cosine):
    """Cosine between a ray and the star, from the cosine of their relative azimuth. [1]"""
    sines = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0)) * sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    return min(max(mu * mu_s + sines * cosine, -1.0), 1.0)


@inlined
def project(moments_m, functions, weight, degree, orders, base, out):
    """Add a ray's azimuth moments, times its Legendre functions, to the moments of a point.

    The moments are those of the first ``orders`` azimuthal orders; the others vanish.
    """
    for l in range(degree + 1):
        for m in range(min(l + 1, orders)):
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
def add_polarised(azimuthal, multiples, sines, b, stokes_q, stokes_u):
    """Add Q and U of a ray at azimuth ``b`` to its azimuth moments; see ``project_polarised``."""
    for m in range(3):
        store(azimuthal, LANES * m, load(azimuthal, LANES * m) + multiples[m, b] * stokes_q)
    for m in range(1, 3):
        at = LANES * (2 + m)
        store(azimuthal, at, load(azimuthal, at) + sines[m, b] * stokes_u)

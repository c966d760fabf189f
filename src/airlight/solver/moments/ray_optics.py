"""Optics of eight wavelengths along a ray, and projection of its radiance onto moments."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined
from airlight.kernel.lanes import exponential, splat
from airlight.physics.optics.reflection import Reflection
from airlight.solver.moments.grid import MomentsGrid
from airlight.solver.moments.harmonics import Harmonics, polarised_functions
from airlight.solver.moments.rays import Rays
from airlight.solver.moments.source import diffuse_horizontal

Float32Array = NDArray[np.float32]


class ScaledOptics(NamedTuple):
    """Delta-M scaled optics of eight wavelengths, in the lanes.

    Attributes
    ----------
    extinction : array, shape (nc, 8)
        Scaled extinction. [m⁻¹]
    moments : array, shape (nc, N + 1, 8)
        Scattering coefficient times Legendre moment, both scaled. [m⁻¹]
    ground : Reflection
        Reflection by the ground.
    star_radius : float
        Angular radius of the star. [rad]
    polarised_moments : array, shape (nc, 4, 8)
        Scattering coefficient times the coefficients β₁, α₂ and α₃ of degree 2; extinction of I
        less that of Q and U; see ``delta_m.delta_m_scaling``. [m⁻¹]
    """

    extinction: Float32Array
    moments: Float32Array
    ground: Reflection
    star_radius: float
    polarised_moments: Float32Array


class SweepTables(NamedTuple):
    """Constants of the sweeps of eight wavelengths.

    Attributes
    ----------
    grid : MomentsGrid
        Nodes in radius and sun elevation.
    rays : Rays
        Rays from the radii of the sweep.
    norm : array, shape (r, a, 8)
        Normalisation factors from ``cull_opaque``. [1]
    azimuths : Azimuths
        Azimuths between ray and star.
    air : ScaledOptics
        Optics of these wavelengths.
    expansion : Harmonics
        Harmonics of the moments.
    """

    grid: MomentsGrid
    rays: Rays
    norm: Float32Array
    azimuths: Azimuths
    air: ScaledOptics
    expansion: Harmonics


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
        tau = tau + extinction[c] * np.float32(columns[first + c])
    return tau


@inlined
def polarised_transmittance_ratio(columns, first, polarised_moments, constituents):
    """Transmittance of Q and U over that of I, of eight wavelengths. [1]

    The columns are the row ``columns[first:]``; ``polarised_moments`` as in ``ScaledOptics``.
    """
    more = splat(0.0)
    for c in range(constituents):
        more = more + polarised_moments[c, 3] * np.float32(columns[first + c])
    return exponential(more)


@inlined
def strength_of(moments, amounts, point, l, constituents):
    """Scattering strength of a point in one degree: Σ moments·amount of eight wavelengths. [1]"""
    strength = splat(0.0)
    for c in range(constituents):
        strength = strength + moments[c, l] * np.float32(amounts[point, c])
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
    return diffuse_horizontal(ground, column, x - column)


@inlined
def star_from_ray(mu, mu_s, cosine):
    """Cosine between a ray and the star, from the cosine of their relative azimuth. [1]"""
    sines = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0)) * sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    return min(max(mu * mu_s + sines * cosine, -1.0), 1.0)


@inlined
def project(moments_m, functions, weight, degree, orders, sun, out):
    """Add a ray's azimuth moments, times its Legendre functions, to the moments of a sun.

    The moments are those of the first ``orders`` azimuthal orders; the others vanish.
    """
    for l in range(degree + 1):
        for m in range(min(l + 1, orders)):
            index = l * (l + 1) // 2 + m
            out[sun, index] += np.float32(weight * functions[index]) * moments_m[m]


@inlined
def project_polarised(azimuthal, mu, weight, sun, first, out):
    """Add a ray's azimuth moments of Q and U to the polarised moments of a point.

    Parameters
    ----------
    azimuthal : lanes, shape (5,)
        Of Q with cos 0, cos φ and cos 2φ, of U with sin φ and sin 2φ.
    mu : float
        Cosine of the ray's zenith angle. [1]
    weight : float
        Weight of the ray in ∫ dmu. [1]
    sun, first : int
        Index of the sun, and of the first polarised moment.
    out : lanes, shape (s, k)
        Moments.
    """
    a0, a1, a2, b1, b2 = polarised_functions(mu)
    out[sun, first] += np.float32(weight * a0) * azimuthal[0]
    once = np.float32(weight * a1) * azimuthal[1]
    out[sun, first + 1] += once + np.float32(weight * b1) * azimuthal[3]
    twice = np.float32(weight * a2) * azimuthal[2]
    out[sun, first + 2] += twice + np.float32(weight * b2) * azimuthal[4]
    once = np.float32(weight * b1) * azimuthal[1]
    out[sun, first + 3] += once + np.float32(weight * a1) * azimuthal[3]
    twice = np.float32(weight * b2) * azimuthal[2]
    out[sun, first + 4] += twice + np.float32(weight * a2) * azimuthal[4]


@inlined
def add_polarised(azimuthal, multiples, sines, b, stokes_q, stokes_u):
    """Add Q and U of a ray at azimuth ``b`` to its azimuth moments; see ``project_polarised``."""
    for m in range(3):
        azimuthal[m] += multiples[m, b] * stokes_q
    for m in range(1, 3):
        azimuthal[2 + m] += sines[m, b] * stokes_u

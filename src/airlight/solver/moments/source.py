"""Source function at a point of a line of sight: single and multiple scattering, separately."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, exponential, lane_view, maximum, splat
from airlight.solver.moments.harmonics import EVEN, polarised_function


class FieldNode(NamedTuple):
    """Place between four nodes of the field.

    Attributes
    ----------
    row, sun : int
        Indices of the radius and of the sun elevation before the point.
    w00, w01, w10, w11 : float
        Weights of the four nodes. [1]
    """

    row: int
    sun: int
    w00: float
    w01: float
    w10: float
    w11: float


@inlined
def field_node(row, sun, f, e):
    """``FieldNode`` of the fractions of the steps to the next radius and to the next sun angle."""
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    return FieldNode(row, sun, g * h, g * e, f * h, f * e)


@inlined
def transmittance_columns(columns, extinction, constituents):
    """Transmittance through columns (nc,) by extinction coefficients (nc,) of lanes. [1]"""
    tau = splat(0.0)
    for c in range(constituents):
        tau = tau + extinction[c] * np.float32(columns[c])
    return exponential(0.0 - tau)


@inlined
def polarised_ratio_columns(columns, polarised_moments, constituents):
    """Transmittance of Q and U over that of I through columns (nc,). [1]

    ``polarised_moments`` as in ``ScaledOptics``; other arguments as in ``transmittance_columns``.
    """
    more = splat(0.0)
    for c in range(constituents):
        more = more + polarised_moments[c, 3] * np.float32(columns[c])
    return exponential(more)


@inlined
def direct_beam(seen, low_columns, high_columns, spread, extinction, constituents):
    """Direct normal irradiance at a point, per that outside the atmosphere. [1]

    Parameters
    ----------
    seen : float
        Visible part of the star, from ``star_points``. [1]
    low_columns, high_columns : array, shape (nc,)
        Columns from the point to space, towards the two points that represent the star. [m]
    spread : bool
        Whether these two differ.
    extinction, constituents :
        As in ``transmittance_columns``.
    """
    light = transmittance_columns(low_columns, extinction, constituents)
    if spread:
        light = light + transmittance_columns(high_columns, extinction, constituents)
        light = light * np.float32(0.5)
    return light * np.float32(seen)


@inlined
def single_scattering_source(density, scattering, phase, constituents):
    """Single-scattering source: Σ scattering coefficient · phase function. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    density : array, shape (nc,)
        Relative densities. [1]
    scattering : lanes, shape (nc,)
        Scattering coefficients. [m⁻¹]
    phase : lanes, shape (nc,)
        Phase functions at the angle to the star. [sr⁻¹]
    constituents :
        As in ``transmittance_columns``.
    """
    source = splat(0.0)
    for c in range(constituents):
        source = source + (scattering[c] * phase[c]) * density[c]
    return source


@inlined
def between(field, node, term):
    """Weighted sum of a term of the field (r, s, 1 + k) at the four nodes of a ``FieldNode``."""
    row, sun = node.row, node.sun
    return (
        node.w00 * field[row, sun, term]
        + node.w01 * field[row, sun + 1, term]
        + node.w10 * field[row + 1, sun, term]
        + node.w11 * field[row + 1, sun + 1, term]
    )


@inlined
def multiple_scattering_source(
    density, moments, polarised_moments, field, functions, node, degree, constituents
):
    """Multiple-scattering source, from the moments of the radiance. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    moments : lanes, shape (nc, N + 1)
        Moments of ``ScaledOptics``. [m⁻¹]
    polarised_moments : lanes, shape (nc, 4)
        Expansion coefficients of the phase matrix, of ``ScaledOptics``. [m⁻¹]
    field : lanes, shape (r, s, 1 + k)
        Field of ``MarchTables``.
    functions : array, shape (k,)
        Harmonics of the line of sight: K_lm P_lm cos mφ. [1]
    node : FieldNode
        Place in the field.
    degree, constituents :
        As in ``transmittance_columns``.
    """
    source = splat(0.0)
    for l in range(degree + 1):
        strength = splat(0.0)
        for c in range(constituents):
            strength = strength + moments[c, l] * density[c]
        part = splat(0.0)
        for index in range(l * (l + 1) // 2, (l + 1) * (l + 2) // 2):
            part = part + functions[index] * between(field, node, 1 + index)
        source = source + strength * part
    beta_1 = splat(0.0)
    for c in range(constituents):
        beta_1 = beta_1 + polarised_moments[c, 0] * density[c]
    part = splat(0.0)
    for m in range(EVEN):
        term = 1 + (degree + 1) * (degree + 2) // 2 + m
        part = part + functions[3 + m] * between(field, node, term)
    source = source + beta_1 * part
    scale = between(field, node, 0)
    # The truncated expansion may be negative where radiance nearly vanishes.
    return maximum(source / scale, 0.0)


@inlined
def polarised_scattering_source(
    density, polarised_moments, field, mu, cosine, node, degree, constituents
):
    """Q and U of the multiple-scattering source.

    Parameters
    ----------
    mu, cosine : float
        Cosines of the line's zenith angle and of its azimuth. [1]
    density, polarised_moments, field, node, degree, constituents :
        As in ``multiple_scattering_source``.

    Returns
    -------
    stokes_q, stokes_u : lanes
        Q and U in the frame of ``stokes_frame``. [m⁻¹ sr⁻¹]
    """
    beta_1, alpha_2, alpha_3 = splat(0.0), splat(0.0), splat(0.0)
    for c in range(constituents):
        beta_1 = beta_1 + polarised_moments[c, 0] * density[c]
        alpha_2 = alpha_2 + polarised_moments[c, 1] * density[c]
        alpha_3 = alpha_3 + polarised_moments[c, 2] * density[c]
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    first = 1 + (degree + 1) * (degree + 2) // 2  # E_20; M_20 has index 3
    stokes_q, stokes_u = splat(0.0), splat(0.0)
    cos_m, sin_m = 1.0, 0.0  # cos mφ and sin mφ
    for m in range(EVEN):
        bright = between(field, node, 4 + m)
        turned = between(field, node, first + m)
        part = beta_1 * bright + alpha_2 * turned
        even, odd = polarised_function(mu, m)
        stokes_q = stokes_q + part * np.float32(even * cos_m)
        stokes_u = stokes_u + part * np.float32(odd * sin_m)
        if m > 0:
            part = alpha_3 * between(field, node, first + EVEN - 1 + m)
            stokes_q = stokes_q + part * np.float32(odd * cos_m)
            stokes_u = stokes_u + part * np.float32(even * sin_m)
        following = cos_m * cosine - sin_m * sine
        sin_m = sin_m * cosine + cos_m * sine
        cos_m = following
    scale = between(field, node, 0)
    return stokes_q / scale, stokes_u / scale


@inlined
def read_phase(half_sine, table, out):
    """Phase functions of all constituents and wavelengths, interpolated in their table. [sr⁻¹]

    Parameters
    ----------
    half_sine : float
        sin(θ/2) of the scattering angle. [1]
    table : array, shape (nodes, nc, w)
        Phase functions on the uniform grid of sin(θ/2).
    out : array, shape (nc, w)
        Receives the values.
    """
    u = half_sine * (table.shape[0] - 1)
    node = min(int(u), table.shape[0] - 2)
    f = np.float32(u - node)
    for at in range(0, table.shape[2], LANES):
        given, found = lane_view(table, at), lane_view(out, at)
        for c in range(table.shape[1]):
            low, high = given[node, c], given[node + 1, c]
            found[c] = low + f * (high - low)


@inlined
def direct_horizontal(below, above, from_low, from_high, extinction, constituents):
    """Direct horizontal irradiance, per normal irradiance outside the atmosphere. [1]

    Parameters
    ----------
    below, above : array, shape (nc,)
        Columns towards the two points that represent the star. [m]
    from_low, from_high : float
        Weights from ``direct_horizontal_weights``. [1]
    """
    low = transmittance_columns(below, extinction, constituents)
    high = transmittance_columns(above, extinction, constituents)
    return low * np.float32(from_low) + high * np.float32(from_high)


@inlined
def diffuse_horizontal(sky, place, fraction):
    """Diffuse horizontal irradiance of the ground, between two sun elevations of the field. [1]

    Parameters
    ----------
    sky : lanes, shape (r, s, 2)
        Field ``sky`` of ``MarchTables``.
    place, fraction : int, float
        Index of the sun angle below, and fraction of the step to the next.
    """
    e = np.float32(fraction)
    g = np.float32(1.0) - e
    return (g * sky[0, place, 1] + e * sky[0, place + 1, 1]) / (
        g * sky[0, place, 0] + e * sky[0, place + 1, 0]
    )

"""Source function at a point of a line of sight: single and multiple scattering, separately.

The march runs these for a group of lanes at a time: eight wavelengths on the CPU, four in a shader.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, exponential, load, maximum, splat, store
from airlight.solvers.moments.harmonics import ELEMENTS, EVEN, polarised_function


@inlined
def transmittance_columns(columns, extinction, constituents, lanes, at):
    """Transmittance of the wavelengths from lane ``at`` on through columns (nc,). [1]"""
    tau = splat(0.0)
    for c in range(constituents):
        tau = tau + load(extinction, lanes * c + at) * np.float32(columns[c])
    return exponential(0.0 - tau)


@inlined
def polarised_ratio_columns(columns, polarised_moments, constituents, lanes, at):
    """Transmittance of Q and U over that of I through columns (nc,). [1]

    ``polarised_moments`` as in ``ScaledOptics``; other arguments as in ``transmittance_columns``.
    """
    more = splat(0.0)
    for c in range(constituents):
        more = more + load(polarised_moments, lanes * (ELEMENTS * c + 3) + at) * np.float32(
            columns[c]
        )
    return exponential(more)


@inlined
def direct_beam(seen, low_columns, high_columns, spread, extinction, constituents, lanes, at):
    """Direct normal irradiance at a point, per that outside the atmosphere. [1]

    Parameters
    ----------
    seen : float
        Visible part of the star, from ``star_points``. [1]
    low_columns, high_columns : array, shape (nc,)
        Columns from the point to space, towards the two points that represent the star. [m]
    spread : bool
        Whether these two differ.
    extinction, constituents, lanes, at :
        As in ``transmittance_columns``.
    """
    light = transmittance_columns(low_columns, extinction, constituents, lanes, at)
    if spread:
        light = light + transmittance_columns(high_columns, extinction, constituents, lanes, at)
        light = light * np.float32(0.5)
    return light * np.float32(seen)


@inlined
def single_scattering_source(density, scattering, phase, constituents, lanes, at):
    """Single-scattering source: Σ scattering coefficient · phase function. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    density : array, shape (nc,)
        Relative densities. [1]
    scattering : array, shape (nc·w,)
        Scattering coefficients. [m⁻¹]
    phase : array, shape (nc·w,)
        Phase functions at the angle to the star. [sr⁻¹]
    constituents, lanes, at :
        As in ``transmittance_columns``.
    """
    source = splat(0.0)
    for c in range(constituents):
        source = (
            source + (load(scattering, lanes * c + at) * load(phase, lanes * c + at)) * density[c]
        )
    return source


@inlined
def between(field, near, far, block, w00, w01, w10, w11):
    """Weighted sum of the field at four nodes."""
    return (
        w00 * load(field, near)
        + w01 * load(field, near + block)
        + w10 * load(field, far)
        + w11 * load(field, far + block)
    )


@inlined
def multiple_scattering_source(
    density, moments, polarised_moments, field, functions, near, far, block, w00, w01, w10, w11,
    degree, constituents, lanes, at,
):  # fmt: skip
    """Multiple-scattering source, from the moments of the radiance. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    density : array, shape (nc,)
        Relative densities. [1]
    moments : array, shape (nc·(N + 1)·w,)
        Moments of ``ScaledOptics``. [m⁻¹]
    polarised_moments : array, shape (nc·4·w,)
        Expansion coefficients of the phase matrix, of ``ScaledOptics``. [m⁻¹]
    field : array
        Field of ``MarchTables``.
    functions : array, shape (k,)
        Harmonics of the line of sight: K_lm P_lm cos mφ. [1]
    near, far, block : int
        Index of the first value of the lower and of the upper row's node; values per node.
    w00, w01, w10, w11 : float
        Weights of the four nodes. [1]
    degree, constituents, lanes, at :
        As in ``transmittance_columns``.
    """
    source = splat(0.0)
    for l in range(degree + 1):
        strength = splat(0.0)
        for c in range(constituents):
            strength = strength + load(moments, lanes * (c * (degree + 1) + l) + at) * density[c]
        part = splat(0.0)
        for index in range(l * (l + 1) // 2, (l + 1) * (l + 2) // 2):
            element = lanes * (1 + index) + at
            part = part + functions[index] * between(
                field, near + element, far + element, block, w00, w01, w10, w11
            )
        source = source + strength * part
    beta_1 = splat(0.0)
    for c in range(constituents):
        beta_1 = beta_1 + load(polarised_moments, lanes * ELEMENTS * c + at) * density[c]
    part = splat(0.0)
    for m in range(EVEN):
        element = lanes * (1 + (degree + 1) * (degree + 2) // 2 + m) + at
        part = part + functions[3 + m] * between(
            field, near + element, far + element, block, w00, w01, w10, w11
        )
    source = source + beta_1 * part
    scale = between(field, near + at, far + at, block, w00, w01, w10, w11)
    # The truncated expansion may be negative where radiance nearly vanishes.
    return maximum(source / scale, 0.0)


@inlined
def polarised_scattering_source(
    density, polarised_moments, field, mu, cosine, near, far, block, w00, w01, w10, w11, degree,
    constituents, lanes, at,
):  # fmt: skip
    """Q and U of the multiple-scattering source.

    Parameters
    ----------
    mu, cosine : float
        Cosines of the line's zenith angle and of its azimuth. [1]
    density, polarised_moments, field, near, far, block, w00, w01, w10, w11, degree, constituents, \
    lanes, at :
        As in ``multiple_scattering_source``.

    Returns
    -------
    stokes_q, stokes_u : lanes
        Q and U in the frame of ``stokes_frame``. [m⁻¹ sr⁻¹]
    """
    beta_1, alpha_2, alpha_3 = splat(0.0), splat(0.0), splat(0.0)
    for c in range(constituents):
        beta_1 = beta_1 + load(polarised_moments, lanes * ELEMENTS * c + at) * density[c]
        alpha_2 = alpha_2 + load(polarised_moments, lanes * (ELEMENTS * c + 1) + at) * density[c]
        alpha_3 = alpha_3 + load(polarised_moments, lanes * (ELEMENTS * c + 2) + at) * density[c]
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    first = lanes * (1 + (degree + 1) * (degree + 2) // 2) + at  # E_20; M_20 has index 3
    stokes_q, stokes_u = splat(0.0), splat(0.0)
    cos_m, sin_m = 1.0, 0.0  # cos mφ and sin mφ
    for m in range(EVEN):
        bright = lanes * (4 + m) + at
        turned = first + lanes * m
        part = beta_1 * between(
            field, near + bright, far + bright, block, w00, w01, w10, w11
        ) + alpha_2 * between(field, near + turned, far + turned, block, w00, w01, w10, w11)
        even, odd = polarised_function(mu, m)
        stokes_q = stokes_q + part * np.float32(even * cos_m)
        stokes_u = stokes_u + part * np.float32(odd * sin_m)
        if m > 0:
            turned = first + lanes * (EVEN - 1 + m)
            part = alpha_3 * between(field, near + turned, far + turned, block, w00, w01, w10, w11)
            stokes_q = stokes_q + part * np.float32(odd * cos_m)
            stokes_u = stokes_u + part * np.float32(even * sin_m)
        following = cos_m * cosine - sin_m * sine
        sin_m = sin_m * cosine + cos_m * sine
        cos_m = following
    scale = between(field, near + at, far + at, block, w00, w01, w10, w11)
    return stokes_q / scale, stokes_u / scale


@inlined
def read_phase(half_sine, table, nodes, width, out):
    """Phase functions of all constituents and wavelengths, interpolated in their table. [sr⁻¹]

    Parameters
    ----------
    half_sine : float
        sin(θ/2) of the scattering angle. [1]
    table : array, shape (nodes·width,)
        Phase functions on the uniform grid of sin(θ/2).
    nodes, width : int
        Number of nodes, and of values at each.
    out : array, shape (width,)
        Receives the values.
    """
    u = half_sine * (nodes - 1)
    node = min(int(u), nodes - 2)
    f = np.float32(u - node)
    for at in range(0, width, LANES):
        low = load(table, node * width + at)
        high = load(table, (node + 1) * width + at)
        store(out, at, low + f * (high - low))


@inlined
def direct_horizontal(below, above, from_low, from_high, extinction, constituents, lanes, at):
    """Direct horizontal irradiance, per normal irradiance outside the atmosphere. [1]

    Parameters
    ----------
    below, above : array, shape (nc,)
        Columns towards the two points that represent the star. [m]
    from_low, from_high : float
        Weights from ``direct_horizontal_weights``. [1]
    extinction, constituents, lanes, at :
        As in ``transmittance_columns``.
    """
    low = transmittance_columns(below, extinction, constituents, lanes, at)
    high = transmittance_columns(above, extinction, constituents, lanes, at)
    return low * np.float32(from_low) + high * np.float32(from_high)


@inlined
def diffuse_horizontal(sky, place, fraction, lanes, at):
    """Diffuse horizontal irradiance of the ground, between two sun elevations of the field. [1]

    Parameters
    ----------
    sky : array
        Field ``sky`` of ``MarchTables``.
    place, fraction : int, float
        Index of the sun angle below, and fraction of the step to the next.
    lanes, at :
        As in ``transmittance_columns``.
    """
    e = np.float32(fraction)
    g = np.float32(1.0) - e
    low = place * 2 * lanes + at
    high = low + 2 * lanes
    return (g * load(sky, low + lanes) + e * load(sky, high + lanes)) / (
        g * load(sky, low) + e * load(sky, high)
    )

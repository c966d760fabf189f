"""Light that a point of the air sends along a line of sight: scattered once, and the rest.

The march runs these for a group of lanes at a time: eight wavelengths on the CPU, four in a shader.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, exponential, load, maximum, splat, store
from airlight.solvers.moments.harmonics import ELEMENTS, EVEN, polarised_function


@inlined
def through_columns(columns, extinction, constituents, lanes, at):
    """Transmittance of the wavelengths from lane ``at`` on through columns (nc,). [1]"""
    tau = splat(0.0)
    for c in range(constituents):
        tau = tau + load(extinction, lanes * c + at) * np.float32(columns[c])
    return exponential(0.0 - tau)


@inlined
def onward_columns(columns, polarising, constituents, lanes, at):
    """Transmittance of Q and U over that of I through columns (nc,), from ``polarising``. [1]"""
    more = splat(0.0)
    for c in range(constituents):
        more = more + load(polarising, lanes * (ELEMENTS * c + 3) + at) * np.float32(columns[c])
    return exponential(more)


@inlined
def star_at(seen, low_columns, high_columns, spread, extinction, constituents, lanes, at):
    """Irradiance by the star at a point, of a surface that faces it, per that outside the air. [1]

    Parameters
    ----------
    seen : float
        Visible part of the star, from ``star_points``. [1]
    low_columns, high_columns : array, shape (nc,)
        Columns from the point to space, towards the two points that represent the star. [m]
    spread : bool
        Whether these two differ.
    extinction, constituents, lanes, at :
        As in ``through_columns``.
    """
    light = through_columns(low_columns, extinction, constituents, lanes, at)
    if spread:
        light = light + through_columns(high_columns, extinction, constituents, lanes, at)
        light = light * np.float32(0.5)
    return light * np.float32(seen)


@inlined
def scattered_star(density, scattering, phase, constituents, lanes, at):
    """Scattering coefficient times phase function of all constituents. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    density : array, shape (nc,)
        Relative densities. [1]
    scattering : array, shape (nc·w,)
        Scattering coefficients. [m⁻¹]
    phase : array, shape (nc·w,)
        Phase functions at the angle to the star. [sr⁻¹]
    constituents, lanes, at :
        As in ``through_columns``.
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
def gathered_light(
    density, moments, polarising, field, functions, near, far, block, w00, w01, w10, w11, degree,
    constituents, lanes, at,
):  # fmt: skip
    """Light scattered before, scattered once more into the line of sight. [m⁻¹ sr⁻¹]

    Parameters
    ----------
    density : array, shape (nc,)
        Relative densities. [1]
    moments : array, shape (nc·(N + 1)·w,)
        Moments of ``Air``. [m⁻¹]
    polarising : array, shape (nc·4·w,)
        Elements that polarise, of ``Air``. [m⁻¹]
    field : array
        Field of ``Light``.
    functions : array, shape (k,)
        Harmonics of the line of sight: K_lm P_lm cos mφ. [1]
    near, far, block : int
        Index of the first value of the lower and of the upper row's node; values per node.
    w00, w01, w10, w11 : float
        Weights of the four nodes. [1]
    degree, constituents, lanes, at :
        As in ``through_columns``.
    """
    gathered = splat(0.0)
    for l in range(degree + 1):
        strength = splat(0.0)
        for c in range(constituents):
            strength = strength + load(moments, lanes * (c * (degree + 1) + l) + at) * density[c]
        part = splat(0.0)
        for index in range(l * (l + 1) // 2, (l + 1) * (l + 2) // 2):
            here = lanes * (1 + index) + at
            part = part + functions[index] * between(
                field, near + here, far + here, block, w00, w01, w10, w11
            )
        gathered = gathered + strength * part
    coupling = splat(0.0)
    for c in range(constituents):
        coupling = coupling + load(polarising, lanes * ELEMENTS * c + at) * density[c]
    part = splat(0.0)
    for m in range(EVEN):
        here = lanes * (1 + (degree + 1) * (degree + 2) // 2 + m) + at
        part = part + functions[3 + m] * between(
            field, near + here, far + here, block, w00, w01, w10, w11
        )
    gathered = gathered + coupling * part
    scale = between(field, near + at, far + at, block, w00, w01, w10, w11)
    # A sum of few harmonics may be negative where there is almost no light.
    return maximum(gathered / scale, 0.0)


@inlined
def gathered_polarised(
    density, polarising, field, mu, cosine, near, far, block, w00, w01, w10, w11, degree,
    constituents, lanes, at,
):  # fmt: skip
    """Q and U of the light scattered before, scattered once more into the line of sight.

    Parameters
    ----------
    mu, cosine : float
        Cosines of the line's zenith angle and of its azimuth. [1]
    density, polarising, field, near, far, block, w00, w01, w10, w11, degree, constituents, lanes, \
    at :
        As in ``gathered_light``.

    Returns
    -------
    along, aslant : lanes
        Q and U in the frame of ``stokes_frame``. [m⁻¹ sr⁻¹]
    """
    coupling, keeping, turning = splat(0.0), splat(0.0), splat(0.0)
    for c in range(constituents):
        coupling = coupling + load(polarising, lanes * ELEMENTS * c + at) * density[c]
        keeping = keeping + load(polarising, lanes * (ELEMENTS * c + 1) + at) * density[c]
        turning = turning + load(polarising, lanes * (ELEMENTS * c + 2) + at) * density[c]
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    first = lanes * (1 + (degree + 1) * (degree + 2) // 2) + at  # E_20; M_20 has index 3
    along, aslant = splat(0.0), splat(0.0)
    multiple, across = 1.0, 0.0  # cos mφ and sin mφ
    for m in range(EVEN):
        bright = lanes * (4 + m) + at
        turned = first + lanes * m
        part = coupling * between(
            field, near + bright, far + bright, block, w00, w01, w10, w11
        ) + keeping * between(field, near + turned, far + turned, block, w00, w01, w10, w11)
        even, odd = polarised_function(mu, m)
        along = along + part * np.float32(even * multiple)
        aslant = aslant + part * np.float32(odd * across)
        if m > 0:
            turned = first + lanes * (EVEN - 1 + m)
            part = turning * between(field, near + turned, far + turned, block, w00, w01, w10, w11)
            along = along + part * np.float32(odd * multiple)
            aslant = aslant + part * np.float32(even * across)
        following = multiple * cosine - across * sine
        across = across * cosine + multiple * sine
        multiple = following
    scale = between(field, near + at, far + at, block, w00, w01, w10, w11)
    return along / scale, aslant / scale


@inlined
def read_phase(half_sine, table, nodes, width, out):
    """Phase functions of all constituents and wavelengths between the table's nodes. [sr⁻¹]

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
def level_star(below, above, from_low, from_high, extinction, constituents, lanes, at):
    """Irradiance of a level surface by the star, per that outside the air. [1]

    Parameters
    ----------
    below, above : array, shape (nc,)
        Columns towards the two points that represent the star. [m]
    from_low, from_high : float
        Weights from ``level_light``. [1]
    extinction, constituents, lanes, at :
        As in ``through_columns``.
    """
    low = through_columns(below, extinction, constituents, lanes, at)
    high = through_columns(above, extinction, constituents, lanes, at)
    return low * np.float32(from_low) + high * np.float32(from_high)


@inlined
def level_sky(sky, place, share, lanes, at):
    """Irradiance of the ground by the sky, between two suns of the field. [1]

    Parameters
    ----------
    sky : array
        Irradiances of ``Light``.
    place, share : int, float
        Index of the sun before, and share of the way to the next.
    lanes, at :
        As in ``through_columns``.
    """
    e = np.float32(share)
    g = np.float32(1.0) - e
    low = place * 2 * lanes + at
    high = low + 2 * lanes
    return (g * load(sky, low + lanes) + e * load(sky, high + lanes)) / (
        g * load(sky, low) + e * load(sky, high)
    )

"""Polarisation along a backward history: product of its phase matrices.

A history runs from the observer to the star, so that the phase matrices of its events are
multiplied from left to right. ``importance`` is this product over the product of phase functions:
three rows, the observer's I, Q and U, by four columns, the Stokes parameters of light arriving
along the current segment. The latter refer to two axes normal to the direction n of the segment: a
(Q > 0 is polarised along a) and n × a (U > 0 half-way between). At the start a is e_θ, down the
meridian, and n × a is e_φ.
"""

from __future__ import annotations

from math import sqrt

from airlight.kernel import compiled_loop, inlined
from airlight.solver.montecarlo.scattering_angles import lobe_ratios, lobe_value


@inlined
def start_axis(u, v, w):
    """Axis e_θ of a direction: normal to it, in its meridian plane, downwards. [1]"""
    flat = sqrt(u * u + v * v)
    if flat < 1e-12:
        return w, 0.0, 0.0
    return w * u / flat, w * v / flat, -flat


@inlined
def plane_turn(ux, uy, uz, vx, vy, vz, ax, ay, az):
    """Rotation from the axis a to the plane of two directions u and v.

    Returns
    -------
    cosine, sine : float
        Of twice the angle from a to that plane, about u. [1]
    x, y, z : float
        Normal of the plane: u × v, a unit vector. [1]
    """
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    # u × a, the second axis
    bx, by, bz = uy * az - uz * ay, uz * ax - ux * az, ux * ay - uy * ax
    length = sqrt(x * x + y * y + z * z)
    if length < 1e-12:  # forward or backward scattering: any plane through both
        return 1.0, 0.0, bx, by, bz
    x, y, z = x / length, y / length, z / length
    cosine, sine = x * bx + y * by + z * bz, -(x * ax + y * ay + z * az)
    return cosine * cosine - sine * sine, 2.0 * cosine * sine, x, y, z


@inlined
def begin(importance, hemisphere):
    """Initial product: the identity in I, Q and U."""
    for s in range(3):
        for k in range(4):
            importance[s, k] = 1.0 if s == k else 0.0
    if hemisphere:  # an irradiance has no axes
        importance[1, 1], importance[2, 2] = 0.0, 0.0


@inlined
def depolarise(importance):
    """Multiply the product by a depolarising reflection."""
    for s in range(3):
        for k in range(1, 4):
            importance[s, k] = 0.0


@compiled_loop
def mixed_matrix(turn, air, shares):
    """Phase matrix of the medium at a point: F₁₁ [sr⁻¹]; F₁₂, F₂₂, F₃₃, F₃₄, F₄₄ over F₁₁ [1]."""
    whole, f12, f22, f33, f34, f44 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(shares.size):
        if shares[i] > 0.0:
            value = shares[i] * lobe_value(air.lobes, i, turn)
            a, b, c, d, e = lobe_ratios(air.lobes, i, turn)
            whole += value
            f12 += value * a
            f22 += value * b
            f33 += value * c
            f34 += value * d
            f44 += value * e
    if not whole > 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return whole, f12 / whole, f22 / whole, f33 / whole, f34 / whole, f44 / whole


@inlined
def scatter(importance, cosine, sine, f12, f22, f33, f34, f44):
    """Multiply the product by the rotation to the scattering plane and a phase matrix over F₁₁.

    Parameters
    ----------
    importance : array, shape (3, 4)
        Product; it then refers to the scattering plane.
    cosine, sine : float
        From ``plane_turn``. [1]
    f12, f22, f33, f34, f44 : float
        Elements over F₁₁. [1]
    """
    for s in range(3):
        whole, skew = importance[s, 0], importance[s, 3]
        along = importance[s, 1] * cosine + importance[s, 2] * sine
        across = importance[s, 2] * cosine - importance[s, 1] * sine
        importance[s, 0] = whole + along * f12
        importance[s, 1] = whole * f12 + along * f22
        importance[s, 2] = across * f33 - skew * f34
        importance[s, 3] = across * f34 + skew * f44


@inlined
def arriving(importance, s, cosine, sine, f12):
    """Contribution of direct light to the observer's Stokes parameter s, over F₁₁. [1]

    Parameters
    ----------
    importance, cosine, sine, f12 :
        As in ``scatter``; direct light is unpolarised.
    s : int
        0, 1 or 2 for I, Q or U.
    """
    along = importance[s, 1] * cosine + importance[s, 2] * sine
    return importance[s, 0] + along * f12


@inlined
def carried_axis(ax, ay, az, u, v, w, p, q, s):
    """Axis a after refraction of the direction (u, v, w) to (p, q, s), by the same rotation."""
    away = (ax * p + ay * q + az * s) / (1.0 + u * p + v * q + w * s)
    return ax - away * (u + p), ay - away * (v + q), az - away * (w + s)


@inlined
def crossed(x, y, z, u, v, w):
    """Cross product of two vectors."""
    return y * w - z * v, z * u - x * w, x * v - y * u

"""Bruneton's 2017 mapping of (r, mu) for columns and transmittance to the top of the shell.

Altitude is mapped by the distance to the horizon, direction by the distance to the top of the shell
between its smallest (straight up) and largest (to the horizon) value. Only rays that miss the
ground are mapped.

Sources: "Atmosphere Ⅱ", a walk through Bruneton's transmittance; E. Bruneton, "Precomputed
Atmospheric Scattering: a New Implementation" (2017).
"""

from __future__ import annotations

from math import sqrt

from airlight.geometry.shell import distance_to_top
from airlight.kernel import kernel


@kernel
def altitude_coordinate(r, bottom_radius, top_radius):
    """Radius to [0, 1]: 0 on the ground, 1 at the top. [1]"""
    tangent = sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
    return sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0)) / tangent


@kernel
def radius_from_coordinate(x, bottom_radius, top_radius):
    """Inverse of ``altitude_coordinate``. [m]"""
    shell = (top_radius - bottom_radius) * (top_radius + bottom_radius)
    return sqrt(x * x * shell + bottom_radius * bottom_radius)


@kernel
def direction_coordinate(r, mu, bottom_radius, top_radius):
    """Direction to [0, 1]: 0 straight up, 1 along the horizon. [1]"""
    shortest = top_radius - r
    longest = sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0)) + sqrt(
        (top_radius - bottom_radius) * (top_radius + bottom_radius)
    )
    distance = distance_to_top(r, mu, top_radius)
    return min(max((distance - shortest) / (longest - shortest), 0.0), 1.0)


@kernel
def cosine_from_coordinate(x, r, bottom_radius, top_radius):
    """Inverse of ``direction_coordinate`` at a radius. [1]"""
    shortest = top_radius - r
    longest = sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0)) + sqrt(
        (top_radius - bottom_radius) * (top_radius + bottom_radius)
    )
    distance = shortest + x * (longest - shortest)
    if distance <= 0.0:
        return 1.0
    mu = ((top_radius - r) * (top_radius + r) - distance * distance) / (2.0 * r * distance)
    return min(max(mu, -1.0), 1.0)

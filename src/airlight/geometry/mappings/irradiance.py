"""Bruneton's 2017 mapping of (r, mu_s) for diffuse horizontal irradiance: linear in both.

Source: E. Bruneton, "Precomputed Atmospheric Scattering: a New Implementation" (2017).
"""

from __future__ import annotations

from airlight.kernel import kernel


@kernel
def radius_coordinate(r, bottom_radius, top_radius):
    """Radius to [0, 1]: 0 on the ground, 1 at the top. [1]"""
    return (r - bottom_radius) / (top_radius - bottom_radius)


@kernel
def radius_from_coordinate(x, bottom_radius, top_radius):
    """Inverse of ``radius_coordinate``. [m]"""
    return bottom_radius + x * (top_radius - bottom_radius)


@kernel
def sun_coordinate(mu_s):
    """Cosine of the star's zenith angle to [0, 1]. [1]"""
    return 0.5 + 0.5 * mu_s


@kernel
def sun_from_coordinate(x):
    """Inverse of ``sun_coordinate``. [1]"""
    return 2.0 * x - 1.0

"""Uniforms of observer and star; also emitted as JavaScript."""

from __future__ import annotations

import math


def observer_uniforms(
    r: float, bottom: float, sun_x: float, sun_y: float, seen: float, star_radius: float
) -> tuple[float, float, float, float, float]:
    """Uniforms derived from the positions of observer and star.

    Parameters
    ----------
    r, bottom : float
        Optical radii of observer and ground. [m]
    sun_x, sun_y : float
        Horizontal components of the direction towards the star. [1]
    seen : float
        Cosine of the apparent zenith angle of the star. [1]
    star_radius : float
        Angular radius of the star. [rad]

    Returns
    -------
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    sun_level, seen_x : float
        Horizontal component of the true and of the apparent direction of the star. [1]
    disc : float
        Radiance of the star's disc per irradiance; 0 for a point. [sr⁻¹]

    Examples
    --------
    >>> observer_uniforms(2.0, 1.0, 0.6, 0.0, 0.8, 0.0)[1:]
    (0.5, 0.6, 0.6, 0.0)
    """
    half = math.sin(0.5 * star_radius)
    return (
        -math.sqrt(max((r - bottom) * (r + bottom), 0.0)) / r,
        bottom / r,
        math.hypot(sun_x, sun_y),
        math.sqrt(max((1.0 - seen) * (1.0 + seen), 0.0)),
        1.0 / (4.0 * math.pi * half * half) if star_radius > 0.0 else 0.0,
    )

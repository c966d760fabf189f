"""Bruneton's 2017 mapping of (r, mu, mu_s, nu) for scattered radiance.

The radius is mapped by the distance to the horizon (``transmittance.altitude_coordinate``), the
view by the distance to its end, ground or top, between the shortest and the longest such distance
at that radius. The view axis has two halves, one on each side of the horizon, where radiance is
discontinuous. The star's zenith angle is mapped by the distance to the top along a ray from the
ground towards it, down to the end of twilight; this limit follows from the planet, since a constant
for Earth would clip thick shells.

Sources: E. Bruneton & F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008, section 4;
E. Bruneton, "Precomputed Atmospheric Scattering: a New Implementation" (2017).
"""

from __future__ import annotations

from math import acos, pi, sin, sqrt

from airlight.geometry.shell import distance_to_bottom, distance_to_top
from airlight.kernel import kernel

#: Depression of the star at the end of twilight, in dips of the horizon at the top of the shell.
_DIPS = 3.0


@kernel
def view_coordinate(r, mu, to_ground, bottom_radius, top_radius):
    """Direction to [0, 1] in its half: 0 straight down or up, 1 along the horizon. [1]

    Parameters
    ----------
    r, mu : float
        Radius [m] and cosine of the view's zenith angle [1].
    to_ground : bool
        Whether the line of sight ends on the ground, which selects the half.
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    """
    to_horizon = sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0))
    if to_ground:
        shortest = r - bottom_radius
        longest = to_horizon
        distance = distance_to_bottom(r, mu, bottom_radius)
    else:
        shortest = top_radius - r
        longest = to_horizon + sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
        distance = distance_to_top(r, mu, top_radius)
    if longest <= shortest:
        return 0.0
    return min(max((distance - shortest) / (longest - shortest), 0.0), 1.0)


@kernel
def cosine_from_view(x, to_ground, r, bottom_radius, top_radius):
    """Inverse of ``view_coordinate`` in one half. [1]

    On the ground all views downwards have length 0: the result is straight down.
    """
    to_horizon = sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0))
    if to_ground:
        shortest = r - bottom_radius
        distance = shortest + x * (to_horizon - shortest)
        if distance <= 0.0:
            return -1.0
        mu = -(to_horizon * to_horizon + distance * distance) / (2.0 * r * distance)
    else:
        shortest = top_radius - r
        longest = to_horizon + sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
        distance = shortest + x * (longest - shortest)
        if distance <= 0.0:
            return 1.0
        mu = ((top_radius - r) * (top_radius + r) - distance * distance) / (2.0 * r * distance)
    return min(max(mu, -1.0), 1.0)


@kernel
def view_index(x, to_ground, n):
    """Fractional index on the axis of n views, between 0 and n - 1; n is even. [1]

    The first half is the ground, from the horizon to straight down; the second the sky, from
    straight up to the horizon. Indices between n/2 - 1 and n/2 are not used.
    """
    half = n // 2
    if to_ground:
        return (1.0 - x) * (half - 1.0)
    return half + x * (half - 1.0)


@kernel
def view_from_index(index, n):
    """Inverse of ``view_index``: coordinate in its half, and whether the view meets the ground."""
    half = n // 2
    if index < half - 0.5:
        return min(max(1.0 - index / (half - 1.0), 0.0), 1.0), True
    return min(max((index - half) / (half - 1.0), 0.0), 1.0), False


@kernel
def lowest_sun_cosine(bottom_radius, top_radius):
    """Cosine of the star's zenith angle below which tables end: three dips of the horizon. [1]

    From the top of the shell the horizon is depressed by one dip; its tangent line leaves the shell
    two dips further round the planet, where the atmosphere is sunlit until the star is depressed by
    one dip. Beyond three dips, sunlit atmosphere is not visible from any point. The cosine is -1
    for thick shells whose three dips exceed a right angle.
    """
    depression = _DIPS * acos(bottom_radius / top_radius)
    if depression >= 0.5 * pi:
        return -1.0
    return -sin(depression)


@kernel
def sun_coordinate(mu_s, lowest, bottom_radius, top_radius):
    """Cosine of the star's zenith angle to [0, 1]: 0 at ``lowest`` and below, 1 overhead. [1]

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle. [1]
    lowest : float
        Limit from ``lowest_sun_cosine``. [1]
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]
    """
    shortest = top_radius - bottom_radius
    longest = sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
    a = (distance_to_top(bottom_radius, mu_s, top_radius) - shortest) / (longest - shortest)
    end = (distance_to_top(bottom_radius, lowest, top_radius) - shortest) / (longest - shortest)
    return max(1.0 - a / end, 0.0) / (1.0 + a)


@kernel
def sun_from_coordinate(x, lowest, bottom_radius, top_radius):
    """Inverse of ``sun_coordinate``. [1]"""
    shortest = top_radius - bottom_radius
    longest = sqrt((top_radius - bottom_radius) * (top_radius + bottom_radius))
    end = (distance_to_top(bottom_radius, lowest, top_radius) - shortest) / (longest - shortest)
    a = (1.0 - x) * end / (1.0 + x * end)
    distance = shortest + a * (longest - shortest)
    mu_s = (longest - distance) * (longest + distance) / (2.0 * bottom_radius * distance)
    return min(max(mu_s, -1.0), 1.0)


@kernel
def angle_coordinate(nu):
    """Cosine of the angle between view and star to [0, 1]. [1]"""
    return 0.5 * (nu + 1.0)


@kernel
def angle_from_coordinate(x):
    """Inverse of ``angle_coordinate``. [1]"""
    return 2.0 * x - 1.0


@kernel
def possible_angle(nu, mu, mu_s):
    """``nu`` clamped to the range possible for the zenith angles of view and star. [1]"""
    spread = sqrt(max((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s), 0.0))
    return min(max(nu, mu * mu_s - spread, -1.0), mu * mu_s + spread, 1.0)

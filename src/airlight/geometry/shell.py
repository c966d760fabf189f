"""Distances and horizons in a spherical shell.

A ray starts at radius ``r`` [m] with the zenith cosine ``mu``. Differences of squares are written
as products, to avoid cancellation.
"""

from __future__ import annotations

from math import sqrt

from airlight.kernel import kernel


@kernel
def chord(r, mu, radius):
    """Half chord of a sphere on the line of a ray; 0 if it misses. [m]

    The tangent point is at the distance -r·mu along the ray; the line meets the sphere half a chord
    before and after it.
    """
    return sqrt(max((radius - r) * (radius + r) + r * r * mu * mu, 0.0))


@kernel
def distance_to_top(r, mu, top_radius):
    """Distance along a ray to the top of the shell, from a point inside it. [m]"""
    return max(-r * mu + chord(r, mu, top_radius), 0.0)


@kernel
def distance_to_bottom(r, mu, bottom_radius):
    """Distance along a ray to the ground, for a ray that meets it. [m]

    From the power of the point, the product of both distances: near the ground the difference
    -r·mu - chord would cancel, with an error of 0.5 m on Earth in single precision.
    """
    further = chord(r, mu, bottom_radius) - r * mu
    if further <= 0.0:
        return 0.0
    return max((r - bottom_radius) * (r + bottom_radius) / further, 0.0)


@kernel
def horizon_cosine(r, bottom_radius):
    """Cosine of the zenith angle of the geometric horizon seen from radius r: at most 0. [1]"""
    return -sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0)) / r


@kernel
def meets_ground(r, mu, bottom_radius):
    """Whether a ray meets the ground, that is, points below the horizon."""
    return mu < horizon_cosine(r, bottom_radius)


@kernel
def radius_along(r, mu, distance):
    """Radius after a distance along a ray. [m]"""
    return sqrt(max(distance * (distance + 2.0 * r * mu) + r * r, 0.0))


@kernel
def distance_to_shell(r, mu, sine, top_radius):
    """Distance along a line of sight from outside to the shell, and zenith cosine at entry.

    Parameters
    ----------
    r, mu : float
        Distance from the centre, more than ``top_radius`` [m]; cosine of the zenith angle. [1]
    sine : float
        Sine of the zenith angle, for an accurate impact parameter far away. [1]
    top_radius : float
        Radius of the top of the shell. [m]

    Returns
    -------
    way : float
        Distance to the shell; -1 for a line that misses it. [m]
    mu : float
        Cosine of the zenith angle at the entry. [1]
    """
    impact = r * sine
    if mu >= 0.0 or impact >= top_radius:
        return -1.0, 0.0
    half_chord = sqrt((top_radius - impact) * (top_radius + impact))
    return max(-r * mu - half_chord, 0.0), -half_chord / top_radius


@kernel
def first_intersection(impact, sine, radius):
    """First intersection of a descending line of sight with a sphere, from its centre. [m]

    Free of cancellation for distant observers.

    Parameters
    ----------
    impact : float
        Impact parameter, less than ``radius``. [m]
    sine : float
        Sine of the line's zenith angle at the observer, whose cosine is negative. [1]
    radius : float
        Radius of the sphere. [m]

    Returns
    -------
    across, up : float
        Coordinates perpendicular to the observer's vertical, on the side of the view, and along it.
        [m]

    Examples
    --------
    >>> first_intersection(0.0, 0.0, 6360e3)  # straight down
    (0.0, 6360000.0)
    """
    depth = sqrt(max((radius - impact) * (radius + impact), 0.0))
    down = sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))
    return impact * down - depth * sine, impact * sine + depth * down

"""Coordinates of a line of sight in the sky-view LUT of one observer.

The LUT has two halves, the sky above the horizon and the ground below it, each with rows from the
horizon (0) to the zenith, the top of the shell or the nadir (1). Rows are dense at the horizon: the
square of the row coordinate is proportional to the angle from the horizon inside the shell, and to
the impact parameter outside.
"""

from __future__ import annotations

from math import acos, atan2, cos, pi, sin, sqrt

from airlight.kernel import kernel


@kernel
def angle_above_horizon(mu, sine, horizon_mu, horizon_sine):
    """Angle of a line of sight above the horizon, negative below it. [rad]

    Parameters
    ----------
    mu, sine : float
        Cosine and sine of its zenith angle. [1]
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    """
    across = mu * horizon_sine - sine * horizon_mu
    return atan2(across, mu * horizon_mu + sine * horizon_sine)


@kernel
def row_from_angle(angle, horizon_mu):
    """Row coordinate of a line of sight from inside the shell. [1]

    Parameters
    ----------
    angle : float
        Angle above the horizon, positive in the sky. [rad]
    horizon_mu : float
        Cosine of the horizon's zenith angle. [1]

    Examples
    --------
    >>> row_from_angle(0.25 * pi, 0.0)  # half-way up: √½
    0.7071067811865476
    """
    highest = acos(horizon_mu)
    part = angle / highest if angle > 0.0 else angle / (highest - pi)
    return sqrt(min(max(part, 0.0), 1.0))


@kernel
def direction_from_row(row, sky, horizon_mu, horizon_sine):
    """Inverse of ``row_from_angle``: cosine and sine of the zenith angle. [1]

    Parameters
    ----------
    row : float
        Coordinate of the row, 0 to 1. [1]
    sky : bool
        Whether the row is in the sky half.
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    """
    highest = acos(horizon_mu)
    angle = row * row * (highest if sky else highest - pi)
    turn, keep = sin(angle), cos(angle)
    return horizon_mu * keep + horizon_sine * turn, horizon_sine * keep - horizon_mu * turn


@kernel
def row_from_impact(impact, bottom_radius, top_radius):
    """Row coordinate of a line of sight from outside the shell. [1]

    Parameters
    ----------
    impact : float
        Impact parameter, at most ``top_radius``. [m]
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the shell. [m]

    Examples
    --------
    >>> row_from_impact(0.0, 6360e3, 6460e3), row_from_impact(6460e3, 6360e3, 6460e3)
    (1.0, 1.0)
    """
    if impact < bottom_radius:
        part = (bottom_radius - impact) / bottom_radius
    else:
        part = (impact - bottom_radius) / (top_radius - bottom_radius)
    return sqrt(min(max(part, 0.0), 1.0))


@kernel
def impact_from_row(row, sky, bottom_radius, top_radius):
    """Inverse of ``row_from_impact``. [m]"""
    if sky:
        return bottom_radius + row * row * (top_radius - bottom_radius)
    return bottom_radius * (1.0 - row * row)

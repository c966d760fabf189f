r"""Refraction in a spherical atmosphere: refracted rays as straight lines, apparent star.

If the refractive index n depends on the radius alone, Bouguer's invariant b = n r sin z holds along
a ray. With the **optical radius** x = n r it reads b = x sin z: with x for the radius, the ray is a
straight line with the true zenith angle at every point, so the geometry of straight rays applies.
Two things differ: a step of arc length is dr/dx times that of the straight line, a factor included
in the densities; and the angle ψ at the planet's centre grows faster, dψ = dψ_x (x/r) dr/dx. The
accumulated difference is the refraction angle, by which a star's zenith angle at a point of the ray
would be wrong without it.

Source: Auer & Standish (2000), Astronomical Journal 119, 2472, for Bouguer's invariant and its
quadrature; Costa et al. (2021), IEEE TVCG 27, 785, section 4.4, for the effects on pictures.
"""

from __future__ import annotations

from math import cos, sin, sqrt

from airlight.geometry.shell import horizon_cosine
from airlight.geometry.sun_disc import sun_elevation, visible_fraction, visible_spread
from airlight.kernel import inlined, kernel


@kernel
def turned(mu, mu_s, nu, angle):
    """Cosines at a point of a refracted ray, from those of the corresponding straight line.

    Parameters
    ----------
    mu : float
        Cosine of the ray's zenith angle at the point. [1]
    mu_s, nu : float
        Cosine of the star's zenith angle at the point of the straight line, and of the angle
        between star and ray. [1]
    angle : float
        Refraction angle from the start of the ray to the point. [rad]

    Returns
    -------
    mu_s, nu : float
        Cosines at the true point. [1]

    Notes
    -----
    Point and ray are rotated together, about the axis perpendicular to both; the star stays fixed.
    A vertical ray is not refracted. Both results are linear in ``mu_s`` and ``nu``.

    Examples
    --------
    >>> turned(0.0, 0.0, 1.0, 0.0)  # towards a star on the horizon, no refraction
    (0.0, 1.0)
    """
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 1e-18))
    across = (nu - mu * mu_s) / sine
    turn, keep = sin(angle), cos(angle)
    mu_s_point = keep * mu_s + turn * across
    return mu_s_point, mu * mu_s_point + sine * (keep * across - turn * mu_s)


@kernel
def refraction_angle(x, mu, refraction_strength, column):
    """Refraction angle of a segment of a ray, from its refraction column. [rad]

    Parameters
    ----------
    x, mu : float
        Optical radius of any point of the ray [m], and its zenith cosine there [1].
    refraction_strength : float
        See ``physics.optics.refracting_shell``. [m⁻²]
    column : float
        Refraction column of the segment. [m]
    """
    return refraction_strength * column * x * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))


@inlined
def refraction_table_index(x, mu_s, bottom, top, refraction_table):
    """Fractional indices in the refraction table; parameters as in ``apparent_sun``.

    Returns
    -------
    row, f, column, e : int, float, int, float
        Index of the node below, and fraction of the distance to the next, on either axis. [1]
    above : float
        Cosine of the star's true zenith angle less that of the horizon's true direction. [1]
    """
    tangent = sqrt((top - bottom) * (top + bottom))
    at = sqrt(max((x - bottom) * (x + bottom), 0.0)) / tangent * (refraction_table.shape[0] - 1)
    row = min(int(at), refraction_table.shape[0] - 2)
    f = at - row
    lifted = refraction_table[row, 0, 0] * (1.0 - f) + refraction_table[row + 1, 0, 0] * f
    true_horizon = horizon_cosine(x, bottom) - lifted
    above = mu_s - true_horizon
    position = sqrt(min(max(above, 0.0) / (1.0 - true_horizon), 1.0)) * (
        refraction_table.shape[1] - 1
    )
    column = min(int(position), refraction_table.shape[1] - 2)
    return row, f, column, position - column, above


@inlined
def apparent_sun_cosine(x, mu_s, bottom, top, refraction_table):
    """Cosine of the star's apparent zenith angle; parameters as in ``apparent_sun``. [1]"""
    row, f, column, e, _ = refraction_table_index(x, mu_s, bottom, top, refraction_table)
    near = (1.0 - e) * refraction_table[row, column, 0] + e * refraction_table[row, column + 1, 0]
    far = (1.0 - e) * refraction_table[row + 1, column, 0] + e * refraction_table[
        row + 1, column + 1, 0
    ]
    return min(mu_s + (1.0 - f) * near + f * far, 1.0)


@inlined
def apparent_sun(x, mu_s, bottom, top, refraction_table):
    """Cosine of a star's apparent zenith angle at optical radius x, and the disc's flattening.

    Parameters
    ----------
    x : float
        Optical radius of the point. [m]
    mu_s : float
        Cosine of the star's true zenith angle there. [1]
    bottom, top : float
        Optical radii of the ground and of the top. [m]
    refraction_table : array, shape (rows, columns, 2)
        Table from ``airlight.solver.tables.refraction_table``; empty without refraction. [1]

    Returns
    -------
    mu_seen : float
        Cosine of the star's apparent zenith angle. [1]
    refraction_jacobian : float
        d mu_seen/d mu_s: factor of the solid angle of the star's disc, and, since radiance is
        conserved, of its irradiance. [1]
    elevation : float
        True elevation above the horizon's true direction, accurate near 0. [rad]
    """
    if refraction_table.shape[0] == 0:
        return mu_s, 1.0, sun_elevation(x, mu_s, bottom)
    sine = bottom / x
    row, f, column, e, above = refraction_table_index(x, mu_s, bottom, top, refraction_table)
    w00, w01 = (1.0 - f) * (1.0 - e), (1.0 - f) * e
    w10, w11 = f * (1.0 - e), f * e
    raised = (
        w00 * refraction_table[row, column, 0]
        + w01 * refraction_table[row, column + 1, 0]
        + w10 * refraction_table[row + 1, column, 0]
        + w11 * refraction_table[row + 1, column + 1, 0]
    )
    refraction_jacobian = (
        w00 * refraction_table[row, column, 1]
        + w01 * refraction_table[row, column + 1, 1]
        + w10 * refraction_table[row + 1, column, 1]
        + w11 * refraction_table[row + 1, column + 1, 1]
    )
    return min(mu_s + raised, 1.0), refraction_jacobian, above / sine


#: A star whose centre is more than this many of its radii above the horizon is sampled at its
#: centre: the two points of a lower star differ by less than 1e-3 from it in clear air.
HIGH = 16.0


@inlined
def star_points(x, mu_s, bottom, top, star_radius, refraction_table):
    """Visible part of the star's disc from a point of the atmosphere, as one or two directions.

    Parameters
    ----------
    x, mu_s, bottom, top, refraction_table :
        Arguments of ``apparent_sun``.
    star_radius : float
        True angular radius of the star. [rad]

    Returns
    -------
    received : float
        Direct normal irradiance over that outside the atmosphere, without transmittance. [1]
    low, high : float
        Cosines of the apparent zenith angles of two points with equal weight; identical where the
        extent of the disc does not matter. [1]
    """
    seen, refraction_jacobian, elevation = apparent_sun(x, mu_s, bottom, top, refraction_table)
    received = refraction_jacobian * visible_fraction(elevation, star_radius)
    if received <= 0.0 or star_radius <= 0.0 or elevation > HIGH * star_radius:
        return received, seen, seen
    mean, deviation = visible_spread(elevation, star_radius)
    middle = seen + refraction_jacobian * (bottom / x) * (mean - elevation)
    offset = refraction_jacobian * (bottom / x) * deviation
    lowest = horizon_cosine(x, bottom)
    return received, max(middle - offset, lowest), min(middle + offset, 1.0)


@inlined
def direct_horizontal_weights(x, mu_s, bottom, top, star_radius, refraction_table):
    """Direct horizontal irradiance, as one or two directions.

    Parameters
    ----------
    x, mu_s, bottom, top, star_radius, refraction_table :
        Arguments of ``star_points``.

    Returns
    -------
    received_low, received_high : float
        Horizontal irradiance from either point over the normal irradiance outside the atmosphere,
        without transmittance. [1]
    low, high : float
        Cosines of the apparent zenith angles of the points, at least 0. [1]
    """
    received, low, high = star_points(x, mu_s, bottom, top, star_radius, refraction_table)
    # Aloft, the horizontal surface hides the lower half of the sky, not the planet.
    low, high = max(low, 0.0), max(high, 0.0)
    return 0.5 * received * low, 0.5 * received * high, low, high

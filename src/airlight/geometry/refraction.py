r"""Bent rays drawn as straight lines: directions along them, and apparent positions of a star.

In air whose refractive index n depends on the radius alone, Bouguer's invariant
b = n r sin z holds along a ray. With the **optical radius** x = n r it reads b = x sin z: drawn in
the plane with x for the radius, the ray is straight and has its true zenith angle at every point,
so all the geometry of straight rays applies to bent ones. Two things differ: a step of arc length
is dr/dx times the drawn one, a factor included in the densities; and the angle ψ at the centre
grows faster, dψ = dψ_x (x/r) dr/dx. The difference, summed along the ray, is the angle by which the
light has been bent, and the error of a star's zenith angle at a point of the ray if it is ignored.

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
    """Cosines at a point of a bent ray, from those of the corresponding straight ray.

    Parameters
    ----------
    mu : float
        Cosine of the ray's zenith angle at the point. [1]
    mu_s, nu : float
        Cosine of the star's zenith angle at the point as drawn, and between star and ray. [1]
    angle : float
        Angle by which the ray has been bent from its start to the point. [rad]

    Returns
    -------
    mu_s, nu : float
        Cosines at the true point. [1]

    Notes
    -----
    Point and ray are rotated together, about the axis perpendicular to both; the star stays fixed.
    A vertical ray is not bent. Both results are linear in ``mu_s`` and ``nu``.

    Examples
    --------
    >>> turned(0.0, 0.0, 1.0, 0.0)  # looking at a star on the horizon, not bent
    (0.0, 1.0)
    """
    sine = sqrt(max((1.0 - mu) * (1.0 + mu), 1e-18))
    across = (nu - mu * mu_s) / sine
    turn, keep = sin(angle), cos(angle)
    here = keep * mu_s + turn * across
    return here, mu * here + sine * (keep * across - turn * mu_s)


@kernel
def refraction_angle(x, mu, refraction_strength, column):
    """Angle by which a ray is bent on a stretch of known column of "refraction". [rad]

    Parameters
    ----------
    x, mu : float
        Optical radius of any point of the ray [m], and its zenith cosine there [1].
    refraction_strength : float
        Strength of the bending; see ``optics.refracting_shell``. [m⁻²]
    column : float
        Column of "refraction" along the stretch. [m]
    """
    return refraction_strength * column * x * sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))


@inlined
def refraction_table_index(x, mu_s, bottom, top, lift):
    """Fractional indices in the refraction table ``lift``; parameters as in ``apparent_sun``.

    Returns
    -------
    row, f, column, e : int, float, int, float
        Node below, and part of the way to the next one, of either axis. [1]
    above : float
        Cosine of its zenith angle above that of the true place of the horizon. [1]
    """
    tangent = sqrt((top - bottom) * (top + bottom))
    at = sqrt(max((x - bottom) * (x + bottom), 0.0)) / tangent * (lift.shape[0] - 1)
    row = min(int(at), lift.shape[0] - 2)
    f = at - row
    lifted = lift[row, 0, 0] * (1.0 - f) + lift[row + 1, 0, 0] * f
    true_horizon = horizon_cosine(x, bottom) - lifted
    above = mu_s - true_horizon
    share = sqrt(min(max(above, 0.0) / (1.0 - true_horizon), 1.0)) * (lift.shape[1] - 1)
    column = min(int(share), lift.shape[1] - 2)
    return row, f, column, share - column, above


@inlined
def apparent_sun_cosine(x, mu_s, bottom, top, lift):
    """Cosine of the star's apparent zenith angle; parameters as in ``apparent_sun``. [1]"""
    row, f, column, e, _ = refraction_table_index(x, mu_s, bottom, top, lift)
    near = (1.0 - e) * lift[row, column, 0] + e * lift[row, column + 1, 0]
    far = (1.0 - e) * lift[row + 1, column, 0] + e * lift[row + 1, column + 1, 0]
    return min(mu_s + (1.0 - f) * near + f * far, 1.0)


@inlined
def apparent_sun(x, mu_s, bottom, top, lift):
    """Apparent zenith cosine of a star from a point of optical radius x, and its flattening.

    Parameters
    ----------
    x : float
        Optical radius of the point. [m]
    mu_s : float
        Cosine of the star's true zenith angle there. [1]
    bottom, top : float
        Optical radii of the ground and of the top. [m]
    lift : array, shape (rows, columns, 2)
        Table from ``airlight.tables.refraction_table``; without rows where light goes straight. [1]

    Returns
    -------
    mu_seen : float
        Cosine of the star's apparent zenith angle. [1]
    refraction_jacobian : float
        d mu_seen/d mu_s: the factor by which the star's disc is smaller than without air, and so is
        the light that arrives, since each part of the disc keeps its radiance. [1]
    elevation : float
        True elevation above the true position of the horizon, accurate near it. [rad]
    """
    if lift.shape[0] == 0:
        return mu_s, 1.0, sun_elevation(x, mu_s, bottom)
    sine = bottom / x
    row, f, column, e, above = refraction_table_index(x, mu_s, bottom, top, lift)
    w00, w01 = (1.0 - f) * (1.0 - e), (1.0 - f) * e
    w10, w11 = f * (1.0 - e), f * e
    raised = (
        w00 * lift[row, column, 0]
        + w01 * lift[row, column + 1, 0]
        + w10 * lift[row + 1, column, 0]
        + w11 * lift[row + 1, column + 1, 0]
    )
    refraction_jacobian = (
        w00 * lift[row, column, 1]
        + w01 * lift[row, column + 1, 1]
        + w10 * lift[row + 1, column, 1]
        + w11 * lift[row + 1, column + 1, 1]
    )
    return min(mu_s + raised, 1.0), refraction_jacobian, above / sine


#: A star whose centre is more than this many of its radii above the horizon is sampled at its
#: centre: the two points of a lower star differ by less than 1e-3 from it in clear air.
HIGH = 16.0


@inlined
def star_points(x, mu_s, bottom, top, star_radius, lift):
    """Visible part of a star from a point of the air, as one or two directions.

    Parameters
    ----------
    x, mu_s, bottom, top, lift :
        Arguments of ``apparent_sun``.
    star_radius : float
        True angular radius of the star. [rad]

    Returns
    -------
    received : float
        Irradiance of a surface that faces the star, over that outside the air, without the air's
        transmittance. [1]
    low, high : float
        Cosines of the apparent zenith angles of the two points that represent the visible part,
        half each; the same where its height does not matter. [1]
    """
    seen, refraction_jacobian, elevation = apparent_sun(x, mu_s, bottom, top, lift)
    received = refraction_jacobian * visible_fraction(elevation, star_radius)
    if received <= 0.0 or star_radius <= 0.0 or elevation > HIGH * star_radius:
        return received, seen, seen
    mean, deviation = visible_spread(elevation, star_radius)
    middle = seen + refraction_jacobian * (bottom / x) * (mean - elevation)
    apart = refraction_jacobian * (bottom / x) * deviation
    lowest = horizon_cosine(x, bottom)
    return received, max(middle - apart, lowest), min(middle + apart, 1.0)


@inlined
def direct_horizontal_weights(x, mu_s, bottom, top, star_radius, lift):
    """Irradiance of a level surface by a star, as one or two directions.

    Parameters
    ----------
    x, mu_s, bottom, top, star_radius, lift :
        Arguments of ``star_points``.

    Returns
    -------
    received_low, received_high : float
        Irradiance from either point over that of a surface that faces the star outside the air,
        without the air's transmittance. [1]
    low, high : float
        Cosines of the apparent zenith angles of the points, at least 0. [1]
    """
    received, low, high = star_points(x, mu_s, bottom, top, star_radius, lift)
    # Aloft, the level surface hides the lower half of the sky, not the planet.
    low, high = max(low, 0.0), max(high, 0.0)
    return 0.5 * received * low, 0.5 * received * high, low, high

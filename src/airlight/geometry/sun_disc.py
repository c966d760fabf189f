"""Fraction of a star's disc above a horizon."""

from __future__ import annotations

from math import acos, asin, atan2, pi, sqrt

from airlight.geometry.shell import horizon_cosine
from airlight.kernel import kernel


@kernel
def sun_elevation(r, mu_s, bottom_radius):
    """Elevation of the star's centre above the geometric horizon, accurate near it. [rad]

    Difference of the cosines over the sine of the horizon's zenith angle: within a disc of 0.5° the
    error is below 3e-5 rad.
    """
    sine = bottom_radius / r
    return (mu_s - horizon_cosine(r, bottom_radius)) / sine


@kernel
def star_elevation(r, mu_s, bottom_radius):
    """Elevation of the star's centre above the geometric horizon. [rad]

    Parameters
    ----------
    r : float
        Distance from the planet's centre. [m]
    mu_s : float
        Cosine of the star's zenith angle. [1]
    bottom_radius : float
        Radius of the ground. [m]

    Examples
    --------
    >>> star_elevation(6360e3, 0.0, 6360e3)
    0.0
    """
    dip = atan2(sqrt(max((r - bottom_radius) * (r + bottom_radius), 0.0)), bottom_radius)
    return atan2(mu_s, sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))) + dip


@kernel
def visible_fraction(elevation, angular_radius):
    """Fraction of a disc's area above a straight horizon: the exact circular segment. [1]

    Parameters
    ----------
    elevation : float
        Elevation of the disc's centre above the horizon. [rad]
    angular_radius : float
        Angular radius of the disc; 0 for a point. [rad]

    Notes
    -----
    The curvature of the horizon over the disc is neglected: for the sun from Earth's ground its
    sagitta is below 1e-5 of the disc's diameter; from 400 km below 1e-3.

    Examples
    --------
    >>> visible_fraction(0.0, 0.005)
    0.5
    """
    if angular_radius <= 0.0:
        return 1.0 if elevation > 0.0 else 0.0
    x = elevation / angular_radius
    if x >= 1.0:
        return 1.0
    if x <= -1.0:
        return 0.0
    return (acos(-x) + x * sqrt(1.0 - x * x)) / pi


@kernel
def mean_cosine(elevation, sine_elevation, angular_radius):
    r"""Mean of max(0, zenith cosine) over a disc: its horizontal irradiance. [1]

    .. math:: \frac{1}{\pi\alpha^2} \int_{disc} \max(0, e')\, d\Omega
              = e F + \frac{2\alpha}{3\pi} (1 - x^2)^{3/2}, \quad x = e / \alpha

    with F the visible fraction; the sine of an elevation within the disc is approximated by the
    angle (relative error below 1e-5 for the sun).

    Parameters
    ----------
    elevation, sine_elevation : float
        Elevation of the disc's centre above the horizon [rad], and its sine [1].
    angular_radius : float
        Angular radius of the disc. [rad]

    Examples
    --------
    >>> mean_cosine(0.5, 0.479425538604203, 0.005)
    0.479425538604203
    """
    if angular_radius <= 0.0 or abs(elevation) >= angular_radius:
        return max(sine_elevation, 0.0)
    x = elevation / angular_radius
    rest = (1.0 - x) * (1.0 + x)
    return sine_elevation * visible_fraction(elevation, angular_radius) + (
        2.0 / (3.0 * pi)
    ) * angular_radius * rest * sqrt(rest)


@kernel
def mean_incidence(sine_elevation, angular_radius):
    """``mean_cosine`` from the sine of the elevation alone. [1]

    Parameters
    ----------
    sine_elevation, angular_radius : float
        Arguments of ``mean_cosine``.

    Examples
    --------
    >>> mean_incidence(0.5, 0.005), mean_incidence(-0.5, 0.005)
    (0.5, 0.0)
    """
    elevation = asin(min(max(sine_elevation, -1.0), 1.0))
    return mean_cosine(elevation, sine_elevation, angular_radius)


@kernel
def visible_spread(elevation, angular_radius):
    r"""Mean elevation of the visible part of a disc, and its standard deviation. [rad]

    With x = e/α and the part y > -x of the unit disc, of area A = π F:

    .. math:: \bar y = \frac{2 (1-x^2)^{3/2}}{3A}, \quad
              \overline{y^2} = \frac{\pi/2 + \arcsin x - x\sqrt{1-x^2}\,(1-2x^2)}{4A}

    A function that varies exponentially over the disc is averaged accurately by the two points one
    standard deviation from the mean.

    Parameters
    ----------
    elevation, angular_radius : float
        Arguments of ``visible_fraction``, which must not be 0. [rad]

    Examples
    --------
    >>> visible_spread(1.0, 0.005)  # the whole disc: α/2
    (1.0, 0.0025)
    """
    x = elevation / angular_radius
    if x >= 1.0:
        return elevation, 0.5 * angular_radius
    rest = sqrt(max((1.0 - x) * (1.0 + x), 0.0))
    area = acos(-x) + x * rest
    if area < 1e-9:
        return 0.0, 0.0
    mean = 2.0 * rest * rest * rest / (3.0 * area)
    square = (0.5 * pi + asin(x) - x * rest * (1.0 - 2.0 * x * x)) / (4.0 * area)
    deviation = sqrt(max(square - mean * mean, 0.0))
    return elevation + angular_radius * mean, angular_radius * deviation

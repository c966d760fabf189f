"""How much of a star's disc stands above a horizon."""

from __future__ import annotations

from math import acos, pi, sqrt

from airlight.kernel import kernel


@kernel
def sun_elevation(r, mu_s, bottom_radius):
    """Elevation of the star's centre above the geometric horizon, right near it. [rad]

    The difference of the cosines over the sine of the horizon's zenith angle: within the disc of
    a star of 0.5° its error is below 3e-5 rad.
    """
    sine = bottom_radius / r
    horizon = -sqrt(max((1.0 - sine) * (1.0 + sine), 0.0))
    return (mu_s - horizon) / sine


@kernel
def visible_fraction(elevation, angular_radius):
    """Part of a disc's area above a straight horizon: the exact circular segment. [1]

    Parameters
    ----------
    elevation : float
        Of the disc's centre above the horizon. [rad]
    angular_radius : float
        Of the disc; 0 for a point. [rad]

    Notes
    -----
    The horizon's own curvature over the disc is left out: for the sun from Earth's ground its
    sagitta is below 1e-5 of the disc's diameter; seen from 400 km below 1e-3.

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
    r"""Mean over a disc of max(0, cosine of the zenith angle): its light on level ground. [1]

    .. math:: \frac{1}{\pi\alpha^2} \int_{disc} \max(0, e')\, d\Omega
              = e F + \frac{2\alpha}{3\pi} (1 - x^2)^{3/2}, \quad x = e / \alpha

    with F the visible fraction; the sine of an elevation within the disc is taken for the angle
    (relative error below 1e-5 for the sun).

    Parameters
    ----------
    elevation, sine_elevation : float
        Of the disc's centre above the horizon [rad], and its sine [1].
    angular_radius : float
        [rad]

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

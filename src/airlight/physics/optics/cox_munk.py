"""Microfacet reflectance of a wind-roughened sea (Cox & Munk 1954).

Cox & Munk (1954), J. Opt. Soc. Am. 44, 838: photographs of sun glitter off Hawaii, winds of 0.7 to
14 m/s. The slope distribution is an isotropic Gaussian; skewness and the anisotropy along the wind
(a third of the variance) are neglected. Shadowing and masking are those of Smith (1967), IEEE
Trans. Antennas Propag. 15, 668, in the form of Walter et al. (2007), "Microfacet models for
refraction through rough surfaces", EGSR, eq. 34; multiple reflection between facets is neglected.
Mishchenko & Travis (1997), J. Geophys. Res. 102, 16989, eqs. 8 to 14, use the same model.

The facets that face a line of sight are weighted by the area across it (Heitz & d'Eon 2014,
"Importance sampling microfacet-based BSDFs using the distribution of visible normals", CGF 33(4),
103): slopes along the line have the density (A + x)₊ φ(x)/(A Φ(A) + φ(A)), with the slope x and
A = cot θ in units of the standard deviation, φ the normal density and Φ its integral.
"""

from __future__ import annotations

from math import exp, sqrt

from airlight.kernel import kernel
from airlight.physics.optics.fresnel import fresnel_reflectances

#: Refractive index of sea water in visible light, 1.337 to 1.349 (Quan & Fry 1995). [1]
SEA_WATER = 1.34
#: Smallest cosine of the star: the mean over the visible half of a sun on the horizon. [1]
LEVEL = 2e-3


@kernel
def mean_square_slope(wind):
    """Variance of the slopes of both axes together, 0.003 + 0.00512 U. [1]

    Cox & Munk (1954), clean surface, summed over both axes.

    Parameters
    ----------
    wind : float
        Wind speed 12.5 m above the sea. [m s⁻¹]

    Examples
    --------
    >>> mean_square_slope(0.0), round(mean_square_slope(10.0), 4)
    (0.003, 0.0542)
    """
    return 0.003 + 0.00512 * wind


@kernel
def hidden_slopes(cosine, slope):
    """Smith's masking function Λ times the cosine, finite for a horizontal line. [1]

    Parameters
    ----------
    cosine : float
        Cosine of the line's zenith angle. [1]
    slope : float
        Root of ``mean_square_slope``. [1]

    Examples
    --------
    >>> hidden_slopes(1.0, 0.2), round(hidden_slopes(0.0, 0.2), 4)  # 0.2/(2 √π) is 0.0564
    (0.0, 0.0566)
    """
    sine = slope * sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    if cosine >= 1.6 * sine:
        return 0.0
    a = cosine / sine
    return sine * (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 + 2.181 * a)


@kernel
def mirror_slope(mu_s, mu_r, nu):
    """Square of the slope tan²β of the facets that mirror the star. [1]

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]

    Examples
    --------
    >>> mirror_slope(1.0, 1.0, -1.0), round(mirror_slope(0.5, 1.0, -0.5), 6)  # tan² 30°
    (0.0, 0.333333)
    """
    eye = max(mu_r, 0.0)
    both = max(mu_s, LEVEL) + eye
    # |s + v|² less its vertical part, for which the star is not raised
    level = max(2.0 * max(1.0 - nu, 2e-8) - (mu_s + eye) * (mu_s + eye), 0.0)
    return level / (both * both)


@kernel
def glint_factor(mu_s, mu_r, nu, wind):
    """Reflectance factor of sun glint. [1]

    π F(ω) p S/(4 μ₀ μ cos⁴β) with the facet tilt β, the slope density p = exp(-tan²β/s²)/(π s²),
    the Fresnel reflectance F, and the shadowing-masking factor S. A star at or below the horizon is
    raised to ``LEVEL`` in its vertical plane.

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``reflection.direct_reflectance``. [1]
    wind : float
        Wind speed. [m s⁻¹]

    Examples
    --------
    >>> n = (0.34 / 2.34) ** 2 / (4.0 * 0.0286)  # overhead: F(0)/(4 s²)
    >>> round(glint_factor(1.0, 1.0, -1.0, 5.0) / n, 9)
    1.0
    """
    square = mean_square_slope(wind)
    slope = sqrt(square)
    sun, eye = max(mu_s, LEVEL), max(mu_r, 0.0)
    cosine = sqrt(min(max(0.5 * (1.0 - nu), 1e-8), 1.0))
    steep = mirror_slope(mu_s, mu_r, nu)
    density = exp(-steep / square) * (1.0 + steep) * (1.0 + steep) / square
    r_s, r_p = fresnel_reflectances(SEA_WATER, cosine)
    seen = sun * eye + sun * hidden_slopes(eye, slope) + eye * hidden_slopes(sun, slope)
    return 0.125 * (r_s + r_p) * density / seen


@kernel
def mirrored_fraction(cosine, wind):
    """Directional albedo of the facets, also their reflectance factor under a uniform sky. [1]

    Fit of the integral of ``glint_factor`` over the hemisphere, for winds of 0.5 to 25 m/s, within
    2.1 % of the value (``builders/sea_reflectance.py``).

    Parameters
    ----------
    cosine : float
        Cosine of the beam's zenith angle. [1]
    wind : float
        Wind speed. [m s⁻¹]
    """
    y = (sqrt(mean_square_slope(wind)) - 0.22) / 0.14
    x = 2.0 * min(max(cosine, 0.0), 1.0) - 1.0
    logarithm = (
        (-2.8161 + y * (-0.1382 - 0.0956 * y))
        + x * (-1.7343 + y * (0.5345 - 0.0925 * y))
        + x * x * (0.2261 + y * (-0.1589 + 0.3819 * y))
        + x * x * x * (0.3613 + y * (-0.5069 + 0.2793 * y))
        + x * x * x * x * (0.1713 + y * (0.0523 - 0.2644 * y))
        + x * x * x * x * x * (-0.0443 + y * (0.2221 - 0.2424 * y))
    )
    return exp(logarithm)


@kernel
def mean_mirrored(wind):
    """Spherical albedo of the facets, within 0.4 %. [1]

    Parameters
    ----------
    wind : float
        Wind speed. [m s⁻¹]

    Examples
    --------
    >>> round(mean_mirrored(5.0), 3)  # smooth water: 0.067
    0.056
    """
    slope = sqrt(mean_square_slope(wind))
    return 0.0712 + slope * (-0.0970 + 0.0480 * slope)


@kernel
def mirrored_cosine(cosine, wind):
    """Effective zenith cosine of the mirrored sky. [1]

    Towards the horizon the visible facets are tilted to the observer: at 5 m/s a horizontal line of
    sight mirrors the sky at 10° elevation. A sky that brightens towards the horizon as 1/(μ + 0.1)
    has the mean mirrored radiance at this cosine. Fit like ``mirrored_fraction``, within 0.012.

    Parameters
    ----------
    cosine : float
        Cosine of the zenith angle of the reflected light, towards the observer. [1]
    wind : float
        Wind speed. [m s⁻¹]
    """
    y = (sqrt(mean_square_slope(wind)) - 0.22) / 0.14
    x = 2.0 * min(max(cosine, 0.0), 1.0) - 1.0
    fall = (
        (1.3079 + y * (0.1125 - 0.1177 * y))
        + x * (0.5868 + y * (0.5464 - 0.1113 * y))
        + x * x * (-0.1865 + y * (0.4264 + 0.3188 * y))
        + x * x * x * (-0.5520 + y * (0.0085 + 0.3510 * y))
        + x * x * x * x * (-0.3068 + y * (-0.0706 + 0.0578 * y))
    )
    return min(max(1.0 - 0.5 * (1.0 - x) * fall, 0.0), 1.0)


@kernel
def facing_limit(cosine, deviation):
    """Slope of facets edge-on to a line of sight, A = cot θ over the standard deviation. [1]

    Parameters
    ----------
    cosine : float
        Cosine of the line's zenith angle. [1]
    deviation : float
        Standard deviation of the slopes of one axis. [1]

    Examples
    --------
    >>> round(facing_limit(0.6, 0.25), 12)
    3.0
    """
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 1e-8))
    return cosine / (sine * deviation)


@kernel
def _shift(limit):
    """Shift of ``facing_slope``, fitted by ``builders/sea_reflectance.py``. [1]"""
    return (0.629 + 0.137 * limit) / (1.0 + limit * (0.675 + 0.336 * limit))


@kernel
def _bend(limit):
    """Width squared of the bend of ``facing_slope``, fitted likewise. [1]"""
    return 1.961 + 0.379 / (1.0 + 0.738 * limit * limit)


@kernel
def facing_slope(normal, limit):
    """Slope along a line of sight, of facets that face it, from a standard normal variable. [1]

    A hyperbola above -A that maps the normal density to that of visible slopes, within 0.17 at 2.6
    standard deviations and 0.05 on the average.

    Parameters
    ----------
    normal : float
        Normal variable; the slope of one axis for a vertical line. [1]
    limit : float
        Result of ``facing_limit``. [1]

    Returns
    -------
    float
        Slope in units of the standard deviation, positive where a facet is turned to the observer.

    Examples
    --------
    >>> round(facing_slope(0.5, 1e4), 3), facing_slope(-3.0, 0.0) > 0.0
    (0.5, True)
    """
    above = normal + limit + _shift(limit)
    return 0.5 * (above + sqrt(above * above + _bend(limit))) - limit


@kernel
def facing_normal(slope, limit):
    """Inverse of ``facing_slope``: the normal variable, -4.8 at least at grazing incidence. [1]

    Examples
    --------
    >>> round(facing_normal(facing_slope(-0.7, 1.5), 1.5), 12)
    -0.7
    """
    above = max(slope + limit, 0.1)
    return above - 0.25 * _bend(limit) / above - limit - _shift(limit)


@kernel
def mirrored_by(along, across, cosine, wind, blur):
    """Direction that a facet mirrors to the observer, and its share of that light. [1]

    The share is the Fresnel reflectance times the visibility of that direction from facets that
    are seen, (1 + Λ)/(1 + Λ + Λ'); 0 for directions below the horizon. Its mean over visible slopes
    is what ``mirrored_fraction`` fits. The rest of the reflectance mirrors other facets.

    Parameters
    ----------
    along, across : float
        Slopes towards and across the line of sight. [1]
    cosine : float
        Cosine of the zenith angle towards the observer. [1]
    wind : float
        Wind speed. [m s⁻¹]
    blur : float
        Width of the horizon's edge for a facet that stands for several; 0 for one. [1]

    Returns
    -------
    share, rest, ahead, aside, up : float
        Share, and rest of the reflectance; components of the direction along the horizontal
        direction of the line of sight, across it and upwards.

    Examples
    --------
    >>> share, rest, ahead, _, up = mirrored_by(0.0, 0.0, 0.6, 5.0, 0.0)
    >>> round(ahead, 12), round(up, 12)  # a level mirror
    (0.8, 0.6)
    """
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0))
    tilt = 1.0 / sqrt(1.0 + along * along + across * across)
    facing = min(max((cosine + sine * along) * tilt, 0.0), 1.0)
    turn = 2.0 * facing * tilt
    up = turn - cosine
    up = min(0.5 * (up + sqrt(up * up + blur * blur)), 1.0)
    r_s, r_p = fresnel_reflectances(SEA_WATER, facing)
    mirrored = 0.5 * (r_s + r_p)
    if up <= 0.0:
        return 0.0, mirrored, 1.0, 0.0, 0.0
    slope = sqrt(mean_square_slope(wind))
    seen = cosine + hidden_slopes(cosine, slope)
    lit = up * seen / max(up * seen + cosine * hidden_slopes(up, slope), 1e-12)
    share = mirrored * lit
    return share, mirrored - share, sine - turn * along, -turn * across, up


@kernel
def steepest_mirror(cosine):
    """Slope of the facet that mirrors the horizon, -tan of half the line's elevation. [1]

    Facets that lean farther away from the observer mirror the sea.

    Parameters
    ----------
    cosine : float
        Cosine of the zenith angle towards the observer. [1]

    Examples
    --------
    >>> round(steepest_mirror(0.6), 12)  # 3/5 and 4/5: an elevation of 36.9°
    -0.333333333333
    """
    return -cosine / (1.0 + sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)))

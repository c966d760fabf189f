"""Size distributions of particles: gamma, log-normal and monodisperse, with quadrature nodes.

A distribution is a probability density over radius. Nodes cover all but a millionth of the
cross-sectional area.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError

FloatArray = npt.NDArray[np.float64]

#: Fraction of the area in the omitted small radii.
_SMALL_SHARE: Final = 1e-6
#: Fraction of Σ r⁴, forward scattering, in the omitted large radii.
_LARGE_SHARE: Final = 1e-6
#: Effective variance below which nodes do not carry all of the particles. [1]
SMALLEST_VARIANCE: Final = 1e-9


class SizeNodes(NamedTuple):
    """Quadrature over a size distribution.

    Parameters
    ----------
    radii : array, shape (n,)
        Radii, ascending. [m]
    weights : array, shape (n,)
        Weights: Σ weights f(radii) is the mean of f per particle, for f that grows at least like an
        area. [1]
    """

    radii: FloatArray
    weights: FloatArray


def _check_gamma(effective_radius: float, effective_variance: float) -> float:
    """Validated shape parameter (1-2b)/b of a gamma distribution. [1]"""
    if not effective_radius > 0.0:
        raise ParameterError("effective_radius", effective_radius, "more than 0 m")
    if not SMALLEST_VARIANCE < effective_variance < 0.5:
        allowed = f"more than {SMALLEST_VARIANCE:g}, below 0.5; spheres of one size have a radius"
        raise ParameterError("effective_variance", effective_variance, allowed)
    return (1.0 - 2.0 * effective_variance) / effective_variance


def gamma_density(
    radii: npt.ArrayLike, effective_radius: float, effective_variance: float
) -> FloatArray:
    r"""Gamma distribution of radii by effective radius a and effective variance b.

    .. math:: N(r) = C\, r^{(1-3b)/b}\, e^{-r/(ab)}, \qquad
              C = \frac{1}{(ab)^{(1-2b)/b}\, \Gamma\!\left(\frac{1-2b}{b}\right)}

    Parameters
    ----------
    radii : array, shape (...)
        Radii. [m]
    effective_radius : float
        Effective radius a, the mean radius by area. [m]
    effective_variance : float
        Effective variance b, below 1/2: beyond it the number of particles diverges. [1]

    Returns
    -------
    array, shape (...)
        Density per radius, of integral 1. [m⁻¹]

    Raises
    ------
    ParameterError
        If a is not above 0 or b not between 0 and 1/2.

    References
    ----------
    Hansen & Travis (1974), Space Science Reviews 16, 527, eq. 2.56. doi:10.1007/BF00168069
    (Costa et al., the OpenSpace paper, print e^{+r/(ab)}, whose integral diverges.)

    Examples
    --------
    >>> round(float(gamma_density(1e-6, 1e-6, 0.25)) * 1e-6, 4)  # shape 2: 16 r e^{-4r}
    0.2931
    """
    shape = _check_gamma(effective_radius, effective_variance)
    scale = effective_radius * effective_variance
    t = np.asarray(radii, dtype=np.float64) / scale
    return np.asarray(np.exp((shape - 1.0) * np.log(t) - t - math.lgamma(shape)) / scale)


def gamma_moment(power: int, effective_radius: float, effective_variance: float) -> float:
    """Mean of r^power over a gamma distribution: (ab)^p Γ(s + p)/Γ(s), s = (1-2b)/b. [m^power]

    For whole powers this is a^p Π (1 + (i - 2) b), i from 0 to p - 1, exact for all b.

    Examples
    --------
    >>> third, second = (gamma_moment(p, 1.6e-6, 0.3) for p in (3, 2))
    >>> round(third / second * 1e6, 12)  # the effective radius [µm]
    1.6
    """
    _check_gamma(effective_radius, effective_variance)
    factors = (1.0 + (i - 2.0) * effective_variance for i in range(power))
    return effective_radius**power * math.prod(factors)


def gamma_limits(effective_radius: float, effective_variance: float) -> tuple[float, float]:
    """Smallest and largest radius relevant to scattering. [m]"""
    from scipy.special import gammainccinv, gammaincinv

    shape = _check_gamma(effective_radius, effective_variance)
    scale = effective_radius * effective_variance
    low = gammaincinv(shape + 2.0, _SMALL_SHARE)  # r² N(r) is a gamma distribution too
    high = gammainccinv(shape + 4.0, _LARGE_SHARE)
    return float(scale * low), float(scale * high)


def _check_log_normal(median_radius: float, geometric_deviation: float) -> float:
    """Validated logarithm of the geometric deviation. [1]"""
    if not median_radius > 0.0:
        raise ParameterError("median_radius", median_radius, "more than 0 m")
    if not 1.0 < geometric_deviation < math.inf:
        raise ParameterError("geometric_deviation", geometric_deviation, "more than 1")
    return math.log(geometric_deviation)


def log_normal_density(
    radii: npt.ArrayLike, median_radius: float, geometric_deviation: float
) -> FloatArray:
    r"""Log-normal distribution of radii.

    .. math:: N(r) = \frac{1}{\sqrt{2\pi}\, r \ln\sigma_g}
              \exp\left(-\frac{\ln^2(r/r_m)}{2 \ln^2\sigma_g}\right)

    Parameters
    ----------
    radii : array, shape (...)
        Radii. [m]
    median_radius : float
        Median radius r_m. [m]
    geometric_deviation : float
        Geometric standard deviation σ_g, above 1. [1]

    Returns
    -------
    array, shape (...)
        Density per radius, of integral 1. [m⁻¹]

    Raises
    ------
    ParameterError
        If r_m is not above 0 or σ_g not above 1.

    References
    ----------
    Hansen & Travis (1974), Space Science Reviews 16, 527, eq. 2.60. doi:10.1007/BF00168069

    Examples
    --------
    >>> round(float(log_normal_density(1e-6, 1e-6, 1.5)) * 1e-6, 4)
    0.9839
    """
    width = _check_log_normal(median_radius, geometric_deviation)
    r = np.asarray(radii, dtype=np.float64)
    deviation = np.log(r / median_radius) / width
    return np.asarray(np.exp(-0.5 * deviation**2) / (math.sqrt(2.0 * math.pi) * width * r))


def log_normal_moment(power: float, median_radius: float, geometric_deviation: float) -> float:
    """Mean of r^power over a log-normal distribution: r_m^p exp(p² ln²σ_g / 2). [m^power]"""
    width = _check_log_normal(median_radius, geometric_deviation)
    return float(median_radius**power) * math.exp(0.5 * (power * width) ** 2)


def log_normal_limits(median_radius: float, geometric_deviation: float) -> tuple[float, float]:
    """Smallest and largest radius relevant to scattering. [m]"""
    from scipy.special import ndtri

    width = _check_log_normal(median_radius, geometric_deviation)
    # r^p N(r) is a log-normal distribution too, its median higher by p ln²σ_g.
    low = 2.0 * width**2 + width * ndtri(_SMALL_SHARE)
    high = 4.0 * width**2 - width * ndtri(_LARGE_SHARE)
    return median_radius * math.exp(low), median_radius * math.exp(high)


def gamma_sizes(effective_radius: float, effective_variance: float, count: int) -> SizeNodes:
    """Nodes over a gamma distribution.

    Parameters
    ----------
    effective_radius, effective_variance
        Parameters of ``gamma_density``. [m], [1]
    """
    radii, widths = _nodes(*gamma_limits(effective_radius, effective_variance), count)
    return SizeNodes(radii, widths * gamma_density(radii, effective_radius, effective_variance))


def log_normal_sizes(median_radius: float, geometric_deviation: float, count: int) -> SizeNodes:
    """Nodes over a log-normal distribution.

    Parameters
    ----------
    median_radius, geometric_deviation
        Parameters of ``log_normal_density``. [m], [1]
    """
    radii, widths = _nodes(*log_normal_limits(median_radius, geometric_deviation), count)
    return SizeNodes(radii, widths * log_normal_density(radii, median_radius, geometric_deviation))


def single_size(radius: float) -> SizeNodes:
    """Monodisperse distribution of a radius [m]."""
    if not radius > 0.0:
        raise ParameterError("radius", radius, "more than 0 m")
    return SizeNodes(np.array([radius]), np.array([1.0]))


def _nodes(low: float, high: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Midpoint rule with even steps in √r.

    The density vanishes at both ends, so the midpoint rule converges fast; even steps in ln r would
    not resolve the ripples of large spheres, even steps in r the small spheres.
    """
    edges = np.linspace(math.sqrt(low), math.sqrt(high), 2 * count + 1)
    middle, step = edges[1::2], edges[2] - edges[0]
    return middle**2, 2.0 * middle * step

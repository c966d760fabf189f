r"""Phase functions of airless spheres and of the Moon.

The irradiance by a sphere of radius R at a distance d, under the irradiance E at phase angle α, is

.. math:: E' = E \, p \, \Phi(\alpha) \, (R/d)^2

with the geometric albedo p and a phase function Φ(0) = 1.
"""

from __future__ import annotations

from math import cos, exp, log, pi, sin
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.kernel import kernel, vectorized
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: Magnitudes of the full Moon and of the sun at their mean distances: Krisciunas & Schaefer (1991),
#: Publications of the Astronomical Society of the Pacific 103, 1033, eq. 9; Cox (2000), Allen's
#: Astrophysical Quantities, 4th edition, section 14.1. [mag]
FULL_MOON: Final = -12.73
SUN: Final = -26.74
#: Ratio of the Moon's mean distance to its radius, to which the magnitude refers. [1]
_RADII_AWAY: Final = 384_400.0 / 1737.4
#: Geometric albedo of the Moon at 550 nm, from these magnitudes. [1]
MOON_ALBEDO: Final = 10.0 ** (-0.4 * (FULL_MOON - SUN)) * _RADII_AWAY**2
#: Exponent of wavelength in the Moon's albedo, from B - V of 0.92 mag, that of the sun 0.65 mag
#: (Cox 2000, table 12.1), between 440 and 550 nm. [1]
MOON_REDDENING: Final = 0.4 * (0.92 - 0.65) * np.log(10.0) / np.log(550.0 / 440.0)
#: Largest phase angle of the measurements; beyond, surface radiance is taken as constant. [deg]
_THINNEST: Final = 160.0
_LOG10: Final = log(10.0)


def lambert_phase(phase: ArrayLike) -> FloatArray:
    """Phase function of a Lambertian sphere, with a geometric albedo of 2/3 its albedo. [1]

    Parameters
    ----------
    phase : array
        Phase angle, 0 to 180. [deg]

    References
    ----------
    Russell (1916), Astrophysical Journal 43, 173.

    Examples
    --------
    >>> lambert_phase([0.0, 90.0, 180.0]).round(4) + 0.0
    array([1.    , 0.3183, 0.    ])
    """
    a = np.radians(np.asarray(phase, float))
    return np.asarray((np.sin(a) + (pi - a) * np.cos(a)) / pi)


@kernel
def dusty_sphere(phase):
    """``lommel_seeliger_phase`` of a single phase angle. [1]

    Parameters
    ----------
    phase : float
        Phase angle, 0 to 180. [deg]
    """
    half = 0.5 * min(max(phase, 1e-9), 180.0 - 1e-9) * pi / 180.0
    dark = sin(half) / cos(half) * log(sin(0.5 * half) / cos(0.5 * half))
    return max(1.0 + sin(half) * dark, 0.0)


@kernel
def measured_phase(phase):
    """``moon_phase`` of a single phase angle. [1]

    Parameters
    ----------
    phase : float
        Phase angle, at least 0. [deg]
    """
    return exp(-0.4 * _LOG10 * (0.026 * phase + 4e-9 * phase * phase * phase * phase))


@kernel
def moon_phase_factor(phase):
    """Brightness of the Moon over that of the full Moon. [1]

    Beyond the measured phases, 160 degrees, the surface radiance of the crescent is constant.

    Parameters
    ----------
    phase : float
        Phase angle, 0 to 180. [deg]

    Examples
    --------
    >>> f"{moon_phase_factor(90.0):.3f}"
    '0.091'
    """
    known = min(phase, _THINNEST)
    return measured_phase(known) * dusty_sphere(phase) / dusty_sphere(known)


def lommel_seeliger_phase(phase: ArrayLike) -> FloatArray:
    r"""Phase function of a Lommel-Seeliger sphere. [1]

    .. math:: \Phi = 1 - \sin\frac{\alpha}{2} \tan\frac{\alpha}{2} \ln\cot\frac{\alpha}{4}

    Parameters
    ----------
    phase : array
        Phase angle, 0 to 180. [deg]

    References
    ----------
    Seeliger (1887); in Hapke (2012), Theory of Reflectance and Emittance Spectroscopy, eq. 11.46.

    Examples
    --------
    >>> lommel_seeliger_phase([0.0, 90.0, 180.0]).round(4) + 0.0
    array([1.    , 0.3768, 0.    ])
    """
    return np.asarray(vectorized(dusty_sphere)(np.asarray(phase, float)))


def moon_phase(phase: ArrayLike) -> FloatArray:
    """Measured phase function of the Moon, without the opposition surge at full Moon. [1]

    ΔV = 0.026 α + 4e-9 α⁴ magnitudes fainter than full, α in degrees.

    Parameters
    ----------
    phase : array
        Phase angle, 0 to 180. [deg]

    References
    ----------
    Krisciunas & Schaefer (1991), Publications of the Astronomical Society of the Pacific 103, 1033,
    eq. 9.

    Examples
    --------
    >>> moon_phase([0.0, 90.0]).round(4)  # half Moon: an eleventh, not a half
    array([1.   , 0.091])
    """
    return np.asarray(vectorized(measured_phase)(np.abs(np.asarray(phase, float))))


def moon_albedo(wavelengths: ArrayLike) -> FloatArray:
    """Geometric albedo of the Moon, reddened by its colour B - V. [1]

    Parameters
    ----------
    wavelengths : array
        Wavelengths. [nm]
    """
    nm = values_in(wavelengths, "nm", "wavelengths")
    return np.asarray(MOON_ALBEDO * (nm / 550.0) ** MOON_REDDENING)


def moon_brightness(wavelengths: ArrayLike, phase: float) -> FloatArray:
    """Geometric albedo of the Moon times its phase function ``moon_phase_factor``. [1]

    Parameters
    ----------
    wavelengths : array
        Wavelengths. [nm]
    phase : float
        Phase angle, 0 to 180. [deg]

    Examples
    --------
    >>> f"{moon_brightness(550.0, 90.0) / moon_brightness(550.0, 0.0):.3f}"
    '0.091'
    """
    return np.asarray(moon_albedo(wavelengths) * moon_phase_factor(phase))


def moon_surface_factor(phase: ArrayLike) -> FloatArray:
    """Correction factor of Lommel-Seeliger surface radiance for the Moon, at a phase angle. [1]

    It makes the disc-integrated brightness equal to the measurement, up to 160 degrees; beyond, it
    is constant.

    Parameters
    ----------
    phase : array
        Phase angle, 0 to 180. [deg]
    """
    known = np.minimum(np.asarray(phase, float), _THINNEST)
    return np.asarray(moon_phase(known) / lommel_seeliger_phase(known))

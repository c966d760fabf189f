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
from airlight.physics.optics.hapke import MOON, Regolith, hapke_reflectance
from airlight.physics.units import values_in

FloatArray = NDArray[np.float64]

#: Geometric albedo of the Moon at 550 nm and opposition, with the surge. With it the disc agrees
#: with Krisciunas & Schaefer (1991) on average over phase angles of 10 to 90 degrees; their law,
#: without a surge, has 0.122 at 0. Sato et al. (2014) give 0.17 at 566 nm. [1]
MOON_ALBEDO: Final = 0.1498
#: Exponent of wavelength in the Moon's albedo, from B - V of 0.92 mag, that of the sun 0.65 mag
#: (Cox 2000, Allen's Astrophysical Quantities, 4th edition, table 12.1), between 440 and 550 nm.
#: [1]
MOON_REDDENING: Final = 0.4 * (0.92 - 0.65) * np.log(10.0) / np.log(550.0 / 440.0)
#: Grains and roughness of the Moon.
_GRAINS, _LOBE, _BACKWARD, _SURGE, _WIDTH, _SLOPE = MOON[:6]
#: Strips of the disc in longitude, and of a half in latitude.
_MERIDIANS: Final = 32
_PARALLELS: Final = 12
#: Geometric albedo of the Earth with its clouds times the squared ratio of its radius to the Moon's
#: mean distance: Mallama, Krobusek & Pavlov (2017), Icarus 282, 19, V = -3.99. [1]
_EARTH: Final = 0.434 * (6371.0 / 384_400.0) ** 2
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
    """Measured phase function of the Moon, without the opposition surge. [1]

    ΔV = 0.026 α + 4e-9 α⁴ magnitudes fainter than full, α in degrees.

    Parameters
    ----------
    phase : float
        Phase angle, 0 to 150. [deg]

    References
    ----------
    Krisciunas & Schaefer (1991), Publications of the Astronomical Society of the Pacific 103, 1033,
    eq. 9.

    Examples
    --------
    >>> round(measured_phase(90.0), 4)  # half Moon: an eleventh, not a half
    0.091
    """
    return exp(-0.4 * _LOG10 * (0.026 * phase + 4e-9 * phase * phase * phase * phase))


@kernel
def moon_reflectance(mu_s, mu_r, cosine):
    """Hapke's reflectance factor of the Moon's mean ground, π times its BRDF. [1]

    Parameters
    ----------
    mu_s, mu_r, cosine : float
        Cosines of incidence, of emergence, and of the phase angle. [1]
    """
    ground = Regolith(
        _GRAINS, _LOBE, _BACKWARD, _SURGE, _WIDTH, _SLOPE, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0
    )
    return hapke_reflectance(mu_s, mu_r, cosine, ground)


@kernel
def moon_disc(phase):
    r"""Mean of the Moon's reflectance factor times the cosine of incidence, over its disc. [1]

    .. math:: p \Phi(\alpha) = \frac{1}{\pi} \int r(\mu_0, \mu, \alpha) \, \mu_0 \, \mu \, d\Omega

    By midpoints in s of luminance longitude and latitude, x = sin(πs/2), within 0.1 %.

    Parameters
    ----------
    phase : float
        Phase angle, 0 to 180. [deg]

    References
    ----------
    Hapke (2012), Theory of Reflectance and Emittance Spectroscopy, 2nd edition, section 11.3.
    """
    angle = min(max(phase, 0.0), 180.0) * pi / 180.0
    half, middle = 0.5 * (pi - angle), 0.5 * angle
    total = 0.0
    for i in range(_MERIDIANS):
        step = pi * ((i + 0.5) / _MERIDIANS - 0.5)
        longitude = middle + half * sin(step)
        across = half * cos(step) * pi / _MERIDIANS
        for j in range(_PARALLELS):
            step = 0.5 * pi * (j + 0.5) / _PARALLELS
            latitude = 0.5 * pi * sin(step)
            along = 0.5 * pi * cos(step) * pi / _PARALLELS
            level = cos(latitude)
            mu_r, mu_s = level * cos(longitude), level * cos(longitude - angle)
            factor = moon_reflectance(mu_s, mu_r, cos(angle))
            total += factor * max(mu_s, 0.0) * max(mu_r, 0.0) * level * across * along
    return total / pi


@kernel
def earthlight(phase):
    """Irradiance of the Moon by the Earth over that by the sun. [1]

    ΔV = -0.00106 β + 2.054e-4 β² of the Earth with its clouds, at its phase angle β = 180° - α.

    Parameters
    ----------
    phase : float
        Phase angle α of the Moon, 0 to 180. [deg]

    References
    ----------
    Mallama & Hilton (2018), Astronomy and Computing 25, 10, eq. 11.

    Examples
    --------
    >>> f"{earthlight(180.0):.1e}"  # new Moon, full Earth
    '1.2e-04'
    """
    own = 180.0 - phase
    return _EARTH * exp(-0.4 * _LOG10 * (2.054e-4 * own - 1.06e-3) * own)


@kernel
def moon_phase_factor(phase):
    """Brightness of the Moon, with earthshine on its whole disc, over that of the full Moon. [1]

    Parameters
    ----------
    phase : float
        Phase angle, 0 to 180. [deg]

    Examples
    --------
    >>> f"{moon_phase_factor(90.0):.3f}"
    '0.080'
    """
    return moon_disc(phase) / moon_disc(0.0) + earthlight(phase)


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
    """Phase function of the Moon by Hapke's law, with the opposition surge, in sunlight alone. [1]

    Parameters
    ----------
    phase : array
        Phase angle, 0 to 180. [deg]

    Examples
    --------
    >>> moon_phase([0.0, 5.0, 90.0]).round(3)  # a surge of a third in the last five degrees
    array([1.   , 0.743, 0.08 ])
    """
    whole = vectorized(moon_disc)(np.abs(np.asarray(phase, float)))
    return np.asarray(whole / vectorized(moon_disc)(0.0))


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
    '0.080'
    """
    return np.asarray(moon_albedo(wavelengths) * moon_phase_factor(phase))

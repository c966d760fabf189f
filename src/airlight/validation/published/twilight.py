r"""Published light of clear twilight skies: illuminance, and magnitude of the zenith.

All are fits to measurements, by the sun's true altitude:

* Seidelmann (ed., 1992), Explanatory Supplement to the Astronomical Almanac, section 9.34: the
  logarithm of the illuminance of a level surface under a cloudless sky as cubics of the altitude
  over 90°, fitted to the Electro-Optics Handbook (RCA 1974) within 0.02, below -5° within 0.01.
  Compared with Urban & Seidelmann (eds., 2013), the third edition, section 12.3.4, Table 12.8, and
  Vallado (2022), Fundamentals of Astrodynamics and Applications, Table 5-1; the number of the
  section in the edition of 1992 is not checked against the book.
* IES Calculation Procedures Committee (1984), Recommended practice for the calculation of daylight
  availability, Journal of the Illuminating Engineering Society 13, 381, coefficients second-hand:
  a sun of 127.5 klx, extinction 0.21 an air mass, and a clear sky, 0.8 klx + 15.5 klx √(sin a).
* Patat, Ugolnikov & Postylyakov (2006), UBVRI twilight sky brightness at ESO-Paranal, A&A 455, 385,
  Table 1: the zenith's V magnitude per square arcsecond, 2635 m above the sea, the night's own
  light included: 21.6 there (Patat 2003, A&A 400, 1183). The measurements scatter by 0.18 mag.
* Hess, Koepke & Schult (1998), BAMS 79, 831, Table 4: the aerosol "continental average", since the
  Supplement's illuminance is that of an average clear day at sea level.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.spectra import v_band
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.sun import solar_irradiance
from airlight.physics.spectra.v_band import V_RANGE, v_passband
from airlight.planets import Planet, load_planet, replace
from airlight.planets.matter.profiles import Exponential
from airlight.planets.spectral import PerWavelength
from airlight.solver import Solution

FloatArray = NDArray[np.float64]

#: Wavelengths at which twilight is solved. [nm]
TWILIGHT_WAVELENGTHS: Final = tuple(float(nm) for nm in range(400, 721, 20))
#: Lowest and highest altitude of the sun [deg], and coefficients of each cubic. [1]
_SUPPLEMENT: Final = (
    (-18.0, -12.0, 13.84, 262.72, 1447.42, 2797.93),
    (-12.0, -5.0, 2.70, 12.17, -431.69, -1899.83),
    (-5.0, -0.8, 2.88, 21.81, -258.11, -858.36),
    (-0.8, 5.0, 2.88, 22.26, -207.64, 1034.30),
    (5.0, 20.0, 3.05, 13.28, -45.98, 64.33),
    (20.0, 90.0, 3.74, 3.97, -4.07, 1.47),
)
#: Scale height of the U.S. Standard Atmosphere, 1976, at sea level, RT/(Mg). [m]
SCALE_HEIGHT: Final = 8434.5
#: Altitude of the observatory on Paranal. [m]
PARANAL: Final = 2635.0
#: Depressions of the sun between which the fit is given. [deg]
PATAT_RANGE: Final = (5.0, 15.0)
_PATAT: Final = (11.84, 1.518, -0.057)
#: V of the zenith of the dark, moonless sky on Paranal. [mag arcsec⁻²]
NIGHT_SKY_V: Final = 21.6


def illuminance_seidelmann1992(altitude: float) -> float:
    """Illuminance of a level surface at sea level under a clear sky. [lx]

    Parameters
    ----------
    altitude : float
        True altitude of the sun, -18 to 90. [deg]

    Examples
    --------
    >>> f"{illuminance_seidelmann1992(-6.0):.2f}"  # the end of civil twilight
    '3.41'
    """
    for low, high, *terms in _SUPPLEMENT:
        if low <= altitude <= high:
            return float(10.0 ** np.polynomial.polynomial.polyval(altitude / 90.0, terms))
    raise ParameterError("altitude", altitude, "-18 to 90 deg")


def illuminance_ies1984(altitude: float) -> float:
    r"""Illuminance of a level surface by sun and clear sky, at the mean distance of the sun. [lx]

    .. math:: E = 127\,500\, \sin a\; e^{-0.21 / \sin a} + 800 + 15\,500 \sqrt{\sin a}

    Parameters
    ----------
    altitude : float
        Altitude of the sun a, 5 to 90. [deg]

    Examples
    --------
    >>> [round(illuminance_ies1984(one), -2) for one in (90.0, 20.0)]
    [119600.0, 33500.0]
    """
    if not 5.0 <= altitude <= 90.0:
        raise ParameterError("altitude", altitude, "5 to 90 deg")
    up = np.sin(np.radians(altitude))
    return float(127_500.0 * up * np.exp(-0.21 / up) + 800.0 + 15_500.0 * np.sqrt(up))


def zenith_v_patat2006(altitude: float) -> float:
    """V surface brightness of the zenith of Paranal in twilight. [mag arcsec⁻²]

    Parameters
    ----------
    altitude : float
        True altitude of the sun, -15 to -5. [deg]

    Examples
    --------
    >>> f"{zenith_v_patat2006(-8.0):.2f}"
    '15.88'
    """
    low, high = PATAT_RANGE
    if not low <= -altitude <= high:
        raise ParameterError("altitude", altitude, f"{-high:g} to {-low:g} deg")
    return float(np.polynomial.polynomial.polyval(-altitude - low, _PATAT))


def one_exponential(earth: Planet) -> Planet:
    """Earth without layers, stratospheric aerosol and refraction, with equal columns.

    Parameters
    ----------
    earth : Planet
        Preset ``earth``, or an edit of it.
    """
    air, *others = earth.constituents
    air = replace(air, profile=Exponential(scale_height=SCALE_HEIGHT))
    low = [one for one in others if one.name != "stratospheric aerosol"]
    return replace(earth, constituents=(air, *low), refraction="none")


def average_aerosol() -> dict[str, object]:
    """Overrides of preset ``earth`` for the continental average aerosol of Hess et al.

    Optical depth 0.151 at 550 nm with Ångström exponents of 1.11 and 1.42 below and above 500 nm,
    0.075 /km at the ground, single-scattering albedo 0.925, mean cosine 0.703.
    """
    aerosol = next(one for one in load_planet("earth").constituents if one.name == "aerosol")
    assert isinstance(aerosol.scattering, PerWavelength)
    nm = np.array(aerosol.scattering.wavelengths)
    above = 0.151 * (nm / 550.0) ** -1.42
    below = 0.151 * (500.0 / 550.0) ** -1.42 * (nm / 500.0) ** -1.11
    return {
        "aerosol.optical_depth": np.where(nm < 500.0, below, above).tolist(),
        "aerosol.profile.scale_height": "2.013 km",
        "aerosol.single_scattering_albedo": 0.925,
        # 3g(4 + g²)/(5(2 + g²)) = 0.703
        "aerosol.phase_function.asymmetry": 0.6407,
    }


def with_night_sky(magnitude: float) -> float:
    """V surface brightness of scattered sunlight plus the night sky. [mag arcsec⁻²]

    Examples
    --------
    >>> f"{with_night_sky(21.6):.2f}"  # twice the light
    '20.85'
    """
    both = 10.0 ** (-0.4 * magnitude) + 10.0 ** (-0.4 * NIGHT_SKY_V)
    return float(-2.5 * np.log10(both))


def between(wavelengths: ArrayLike, values: ArrayLike, at: FloatArray) -> FloatArray:
    """Log-linear interpolation of positive values in wavelength, constant beyond the ends.

    Parameters
    ----------
    wavelengths, values : array, shape (nl,)
        Wavelengths, ascending [nm], and values there, positive.
    at : array, shape (n,)
        [nm]

    Examples
    --------
    >>> between([400.0, 500.0], [1.0, 100.0], np.array([450.0, 600.0])).round(6)
    array([ 10., 100.])
    """
    return np.exp(np.interp(at, np.asarray(wavelengths, float), np.log(values)))


def zenith_light(solution: Solution, altitude: float, observer: float = 0.0) -> FloatArray:
    """Radiance of the zenith over the sun's irradiance, shape (nl,). [sr⁻¹]

    Parameters
    ----------
    altitude : float
        True altitude of the sun. [deg]
    observer : float
        Altitude of the observer. [m]
    """
    light = solution.radiance(altitude=observer, sun_zenith=90.0 - altitude, view_zenith=0.0)
    return np.asarray(light) / solution.lights[0].irradiance


def ground_light(solution: Solution, altitude: float) -> FloatArray:
    """Global horizontal irradiance over that of the sun, shape (nl,). [1]"""
    found = solution.irradiance(altitude=0.0, sun_zenith=90.0 - altitude)
    return np.asarray(found["direct"] + found["diffuse"]) / solution.lights[0].irradiance


def ground_illuminance(solution: Solution, altitude: float) -> float:
    """Horizontal illuminance for a true altitude [deg] of the sun at 1 au. [lx]"""
    return illuminance(solution.wavelengths, ground_light(solution, altitude))


def paranal_zenith_v(solution: Solution, altitude: float) -> float:
    """V of the zenith at Paranal with night sky, for a sun altitude [deg]. [mag arcsec⁻²]"""
    light = zenith_light(solution, altitude, PARANAL)
    return with_night_sky(v_magnitude(solution.wavelengths, light))


def illuminance(wavelengths: ArrayLike, transmitted: ArrayLike) -> float:
    """Illuminance from irradiance over that of the sun outside the atmosphere. [lx]

    Parameters
    ----------
    wavelengths : array, shape (nl,)
        Wavelengths, ascending. [nm]
    transmitted : array, shape (nl,)
        Irradiance over the sun's at 1 au; positive. [1]
    """
    seen = cie_1931()
    nm = np.asarray(seen.wavelengths, float)
    ratio = between(wavelengths, transmitted, nm)
    luminous = seen.at(nm)[:, 1] * solar_irradiance(nm)
    return float(LUMINOUS_EFFICACY * np.trapezoid(ratio * luminous, nm))


def v_magnitude(wavelengths: ArrayLike, relative_radiance: ArrayLike) -> float:
    """V per square arcsecond from a radiance over the sun's irradiance. [mag arcsec⁻²]

    Parameters
    ----------
    relative_radiance : array, shape (nl,)
        Radiance over the sun's irradiance at 1 au; positive. [sr⁻¹]
    """
    nm = np.arange(V_RANGE[0], V_RANGE[1] + 0.5)
    light = between(wavelengths, relative_radiance, nm) * v_passband(nm) * solar_irradiance(nm)
    return float(v_band.v_magnitude(np.trapezoid(light, nm)))

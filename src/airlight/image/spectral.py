"""Spectra to linear sRGB: the contribution of each wavelength of a solution to each channel."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.xyz import XYZ_TO_RGB
from airlight.physics.cubic_curves import cubic_curve, spline_slopes
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.sun import solar_irradiance
from airlight.physics.units import values_in

Irradiance = Callable[[NDArray[np.float64]], ArrayLike] | ArrayLike

#: Colour of the sun as printed in the first Atmosphere Plus notes: per channel, the sun at one
#: wavelength times a constant "after normalization and scaling". Legacy value, not used.
LEGACY_SUN_COLOR: Final = (20.344770, 16.907042, 23.453083)

#: Wavelength grid of the matching functions, 360 to 830 in steps of 1. [nm]
EYE: Final[NDArray[np.float64]] = np.arange(360.0, 831.0)
#: Assumed power law of the sky's radiance relative to the sun's irradiance, at three wavelengths.
_SKY_POWER: Final = -3.0


@cache
def eye_rgb() -> NDArray[np.float64]:
    """Matching functions in linear sRGB times the trapezoid's weights, shape (471, 3). [nm]"""
    rgb = cie_1931().values @ XYZ_TO_RGB.T
    rgb[[0, -1]] *= 0.5
    rgb.flags.writeable = False
    return rgb


def on_eye_grid(irradiance: Irradiance | None) -> NDArray[np.float64]:
    """Irradiance at 360 to 830 nm, shape (471,). [W m⁻² nm⁻¹]"""
    if irradiance is None:
        return solar_irradiance(EYE)
    given = irradiance(EYE) if callable(irradiance) else irradiance
    values = np.broadcast_to(np.asarray(given, dtype=np.float64), EYE.shape)
    if not (np.isfinite(values).all() and (values >= 0.0).all()):
        raise ParameterError("irradiance", values.min(), "finite numbers, not below 0")
    return values


def irradiance_at(
    wavelengths: NDArray[np.float64], irradiance: Irradiance | None
) -> NDArray[np.float64]:
    """Irradiance at wavelengths, all above 0, shape (n,). [W m⁻² nm⁻¹]"""
    if irradiance is None:
        local = solar_irradiance(wavelengths)
    elif callable(irradiance):
        given = np.asarray(irradiance(wavelengths), dtype=np.float64)
        local = np.broadcast_to(given, wavelengths.shape)
    else:
        local = np.interp(wavelengths, EYE, on_eye_grid(irradiance))
    if not (local > 0.0).all():
        raise ParameterError("irradiance", float(local.min()), "above 0 at every wavelength")
    return local


def sun_color(irradiance: Irradiance | None = None) -> NDArray[np.float64]:
    r"""Linear sRGB of light with the sun's spectrum: the notes' spectral intensity I.

    .. math:: I = M^{-1} \int E(\lambda)\, (\bar x, \bar y, \bar z)(\lambda)\, d\lambda

    Parameters
    ----------
    irradiance : callable, array or None
        Spectrum: a function of wavelengths [nm], or values at 360, 361, … 830 nm; None is ASTM
        G-173 extraterrestrial. [W m⁻² nm⁻¹]

    Returns
    -------
    array, shape (3,)
        Colour weighted by the matching functions; 683 lm/W times its luminance is in lx. [W m⁻²]

    References
    ----------
    Atmosphere Plus notes 2, section 1.1.4: (213.865952, 190.346115, 183.806488) in float32.

    Examples
    --------
    >>> sun_color().round(5)
    array([213.86595, 190.34611, 183.80648])
    """
    return on_eye_grid(irradiance) @ eye_rgb()


def sky_factors(
    wavelengths: ArrayLike, irradiance: Irradiance | None = None
) -> NDArray[np.float64]:
    r"""Linear sRGB of a λ⁻³ sky per channel: the factors of a sky of three wavelengths.

    .. math:: k_c = \int M^{-1}_c (\bar x, \bar y, \bar z)\, E(\lambda)\, (\lambda/\lambda_c)^{-3}
              \, d\lambda

    Channel c is red for the longest wavelength, blue for the shortest. Multiplied by a sky's
    radiance over the sun's irradiance at λ_c it gives channel c. The error is some tens of ΔE at
    sunset, against less than one for 16 wavelengths.

    Parameters
    ----------
    wavelengths : array, shape (3,)
        Wavelengths in any order. [nm]
    irradiance : callable, array or None
        Spectrum of the star, as in ``sun_color``.

    Returns
    -------
    array, shape (3,)
        Factors of red, green and blue. [W m⁻²]

    References
    ----------
    Bruneton (2017), ``demo.cc``, *sky radiance to luminance factors*. His table of the sun holds
    means over 10 nm assigned to each interval's beginning, which gives (248.1, 193.2, 182.8); the 1
    nm spectrum gives the values below, 0.5 %, 0.6 % and -1.3 % off.

    Examples
    --------
    >>> sky_factors([680.0, 550.0, 440.0]).round(1)
    array([249.4, 194.4, 180.4])
    """
    longest_first = np.sort(checked_wavelengths(wavelengths))[::-1]
    if longest_first.shape != (3,):
        raise ParameterError("wavelengths", longest_first.tolist(), "three wavelengths")
    slope = (EYE[:, None] / longest_first) ** _SKY_POWER
    return np.asarray(on_eye_grid(irradiance) @ (eye_rgb() * slope))


def rgb_weights(
    wavelengths: ArrayLike, irradiance: Irradiance | None = None
) -> NDArray[np.float64]:
    """Weights W such that linear sRGB = radiance @ W.

    Radiance over the sun's irradiance is interpolated (cubic spline, constant beyond the ends),
    multiplied by the sun's spectrum and the matching functions, and integrated at 1 nm. Exactly
    **three** wavelengths get one channel each, by ``sky_factors``.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Wavelengths, distinct, any order, 300 to 900. [nm]
    irradiance : callable, array or None
        Spectrum of the star, as in ``sun_color``; a callable is also evaluated at ``wavelengths``,
        an array is interpolated there. The radiance must have been computed with the same spectrum.

    Returns
    -------
    array, shape (n, 3)
        Weights. [nm]

    Raises
    ------
    ParameterError
        If a wavelength is repeated or out of range, or an irradiance is not positive.

    Examples
    --------
    >>> at = default_wavelengths()
    >>> (solar_irradiance(at) @ rgb_weights(at) / sun_color()).round(12)  # the sun has its colour
    array([1., 1., 1.])
    """
    at = checked_wavelengths(wavelengths)
    local = irradiance_at(at, irradiance)
    if at.size == 3:
        weights = np.zeros((3, 3))
        weights[np.argsort(-at), [0, 1, 2]] = sky_factors(at, irradiance)
    else:
        spectrum = on_eye_grid(irradiance)
        weights = _interpolation(tuple(at.tolist())).T @ (spectrum[:, None] * eye_rgb())
    return weights / local[:, None]


@cache
def _interpolation(wavelengths: tuple[float, ...]) -> NDArray[np.float64]:
    """Values at 360 to 830 nm as a linear map of values at the wavelengths, shape (471, n)."""
    order = np.argsort(wavelengths)
    nodes = values_in(wavelengths, "nm", "wavelengths")[order]
    unit = np.eye(nodes.size)[order]
    if nodes.size == 1:
        return np.ones((EYE.size, 1))
    at = np.clip(EYE, nodes[0], nodes[-1])
    return cubic_curve(nodes, unit, spline_slopes(nodes, unit), at)


def checked_wavelengths(wavelengths: ArrayLike) -> NDArray[np.float64]:
    """Wavelengths as an array; at least one, distinct, 300 to 900, or ``ParameterError``. [nm]"""
    at = values_in(wavelengths, "nm", "wavelengths")
    if at.ndim != 1 or at.size == 0:
        raise ParameterError("wavelengths", wavelengths, "a list of at least one wavelength")
    outside = ~((at >= 300.0) & (at <= 900.0))
    if outside.any():
        raise ParameterError("wavelengths", float(at[outside][0]), "300 to 900 nm")
    if np.unique(at).size != at.size:
        raise ParameterError("wavelengths", at.tolist(), "distinct wavelengths")
    return at


def default_wavelengths(
    count: int = 16, low: float = 280.0, high: float = 1000.0
) -> NDArray[np.float64]:
    """Equidistant wavelengths for spectral colour.

    Their ends, 410 and 695 nm (390 and 710 nm for 20 and more), minimise the maximum colour error
    over typical skies among multiples of 5 nm. The largest ΔE (CIE 2000) of eleven skies is 2.9,
    1.2, 0.31, 0.10 and 0.09 for 8, 12, 16, 24 and 40 wavelengths, and 42 for three.

    Parameters
    ----------
    count : int
        Number of wavelengths, at least 1; three are 680, 550 and 440 nm, for the three-wavelength
        mode.
    low, high : float
        Limits, such as those of a planet; the ends are moved inside. [nm]

    Returns
    -------
    array, shape (count,)
        Wavelengths, ascending; three descend from red to blue. [nm]

    Raises
    ------
    ParameterError
        If the count is below 1, or no visible wavelength lies between the limits.

    Examples
    --------
    >>> default_wavelengths()
    array([410., 429., 448., 467., 486., 505., 524., 543., 562., 581., 600.,
           619., 638., 657., 676., 695.])
    >>> default_wavelengths(5, low=430.0, high=690.0)
    array([430., 495., 560., 625., 690.])
    """
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
        raise ParameterError("count", count, "a whole number, at least 1")
    first, last = (410.0, 695.0) if count < 20 else (390.0, 710.0)
    first, last = max(low, first), min(high, last)
    if not first < last:
        raise ParameterError("low, high", (low, high), "limits that include visible wavelengths")
    if count == 3 and low <= 440.0 and high >= 680.0:
        return np.array([680.0, 550.0, 440.0])
    return np.linspace(first, last, int(count)) if count > 1 else np.array([0.5 * (first + last)])

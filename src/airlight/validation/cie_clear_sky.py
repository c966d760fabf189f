r"""CIE standard clear sky, type 12: relative luminance, a fit to measured skies.

.. math:: \frac{L(Z, \chi)}{L_z} = \frac{f(\chi)\, \varphi(Z)}{f(Z_s)\, \varphi(0)}, \quad
          \varphi(Z) = 1 + a\, e^{b/\cos Z}, \quad
          f(\chi) = 1 + c\,(e^{d\chi} - e^{d\pi/2}) + e \cos^2\chi

with a = -1, b = -0.32, c = 10, d = -3, e = 0.45. It is a statistical fit, not a solution of
radiative transfer.

Source: CIE S 011/ISO 15469:2004, Spatial distribution of daylight: CIE standard general sky;
Darula & Kittler (2002), CIE general sky standard defining luminance distributions, eSim.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

#: Coefficients of type 12, "CIE standard clear sky, low luminance turbidity". [1], d per radian
A: Final = -1.0
B: Final = -0.32
C: Final = 10.0
D: Final = -3.0
E: Final = 0.45


def gradation(cosine: ArrayLike) -> FloatArray:
    """Gradation φ from zenith to horizon; 1 at the horizon. [1]

    Parameters
    ----------
    cosine : array, shape (...)
        Cosine of the view's zenith angle, 0 to 1. [1]
    """
    mu = np.asarray(cosine, dtype=float)
    return np.asarray(1.0 + A * np.exp(B / np.maximum(mu, 1e-300)))


def indicatrix(angle: ArrayLike) -> FloatArray:
    """Indicatrix f, which brightens towards the sun; 1 at a right angle. [1]

    Parameters
    ----------
    angle : array, shape (...)
        Angle χ between view and sun. [rad]
    """
    chi = np.asarray(angle, dtype=float)
    bright = C * (np.exp(D * chi) - np.exp(0.5 * D * np.pi))
    return np.asarray(1.0 + bright + E * np.square(np.cos(chi)))


def angle_to_sun(sun_zenith: ArrayLike, view_zenith: ArrayLike, azimuth: ArrayLike) -> FloatArray:
    """Angle χ between view and sun.

    Parameters
    ----------
    sun_zenith, view_zenith, azimuth : array, shapes that broadcast to (...)
        [deg]

    Returns
    -------
    array, shape (...)
        [rad]

    Examples
    --------
    >>> float(np.degrees(angle_to_sun(60.0, 30.0, 180.0)).round(9))
    90.0
    """
    sun, view, around = (np.radians(x) for x in (sun_zenith, view_zenith, azimuth))
    cosine = np.cos(sun) * np.cos(view) + np.sin(sun) * np.sin(view) * np.cos(around)
    return np.asarray(np.arccos(np.clip(cosine, -1.0, 1.0)))


def relative_luminance(
    sun_zenith: ArrayLike, view_zenith: ArrayLike, azimuth: ArrayLike
) -> FloatArray:
    """Luminance of the sky over that of its zenith.

    Parameters
    ----------
    sun_zenith, view_zenith : array, shapes that broadcast to (...)
        0 to 90. [deg]
    azimuth : array
        Azimuth between view and sun. [deg]

    Returns
    -------
    array, shape (...)
        [1]

    Examples
    --------
    >>> relative_luminance(60.0, [60.0, 0.0, 60.0], [180.0, 0.0, 0.0]).round(3).tolist()
    [1.236, 1.0, 13.479]
    """
    chi = angle_to_sun(sun_zenith, view_zenith, azimuth)
    here = indicatrix(chi) * gradation(np.cos(np.radians(view_zenith)))
    zenith = indicatrix(np.radians(sun_zenith)) * gradation(1.0)
    return np.asarray(here / zenith)

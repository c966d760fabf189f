"""Neutral points: unpolarised points of the sky in the principal plane, through sun and zenith."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from airlight.solver.solution import Solution

FloatArray = NDArray[np.float64]

#: Neutral points: above and below the sun, above and below the antisolar point.
NEUTRAL_POINTS: Final = ("Babinet", "Brewster", "Arago", "fourth")
#: Step of the zenith angles in the principal plane. [deg]
_STEP: Final = 0.25


def principal_plane(
    solution: Solution, *, sun_zenith: float, altitude: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Signed degree of polarisation in the principal plane, above the horizon.

    Parameters
    ----------
    solution : Solution
        Solution with polarised transfer.
    sun_zenith : float
        Zenith angle of the sun, 0 to 180. [deg]
    altitude : float
        Altitude of the observer. [m]

    Returns
    -------
    view_zenith : array, shape (n,)
        Zenith angles, positive on the sun's side. [deg]
    degree : array, shape (n, nl)
        -Q/I, positive for polarisation perpendicular to the plane; NaN where I is 0. [1]
    """
    view = np.arange(-90.0 + 0.5 * _STEP, 90.0, _STEP)  # without the zenith, of undefined plane
    light = solution.radiance(
        altitude=altitude, sun_zenith=sun_zenith, view_zenith=np.abs(view),
        azimuth=np.where(view < 0.0, 180.0, 0.0), stokes=True,
    )  # fmt: skip
    whole, along = (np.asarray(light.sel(stokes=name), np.float64) for name in "IQ")
    return view, np.where(whole > 0.0, -along / np.where(whole > 0.0, whole, 1.0), np.nan)


def neutral_points(
    solution: Solution, *, sun_zenith: float, altitude: float = 0.0
) -> dict[str, FloatArray]:
    """Neutral points of the sky in the principal plane.

    The degree of ``principal_plane`` is negative where multiple scattering, polarised parallel to
    the plane, outweighs single scattering, polarised perpendicular to it; neutral points are the
    zeros on either side. Of several zeros of one name the nearest to the sun, or to the antisolar
    point, is returned.

    Parameters
    ----------
    solution, sun_zenith, altitude :
        Arguments of ``principal_plane``.

    Returns
    -------
    dict of str to array, shape (nl,)
        Zenith angle of each of ``NEUTRAL_POINTS``, positive on the sun's side; NaN if below the
        horizon. [deg]

    References
    ----------
    Coulson (1988), Polarization and Intensity of Light in the Atmosphere, section 4.4; the fourth:
    Horváth, Bernáth, Suhai, Barta & Wehner (2002), JOSA A 19, 2085.
    """
    view, degree = principal_plane(solution, sun_zenith=sun_zenith, altitude=altitude)
    found = {name: np.full(degree.shape[1], np.nan) for name in NEUTRAL_POINTS}
    for k, values in enumerate(degree.T):
        nearest = dict.fromkeys(NEUTRAL_POINTS, np.inf)
        before, after = values[:-1], values[1:]
        for at in np.flatnonzero((before < 0.0) != (after < 0.0)):
            if not (np.isfinite(before[at]) and np.isfinite(after[at])):
                continue
            zero = view[at] + _STEP * before[at] / (before[at] - after[at])
            name, distance = _named(zero, sun_zenith)
            if distance < nearest[name]:
                nearest[name], found[name][k] = distance, zero
    return found


def _named(view: float, sun: float) -> tuple[str, float]:
    """Name of a neutral point, and its angle from the sun or from the antisolar point."""
    from_sun, from_opposite = view - sun, view - (sun - 180.0)
    if abs(from_sun) <= abs(from_opposite):
        return ("Babinet" if from_sun < 0.0 else "Brewster"), abs(from_sun)
    return ("Arago" if from_opposite > 0.0 else "fourth"), abs(from_opposite)

"""Frame of Stokes parameters: the meridian plane of a line of sight.

Q > 0 is polarised along e_θ, in the meridian plane (of line of sight and zenith), away from the
zenith; U > 0 half-way between e_θ and e_φ, towards larger azimuths. To an observer under the sky
larger azimuths are on the right, so that the angle of polarisation, atan2(U, Q)/2, is counted from
the vertical, counterclockwise. In a spherical shell the frame is constant along a line of sight.
Within the solvers azimuths are 0 to 180 degrees; on the other side of the star U changes sign.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import TYPE_CHECKING, Any, Final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.kernel import kernel

if TYPE_CHECKING:
    import xarray

FloatArray = NDArray[np.float64]

#: Names of the Stokes parameters; V is neglected.
STOKES: Final = ("I", "Q", "U")
#: Square of the sine of the zenith angle below which a line counts as vertical, with azimuth 0,
#: since rounding would lose it. [1]
VERTICAL: Final = 1e-9


@kernel
def star_plane(mu, mu_s, nu):
    """Rotation from the meridian plane of a line of sight to the scattering plane of the star.

    Parameters
    ----------
    mu, mu_s, nu : float
        Cosines of the zenith angles of line and star, and of the angle between them. [1]

    Returns
    -------
    cosine, sine : float
        Of twice the angle from e_θ to the star's side, about the line; a vertical line has
        azimuth 0. [1]

    Examples
    --------
    >>> star_plane(0.0, 0.0, 0.0)[0]  # both on the horizon: across the meridian
    -1.0
    """
    # Components of the star across the line, along e_θ with the other sign and along e_φ, over the
    # sine of the zenith angle; from that azimuth, single precision keeps them next to the zenith.
    sine_v = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
    sine_s = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    azimuth = (nu - mu * mu_s) / max(sine_v * sine_s, 1e-12)
    azimuth = min(max(azimuth, -1.0), 1.0)
    along = mu * sine_s * azimuth - sine_v * mu_s
    across = 0.0 - sine_s * sqrt((1.0 - azimuth) * (1.0 + azimuth))
    whole = along * along + across * across
    cosine, sine = 1.0, 0.0
    if whole > 1e-24 and sine_v * sine_v > VERTICAL:
        cosine = (along * along - across * across) / whole
        sine = 2.0 * along * across / whole
    return cosine, sine


def star_planes(mu: FloatArray, mu_s: FloatArray, nu: FloatArray) -> tuple[FloatArray, FloatArray]:
    """``star_plane`` for n lines of sight, each result of shape (n,)."""
    turns = np.array([star_plane(*line) for line in zip(mu, mu_s, nu, strict=True)])
    cosine, sine = turns.reshape(-1, 2).T
    return cosine, sine


def to_meridian(stokes: FloatArray, view_zenith: FloatArray, azimuth: FloatArray) -> FloatArray:
    """I, Q and U of a solver for the observer's azimuths, of either sign.

    Parameters
    ----------
    stokes : array, shape (n, 3, nl)
        I, Q and U for azimuths 0 to 180, vertical lines at azimuth 0.
    view_zenith, azimuth : array, shape (n,)
        Zenith angles of the views, and azimuths from the star. [deg]
    """
    around = np.radians(azimuth)
    out = stokes.copy()
    left = np.sin(around) < 0.0
    sine = np.sin(np.radians(view_zenith))
    vertical = sine**2 < VERTICAL
    turn = np.where(vertical, np.cos(np.radians(view_zenith)) * around, 0.0)
    q, u = stokes[:, 1], np.where((left & ~vertical)[:, None], -stokes[:, 2], stokes[:, 2])
    cosine, side = np.cos(2.0 * turn)[:, None], np.sin(2.0 * turn)[:, None]
    out[:, 1], out[:, 2] = q * cosine + u * side, u * cosine - q * side
    return out


@overload
def degree_of_polarisation(stokes: xarray.DataArray) -> xarray.DataArray: ...


@overload
def degree_of_polarisation(stokes: ArrayLike) -> FloatArray: ...


def degree_of_polarisation(stokes: Any) -> Any:
    """Degree of linear polarisation, √(Q² + U²)/I; 0 where I is 0.

    Parameters
    ----------
    stokes : xarray.DataArray or array, shape (3, ...)
        I, Q and U: a result of ``Solution.radiance(stokes=True)``, or an array with them on its
        first axis.

    Returns
    -------
    xarray.DataArray or array
        Degree, without the axis of the Stokes parameters. [1]

    Raises
    ------
    ParameterError
        If there are no I, Q and U.

    Examples
    --------
    >>> degree_of_polarisation([2.0, 0.6, -0.8]), degree_of_polarisation([0.0, 0.0, 0.0])
    (array(0.5), array(0.))
    """
    return _of_stokes(stokes, _degree, "degree of linear polarisation", "1")


@overload
def angle_of_polarisation(stokes: xarray.DataArray) -> xarray.DataArray: ...


@overload
def angle_of_polarisation(stokes: ArrayLike) -> FloatArray: ...


def angle_of_polarisation(stokes: Any) -> Any:
    """Angle of linear polarisation, atan2(U, Q)/2; 0 where light is unpolarised.

    Parameters
    ----------
    stokes : xarray.DataArray or array, shape (3, ...)
        I, Q and U, as for ``degree_of_polarisation``.

    Returns
    -------
    xarray.DataArray or array
        Angle from the meridian plane, counterclockwise to the observer, above -90 to 90, without
        the axis of the Stokes parameters. [deg]

    Raises
    ------
    ParameterError
        If there are no I, Q and U.

    Examples
    --------
    >>> angle_of_polarisation([[2.0, 2.0], [0.5, -0.5], [0.5, 0.0]])
    array([22.5, 90. ])
    """
    return _of_stokes(stokes, _angle, "angle of linear polarisation", "deg")


def _degree(i: FloatArray, q: FloatArray, u: FloatArray) -> FloatArray:
    lit = i > 0.0
    return np.asarray(np.where(lit, np.hypot(q, u) / np.where(lit, i, 1.0), 0.0))


def _angle(i: FloatArray, q: FloatArray, u: FloatArray) -> FloatArray:
    there = (i > 0.0) & ((q != 0.0) | (u != 0.0))
    # + 0.0 removes the sign of a zero: -90° and 90° are one angle, returned as 90°
    angle = 0.5 * np.degrees(np.arctan2(u + 0.0, q + 0.0))
    return np.asarray(np.where(there, angle, 0.0))


def _of_stokes(
    stokes: Any,
    formula: Callable[[FloatArray, FloatArray, FloatArray], FloatArray],
    name: str,
    unit: str,
) -> Any:
    """Results of a formula of I, Q and U, labelled where these are."""
    if hasattr(stokes, "coords"):
        there = (
            [str(one) for one in stokes.coords["stokes"].values] if "stokes" in stokes.dims else []
        )
        if not set(STOKES) <= set(there):
            raise ParameterError("stokes", tuple(stokes.dims), "I, Q and U along an axis stokes")
        parts = [stokes.sel(stokes=one, drop=True) for one in STOKES]
        found = parts[0].copy(data=formula(*(np.asarray(one, np.float64) for one in parts)))
        found.name = name.replace(" ", "_")
        found.attrs = {**parts[0].attrs, "units": unit, "long_name": name}
        return found
    array = np.asarray(stokes, np.float64)
    if array.ndim == 0 or array.shape[0] != len(STOKES):
        raise ParameterError("stokes", array.shape, "I, Q and U along the first axis")
    return formula(*array)

"""Frame of Stokes parameters: the meridian plane of a line of sight.

Q > 0 is light that swings in the plane of line and zenith, along e_θ, away from the zenith; U > 0
light that swings half-way between e_θ and e_φ, towards larger azimuths. To an observer under the
sky larger azimuths are on the right, so that the angle of polarisation, atan2(U, Q)/2, is counted
from the vertical, counterclockwise. In a spherical shell the frame is the same along a whole line.
Within the solvers azimuths are 0 to 180 degrees; on the other side of the star U has the other
sign.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: Names of the Stokes parameters of a line of sight; V is left out.
STOKES: Final = ("I", "Q", "U")
#: Sine of the zenith angle below which a line counts as vertical. [1]
_VERTICAL = 1e-12


def star_plane(mu: FloatArray, mu_s: FloatArray, nu: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Turn from the meridian plane of lines of sight to the plane of line and star.

    Parameters
    ----------
    mu, mu_s, nu : array, shape (n,)
        Cosines of the zenith angles of line and star, and of the angle between them. [1]

    Returns
    -------
    cosine, sine : array, shape (n,)
        Of twice the angle from e_θ to the star's side, about the line; a vertical line has
        azimuth 0. [1]

    Examples
    --------
    >>> cosine, sine = star_plane(np.array([0.0]), np.array([0.0]), np.array([0.0]))
    >>> cosine.round(12).tolist()  # both on the horizon: across the meridian
    [-1.0]
    """
    along = mu * nu - mu_s
    square = 1.0 - mu**2 - mu_s**2 - nu**2 + 2.0 * mu * mu_s * nu
    across = -np.sqrt(np.maximum(square, 0.0))
    whole = along**2 + across**2
    plain = (whole < 1e-24) | ((1.0 - mu) * (1.0 + mu) < _VERTICAL**2)
    safe = np.where(plain, 1.0, whole)
    cosine = np.where(plain, 1.0, (along**2 - across**2) / safe)
    sine = np.where(plain, 0.0, 2.0 * along * across / safe)
    return cosine, sine


def to_meridian(stokes: FloatArray, view_zenith: FloatArray, azimuth: FloatArray) -> FloatArray:
    """Turn a solver's I, Q and U to the frame of the observer's own azimuths.

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
    vertical = np.abs(sine) < 1e-9
    turn = np.where(vertical, np.cos(np.radians(view_zenith)) * around, 0.0)
    q, u = stokes[:, 1], np.where((left & ~vertical)[:, None], -stokes[:, 2], stokes[:, 2])
    cosine, side = np.cos(2.0 * turn)[:, None], np.sin(2.0 * turn)[:, None]
    out[:, 1], out[:, 2] = q * cosine + u * side, u * cosine - q * side
    return out

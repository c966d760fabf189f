"""Axes of places on a sphere: east, north and up."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def place_axes(latitude: ArrayLike, longitude: ArrayLike) -> NDArray[np.float64]:
    """Unit vectors east, north and up of places.

    Parameters
    ----------
    latitude, longitude : array, shape (...)
        The places. [deg]

    Returns
    -------
    array, shape (..., 3, 3)
        The three vectors, by rows; x is towards latitude and longitude 0, z towards the north
        pole. [1]

    Examples
    --------
    >>> place_axes(0.0, 90.0).round(12).tolist()
    [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]
    """
    phi, lam = np.broadcast_arrays(np.radians(latitude), np.radians(longitude))
    sin_phi, cos_phi, sin_lam, cos_lam = np.sin(phi), np.cos(phi), np.sin(lam), np.cos(lam)
    zero = np.zeros_like(phi)
    rows = (
        (-sin_lam, cos_lam, zero),
        (-sin_phi * cos_lam, -sin_phi * sin_lam, cos_phi),
        (cos_phi * cos_lam, cos_phi * sin_lam, sin_phi),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2) + 0.0

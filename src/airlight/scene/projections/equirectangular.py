"""The panorama of the whole sphere: columns are equal steps of azimuth, rows of elevation."""

from __future__ import annotations

import math

import numpy as np

from airlight.scene.projections.projection import FloatArray, Projection


def rays(x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float) -> FloatArray:
    """View vectors of a panorama whose middle looks straight ahead.

    The left and the right edge are one meridian, straight behind the camera.

    Parameters
    ----------
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Of the picture. [pixel]
    field_of_view : float
        A full turn; nothing else is allowed. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward). [1]

    Examples
    --------
    >>> top = rays(np.array([3.0]), np.array([0.0]), 8, 4, 2.0 * math.pi)
    >>> [round(float(v), 12) + 0.0 for v in top[0, 0]]
    [0.0, 1.0, 0.0]
    """
    azimuth = 2.0 * math.pi * (x / width - 0.5)
    elevation = math.pi * (0.5 - y / height)
    flat = np.cos(elevation)[:, np.newaxis]
    out = np.empty((len(y), len(x), 3))
    out[..., 0] = flat * np.sin(azimuth)
    out[..., 1] = np.sin(elevation)[:, np.newaxis]
    out[..., 2] = flat * np.cos(azimuth)
    return out


def pixel_angle(width: int, height: int, field_of_view: float) -> float:
    """Height of a pixel, and its width at the panorama's horizon. [rad]"""
    return math.pi / height


EQUIRECTANGULAR = Projection(
    name="equirectangular",
    rays=rays,
    pixel_angle=pixel_angle,
    fits=lambda width, height: width == 2 * height,
    shape="twice as wide as high",
    field_of_view=360.0,
    field_of_view_limits=(360.0, 360.0),
    look_zenith=90.0,
)

"""Texels of a map: solid angles, and lookup by direction."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.scene.camera import Camera

FloatArray = NDArray[np.float64]

#: Projections of maps.
MAPS: Final = ("equirectangular", "octahedral", "fisheye")


def check_map(camera: Camera) -> None:
    """Raise for an unsupported projection.

    Raises
    ------
    ParameterError
        If the projection is not in ``MAPS``.
    """
    if camera.projection not in MAPS:
        raise ParameterError("camera.projection", camera.projection, f"{', '.join(MAPS)}")


def texel_solid_angles(camera: Camera, rows: slice | None = None) -> FloatArray:
    """Solid angles of the texels of a panorama, an octahedral map or a fisheye.

    Exact for the first two; for a fisheye by the midpoint rule, with an error below the square of
    the texel angle, and 0 outside the image circle.

    Parameters
    ----------
    camera : Camera
        Camera that renders the map.
    rows : slice, optional
        Rows from the top; by default all.

    Returns
    -------
    array, shape (rows, width), or (rows, 1) where a row has one
        Solid angles. [sr]

    Examples
    --------
    >>> camera = Camera(projection="octahedral", width=8, height=8)
    >>> f"{8 * texel_solid_angles(camera).sum() / math.pi:.12g}"
    '4'
    """
    check_map(camera)
    height, width = camera.height, camera.width
    row = np.arange(height, dtype=np.float64)[slice(None) if rows is None else rows][:, None]
    if camera.projection == "octahedral":
        return np.full_like(row, 4.0 * math.pi / (width * height))
    if camera.projection == "equirectangular":
        above = np.sin(np.pi * (0.5 - row / height))
        below = np.sin(np.pi * (0.5 - (row + 1.0) / height))
        return np.asarray(2.0 * np.pi / width * (above - below))
    pixel = camera.pixel_angle
    radius = np.hypot(np.arange(width) + 0.5 - 0.5 * width, row + 0.5 - 0.5 * height)
    inside = radius <= 0.5 * min(width, height)
    return np.where(inside, pixel * pixel * np.sinc(radius * pixel / np.pi), 0.0)


def texel_positions(camera: Camera, directions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Image positions of directions: the inverse projection.

    Parameters
    ----------
    camera : Camera
        Camera that renders the map: a panorama, an octahedral map or a fisheye.
    directions : array, shape (n, 3)
        Unit vectors in the observer's local frame.

    Returns
    -------
    x, y : array, shape (n,)
        Distances from the left and the top edge; NaN outside the image circle. [pixel]

    Examples
    --------
    >>> camera = Camera(projection="equirectangular", width=8, height=4)
    >>> texel_positions(camera, np.array([[0.0, -1.0, 0.0]]))  # on the right of straight ahead
    (array([6.]), array([2.]))
    """
    check_map(camera)
    right, up, forward = (directions @ camera.axes.T).T
    width, height = camera.width, camera.height
    if camera.projection == "equirectangular":
        x = width * (0.5 + np.arctan2(right, forward) / (2.0 * np.pi))
        return x, height * (0.5 - np.arctan2(up, np.hypot(right, forward)) / np.pi)
    if camera.projection == "octahedral":
        r = np.sqrt(np.maximum(1.0 - np.abs(up), 0.0))
        b = r * np.arctan2(np.abs(forward), np.abs(right)) / (0.5 * np.pi)
        a = r - b
        a, b = np.where(up < 0.0, 1.0 - b, a), np.where(up < 0.0, 1.0 - a, b)
        x = 0.5 * width * (1.0 + np.copysign(a, right))
        return x, 0.5 * height * (1.0 + np.copysign(b, forward))
    level = np.hypot(right, up)
    radius = np.arctan2(level, forward) / camera.pixel_angle
    radius = np.where(radius <= 0.5 * min(width, height), radius, np.nan)
    scale = np.divide(radius, level, out=np.zeros_like(level), where=level > 0.0)
    return 0.5 * width + scale * right, 0.5 * height - scale * up


def texels_of(camera: Camera, directions: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Row and column of the texel of each direction; -1 outside the map."""
    x, y = texel_positions(camera, directions)
    shown = np.isfinite(x)
    column = np.where(shown, np.clip(np.floor(np.where(shown, x, 0.0)), 0, camera.width - 1), -1)
    row = np.where(shown, np.clip(np.floor(np.where(shown, y, 0.0)), 0, camera.height - 1), -1)
    return row.astype(np.intp), column.astype(np.intp)


def reaching_poles(rgb: NDArray[np.float32]) -> NDArray[np.float32]:
    """Resampled rows of a panorama whose first and last rows are exactly the poles.

    For programs that map the zenith angle θ to row θ (height - 1)/180° instead of θ height/180° -
    ½, which is half a row off at the poles. Linear interpolation conserves the radiance to second
    order in the row height and shifts rows near the horizon by less than 0.5/height.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Radiance at the row centres; ``height`` is 2 or more.

    Returns
    -------
    array, shape (height, width, 3)
        Radiance at equidistant zenith angles from 0 to 180°.

    Examples
    --------
    >>> rows = np.array([22.5, 67.5, 112.5, 157.5], np.float32)[:, None, None]
    >>> reaching_poles(rows).ravel()  # the middles of rows at the poles are the first and last
    array([ 22.5,  60. , 120. , 157.5], dtype=float32)
    """
    height = len(rgb)
    place = np.clip(np.arange(height) * height / (height - 1.0) - 0.5, 0.0, height - 1.0)
    lower = np.minimum(place.astype(np.intp), height - 2)
    share = (place - lower)[:, None, None].astype(np.float32)
    return np.asarray(rgb[lower] * (1.0 - share) + rgb[lower + 1] * share)

"""Pixel positions of directions: the inverse of any projection."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.scene.camera import Camera
from airlight.scene.projections.projected import projected_rays

FloatArray = NDArray[np.float64]

#: Pixels per side of the grid of initial guesses.
_GRID: Final = 160
#: Number of Newton steps, and step of the difference quotients in pixels.
_STEPS: Final = 8
_SLOPE: Final = 1e-3
#: Largest remaining angle to the direction, relative to the angle of a pixel.
_NEAR: Final = 0.05


def pixel_positions(
    camera: Camera, directions: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pixel positions of directions, and the solid angle of a pixel there.

    Parameters
    ----------
    camera : Camera
        Camera; its orientation is ignored.
    directions : array, shape (n, 3)
        Unit vectors in the camera's frame: right, up, forward.

    Returns
    -------
    x, y : array, shape (n,)
        Position from the left and the top edge; NaN for directions outside the frame. [pixel]
    solid_angle : array, shape (n,)
        Solid angle of a pixel. [sr]

    Notes
    -----
    Newton's method on the projection itself, from the nearest point of a coarse grid.

    Examples
    --------
    >>> camera = Camera(width=80, height=40, field_of_view=60.0)
    >>> x, y, _ = pixel_positions(camera, np.array([[0.0, 0.0, 1.0]]))
    >>> x.round(6), y.round(6)
    (array([40.]), array([20.]))
    """
    from scipy.spatial import cKDTree

    width, height = camera.width, camera.height
    across, down = _centres(width), _centres(height)
    grid = _rays(camera, across, down).reshape(-1, 3)
    shown = np.flatnonzero(np.any(grid != 0.0, axis=-1))
    # From the centre of a cell it is at most its diagonal to a direction within it.
    reach = 3.0 * max(width / across.size, height / down.size) * camera.pixel_angle
    distance, nearest = cKDTree(grid[shown]).query(directions, distance_upper_bound=max(reach, 0.2))
    near = np.isfinite(distance)
    cell = shown[np.where(near, nearest, 0)]
    x, y = across[cell % across.size], down[cell // across.size]
    solid = np.full(len(directions), np.nan)
    found = np.zeros(len(directions), bool)
    for k in np.flatnonzero(near):
        x[k], y[k], solid[k], found[k] = _newton(camera, directions[k], x[k], y[k])
    x[~found] = y[~found] = solid[~found] = np.nan
    return x, y, solid


def _centres(side: int) -> FloatArray:
    """Centres of the cells of the coarse grid along a side. [pixel]"""
    count = min(_GRID, side)
    return np.asarray((np.arange(count) + 0.5) * (side / count), np.float64)


def _newton(
    camera: Camera, direction: FloatArray, x: float, y: float
) -> tuple[float, float, float, bool]:
    solid = math.nan
    for _ in range(_STEPS):
        at = _rays(camera, np.array([x, x + _SLOPE]), np.array([y, y + _SLOPE]))
        if not at.any(axis=-1).all():
            return x, y, solid, False
        right, below = (at[0, 1] - at[0, 0]) / _SLOPE, (at[1, 0] - at[0, 0]) / _SLOPE
        slopes = np.stack([right, below], axis=1)
        step = np.linalg.lstsq(slopes, direction - at[0, 0], rcond=None)[0]
        solid = float(np.linalg.norm(np.cross(right, below)))
        x = float(min(max(x + step[0], 0.0), camera.width - 2.0 * _SLOPE))
        y = float(min(max(y + step[1], 0.0), camera.height - 2.0 * _SLOPE))
        if max(abs(step)) < 1e-6:
            break
    error = np.linalg.norm(_rays(camera, np.array([x]), np.array([y]))[0, 0] - direction)
    return x, y, solid, bool(error < _NEAR * math.sqrt(solid))


def _rays(camera: Camera, x: FloatArray, y: FloatArray) -> FloatArray:
    assert camera.field_of_view is not None
    return projected_rays(
        camera.projection, x, y, camera.width, camera.height, math.radians(camera.field_of_view)
    )

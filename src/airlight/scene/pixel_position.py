"""Pixel positions of directions: the inverse of any projection."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.scene.camera import Camera
from airlight.scene.projections.projected import projected_points, projected_rays

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
    x[near], y[near], solid[near], found[near] = _newton(camera, directions[near], x[near], y[near])
    x[~found] = y[~found] = solid[~found] = np.nan
    return x, y, solid


def _centres(side: int) -> FloatArray:
    """Centres of the cells of the coarse grid along a side. [pixel]"""
    count = min(_GRID, side)
    return np.asarray((np.arange(count) + 0.5) * (side / count), np.float64)


def _newton(
    camera: Camera, directions: FloatArray, x: FloatArray, y: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, NDArray[np.bool_]]:
    """Positions, solid angles of a pixel there, and whether it shows the direction."""
    solid, inside = np.full(x.size, np.nan), np.ones(x.size, bool)
    active = np.arange(x.size)
    for _ in range(_STEPS):
        across, down = x[active], y[active]
        at = _points(camera, across, down)
        right, below = (
            _points(camera, across + _SLOPE, down),
            _points(camera, across, down + _SLOPE),
        )
        shown = at.any(axis=1) & right.any(axis=1) & below.any(axis=1)
        inside[active[~shown]] = False
        active, at, right, below = active[shown], at[shown], right[shown], below[shown]
        right, below, off = (right - at) / _SLOPE, (below - at) / _SLOPE, directions[active] - at
        # Least squares of off = right dx + below dy; the determinant is the solid angle squared.
        rr, bb, rb = _dot(right, right), _dot(below, below), _dot(right, below)
        ro, bo = _dot(right, off), _dot(below, off)
        square = np.maximum(rr * bb - rb**2, 1e-300)
        dx, dy = (bb * ro - rb * bo) / square, (rr * bo - rb * ro) / square
        solid[active] = np.sqrt(square)
        x[active] = np.clip(x[active] + dx, 0.0, camera.width - 2.0 * _SLOPE)
        y[active] = np.clip(y[active] + dy, 0.0, camera.height - 2.0 * _SLOPE)
        active = active[np.maximum(np.abs(dx), np.abs(dy)) >= 1e-6]
        if not active.size:
            break
    error = np.linalg.norm(_points(camera, x, y) - directions, axis=1)
    return x, y, solid, inside & (error < _NEAR * np.sqrt(solid))


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("ij,ij->i", a, b), np.float64)


def _rays(camera: Camera, x: FloatArray, y: FloatArray) -> FloatArray:
    return projected_rays(camera.projection, x, y, *_frame(camera))


def _points(camera: Camera, x: FloatArray, y: FloatArray) -> FloatArray:
    return projected_points(camera.projection, x, y, *_frame(camera))


def _frame(camera: Camera) -> tuple[int, int, float]:
    """Width and height [pixel], and field of view [rad]."""
    assert camera.field_of_view is not None
    return camera.width, camera.height, math.radians(camera.field_of_view)

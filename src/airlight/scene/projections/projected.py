"""View vectors of any projection by index: one point, a grid of pixels, or many points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.choice import chosen_kernel
from airlight.scene.projections import PROJECTIONS

FloatArray = NDArray[np.float64]

#: ``projected_ray(projection, x, y, width, height, field_of_view)``: ``Projection.ray`` of the
#: projection with that index in ``PROJECTIONS``, counted from 0.
projected_ray = chosen_kernel(
    "projected_ray", [projection.ray for projection in PROJECTIONS.values()], __name__
)


@compiled_loop
def _fill(projection, x, y, width, height, field_of_view, out):
    for row in range(out.shape[0]):
        across, down = x[min(row, x.shape[0] - 1)], y[min(row, y.shape[0] - 1)]
        for column in range(out.shape[1]):
            at = down[min(column, down.size - 1)]
            ray = projected_ray(projection, across[column], at, width, height, field_of_view)
            out[row, column, 0], out[row, column, 1], out[row, column, 2] = ray


def projected_rays(
    projection: str, x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float
) -> FloatArray:
    """View vectors of a grid of pixels in the camera's frame.

    Parameters
    ----------
    projection : str
        Name in ``PROJECTIONS``.
    x, y : array, shape (nx,) and (ny,)
        Pixel coordinates from the left and the top edge. [pixel]
    width, height : int
        Size of the frame. [pixel]
    field_of_view : float
        Field of view of the projection's ``ray``. [rad]

    Returns
    -------
    array, shape (ny, nx, 3)
        Unit vectors (right, up, forward), zero outside the projection. [1]

    Examples
    --------
    >>> projected_rays("fisheye", np.array([2.0]), np.array([2.0]), 4, 4, 3.0)
    array([[[0., 0., 1.]]])
    """
    out = np.empty((len(y), len(x), 3))
    index = list(PROJECTIONS).index(projection)
    _fill(index, x[None, :], y[:, None], width, height, field_of_view, out)
    return out


def projected_points(
    projection: str, x: FloatArray, y: FloatArray, width: int, height: int, field_of_view: float
) -> FloatArray:
    """View vectors of points in the camera's frame.

    Parameters
    ----------
    projection, width, height, field_of_view :
        Arguments of ``projected_rays``.
    x, y : array, shape (n,)
        Pixel coordinates from the left and the top edge. [pixel]

    Returns
    -------
    array, shape (n, 3)
        Unit vectors (right, up, forward), zero outside the projection. [1]

    Examples
    --------
    >>> projected_points("fisheye", np.array([2.0]), np.array([2.0]), 4, 4, 3.0)
    array([[0., 0., 1.]])
    """
    out = np.empty((1, len(x), 3))
    index = list(PROJECTIONS).index(projection)
    _fill(index, x[None, :], y[None, :], width, height, field_of_view, out)
    return np.asarray(out[0])

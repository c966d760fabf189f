"""Conversion of depth passes to distances along each ray."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.composition.pinhole import Pinhole
from airlight.errors import ParameterError

FloatArray = NDArray[np.float64]

#: Kinds of a depth pass.
KINDS: Final = ("auto", "planar", "distance", "position", "inverse")
#: Depth from which a pixel has no surface: renderers write 1e10, 1e11 or infinity. [scene units]
FAR: Final = 1e9


def kind_of(depth: NDArray[np.floating], kind: str) -> str:
    """Kind of a depth pass; ``auto`` means positions with three channels, otherwise planar.

    Parameters
    ----------
    depth : array, shape (h, w) or (h, w, 3)
        Depth pass.
    kind : str
        One of ``KINDS``.
    """
    if kind not in KINDS:
        raise ParameterError("depth_kind", kind, ", ".join(KINDS))
    if kind == "auto":
        kind = "position" if depth.ndim == 3 else "planar"
    if depth.ndim != (3 if kind == "position" else 2):
        shape = "(h, w, 3)" if kind == "position" else "(h, w)"
        raise ParameterError("depth", depth.shape, f"shape {shape} for {kind!r}")
    return kind


def distances(
    depth: NDArray[np.floating], kind: str, camera: Pinhole, rows: slice, metres_per_unit: float
) -> FloatArray:
    """Distances along the rays of rows of pixels.

    Parameters
    ----------
    depth : array, shape (rows, width) or (rows, width, 3)
        Depth pass of these rows. Planar: along the optical axis; distance: along the ray; position:
        surface point in scene coordinates; inverse: 1 over planar. [scene units]
    kind : str
        Result of ``kind_of``.
    camera : Pinhole
        Camera of the image.
    metres_per_unit : float
        Length of the scene's unit. [m]

    Returns
    -------
    array, shape (rows, width)
        Distance; infinite without a surface: for NaN, 0 or less, ``FAR`` or more, and a position of
        exactly 0, 0, 0. [m]
    """
    given = np.asarray(depth, np.float64)
    if kind == "position":
        away = np.sqrt(np.sum(np.square(given - camera.position), axis=-1))
        away[~given.any(axis=-1)] = np.inf
    elif kind == "inverse":
        away = np.full(given.shape, np.inf)
        np.divide(1.0, given, out=away, where=given > 1.0 / FAR)
    else:
        away = given.copy()
    nothing = ~((away > 0.0) & (away < FAR))
    if kind in ("planar", "inverse"):
        with np.errstate(invalid="ignore"):
            away = away * np.linalg.norm(camera.rays(rows), axis=-1)
    away = away * metres_per_unit
    away[nothing] = np.inf
    return np.asarray(away)


def filled(away: FloatArray, partial: NDArray[np.bool_], reach: int) -> FloatArray:
    """Fill partially covered pixels without depth from the nearest surface.

    A depth pass has a single sample per pixel, which may miss a surface on its silhouette.

    Parameters
    ----------
    away : array, shape (h, w)
        Distances, infinite without a surface. [m]
    partial : array of bool, shape (h, w)
        Pixels that a surface covers partially.
    reach : int
        Maximum distance of the surface. [pixel]

    Examples
    --------
    >>> filled(np.array([[5.0, np.inf, np.inf]]), np.array([[False, True, False]]), 2)
    array([[ 5.,  5., inf]])
    """
    lacking = partial & np.isinf(away)
    if not lacking.any() or np.isinf(away).all():
        return away
    from scipy.ndimage import distance_transform_edt

    gap, nearest = distance_transform_edt(np.isinf(away), return_indices=True)
    found = away[tuple(nearest)]
    return np.where(lacking & (gap <= reach), found, away)

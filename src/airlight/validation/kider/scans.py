"""Measured skies: files, score of a model, and its lower limit."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.studies.fit.scans import Scans, read_scan_file

FloatArray = NDArray[np.float64]

#: Sky radiance above Ithaca, New York, on 27 May 2013.
FILE: Final = "kider2013-05-27.npz"
#: Scores are given in this unit. [mW/W]
MILLI: Final = 1e3


def read_scans(folder: Path) -> Scans:
    """Read the scans of 27 May 2013 from a folder of reference data."""
    return read_scan_file(folder / FILE)


def rmse_per_scan(got: FloatArray, measured: FloatArray) -> FloatArray:
    """Root mean square error over directions and wavelengths, scan by scan.

    Parameters
    ----------
    got, measured : array, shape (ns, nd, nl)
        [W m⁻² sr⁻¹ nm⁻¹]

    Returns
    -------
    array, shape (ns,)
        [mW m⁻² sr⁻¹ nm⁻¹]

    Examples
    --------
    >>> zero = np.zeros((2, 3, 4))
    >>> rmse_per_scan(zero + np.array([0.003, 0.004])[:, None, None], zero)
    array([3., 4.])
    """
    return np.asarray(MILLI * np.sqrt(np.square(got - measured).mean(axis=(1, 2))))


def total_rmse(got: FloatArray, measured: FloatArray) -> float:
    """Score of a model: root of the mean over scans of their squared RMSE.

    Returns
    -------
    float
        [mW m⁻² sr⁻¹ nm⁻¹]

    References
    ----------
    Bruneton (2017), A Qualitative and Quantitative Evaluation of 8 Clear Sky Models, IEEE TVCG
    23, 2641. doi:10.1109/TVCG.2016.2622272

    Examples
    --------
    >>> zero = np.zeros((2, 3, 4))
    >>> score = total_rmse(zero + np.array([0.003, 0.004])[:, None, None], zero)
    >>> f"{score:.4f}"  # sqrt((9 + 16) / 2)
    '3.5355'
    """
    return float(np.sqrt(np.square(rmse_per_scan(got, measured)).mean()))


def best_factor(got: FloatArray, measured: FloatArray) -> float:
    """Factor of a model's radiances that minimises its error. [1]

    Parameters
    ----------
    got, measured : array, shape (ns, nd, nl)
        Radiances in the same unit.
    """
    return float((got * measured).sum() / np.square(got).sum())


def symmetric_part(scans: Scans) -> FloatArray:
    """Measured skies, symmetrised about the sun's vertical plane.

    Each radiance is averaged with that in the mirrored direction, interpolated in azimuth by
    Catmull-Rom cubics. The error of a horizontally homogeneous model is at least the difference.

    Returns
    -------
    array, shape (ns, nd, nl)
        [W m⁻² sr⁻¹ nm⁻¹]
    """
    out = np.empty_like(scans.radiance)
    for scan in range(len(scans.time)):
        heights = np.round(scans.view_zenith[scan], 3)
        for height in np.unique(heights):
            ring = np.flatnonzero(heights == height)
            values, azimuth = scans.radiance[scan, ring], scans.azimuth[scan, ring]
            mirrored = values if ring.size < 4 else _around_ring(values, azimuth, -azimuth)
            out[scan, ring] = 0.5 * (values + mirrored)
    return out


def _around_ring(values: FloatArray, azimuth: FloatArray, at: FloatArray) -> FloatArray:
    """Interpolate values (n, nl) at evenly spaced azimuths [deg] by a periodic cubic."""
    order = np.argsort(azimuth % 360.0)
    start = (azimuth % 360.0)[order[0]]
    steps = ((at - start) % 360.0) * (len(order) / 360.0)
    first = np.floor(steps).astype(int)
    t = (steps - first)[:, None]
    a, b, c, d = (values[order[(first + k) % len(order)]] for k in (-1, 0, 1, 2))
    slope, bend, turn = c - a, 2.0 * a - 5.0 * b + 4.0 * c - d, 3.0 * (b - c) + d - a
    return np.asarray(b + 0.5 * t * (slope + t * (bend + t * turn)))

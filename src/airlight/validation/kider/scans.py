"""Fifteen measured skies: their file, the score of a model against them, and its floor."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.solvers.solution import Solution

FloatArray = NDArray[np.float64]

#: Sky radiance above Ithaca, New York, on 27 May 2013.
FILE: Final = "kider2013-05-27.npz"
#: Scores are given in this unit. [mW/W]
MILLI: Final = 1e3


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Measured sky radiance, ``ns`` scans of ``nd`` directions at ``nl`` wavelengths.

    Attributes
    ----------
    time : tuple of str, length ns
        Local time of day.
    sun_zenith : array, shape (ns,)
        [deg]
    view_zenith, azimuth : array, shape (ns, nd)
        Zenith angle and azimuth of the view; azimuth 0 is on the sun's side. [deg]
    wavelengths : array, shape (nl,)
        [nm]
    radiance : array, shape (ns, nd, nl)
        [W m⁻² sr⁻¹ nm⁻¹]
    solar_irradiance, ground_albedo : array, shape (nl,)
        Values given to all published models. [W m⁻² nm⁻¹], [1]
    """

    time: tuple[str, ...]
    sun_zenith: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray
    wavelengths: FloatArray
    radiance: FloatArray
    solar_irradiance: FloatArray
    ground_albedo: FloatArray

    @property
    def angle_from_sun(self) -> FloatArray:
        """Angle between view and sun, shape (ns, nd). [deg]"""
        view, sun = np.radians(self.view_zenith), np.radians(self.sun_zenith)[:, None]
        around = np.cos(np.radians(self.azimuth))
        nu = np.cos(view) * np.cos(sun) + np.sin(view) * np.sin(sun) * around
        return np.asarray(np.degrees(np.arccos(np.clip(nu, -1.0, 1.0))))

    def seen(
        self,
        solution: Solution,
        view_zenith: FloatArray | None = None,
        azimuth: FloatArray | None = None,
    ) -> FloatArray:
        """Radiance of a solution in the measured directions, shape (ns, nd, nl).

        Parameters
        ----------
        solution : Solution
            Solution at ``wavelengths``, whose ground is at the instrument's altitude.
        view_zenith, azimuth : array, shape (ns, nd), optional
            Other directions than the measured ones. [deg]

        Returns
        -------
        array
            [W m⁻² sr⁻¹ nm⁻¹]
        """
        zenith = self.view_zenith if view_zenith is None else view_zenith
        around = self.azimuth if azimuth is None else azimuth
        got = solution.radiance(
            altitude=0.0, sun_zenith=self.sun_zenith[:, None], view_zenith=zenith, azimuth=around
        )
        return np.asarray(got.values, dtype=np.float64)


def read_scans(folder: Path) -> Scans:
    """Read the scans from a folder of reference data.

    Parameters
    ----------
    folder : Path
        Folder of reference data, as given by ``--data``.

    Raises
    ------
    FileError
        If the file cannot be read, lacks an array, or has impossible shapes or values.
    """
    file = folder / FILE
    try:
        with file.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            time = tuple(str(one)[11:16].replace(".", ":") for one in stored["time"])
            arrays = {
                ours: np.asarray(stored[theirs], dtype=np.float64)
                for ours, theirs in (
                    ("sun_zenith", "sun_zenith_deg"),
                    ("view_zenith", "view_zenith_deg"),
                    ("azimuth", "relative_azimuth_deg"),
                    ("wavelengths", "wavelength_nm"),
                    ("radiance", "radiance"),
                    ("solar_irradiance", "solar_irradiance"),
                    ("ground_albedo", "ground_albedo"),
                )
            }
    except KeyError as error:
        raise FileError(file, f"lacks an array: {error}") from error
    except (OSError, ValueError, zipfile.BadZipFile) as error:
        raise FileError(file, f"cannot be read: {error}") from error
    scans = Scans(time=time, **arrays)
    shape = scans.radiance.shape
    shapes = {
        "sun_zenith": shape[:1],
        "view_zenith": shape[:2],
        "azimuth": shape[:2],
        "wavelengths": shape[2:],
        "solar_irradiance": shape[2:],
        "ground_albedo": shape[2:],
    }
    if len(shape) != 3 or len(time) != shape[0]:
        raise FileError(file, f"radiance is {shape} for {len(time)} scans")
    for name, expected in shapes.items():
        if arrays[name].shape != expected:
            raise FileError(file, f"{name} is {arrays[name].shape}, not {expected}")
    for name, values in arrays.items():
        if not np.isfinite(values).all():
            raise FileError(file, f"{name} holds what is no number")
    return scans


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

    Parameters
    ----------
    got, measured : array, shape (ns, nd, nl)
        [W m⁻² sr⁻¹ nm⁻¹]

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
    """Common factor for all of a model's radiances that minimises its error. [1]

    Parameters
    ----------
    got, measured : array, shape (ns, nd, nl)
        Radiances in the same unit.
    """
    return float((got * measured).sum() / np.square(got).sum())


def symmetric_part(scans: Scans) -> FloatArray:
    """The measured skies made symmetric about the sun's vertical.

    Each radiance becomes the mean of itself and of that in the mirrored direction, which is
    interpolated along its ring (the directions at one zenith angle, evenly spaced in azimuth) by
    Catmull and Rom's cubic. No model without clouds can be nearer to the measurement.

    Parameters
    ----------
    scans : Scans

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

"""Residuals of a fit by wavelength, view zenith angle and angle from the sun."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.studies.fit.fit_sky import SkyFit
from airlight.studies.fit.measurements import IntArray, Measurements
from airlight.studies.fit.photograph import Photograph

FloatArray = NDArray[np.float64]

#: Edges of the bins of angles from the sun and from the zenith. [deg]
SUN_EDGES: Final = (0, 4, 8, 15, 25, 35, 45, 55, 65, 75, 90, 110, 130, 180)
ZENITH_EDGES: Final = (0, 10, 20, 30, 40, 50, 60, 70, 75, 80, 85, 90, 120, 180)
#: Wavelengths that represent a photograph's channels. [nm]
CHANNELS: Final = (610.0, 550.0, 465.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Residuals:
    """Measured and predicted values with their coordinates, n values.

    Attributes
    ----------
    measured, predicted, first, sigma : array, shape (n,)
        Values, predictions of the fit and of its start, standard deviations; one unit.
    wavelength : array, shape (n,)
        Wavelength, or representative wavelength of a channel of a photograph. [nm]
    view_zenith, azimuth, from_sun, sun_zenith : array, shape (n,)
        [deg]
    scan : array of int, shape (n,)
    scans : tuple of str
    unit : str
        Unit of the values.
    """

    measured: FloatArray
    predicted: FloatArray
    first: FloatArray
    sigma: FloatArray
    wavelength: FloatArray
    view_zenith: FloatArray
    azimuth: FloatArray
    from_sun: FloatArray
    sun_zenith: FloatArray
    scan: IntArray
    scans: tuple[str, ...]
    unit: str

    @classmethod
    def of_measurements(
        cls, data: Measurements, predicted: FloatArray, first: FloatArray, sigma: FloatArray
    ) -> Residuals:
        """Residuals of radiances, from predictions in the order of the data."""
        names = ("wavelength", "view_zenith", "azimuth", "sun_zenith", "scan", "scans")
        return cls(
            measured=data.radiance,
            predicted=predicted,
            first=first,
            sigma=sigma,
            from_sun=data.angle_from_sun,
            unit="W m⁻² sr⁻¹ nm⁻¹",
            **{name: getattr(data, name) for name in names},
        )

    @property
    def relative(self) -> FloatArray:
        """Relative residuals, shape (n,), with a lower limit of the denominator. [%]"""
        least = 1e-3 * float(np.median(np.abs(self.measured)))
        return 100.0 * (self.predicted - self.measured) / np.maximum(np.abs(self.measured), least)

    def rms(self, chosen: NDArray[np.bool_] | slice = slice(None)) -> float:
        """Root mean square difference, in the unit of the values."""
        residual = (self.predicted - self.measured)[chosen]
        return float(np.sqrt(np.square(residual).mean()))


def residuals_of(sky: SkyFit) -> Residuals:
    """Residuals of a fit."""
    found, data = sky.fitted, sky.data
    if isinstance(data, Measurements):
        return Residuals.of_measurements(data, found.predicted, sky.first, found.sigma)
    return _of_photograph(sky, data)


def _of_photograph(sky: SkyFit, data: Photograph) -> Residuals:
    count = data.view_zenith.size

    def each(values: ArrayLike) -> FloatArray:
        return np.repeat(np.asarray(values, dtype=np.float64), 3)

    return Residuals(
        measured=data.rgb.ravel(),
        predicted=sky.fitted.predicted,
        first=sky.first,
        sigma=sky.fitted.sigma,
        wavelength=np.tile(CHANNELS, count),
        view_zenith=each(data.view_zenith),
        azimuth=each(data.azimuth),
        from_sun=each(data.angle_from_sun),
        sun_zenith=np.full(3 * count, data.sun_zenith),
        scan=np.zeros(3 * count, np.int64),
        scans=("photograph",),
        unit="of the picture",
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Binned:
    """Residuals in bins.

    Attributes
    ----------
    middle : array, shape (b,)
        Centre of each non-empty bin.
    bias, spread : array, shape (b,)
        Mean and root mean square of the relative differences. [%]
    share : array, shape (b,)
        Fraction of the sum of squared differences. [1]
    count : array of int, shape (b,)
    """

    middle: FloatArray
    bias: FloatArray
    spread: FloatArray
    share: FloatArray
    count: IntArray


def binned(residuals: Residuals, by: FloatArray, edges: ArrayLike | None = None) -> Binned:
    """Residuals in bins of an angle, or at each value if there are no edges.

    Parameters
    ----------
    by : array, shape (n,)
        Binned quantity.
    edges : array, optional
        Edges of the bins.
    """
    squares = np.square(residuals.predicted - residuals.measured)
    total = max(float(squares.sum()), np.finfo(float).tiny)
    if edges is None:
        middles = np.unique(by)
        chosen = [by == one for one in middles]
    else:
        pairs = list(pairwise(np.asarray(edges, dtype=np.float64)))
        middles = np.array([0.5 * (a + b) for a, b in pairs])
        chosen = [(by >= a) & (by < b) for a, b in pairs]
    kept = [k for k, one in enumerate(chosen) if one.any()]
    relative = residuals.relative
    return Binned(
        middle=middles[kept],
        bias=np.array([relative[chosen[k]].mean() for k in kept]),
        spread=np.array([np.sqrt(np.square(relative[chosen[k]]).mean()) for k in kept]),
        share=np.array([squares[chosen[k]].sum() / total for k in kept]),
        count=np.array([chosen[k].sum() for k in kept], dtype=np.int64),
    )

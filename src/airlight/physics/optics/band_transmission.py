"""Transmittance of gases averaged over bands, by the amount of the gas."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.physics.spectra.tables import read_spectrum

FloatArray = NDArray[np.float64]

#: Tables by formula of the gas.
TABLES: Final = {
    "H2O": "water-vapour-transmission",
    "O2": "oxygen-transmission",
    "CO2": "carbon-dioxide-transmission",
    "CH4": "methane-transmission",
}
#: Last row that stands for 1 nm; those beyond stand for 5 nm. [nm]
LAST_NARROW: Final = 1000.0
#: Wavelengths outside which tables of gases say nothing. [nm]
LIMITS: Final = (200.0, 2500.5)


def band_transmittance(table: str, centre: float, width: float, columns: FloatArray) -> FloatArray:
    """Mean transmittance of a gas over a band.

    Between the columns of the table the logarithm of the optical depth of a row is a monotone
    cubic in that of the column (Fritsch & Carlson 1980); beyond them it goes on in proportion to
    the column below, and with the last slope above. All wavelengths of a band count equally.

    Parameters
    ----------
    table : str
        Name of ``TABLES``.
    centre, width : float
        Middle and full width of the band. [nm]
    columns : array, shape (n,)
        Columns of molecules along the path. [m⁻²]

    Returns
    -------
    array, shape (n,)
        Transmittance; 1 where the table has no absorption. [1]

    Examples
    --------
    >>> oxygen = band_transmittance("oxygen-transmission", 764.0, 10.0, 4.5e28 * np.array([1.5]))
    >>> round(oxygen.item(), 3)  # the lines' own mean, see oxygen-bands.csv
    0.594
    """
    from scipy.interpolate import PchipInterpolator

    spectrum = read_spectrum(table)
    low, high = centre - 0.5 * width, centre + 0.5 * width
    nm = spectrum.wavelengths
    half = np.where(nm <= LAST_NARROW, 0.5, 2.5)
    parts = np.minimum(nm + half, high) - np.maximum(nm - half, low)  # of rows in the band
    inside = (parts > 0.0) & (spectrum.values[:, 0] > 0.0)
    if not inside.any():
        return np.ones(columns.shape)
    known = np.log(np.array([float(one) for one in spectrum.columns]))
    depths, lost = np.log(np.maximum(spectrum.values[inside], 1e-12)), parts[inside] / width
    at = np.log(np.maximum(columns, 1e-300))
    within = np.clip(at, known[0], known[-1])
    curve = PchipInterpolator(known, depths, axis=1)
    slope = curve(known[-1:], 1)
    found = curve(within) + np.minimum(at - known[0], 0.0)
    found += slope * np.maximum(at - known[-1], 0.0)
    return np.asarray(1.0 + lost @ np.expm1(-np.exp(found)))

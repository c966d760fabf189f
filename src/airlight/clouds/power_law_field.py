"""Periodic random fields of two dimensions with a power-law spectrum."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.grid import Grid

FloatArray = NDArray[np.float64]


def power_law_field(
    grid: Grid,
    random: np.random.Generator,
    *,
    slope: float = -5.0 / 3.0,
    longest: float = np.inf,
    stretch: float = 1.0,
) -> FloatArray:
    """Gaussian field of mean 0 and variance 1 whose spectrum along a line is k^slope.

    A field of two dimensions has the power k^(slope - 1) for each wave vector.

    Parameters
    ----------
    grid : Grid
        Periodic box.
    random : numpy.random.Generator
        Source of the phases.
    slope : float
        Exponent of the spectrum along a line; -5/3 of the optical depth of stratocumulus
        (Cahalan et al. 1994, JAS 51, 2434). [1]
    longest : float
        Wavelength above which the spectrum is flat. [m]
    stretch : float
        Ratio of the scales eastwards and northwards. [1]

    Returns
    -------
    array, shape (columns, columns)
        Values. [1]
    """
    waves = np.fft.fftfreq(grid.columns, grid.spacing)
    square = (waves[:, None] * stretch) ** 2 + waves[None, : grid.columns // 2 + 1] ** 2
    square = np.maximum(square, longest**-2.0)
    square[0, 0] = 1.0
    amplitude = square ** (0.25 * (slope - 1.0))
    amplitude[0, 0] = 0.0
    noise = np.fft.rfft2(random.standard_normal((grid.columns, grid.columns)))
    field = np.fft.irfft2(amplitude * noise, s=(grid.columns, grid.columns))
    return np.asarray(field / field.std())

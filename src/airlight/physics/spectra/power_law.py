"""Interpolation of positive spectra by a power law of wavelength, after Ångström."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def power_law(at: npt.ArrayLike, wavelengths: npt.ArrayLike, values: npt.ArrayLike) -> FloatArray:
    r"""Power-law interpolation of a spectrum; linear next to values of 0 or less.

    .. math:: f(\lambda) = f_1 (\lambda/\lambda_1)^{-\alpha}, \quad
              \alpha = -\frac{\ln(f_2/f_1)}{\ln(\lambda_2/\lambda_1)}

    Parameters
    ----------
    at : array, shape (...)
        Wavelengths of interpolation; beyond the ends the end value is used. [nm]
    wavelengths : array, shape (n,)
        Wavelengths of the rows, above 0, in any order. [nm]
    values : array, shape (n,)
        Values of the rows.

    Returns
    -------
    array, shape (...)
        Values; those of the rows exactly.

    References
    ----------
    Ångström (1929), Geografiska Annaler 11, 156, doi:10.1080/20014422.1929.11880498.

    Examples
    --------
    >>> f"{power_law(550.0, [440.0, 675.0], [0.31, 0.19]):.3f}"  # exponent 1.14
    '0.240'
    """
    order = np.argsort(wavelengths)
    known = np.asarray(wavelengths, dtype=np.float64)[order]
    rows = np.asarray(values, dtype=np.float64)[order]
    nm = np.clip(np.asarray(at, dtype=np.float64), known[0], known[-1])
    below = np.searchsorted(known, nm, side="right") - 1
    positive = rows > 0.0
    curved = (nm != known[below]) & positive[below] & positive[np.minimum(below + 1, rows.size - 1)]
    logarithm = np.interp(np.log(nm), np.log(known), np.log(np.where(positive, rows, 1.0)))
    return np.where(curved, np.exp(logarithm), np.interp(nm, known, rows))

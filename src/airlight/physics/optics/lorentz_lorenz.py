"""Refractivity of a gas at another density: the Lorentz-Lorenz relation."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError

FloatArray = npt.NDArray[np.float64]

#: Largest specific refraction accepted for a gas: n = 1.6.
LARGEST_REFRACTION: Final = 0.35


def refraction_of(refractivity: npt.ArrayLike) -> FloatArray:
    """Molar quantity that is additive over molecules, (n²-1)/(n²+2).

    Parameters
    ----------
    refractivity : array, shape (...)
        Refractivity n - 1. [1]

    Returns
    -------
    array, shape (...)
        Specific refraction. [1]
    """
    excess = np.asarray(refractivity, dtype=np.float64)
    squared = excess * (2.0 + excess)
    return np.asarray(squared / (squared + 3.0))


def refractivity_of(refraction: npt.ArrayLike) -> FloatArray:
    """Refractivity n - 1 from (n²-1)/(n²+2): the inverse of ``refraction_of``.

    Parameters
    ----------
    refraction : array, shape (...)
        Specific refraction, 0 to 0.35. [1]

    Returns
    -------
    array, shape (...)
        Refractivity n - 1, without cancellation at low density. [1]

    Raises
    ------
    ParameterError
        If it is too large for a gas.
    """
    value = np.asarray(refraction, dtype=np.float64)
    if not np.all(value <= LARGEST_REFRACTION):
        raise ParameterError(
            "(n²-1)/(n²+2)",
            float(np.max(value)),
            f"0 to {LARGEST_REFRACTION:g}: the density is too high for a gas",
        )
    squared = 3.0 * value / (1.0 - value)
    return np.asarray(squared / (1.0 + np.sqrt(1.0 + squared)))


def refractivity_at(
    refractivity: npt.ArrayLike, number_density: npt.ArrayLike, other_density: npt.ArrayLike
) -> FloatArray:
    r"""Refractivity of a gas at another density.

    .. math:: \frac{n^2-1}{n^2+2} \propto N

    Assuming n - 1 proportional to N would err by 3e-6 of the value for air from 0 to 15 °C, by
    0.25 % from there to the ground of Venus.

    Parameters
    ----------
    refractivity : array, shape (...)
        Refractivity n - 1 at the first density. [1]
    number_density, other_density : array, shape (...)
        First density, and the other density. [m⁻³]

    Returns
    -------
    array, shape (...)
        Refractivity n - 1 at the other density. [1]

    Raises
    ------
    ParameterError
        If the result is too large for a gas.

    Examples
    --------
    >>> f"{refractivity_at(2.7782e-4, 2.5469e25, 2.6868e25):.4e}"  # air from 15 °C to 0 °C
    '2.9308e-04'
    """
    first = np.asarray(number_density, dtype=np.float64)
    ratio = np.asarray(other_density, dtype=np.float64) / first
    return refractivity_of(refraction_of(refractivity) * ratio)

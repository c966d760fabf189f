"""Reflectance spectra for the colours of a map."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.xyz import XYZ_TO_RGB
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.sun import solar_irradiance
from airlight.physics.units import values_in


def reflectance_basis(wavelengths: ArrayLike) -> NDArray[np.float64]:
    r"""Reflectance spectra for red, green and blue of a map.

    The reflectance ρ = basis @ rgb is the smoothest one that has the colour under the sun:

    .. math:: \min \int \left(\frac{d\rho}{d\lambda}\right)^2 d\lambda \quad\text{where}\quad
              \int \rho\, E\, \bar c_k\, d\lambda = c_k \int E\, \bar c_k\, d\lambda,
              \quad k = r, g, b

    so that white, (1, 1, 1), is 1 at every wavelength and grey is flat. For saturated colours ρ
    leaves [0, 1] (pure green: -0.18 to 1.07); the caller clamps, which changes such a colour.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Wavelengths; the end values apply beyond 360 and 830. [nm]

    Returns
    -------
    array, shape (n, 3)
        Reflectance per channel. [1]

    Raises
    ------
    ParameterError
        If a wavelength is not a positive number.

    References
    ----------
    Burns (2019), "Numerical methods for smoothly approximating a reflectance given RGB",
    least-slope-squares method, with the sun instead of D65.

    Examples
    --------
    >>> reflectance_basis([440.0, 550.0, 680.0]) @ np.array([0.3, 0.3, 0.3])
    array([0.3, 0.3, 0.3])
    """
    at = values_in(wavelengths, "nm", "wavelengths")
    if at.ndim != 1 or not ((at > 0.0) & (at < np.inf)).all():
        raise ParameterError("wavelengths", wavelengths, "a list of numbers above 0 nm")
    nodes, basis = _basis()
    return np.stack([np.interp(at, nodes, column) for column in basis.T], axis=-1)


@cache
def _basis() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wavelengths, shape (471,), and the basis there, shape (471, 3).

    Lagrange's conditions are [[DᵀD, Aᵀ], [A, 0]] (ρ, multipliers) = (0, rgb); D takes differences,
    A is the colour of a reflectance over the colour of white.
    """
    functions = cie_1931()
    nodes = functions.wavelengths
    trapezoid = np.ones_like(nodes)
    trapezoid[[0, -1]] = 0.5
    colors = (functions.values @ XYZ_TO_RGB.T) * (solar_irradiance(nodes) * trapezoid)[:, None]
    constraint = (colors / colors.sum(axis=0)).T
    difference = np.diff(np.eye(nodes.size), axis=0)
    system = np.block([[difference.T @ difference, constraint.T], [constraint, np.zeros((3, 3))]])
    targets = np.concatenate([np.zeros((nodes.size, 3)), np.eye(3)])
    return nodes, np.linalg.solve(system, targets)[: nodes.size]

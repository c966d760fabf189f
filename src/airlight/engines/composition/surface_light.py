"""Spectral upsampling of surface colours, and their attenuation.

A colour is upsampled to the smoothest reflectance spectrum with that colour under the star
(``image.upsampling``), multiplied by the spectral transmittance and converted back: a 3 x 3 matrix
per pixel, the identity without atmosphere. White under the star is exact.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.image.upsampling import reflectance_basis
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


class SurfaceLight:
    """Attenuation of surface colours by spectral transmittance.

    Parameters
    ----------
    solution : MomentsSolution
        Solution, whose first light is the star.
    white : float or None
        Value of a white Lambert surface facing the star without atmosphere; None for colours in
        radiance. [1]

    Attributes
    ----------
    scale : array, shape (3,)
        Radiance of the unit of each channel. [W m⁻² sr⁻¹]
    colors : array, shape (nl, 3)
        Linear sRGB per radiance over the star's irradiance. [W m⁻² sr⁻¹ sr]
    """

    def __init__(self, solution: MomentsSolution, white: float | None) -> None:
        self.colors = solution.lights[0].colors()
        sun = self.colors.sum(axis=0)
        self.scale = np.ones(3) if white is None else sun / (np.pi * white)
        basis = reflectance_basis(solution.wavelengths)
        whole = self.colors.T @ basis
        # what a spectrum of unit colour contributes at each wavelength, shape (nl, 3, 3)
        spectra = basis @ np.linalg.inv(whole)
        self._shares = self.colors[:, :, None] * spectra[:, None, :]

    def through(self, colors: FloatArray, transmittance: FloatArray) -> FloatArray:
        """Attenuated colours, shape (n, 3).

        Parameters
        ----------
        colors : array, shape (n, 3)
            Colours of surfaces, linear sRGB. [any unit]
        transmittance : array, shape (n, nl)
            Transmittance between camera and surfaces. [1]
        """
        matrices = (transmittance @ self._shares.reshape(-1, 9)).reshape(-1, 3, 3)
        return np.asarray(np.einsum("nij,nj->ni", matrices, colors))

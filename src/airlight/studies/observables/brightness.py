"""Luminance and V surface brightness of radiances."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.physics.spectra.v_band import v_magnitude
from airlight.solver.solution import Solution
from airlight.studies.observables.spectral_integrals import V_BAND, WEIGHTED, SpectralIntegrals

FloatArray = NDArray[np.float64]

#: Default wavelengths: steps of 20 nm err by 0.1 % by day and 1 % in twilight. [nm]
BRIGHTNESS_WAVELENGTHS: Final = tuple(float(nm) for nm in range(400, 701, 20))
#: Columns of a table.
COLUMNS: Final = ("luminance_cd_m-2", "V_mag_arcsec-2")


def brightness(solution: Solution, radiance: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Luminance and V surface brightness, each of shape (n,). [cd m⁻²], [mag arcsec⁻²]

    Parameters
    ----------
    solution : Solution
        Solution, at two wavelengths or more; NaN where they do not reach.
    radiance : array, shape (n, nl)
        Spectral radiance. [W m⁻² sr⁻¹ nm⁻¹]
    """
    star = solution.lights[0].irradiance
    ratio = radiance / np.where(star > 0.0, star, 1.0)
    integrals = SpectralIntegrals(solution)
    luminance = integrals.weighted(WEIGHTED["illuminance"], ratio)
    return luminance, v_magnitude(integrals.weighted(V_BAND, ratio))

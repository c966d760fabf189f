"""Limb radiance as a function of tangent height."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.physics.units import values_in
from airlight.solver.solution import Solution
from airlight.studies.observables.distant_lines import lines_into_shell

FloatArray = NDArray[np.float64]


def limb_radiance(
    solution: Solution,
    tangent_height: ArrayLike,
    sun_zenith: ArrayLike,
    azimuth: ArrayLike = 90.0,
) -> FloatArray:
    """Radiance along lines of sight from space, by tangent height.

    Parameters
    ----------
    tangent_height : array, shape (...)
        Geometric tangent height, without refraction, up to the top of the shell; below 0 the line
        meets the ground. [m]
    sun_zenith : array, shape (...)
        Zenith angle of the sun at the tangent point, 0 to 180. [deg]
    azimuth : array, shape (...)
        Azimuth of the line relative to the sun there: 0 towards the sun, 180 away from it. [deg]

    Returns
    -------
    array, shape (..., nl)
        Spectral radiance. [W m⁻² sr⁻¹ nm⁻¹]
    """
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    height, sun, around = np.broadcast_arrays(
        values_in(tangent_height, "m", "tangent_height"),
        values_in(sun_zenith, "deg", "sun_zenith"),
        values_in(azimuth, "deg", "azimuth"),
    )
    outside = ~((height >= -bottom) & (height <= top - bottom))
    if outside.any():
        raise ParameterError(
            "tangent_height", float(height[outside].flat[0]),
            f"{-bottom:g} to {top - bottom:g} m; a higher line misses the atmosphere",
        )  # fmt: skip
    impact = bottom + height
    across = np.sin(np.radians(sun)) * np.cos(np.radians(around))
    half_chord = np.sqrt(np.maximum((top - impact) * (top + impact), 0.0))
    mu_s = (impact * np.cos(np.radians(sun)) - half_chord * across) / top
    lines = lines_into_shell(impact.ravel(), mu_s.ravel(), across.ravel(), bottom, top)
    values = solution.relative_radiance(lines) * solution.lights[0].irradiance
    return np.asarray(values.reshape(*height.shape, -1))

"""``under_clouds``: clear air lit by a sky that is partly cloudy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.solver.moments.harmonics import POLARISED, coefficient_count
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


def under_clouds(clear: MomentsSolution, cloudy: MomentsSolution, cover: float) -> MomentsSolution:
    r"""Solution of the clear air whose multiple scattering is that below and among clouds.

    .. math:: M = (1 - c)\, M_\mathrm{clear} + c\, M_\mathrm{cloudy}

    for the moments M of the diffuse radiance and the diffuse irradiance, on the radii and to the
    degree of the clear solution. Its direct beam is that of clear air; light in the truncated
    forward peak of the clouds is left out.

    Parameters
    ----------
    clear, cloudy : MomentsSolution
        Solutions of a shell without and with a cloud layer, at the same wavelengths and number of
        sun angles.
    cover : float
        Cloud cover c, 0 to 1. [1]

    Raises
    ------
    ParameterError
        If the cover is out of range, or the solutions do not belong together.
    """
    if not 0.0 <= cover <= 1.0:
        raise ParameterError("cover", cover, "0 to 1")
    one, other = clear.moments, cloudy.moments
    grid = one.grid
    if (
        grid.top_radius != other.grid.top_radius
        or one.degree > other.degree
        or not np.array_equiv(grid.sun_cosines, other.grid.sun_cosines)
        or not np.array_equiv(clear.wavelengths, cloudy.wavelengths)
    ):
        allowed = "a solution of the same shell, wavelengths, sun angles and at least that degree"
        raise ParameterError("cloudy", cloudy, allowed)
    known = other.grid.radii[:: other.refinement]
    wanted = grid.radii[:: one.refinement]
    harmonics = coefficient_count(one.degree)
    terms = np.r_[:harmonics, other.field.shape[2] - POLARISED : other.field.shape[2]]
    weight = np.float32(cover)
    field = _at_radii(other.field[:, :, terms], known, wanted)
    sky = _at_radii(other.sky, known, wanted)
    mixed = replace(
        one,
        field=(1 - weight) * one.field + weight * field,
        sky=(1 - weight) * one.sky + weight * sky,
    )
    solution = MomentsSolution(
        clear.medium, clear.settings, mixed, clear.report.seconds, clear.geometry
    )
    solution.planet = clear.planet
    return solution


def _at_radii(values: Float32Array, known: FloatArray, wanted: FloatArray) -> Float32Array:
    """Values (r, …) at known radii [m], linearly interpolated to others."""
    place = np.interp(wanted, known, np.arange(known.size))
    below = np.minimum(place.astype(int), known.size - 2)
    part = (place - below).astype(np.float32).reshape(-1, *(1,) * (values.ndim - 1))
    return np.asarray((1 - part) * values[below] + part * values[below + 1], np.float32)

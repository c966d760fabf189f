"""Solver settings with which predictions are smooth functions of a planet's parameters."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.settings import MomentsSettings, settings_for

FloatArray = NDArray[np.float64]

#: Tolerance of solutions: all orders, so that their number does not jump between neighbouring
#: values.
_TOLERANCE: Final = 1e-4


def smooth(quality: str) -> MomentsSettings:
    """Solver settings without jumps in predictions: tolerance, and one degree for all media."""
    settings = settings_for(quality)
    return replace(settings, degree=settings.thick_degree, tolerance=_TOLERANCE)


def smooth_near(quality: str, planet: Planet, wavelengths: FloatArray) -> MomentsSettings:
    """Settings of ``smooth`` with the degree of the harmonics of a planet at this quality.

    Optically thin media have a lower degree, whose effect on the radiance of haze exceeds the
    differences of a fit. ``preview`` keeps the higher degree, as in the first rounds of a fit.

    Parameters
    ----------
    planet : Planet
        Planet near the solution of the fit.
    wavelengths : array, shape (nl,)
        Wavelengths of the solution. [nm]
    """
    if quality == "preview":
        return smooth(quality)
    medium = Medium.from_planet(planet, wavelengths)
    degree = Optics.chosen(medium, settings_for(quality)).degree
    return replace(smooth(quality), degree=degree, thick_degree=degree)

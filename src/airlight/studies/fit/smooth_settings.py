"""Settings of the solver by which predictions change smoothly with a planet's parameters."""

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

#: Tolerance of solutions: all orders, so that their number makes no jump between two neighbours.
_TOLERANCE: Final = 1e-4


def smooth(quality: str) -> MomentsSettings:
    """Settings of a quality by which predictions have no jumps: tolerance, and degree of all air.

    Raises
    ------
    ParameterError
        If there is no such quality.
    """
    settings = settings_for(quality)
    return replace(settings, degree=settings.thick_degree, tolerance=_TOLERANCE)


def smooth_near(quality: str, planet: Planet, wavelengths: FloatArray) -> MomentsSettings:
    """Settings as from ``smooth``, with the degree that a planet has at this quality.

    The degree of clear air is lower, and the light of haze differs between the two by more than
    differences of a fit do. A preview has the higher one for all air, as the first rounds of a fit.

    Parameters
    ----------
    quality : str
    planet : Planet
        Planet near that which is sought.
    wavelengths : array, shape (nl,)
        Wavelengths that are solved. [nm]

    Raises
    ------
    ParameterError
        If there is no such quality.
    """
    if quality == "preview":
        return smooth(quality)
    medium = Medium.from_planet(planet, wavelengths)
    degree = Optics.chosen(medium, settings_for(quality)).degree
    return replace(smooth(quality), degree=degree, thick_degree=degree)

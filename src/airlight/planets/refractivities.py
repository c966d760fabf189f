"""Refractivities of a planet's constituents at a single wavelength."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

FloatArray = npt.NDArray[np.float64]

#: Wavelength whose refractivity is used for all. [nm]
REFRACTION_WAVELENGTH: Final = 550.0


def refractivities(planet: Planet) -> FloatArray:
    """n - 1 of each constituent at relative density 1; zero without refraction.

    Sampled at 550 nm, or at the nearest wavelength of the planet's range.

    Returns
    -------
    array, shape (nc,)
        Refractivities. [1]

    Raises
    ------
    ParameterError
        If the planet refracts but no constituent has a refractivity.
    """
    result = np.zeros(len(planet.constituents))
    if planet.refraction == "none":
        return result
    low, high = planet.wavelength_limits
    nm = [min(max(REFRACTION_WAVELENGTH, low), high)]
    for i, one in enumerate(planet.constituents):
        result[i] = one.refractivities(nm, planet.thickness)[0]
    if not result.any():
        raise ParameterError(
            "refraction", planet.refraction, "'none', or a gas of known refractivity"
        )
    return result

"""Wavelengths of a picture, common to all renderers.

Still pictures have sixteen, evenly spaced; interactive pictures and GPUs have three or four,
optimised for colours.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.image.four_wavelengths import CHOSEN, few_wavelengths
from airlight.image.spectral import default_wavelengths
from airlight.planets.matter.absorbers import CrossSectionAbsorption

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

FloatArray = npt.NDArray[np.float64]

#: Default number of wavelengths: of a still picture, and of a picture rendered by a GPU.
STILL: Final = 16
LIVE: Final = 4
#: Number of wavelengths of each word.
COUNTS: Final = {"three": 3, "four": 4, "eight": 8, "sixteen": 16}
#: Table of the bands of methane.
METHANE_BANDS: Final = "methane-bands"


def picture_wavelengths(
    planet: Planet, choice: int | str | None = None, *, most: int | None = None
) -> FloatArray:
    """Wavelengths of a picture of a planet.

    Parameters
    ----------
    planet : Planet
        Planet, with its wavelength range.
    choice : int or str, optional
        Number of wavelengths, evenly spaced over the visible; three are 680, 550 and 440 nm. Or a
        word from ``COUNTS``, whose small sets are optimised for colours. Default: sixteen, or four
        optimised ones if ``most`` requires.
    most : int, optional
        Limit of the renderer, 3 or 4.

    Returns
    -------
    array, shape (n,)
        Wavelengths. [nm]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> picture_wavelengths(load_planet("mars-rayleigh"), "sixteen", most=4).size
    4
    >>> picture_wavelengths(load_planet("earth"), 3)
    array([680., 550., 440.])
    >>> picture_wavelengths(load_planet("earth"), "three")
    array([450., 550., 620.])
    """
    limits = planet.wavelength_limits
    if isinstance(choice, str) and choice not in COUNTS:
        raise ParameterError("wavelengths", choice, ", ".join(COUNTS))
    if choice is None:
        count, fitted = (STILL, False) if most is None or most >= STILL else (LIVE, True)
    elif isinstance(choice, str):
        count = COUNTS[choice]
        if most is not None and count > most:
            count = LIVE
        fitted = count in CHOSEN
    else:
        count, fitted = choice, False
    if not fitted:
        return default_wavelengths(count, *limits)
    return few_wavelengths(count, *limits, methane=_absorbs_methane(planet))


def _absorbs_methane(planet: Planet) -> bool:
    """Whether a constituent has the bands of methane."""
    return any(
        isinstance(one.absorption, CrossSectionAbsorption)
        and one.absorption.cross_section == METHANE_BANDS
        for one in planet.constituents
    )


def texel_wavelengths(planet: Planet, choice: int | str | None = None) -> FloatArray:
    """Wavelengths of a picture that is rendered on a GPU, at most those of a texel.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> texel_wavelengths(load_planet("earth"))
    array([440., 500., 560., 620.])
    >>> texel_wavelengths(load_planet("neptune"))  # beside the bands of its methane
    array([450., 500., 570., 650.])
    """
    return picture_wavelengths(planet, choice, most=LIVE)

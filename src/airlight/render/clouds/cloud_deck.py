"""``CloudDeck``: clouds of one kind in a picture."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.render.clouds.cloud_tables import SOLVED

FloatArray = NDArray[np.float64]

#: Optical properties of a cloud's particles at wavelengths. [nm]
OpticsAt = Callable[[FloatArray], CloudOptics]
#: Distance of the first and the last solved wavelength from the ends, over the number of all. [1]
_INSET: Final = 0.08


class CloudDeck(NamedTuple):
    """Clouds of one kind.

    Attributes
    ----------
    field : CloudField
        Extinction.
    optics_at : callable
        Optical properties of the particles at wavelengths, as ``CloudOptics.of_particles``.
    number : int
        Number among the clouds of the planet.
    place : tuple of two float
        Place of the finer box in the field: east and north of its middle. [m]
    """

    field: CloudField
    optics_at: OpticsAt
    number: int = 0
    place: tuple[float, float] = (0.0, 0.0)


def solved_wavelengths(count: int) -> NDArray[np.int64]:
    """Indices of at most ``SOLVED`` of so many wavelengths at which boxes are solved."""
    if count <= SOLVED:
        return np.arange(count)
    return np.round(np.linspace(_INSET, 1.0 - _INSET, SOLVED) * (count - 1)).astype(np.int64)

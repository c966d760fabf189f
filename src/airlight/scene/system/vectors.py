"""Vectors in the frame of a scene."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.schema.field import Field

FloatArray = NDArray[np.float64]

#: Largest coordinate: 100 light years. [m]
_FARTHEST: Final = 1e18
#: Declaration of a position.
POSITION: Final = Field(
    label="position",
    help="Coordinates in the frame of the scene.",
    unit="m",
    range=(-_FARTHEST, _FARTHEST),
    listed=True,
    example='["384400 km", "0 km", "0 km"]',
)


def unit(vector: Sequence[float] | FloatArray, field: str) -> FloatArray:
    """Unit vector of a direction, shape (3,). [1]

    Parameters
    ----------
    vector : sequence of float
        Direction of any length above 0.
    field : str
        Name for error messages.

    Examples
    --------
    >>> unit([0.0, 3.0, 4.0], "pole")
    array([0. , 0.6, 0.8])
    """
    given = np.asarray(vector, float)
    if given.shape != (3,) or not np.isfinite(given).all() or not np.any(given):
        raise ParameterError(field, tuple(vector), "three numbers that are not all 0")
    given = given / np.abs(given).max()
    return np.asarray(given / np.linalg.norm(given))


def frame_of(pole: FloatArray, turn: float) -> FloatArray:
    """Axes of a body-fixed frame as rows: x through the prime meridian, z to the north pole.

    Parameters
    ----------
    pole : array, shape (3,)
        Direction of the north pole.
    turn : float
        Angle of the prime meridian from the ascending node of the equator, eastward; from x where
        the pole is along z. [deg]

    Returns
    -------
    array, shape (3, 3)
        Axes. [1]

    References
    ----------
    Archinal et al. (2018), Celestial Mechanics and Dynamical Astronomy 130, 22, figure 1.

    Examples
    --------
    >>> frame_of(np.array([0.0, 0.0, 1.0]), 90.0)[0].round(12) + 0.0
    array([0., 1., 0.])
    """
    north = unit(pole, "pole")
    node = np.array([-north[1], north[0], 0.0])
    flat = float(np.linalg.norm(node))
    node = node / flat if flat > 1e-12 else np.array([1.0, 0.0, 0.0])
    beside = np.cross(north, node)
    angle = np.radians(turn)
    x = np.cos(angle) * node + np.sin(angle) * beside
    return np.stack([x, np.cross(north, x), north])

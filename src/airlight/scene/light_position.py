"""Where a light stands in the sky of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from airlight.scene.directions import direction


@dataclass(frozen=True, kw_only=True)
class LightPosition:
    """The direction of one of a scene's lights, in the observer's local frame.

    What shines there stands in the solution's ``lights``, in the same order.

    Parameters
    ----------
    zenith : float
        True zenith angle at the observer. [deg]
    azimuth : float
        From the star's side, to the right. [deg]

    Examples
    --------
    >>> LightPosition(zenith=90.0).direction.round(12) + 0.0
    array([1., 0., 0.])
    """

    zenith: float
    azimuth: float = 0.0

    @property
    def direction(self) -> NDArray[np.float64]:
        """Unit vector towards the light, shape (3,). [1]"""
        return direction(self.zenith, self.azimuth)

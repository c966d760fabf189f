"""Exposure by the settings of a camera."""

from __future__ import annotations

from math import inf, log2
from typing import Final

import numpy as np

from airlight.errors import ParameterError
from airlight.image.exposure import MOST_EXPOSURE
from airlight.physics.constants import LUMINOUS_EFFICACY

#: Exposure at which a sensor of ISO 1 saturates [lx s], and the light that passes a lens [1].
_SATURATION: Final = 78.0
_LENS: Final = 0.65


def camera_exposure(iso: float, aperture: float, shutter: float) -> float:
    r"""Saturation-based exposure of a camera: sensor saturation is 1.

    .. math:: L_\mathrm{sat} = \frac{78}{S} \frac{N^2}{q\,t}, \quad q = 0.65

    Parameters
    ----------
    iso : float
        Sensitivity S. [ISO]
    aperture : float
        Focal length over the diameter of the lens, N. [1]
    shutter : float
        Exposure time t. [s]

    Returns
    -------
    float
        Exposure, within ±100. [EV]

    Raises
    ------
    ParameterError
        If a number is not above 0.

    References
    ----------
    ISO 12232:2019, saturation-based speed, with q for a lens transmittance of 0.9.

    Examples
    --------
    >>> f"{camera_exposure(iso=100.0, aperture=16.0, shutter=1 / 100):.2f}"  # "sunny 16"
    '-5.49'
    """
    for name, value in (("iso", iso), ("aperture", aperture), ("shutter", shutter)):
        if not (isinstance(value, (int, float, np.number)) and 0.0 < value < inf):
            raise ParameterError(name, value, "above 0, finite")
    saturating = _SATURATION / iso * aperture**2 / (_LENS * shutter)
    return min(max(log2(LUMINOUS_EFFICACY / saturating), -MOST_EXPOSURE), MOST_EXPOSURE)

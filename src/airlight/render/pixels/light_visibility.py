"""Visibility of secondary lights; also emitted as JavaScript."""

from __future__ import annotations

import math
from typing import Final

#: Irradiance over that of the first light below which a light is invisible by day. [1]
MIN_RELATIVE_IRRADIANCE: Final = 1e-5
#: Margin for refraction at the horizon and for twilight. [deg]
_LIFTED: Final = 1.0
_DEGREE: Final = 180.0 / math.pi


def light_visibility(
    zenith: float,
    first_zenith: float,
    radius: float,
    share: float,
    altitude: float,
    bottom: float,
    thickness: float,
) -> float:
    """Visibility of a light: 2 for disc and illumination, 1 for the disc only, 0 for none.

    A light is invisible without irradiance or too far below the horizon to illuminate visible air.
    By day, illumination below ``MIN_RELATIVE_IRRADIANCE`` is ignored.

    Parameters
    ----------
    zenith, first_zenith : float
        Zenith angles of the light and of the first one. [deg]
    radius : float
        Angular radius of the light. [deg]
    share : float
        Irradiance over that of the first light. [1]
    altitude, bottom, thickness : float
        Altitude of the observer, radius of the ground, height of the shell. [m]

    Examples
    --------
    >>> [light_visibility(z, 40.0, 0.26, 2e-6, 0.0, 6360e3, 1e5) for z in (60.0, 95.0, 130.0)]
    [1.0, 0.0, 0.0]
    """
    if share <= 0.0:
        return 0.0
    dip = math.atan2(math.sqrt(altitude * (2.0 * bottom + altitude)), bottom) * _DEGREE
    below = zenith - 90.0 - dip - radius - _LIFTED
    # visible air extends as far beyond the horizon as sunlit air beyond the terminator
    lit = math.atan2(math.sqrt(thickness * (2.0 * bottom + thickness)), bottom) * _DEGREE
    if below > 2.0 * lit:
        return 0.0
    if altitude < thickness and first_zenith < 90.0 and share < MIN_RELATIVE_IRRADIANCE:
        return 1.0 if below < 0.0 else 0.0
    return 2.0

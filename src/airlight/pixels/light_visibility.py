"""Whether a light beside the first one can be seen, as plain numbers, for hosts in any language."""

from __future__ import annotations

import math
from typing import Final

#: Share of the first light below which the light of another is not seen beside its daylight. [1]
MIN_RELATIVE_IRRADIANCE: Final = 1e-5
#: Angle by which refraction lifts a light at most, and by which twilight outlasts its geometry.
#: [deg]
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
    """What of a light is rendered: 2 everything, 1 its disc alone, 0 nothing.

    Nothing of a light without irradiance, or so far below the horizon that it lights no air in
    view. By day, of a light of less than ``MIN_RELATIVE_IRRADIANCE`` of the first, the disc.

    Parameters
    ----------
    zenith, first_zenith : float
        Zenith angles of the light and of the first one. [deg]
    radius : float
        Angular radius of the light. [deg]
    share : float
        Its irradiance over the first one's. [1]
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
    # the farthest air in view is as far behind the horizon as it is lit behind the terminator
    lit = math.atan2(math.sqrt(thickness * (2.0 * bottom + thickness)), bottom) * _DEGREE
    if below > 2.0 * lit:
        return 0.0
    if altitude < thickness and first_zenith < 90.0 and share < MIN_RELATIVE_IRRADIANCE:
        return 1.0 if below < 0.0 else 0.0
    return 2.0

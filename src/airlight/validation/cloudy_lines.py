"""Lines of sight on which solvers of three-dimensional clouds are compared: 60 radiances."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.solver.montecarlo.cloudy_air import CloudyAir
from airlight.solver.montecarlo.estimate import Estimate

FloatArray = NDArray[np.float64]

#: Zenith angles of the sun, which is in the east. [deg]
SUNS: Final = (20.0, 45.0, 60.0, 75.0, 85.0)
_SUN_AZIMUTH: Final = 90.0
#: Altitude of the observer above the place of the field, view zenith angle, and azimuth from the
#: sun: on the ground, at 3 km, in an airliner and in orbit. [m], [deg]
VIEWS: Final = (
    (0.0, 20.0, 0.0),
    (0.0, 45.0, 90.0),
    (0.0, 60.0, 180.0),
    (0.0, 80.0, 45.0),
    (3e3, 95.0, 90.0),
    (3e3, 120.0, 0.0),
    (3e3, 150.0, 180.0),
    (11e3, 110.0, 30.0),
    (11e3, 140.0, 135.0),
    (11e3, 180.0, 0.0),
    (400e3, 180.0, 0.0),
    (400e3, 179.5, 90.0),
)


def cloudy_lines(latitude: float, longitude: float) -> dict[str, FloatArray]:
    """Keyword arguments of ``CloudyAir.radiance`` for the 60 lines of sight at a place.

    Parameters
    ----------
    latitude, longitude : float
        Place of the field. [deg]

    Examples
    --------
    >>> cloudy_lines(10.0, 20.0)["sun_zenith"].shape
    (60,)
    """
    views = np.tile(np.array(VIEWS), (len(SUNS), 1))
    return {
        "latitude": np.full(len(views), latitude),
        "longitude": np.full(len(views), longitude),
        "altitude": views[:, 0],
        "view_zenith": views[:, 1],
        "azimuth": np.mod(views[:, 2] + _SUN_AZIMUTH, 360.0),
        "sun_zenith": np.repeat(SUNS, len(VIEWS)),
        "sun_azimuth": np.full(len(views), _SUN_AZIMUTH),
    }


def cloudy_radiances(air: CloudyAir) -> Estimate:
    """Monte Carlo radiances of those lines at the place of the first field."""
    first = air.fields[0]
    return air.radiance(**cloudy_lines(first.latitude, first.longitude))

"""Positions and rotations of bodies of the solar system in a common frame.

The frame is that of the J2000 equator, with its origin at the Earth's centre: x to the equinox, z
to the north pole. Positions are apparent: corrected for light time to the Earth.
"""

from __future__ import annotations

import math
from datetime import datetime
from typing import TYPE_CHECKING, Final, NamedTuple

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.instant import days_of, ephemeris_time
from airlight.physics.constants import ASTRONOMICAL_UNIT

if TYPE_CHECKING:
    from astronomy import Time

#: Bodies by name, with astronomy-engine's name for them.
BODIES: Final = {
    "earth": "Earth",
    "moon": "Moon",
    "sun": "Sun",
    "mercury": "Mercury",
    "venus": "Venus",
    "mars": "Mars",
    "jupiter": "Jupiter",
    "saturn": "Saturn",
    "uranus": "Uranus",
    "neptune": "Neptune",
}


class Position(NamedTuple):
    """Position and rotation of a body.

    Attributes
    ----------
    position : tuple of float
        Centre, from the Earth's. [m]
    pole : tuple of float
        Direction of the north pole. [1]
    prime_meridian : float
        Angle W of the prime meridian from the ascending node of the equator. [deg]
    """

    position: tuple[float, float, float]
    pole: tuple[float, float, float]
    prime_meridian: float


def position_of(body: str, time: datetime) -> Position:
    """Position and rotation of a body at a time.

    Parameters
    ----------
    body : str
        Name from ``BODIES``.
    time : datetime
        Time with its zone, 1700 to 2199.

    Raises
    ------
    ParameterError
        If the body is unknown, or the time has no zone or is out of range.

    Examples
    --------
    >>> from datetime import UTC
    >>> moon = position_of("moon", datetime(2017, 8, 21, 18, 26, tzinfo=UTC))
    >>> sum(x * x for x in moon.position) ** 0.5 // 1e6  # near its perigee
    372.0
    """
    import astronomy

    if body not in BODIES:
        raise ParameterError("ephemeris", body, ", ".join(BODIES))
    moment = ephemeris_time(days_of(time))
    known = getattr(astronomy.Body, BODIES[body])
    if body == "earth":
        return _earth(moment)
    axis = astronomy.RotationAxis(known, moment)
    seen = astronomy.GeoVector(known, moment, aberration=True)
    at = (seen.x * ASTRONOMICAL_UNIT, seen.y * ASTRONOMICAL_UNIT, seen.z * ASTRONOMICAL_UNIT)
    return Position(at, (axis.north.x, axis.north.y, axis.north.z), axis.spin % 360.0)


def _earth(moment: Time) -> Position:
    """Rotation of the Earth by its equator of date and sidereal time.

    Astronomy-engine's own elements of the Earth are 0.8 degrees off in longitude.
    """
    import astronomy

    turn = math.radians(15.0 * astronomy.SiderealTime(moment))
    back = astronomy.Rotation_EQD_EQJ(moment)
    pole, east = (
        astronomy.RotateVector(back, astronomy.Vector(x, y, z, moment))
        for x, y, z in ((0.0, 0.0, 1.0), (-math.sin(turn), math.cos(turn), 0.0))
    )
    # Sine and cosine of W: from the vector a quarter turn east, whose node angle is W + 90.
    flat = math.hypot(pole.x, pole.y)
    node_x, node_y = -pole.y / flat, pole.x / flat
    along = east.x * node_x + east.y * node_y
    beside_x, beside_y, beside_z = -pole.z * node_y, pole.z * node_x, flat
    across = east.x * beside_x + east.y * beside_y + east.z * beside_z
    meridian = math.degrees(math.atan2(across, along)) - 90.0
    return Position((0.0, 0.0, 0.0), (pole.x, pole.y, pole.z), meridian % 360.0)

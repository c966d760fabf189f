"""Free flight over a planet, from the ground to deep space, under a sun that keeps its place.

Level movement follows the planet's curve at one altitude, and the local frame turns with it; the
camera keeps its angle to the zenith. Every speed is in proportion to the distance to the ground.
The planet does not turn: the sun's direction is fixed to it until time is set.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.scene.directions import direction
from airlight.scene.observer import planet_frame
from airlight.scene.scene import HIGHEST_ALTITUDE
from airlight.viewer.parameters.view_parameters import LOWEST_ALTITUDE
from airlight.viewer.session.session import Session

FloatArray = NDArray[np.float64]
View = Mapping[str, Any]

#: Speed over distance to the ground. [1/s]
RATE: Final = 0.8
#: Added to that distance, so that one gets away from the ground. [m]
_FOOTING: Final = 5.0
#: Altitude grows by this factor with each notch of the wheel.
NOTCH: Final = 1.15
#: What keys do, by name in lower case: right, ahead, up.
KEYS: Final[Mapping[str, tuple[float, float, float]]] = {
    "w": (0.0, 1.0, 0.0),
    "s": (0.0, -1.0, 0.0),
    "a": (-1.0, 0.0, 0.0),
    "d": (1.0, 0.0, 0.0),
    "e": (0.0, 0.0, 1.0),
    "q": (0.0, 0.0, -1.0),
    "arrowup": (0.0, 1.0, 0.0),
    "arrowdown": (0.0, -1.0, 0.0),
    "arrowleft": (-1.0, 0.0, 0.0),
    "arrowright": (1.0, 0.0, 0.0),
    "pageup": (0.0, 0.0, 1.0),
    "pagedown": (0.0, 0.0, -1.0),
}
#: Keys that make it faster or slower while they are held.
FACTORS: Final[Mapping[str, float]] = {"shift": 4.0, "control": 0.25}
#: Longest time of one step: after a pause nobody wants to be far away. [s]
_LONGEST_STEP: Final = 0.1


def _angle(one: FloatArray, other: FloatArray) -> float:
    """Between two vectors, to the last digit also where it is small. [deg]"""
    cross = float(np.linalg.norm(np.cross(one, other)))
    return math.degrees(math.atan2(cross, float(one @ other)))


def _bearing(vector: FloatArray, north: FloatArray, east: FloatArray, old: float) -> float:
    """Compass bearing of a vector; the old one if it stands upright. [deg]"""
    x, y = float(vector @ north), float(vector @ east)
    if math.hypot(x, y) < 1e-12:
        return old
    return math.degrees(math.atan2(y, x)) % 360.0


def flown(
    view: View, right: float, ahead: float, up: float, seconds: float, bottom_radius: float
) -> dict[str, float]:
    """The view after flying for a while.

    Parameters
    ----------
    view : mapping
        Values of the parameters ``view.…`` by path.
    right, ahead, up : float
        Where to, in the camera's frame: ahead is along the line of sight, up away from the ground.
        Of length 1 for the usual speed.
    seconds : float
        [s]
    bottom_radius : float
        Of the planet. [m]

    Returns
    -------
    dict
        The values that changed: position, heading, sun.

    Examples
    --------
    >>> from airlight.viewer.parameters.view_parameters import DEFAULTS
    >>> north = flown({**DEFAULTS, "view.heading": 0.0, "view.look_zenith": 90.0}, 0, 1, 0, 1, 6e6)
    >>> north["view.latitude"] > 0, north["view.altitude"], north["view.sun_zenith"] > 60
    (True, 2.0, True)
    """
    altitude = float(view["view.altitude"])
    tilt = math.radians(float(view["view.look_zenith"]))
    level, climb = ahead * math.sin(tilt), ahead * math.cos(tilt) + up
    reach = RATE * seconds
    higher = (altitude + _FOOTING) * math.exp(climb * reach) - _FOOTING
    higher = min(max(higher, LOWEST_ALTITUDE), HIGHEST_ALTITUDE)
    middle = 0.5 * (altitude + higher)
    way = math.hypot(level, right) * reach * (middle + _FOOTING)
    course = float(view["view.heading"]) + math.degrees(math.atan2(right, level))
    turned = _turned(view, course, way / (bottom_radius + middle)) if way > 0.0 else {}
    return {**turned, "view.altitude": higher if climb != 0.0 else altitude}


def _turned(view: View, course: float, angle: float) -> dict[str, float]:
    """The view after moving by an angle [rad] on a great circle that starts on a course [deg]."""
    latitude, longitude = float(view["view.latitude"]), float(view["view.longitude"])
    heading, bearing = float(view["view.heading"]), float(view["view.sun_azimuth"])
    along, _, upward = planet_frame(latitude, longitude, course).T
    look = planet_frame(latitude, longitude, heading)[:, 0]
    sun = planet_frame(latitude, longitude, bearing) @ direction(float(view["view.sun_zenith"]), 0)
    # The rotation that carries the observer along carries what the camera calls level too.
    look = _carried(look, upward, along, angle)
    place = upward * math.cos(angle) + along * math.sin(angle)
    new_latitude = math.degrees(math.atan2(place[2], math.hypot(place[0], place[1])))
    new_longitude = math.degrees(math.atan2(place[1], place[0]))
    frame = planet_frame(new_latitude, new_longitude, 0.0)
    north, east = frame[:, 0], -frame[:, 1]
    return {
        "view.latitude": new_latitude,
        "view.longitude": new_longitude,
        "view.heading": _bearing(look, north, east, heading),
        "view.sun_zenith": _angle(sun, frame[:, 2]),
        "view.sun_azimuth": _bearing(sun, north, east, bearing),
    }


def _carried(vector: FloatArray, upward: FloatArray, along: FloatArray, angle: float) -> FloatArray:
    """A vector turned by the rotation that leads from ``upward`` towards ``along``."""
    up, on = float(vector @ upward), float(vector @ along)
    rest = vector - up * upward - on * along
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(rest + (up * c - on * s) * upward + (up * s + on * c) * along)


def looked(view: View, right: float, down: float) -> dict[str, float]:
    """The view after the camera has turned by angles, as a mouse turns it. [deg]

    Parameters
    ----------
    view : mapping
    right, down : float
        As seen on the picture. [deg]
    """
    tilt = float(view["view.look_zenith"])
    # Near the zenith a turn of the compass moves the picture less: at most five times more of it.
    widen = 1.0 / max(math.sin(math.radians(tilt)), 0.2)
    return {
        "view.heading": (float(view["view.heading"]) + right * widen) % 360.0,
        "view.look_zenith": min(max(tilt + down, 0.0), 180.0),
    }


def risen(view: View, notches: float) -> dict[str, float]:
    """The view after turning the wheel: away from the ground for notches above 0."""
    altitude = (float(view["view.altitude"]) + _FOOTING) * NOTCH**notches - _FOOTING
    return {"view.altitude": min(max(altitude, LOWEST_ALTITUDE), HIGHEST_ALTITUDE)}


def sun_dragged(view: View, right: float, down: float) -> dict[str, float]:
    """The view with the sun moved by angles over the sky. [deg]

    Over the zenith it goes on down the other side.
    """
    zenith = float(view["view.sun_zenith"]) + down
    bearing = float(view["view.sun_azimuth"]) + right
    if zenith < 0.0:
        zenith, bearing = -zenith, bearing + 180.0
    if zenith > 180.0:
        zenith, bearing = 360.0 - zenith, bearing + 180.0
    return {"view.sun_zenith": min(zenith, 180.0), "view.sun_azimuth": bearing % 360.0}


def sun_at(latitude: float, declination: float, hour: float) -> tuple[float, float]:
    """Where the sun stands by its declination and the local solar time.

    Parameters
    ----------
    latitude, declination : float
        [deg]
    hour : float
        12 when it is highest; a planet's day has 24. [h]

    Returns
    -------
    zenith, azimuth : float
        The second is a compass bearing. [deg]

    Examples
    --------
    >>> zenith, azimuth = sun_at(50.0, 0.0, 6.0)  # at the equinox it rises in the east at six
    >>> round(zenith, 9), round(azimuth, 9)
    (90.0, 90.0)
    """
    frame = planet_frame(latitude, 0.0, 0.0)
    turn = math.radians(15.0 * (12.0 - hour))
    tilt = math.radians(declination)
    sun = np.array(
        [math.cos(tilt) * math.cos(turn), math.cos(tilt) * math.sin(turn), math.sin(tilt)]
    )
    return _angle(sun, frame[:, 2]), _bearing(sun, frame[:, 0], -frame[:, 1], 180.0)


def time_of(latitude: float, zenith: float, azimuth: float) -> tuple[float, float]:
    """Declination [deg] and local solar time [h] of a sun by where it stands; see ``sun_at``.

    Examples
    --------
    >>> declination, hour = time_of(50.0, *sun_at(50.0, 20.0, 15.5))
    >>> round(declination, 9), round(hour, 9)
    (20.0, 15.5)
    """
    sun = planet_frame(latitude, 0.0, azimuth) @ direction(zenith, 0.0)
    declination = math.degrees(math.atan2(sun[2], math.hypot(sun[0], sun[1])))
    return declination, (12.0 - math.degrees(math.atan2(sun[1], sun[0])) / 15.0) % 24.0


class Flight:
    """Keys, mouse and wheel of a host, turned into the view of a session.

    Parameters
    ----------
    session : Session

    Notes
    -----
    The host tells which keys go down and up and calls ``step`` before each frame; while ``moving``
    is false it need not draw.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._held: set[str] = set()

    def press(self, key: str) -> bool:
        """A key goes down, by its name; whether it is one of the flight's."""
        name = key.lower()
        if name not in KEYS and name not in FACTORS:
            return False
        self._held.add(name)
        return True

    def release(self, key: str = "") -> None:
        """A key goes up; without a name all do, as when the window loses the keyboard."""
        if key:
            self._held.discard(key.lower())
        else:
            self._held.clear()

    @property
    def moving(self) -> bool:
        """Whether a held key moves the camera."""
        return any(key in KEYS for key in self._held)

    def step(self, seconds: float) -> bool:
        """Fly on for the time since the last frame; whether the view has changed. [s]"""
        if not self.moving or seconds <= 0.0:
            return False
        moves = [KEYS[key] for key in self._held if key in KEYS]
        right, ahead, up = (sum(parts) for parts in zip(*moves, strict=True))
        speed = math.prod(FACTORS[key] for key in self._held if key in FACTORS)
        length = math.sqrt(right * right + ahead * ahead + up * up)
        if length == 0.0:
            return False
        time = min(seconds, _LONGEST_STEP) * speed / length
        radius = self.bottom_radius
        self._session.move(flown(self._session.view, right, ahead, up, time, radius))
        return True

    @property
    def bottom_radius(self) -> float:
        """Of the ground of the session's planet. [m]"""
        return 1e3 * float(self._session.value("shell.bottom_radius"))

    def look(self, right: float, down: float) -> None:
        """The mouse has moved by parts of the picture's width: the picture follows it."""
        fov = float(self._session.view["view.field_of_view"])
        self._session.move(looked(self._session.view, -right * fov, -down * fov))

    def wheel(self, notches: float) -> None:
        """The wheel has turned: towards the ground for notches above 0."""
        self._session.move(risen(self._session.view, -notches))

    def drag_sun(self, right: float, down: float) -> None:
        """The mouse drags the sun by parts of the picture's width."""
        fov = float(self._session.view["view.field_of_view"])
        self._session.move(sun_dragged(self._session.view, right * fov, down * fov))

    def set_time(self, declination: float, hour: float) -> None:
        """The sun by time; see ``sun_at``. [deg], [h]"""
        latitude = float(self._session.view["view.latitude"])
        zenith, azimuth = sun_at(latitude, declination, hour)
        self._session.move({"view.sun_zenith": zenith, "view.sun_azimuth": azimuth})

    @property
    def time(self) -> tuple[float, float]:
        """Declination [deg] and local solar time [h] of the sun where the observer is."""
        view = self._session.view
        latitude, zenith, azimuth = (
            float(view[f"view.{name}"]) for name in ("latitude", "sun_zenith", "sun_azimuth")
        )
        return time_of(latitude, zenith, azimuth)

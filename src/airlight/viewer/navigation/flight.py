"""Free flight over a planet, from the ground to deep space, under a fixed sun.

The planet does not rotate: the sun's direction is fixed to it until the time is set. Formulas:
``scene.flight``; keys: ``navigation.keys``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from airlight.scene.flight import (
    RATE,
    angle_dragged,
    angle_flown,
    climbed,
    course_of,
    horizon_kept,
    looked,
    planet_hidden,
    risen,
    sun_dragged,
    turned,
    turns_planet,
)
from airlight.scene.sun_time import sun_at, time_of
from airlight.viewer.navigation.keys import FACTORS, HELD, RATES
from airlight.viewer.parameters.sun_clock import CLOCK, date_later
from airlight.viewer.session.session import Session

View = Mapping[str, Any]


def flown(
    view: View, right: float, ahead: float, up: float, seconds: float, bottom_radius: float
) -> dict[str, float]:
    """View values changed by a flight of some time.

    Parameters
    ----------
    view : mapping
        Values of the parameters ``view.…`` by path.
    right, ahead, up : float
        Direction in the camera's frame: ahead along the line of sight, up away from the ground.
        Length 1 is the usual speed. [1]
    seconds : float
        Duration. [s]
    bottom_radius : float
        Radius of the planet's ground. [m]

    Returns
    -------
    dict
        Values that changed, by path: position, heading, sun.

    Examples
    --------
    >>> from airlight.viewer.parameters.view_parameters import DEFAULTS
    >>> north = flown({**DEFAULTS, "view.heading": 0.0, "view.look_zenith": 90.0}, 0, 1, 0, 1, 6e6)
    >>> north["view.latitude"] > 0, north["view.altitude"], north["view.sun_zenith"] > 60
    (True, 2.0, True)
    """
    altitude, tilt, heading = _numbers(view, "altitude", "look_zenith", "heading")
    reach = RATE * seconds
    higher = climbed(altitude, tilt, ahead, up, reach)
    changed = {} if ahead == 0.0 and up == 0.0 else _lifted(view, higher, bottom_radius)
    angle = angle_flown(altitude, higher, tilt, right, ahead, reach, bottom_radius)
    if angle > 0.0:
        changed |= _carried(view, course_of(tilt, heading, right, ahead), angle)
    return changed


def _lifted(view: View, higher: float, bottom_radius: float) -> dict[str, float]:
    """Altitude, and the tilt that keeps the horizon in the picture."""
    altitude, tilt = _numbers(view, "altitude", "look_zenith")
    return {
        "view.altitude": higher,
        "view.look_zenith": horizon_kept(tilt, altitude, higher, bottom_radius),
    }


def _carried(view: View, course: float, angle: float) -> dict[str, float]:
    """Position, heading and sun after an angle [rad] of a great circle on a bearing [deg]."""
    names = ("latitude", "longitude", "heading", "sun_zenith", "sun_azimuth")
    moved = turned(*[*_numbers(view, *names), course, angle])
    return {f"view.{name}": value for name, value in zip(names, moved, strict=True)}


def _numbers(view: View, *names: str) -> tuple[float, ...]:
    return tuple(float(view[f"view.{name}"]) for name in names)


class Flight:
    """Controller that turns keys, mouse and wheel of a host into a session's view.

    Notes
    -----
    The host reports key presses and releases and calls ``step`` before each frame. All movement
    between two calls of ``rest`` is one undo step.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._held: set[str] = set()

    def press(self, key: str) -> bool:
        """Handle a key press; returns whether the key, by its name, belongs to the flight."""
        name = key.lower()
        if name not in HELD and name not in FACTORS:
            return False
        self._held.add(name)
        return True

    def release(self, key: str = "") -> None:
        """Handle a key release; without a name, of all keys, as when the window loses focus."""
        moving = self.moving
        if key:
            self._held.discard(key.lower())
        else:
            self._held.clear()
        if moving and not self.moving:
            self.rest()

    def rest(self) -> None:
        """End the movement; the next one is a separate undo step."""
        self._session.end_drag()

    @property
    def moving(self) -> bool:
        """Whether a held key moves the camera."""
        return any(key in HELD for key in self._held)

    def step(self, seconds: float) -> bool:
        """Advance by the time since the last frame [s]; returns whether the view has changed."""
        if not self.moving or seconds <= 0.0:
            return False
        ways = dict.fromkeys(("right", "ahead", "up", "turn", "tilt", "widen"), 0.0)
        for key in self._held & HELD.keys():
            axis, sign = HELD[key]
            ways[axis] += sign
        time = min(seconds, RATES["longest_step"]) * self.speed
        changed = dict(self._flown(ways, time))
        view = {**self._session.view, **changed}
        field = float(view["view.field_of_view"])
        if ways["turn"] or ways["tilt"]:
            angle = RATES["turn"] * field * time
            changed |= _looked(view, ways["turn"] * angle, ways["tilt"] * angle)
        if ways["widen"]:
            changed |= self._widened(field * math.exp(ways["widen"] * RATES["widen"] * time))
        if changed:
            self._session.move(changed, gesture="keys", held=True)
        return bool(changed)

    @property
    def speed(self) -> float:
        """Speed factor of the held keys. [1]"""
        return math.prod(FACTORS[key] for key in self._held if key in FACTORS)

    def _flown(self, ways: Mapping[str, float], time: float) -> dict[str, float]:
        way = [ways[axis] for axis in ("right", "ahead", "up")]
        length = math.hypot(*way)
        if length == 0.0:
            return {}
        right, ahead, up = way
        return flown(self._session.view, right, ahead, up, time / length, self.bottom_radius)

    @property
    def bottom_radius(self) -> float:
        """Radius of the ground of the session's planet. [m]"""
        return 1e3 * float(self._session.value("shell.bottom_radius"))

    @property
    def planet_hidden(self) -> bool:
        """Whether a far planet is outside the picture."""
        tilt, altitude, field = _numbers(
            self._session.view, "look_zenith", "altitude", "field_of_view"
        )
        return planet_hidden(tilt, altitude, self.bottom_radius, field)

    def look(self, right: float, down: float) -> None:
        """Turn the camera, or a planet seen whole, by a drag in fractions of the width. [1]"""
        view = self._session.view
        field, altitude = _numbers(view, "field_of_view", "altitude")
        if turns_planet(altitude, self.bottom_radius):
            (heading,) = _numbers(view, "heading")
            course = heading + math.degrees(math.atan2(-right, down))
            share = math.hypot(right, down)
            angle = angle_dragged(altitude, self.bottom_radius, field, share)
            moved = _carried(view, course, angle)
        else:
            moved = _looked(view, -right * field, -down * field)
        self._session.move(moved, gesture="look", held=True)

    def wheel(self, notches: float) -> None:
        """Change the altitude by wheel notches, towards the ground if positive."""
        view = self._session.view
        higher = risen(float(view["view.altitude"]), -notches)
        self._session.move(_lifted(view, higher, self.bottom_radius), gesture="wheel")

    def widen(self, notches: float) -> None:
        """Change the field of view by wheel notches, wider if positive."""
        field = float(self._session.view["view.field_of_view"])
        changed = self._widened(field * RATES["notch"] ** notches)
        self._session.move(changed, gesture="field of view")

    def _widened(self, field: float) -> dict[str, float]:
        limits = self._session.parameter("view.field_of_view")
        return {"view.field_of_view": min(max(field, limits.low), limits.most)}

    def drag_sun(self, right: float, down: float) -> None:
        """Move the sun by a mouse drag, in fractions of the picture's width. [1]"""
        view = self._session.view
        field = float(view["view.field_of_view"])
        zenith, azimuth = _numbers(view, "sun_zenith", "sun_azimuth")
        moved = sun_dragged(zenith, azimuth, right * field, down * field)
        self._session.move(_sun(moved), gesture="sun", held=True)

    def set_time(self, declination: float, hour: float, *, gesture: str = "time of day") -> None:
        """Set the sun by declination [deg] and hour [h]; without a gesture, no undo step.

        See ``sun_at``.
        """
        latitude = float(self._session.view["view.latitude"])
        self._session.move(_sun(sun_at(latitude, declination, hour)), gesture=gesture)

    def pass_time(self, hours: float) -> None:
        """Advance the sun, or the date that determines it, by some hours, without an undo step."""
        view = self._session.view
        if view[CLOCK]:
            self._session.move(date_later(view, hours))
            return
        declination, hour = self.time
        self.set_time(declination, (hour + hours) % 24.0, gesture="")

    @property
    def time(self) -> tuple[float, float]:
        """Declination [deg] and local solar time [h] of the sun at the observer."""
        return time_of(*_numbers(self._session.view, "latitude", "sun_zenith", "sun_azimuth"))


def _looked(view: View, right: float, down: float) -> dict[str, float]:
    tilt, heading = _numbers(view, "look_zenith", "heading")
    tilt, heading = looked(tilt, heading, right, down)
    return {"view.look_zenith": tilt, "view.heading": heading}


def _sun(angles: tuple[float, float]) -> dict[str, float]:
    return {"view.sun_zenith": angles[0], "view.sun_azimuth": angles[1]}

"""``FlightRecorder``: key frames of a flight, recorded, edited and played in a session."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.scene.display_fields import DISPLAY_FIELDS
from airlight.scene.projections import PROJECTIONS
from airlight.studies.film import load_film
from airlight.studies.film.flight_film import FlightKey, flight_keys, write_flight
from airlight.studies.film.flight_path import UNITS, FlightPath
from airlight.studies.film.key_frames import smooth_value
from airlight.viewer.parameters.sun_clock import CLOCK
from airlight.viewer.session.session import Session

#: Time from the last key frame to one that is appended by hand. [s]
STEP: Final = 3.0
#: Interval between key frames while a flight is recorded. [s]
INTERVAL: Final = 1.0
#: Shortest time between two key frames. [s]
SHORTEST: Final = 0.05
#: Name of the undo step of a played flight.
_GESTURE: Final = "flight"


def view_path(name: str) -> str:
    """Path of the session's value of a number of ``UNITS``.

    Examples
    --------
    >>> view_path("look_bearing"), view_path("altitude")
    ('view.heading', 'view.altitude')
    """
    return "view.heading" if name == "look_bearing" else f"view.{name}"


class FlightRecorder:
    """Key frames of a flight, and the moment that is shown.

    Attributes
    ----------
    keys : tuple of FlightKey
        Key frames, by ascending time; the first is at 0.
    time : float
        Time of the flight that is shown. [s]
    plays, records : bool
        Whether the flight is being played, or recorded.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._path: FlightPath | None = None
        self.keys: tuple[FlightKey, ...] = ()
        self.time = 0.0
        self.plays = self.records = False
        self._begins = False  # whether the next step is the first, after a rest of any length

    @property
    def duration(self) -> float:
        """Time of the last key frame. [s]"""
        return self.keys[-1].time if self.keys else 0.0

    @property
    def moving(self) -> bool:
        """Whether the flight is being played or recorded."""
        return self.plays or self.records

    # --- editing ------------------------------------------------------------------------------

    def add(self) -> None:
        """Add the view as a key frame: at the time shown, or after the last one."""
        if self.keys and self.time > self.duration - SHORTEST:
            self.time = self.duration + STEP
        self._put(self._seen(self.time))

    def delete(self, number: int) -> None:
        """Delete a key frame; the flight starts with the first that is left."""
        left = self.keys[:number] + self.keys[number + 1 :]
        first = left[0].time if left else 0.0
        self._set(tuple(replace(one, time=one.time - first) for one in left))

    def retime(self, number: int, time: float) -> None:
        """Move a key frame in time, between its neighbours; the first stays. [s]"""
        if number == 0:
            return
        late = len(self.keys) == number + 1
        highest = 3600.0 if late else self.keys[number + 1].time - SHORTEST
        moved = min(max(time, self.keys[number - 1].time + SHORTEST), highest)
        key = replace(self.keys[number], time=moved)
        self._set((*self.keys[:number], key, *self.keys[number + 1 :]))

    def clear(self) -> None:
        """Delete all key frames."""
        self._set(())

    def _seen(self, time: float) -> FlightKey:
        """Key frame of the session's view."""
        view, display = self._session.view, self._session.display
        return FlightKey(
            time=time,
            view={name: float(view[view_path(name)]) for name in UNITS},
            exposure=None if display["automatic"] else float(display["exposure"]),
        )

    def _put(self, key: FlightKey) -> None:
        """Insert a key frame, in place of one at the same time."""
        others = [one for one in self.keys if abs(one.time - key.time) >= SHORTEST]
        self._set(tuple(sorted([*others, key], key=lambda one: one.time)))

    def _set(self, keys: tuple[FlightKey, ...]) -> None:
        times, views = [one.time for one in keys], [one.view for one in keys]
        path = None
        if len(keys) > 1:  # before anything is changed: two places may be opposite each other
            path = FlightPath(times, {name: [one[name] for one in views] for name in UNITS})
        self.keys, self._path = keys, path
        self.time = min(self.time, self.duration)

    # --- recording and playing ----------------------------------------------------------------

    def toggle_recording(self) -> None:
        """Record the flight from its end on; or stop, with a last key frame."""
        self.plays = False
        self.records = self._begins = not self.records
        if self.records:
            self.time = self.duration + (STEP if self.keys else 0.0)
        self._record()

    def _record(self) -> None:
        """Add the view at the time shown; while nothing moves, the last key frame moves on."""
        if self.keys and self.time - self.duration < SHORTEST:
            return
        key, last = self._seen(self.time), self.keys[-2:]
        still = len(last) == 2 and all(replace(one, time=self.time) == key for one in last)
        self._set((*(self.keys[:-1] if still else self.keys), key))

    def toggle_playing(self) -> None:
        """Play the flight from the time shown, from its start once it has ended; or pause."""
        if self.plays:
            self.pause()
            return
        if self._path is None:
            raise ParameterError("flight", f"{len(self.keys)} key frames", "two or more key frames")
        if self.records:
            self.toggle_recording()
        self.plays = self._begins = True
        self.show(self.time if self.time < self.duration else 0.0)

    def pause(self) -> None:
        """Stop playing; all that was played is one undo step."""
        if self.plays:
            self.plays = False
            self._session.end_drag()

    def step(self, seconds: float) -> None:
        """Advance by the time since the last frame. [s]"""
        if self._begins:
            self._begins = False
        elif self.records:
            self.time += seconds
            if self.time - self.duration >= INTERVAL:
                self._record()
        elif self.plays:
            self.show(self.time + seconds)
            if self.time >= self.duration:
                self.pause()

    def show(self, time: float) -> None:
        """Show the view at a time of the flight. [s]"""
        self.time = min(max(time, 0.0), self.duration)
        exact = [one for one in self.keys if one.time == self.time]
        if exact:
            key = exact[0]
        elif self._path is not None:
            view = {"roll": 0.0, **self._path.view(self.time)}
            key = FlightKey(time=self.time, view=view, exposure=self._exposure())
        else:
            return
        changes: dict[str, Any] = {view_path(name): value for name, value in key.view.items()}
        changes[CLOCK] = False  # the sun is the flight's
        if key.exposure is not None:
            changes |= {"display.automatic": False, "display.exposure": key.exposure}
        self._session.move(changes, gesture=_GESTURE, held=True)

    def _exposure(self) -> float | None:
        """Exposure at the time shown, if it is fixed in all key frames. [EV]"""
        values = [one.exposure for one in self.keys if one.exposure is not None]
        if len(values) < len(self.keys):
            return None
        return smooth_value([one.time for one in self.keys], values, self.time)

    # --- files --------------------------------------------------------------------------------

    def save(self, path: str | Path) -> None:
        """Write a film file for ``airlight animate``; an edited planet is written beside it."""
        session, path = self._session, Path(path)
        if path.suffix != ".toml":
            raise ParameterError("flight", path.name, "a name that ends in .toml")
        if len(self.keys) < 2:
            raise ParameterError("flight", f"{len(self.keys)} key frames", "two or more key frames")
        planet = str(session.planet.source)
        if session.planet.changes:
            beside = path.with_name(f"{path.stem}-planet.toml")
            session.save_planet(beside)
            planet = beside.name
        elif planet.endswith(".toml"):
            planet = str(Path(planet).resolve())
        values = session.view
        projection = str(values["view.projection"])
        view = {name: values[f"view.{name}"] for name in ("projection", "ground", "dehaze")}
        if values["view.filter"]:
            view["polariser"] = f"{values['view.polariser']!r} deg"
        low, high = PROJECTIONS[projection].field_of_view_limits
        keys = [_within(one, low, high) for one in self.keys]
        display = {name: values[f"display.{name}"] for name in DISPLAY_FIELDS}
        write_flight(path, keys, planet=planet, view=view, display=display)

    def load(self, path: str | Path) -> None:
        """Read the film file of a flight, show its planet and its first view."""
        film = load_film(path)
        keys = flight_keys(film)
        if film.planet_name != str(self._session.planet.source):
            self._session.open(film.planet_name)
        self.plays = self.records = False
        self._set(keys)
        self.show(0.0)
        self._session.end_drag()


def _within(key: FlightKey, low: float, high: float) -> FlightKey:
    """Key frame whose field of view is within a projection's limits. [deg]"""
    view: Mapping[str, float] = key.view
    return replace(key, view={**view, "field_of_view": min(max(view["field_of_view"], low), high)})

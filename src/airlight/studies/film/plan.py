"""Table ``[film]`` of a film file: number of frames, clock and key frames."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Final

from airlight.errors import ConflictError, ParameterError
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.studies.film.flight_path import UNITS, FlightPath
from airlight.studies.film.key_frames import FLIGHT, KeyFrames

#: Largest number of frames: five digits of their names.
MOST_FRAMES: Final = 99_999
#: Path of the exposure, a number of the film, in EV.
EXPOSURE: Final = "film.exposure"
#: Beginning of the paths of a view.
VIEW: Final = "view."


@parameters
class FilmPlan(TomlModel):
    """Duration, clock and key frames of a film.

    Parameters
    ----------
    frames : float
        Number of frames, an integer. [1]
    rate : float
        Frames per second of playback. [1/s]
    start, end : str, optional
        Instants of the first and the last frame; time is linear between them.
    zone : str, optional
        Zone of instants without one.
    keys : tuple of KeyFrames
        Animated parameters.
    """

    frames: float = key(
        label="frames",
        help="Number of frames.",
        range=(1, MOST_FRAMES),
        example="120",
        default=120.0,
    )
    rate: float = key(
        label="rate",
        help="Frames per second of playback.",
        range=(1.0, 1000.0),
        example="30",
        default=30.0,
    )
    start: str | None = key(
        label="start",
        help="Time of the first frame, as for `--time`; with its zone for a scene.",
        kind="text",
        range=(1, 100),
        example="2026-06-21T20:00Z",
        default=None,
    )
    end: str | None = key(
        label="end",
        help="Time of the last frame; requires `start`.",
        kind="text",
        range=(1, 100),
        example="2026-06-21T21:30Z",
        default=None,
    )
    zone: str | None = key(
        label="zone",
        help="Zone of times without one, for a planet: `Europe/Stockholm`, `solar`.",
        kind="text",
        range=(1, 60),
        example="Europe/Stockholm",
        default=None,
    )
    keys: tuple[KeyFrames, ...] = key(
        label="keys",
        help="Animated numbers, see below.",
        kind="table",
        table=KeyFrames,
        example="[[film.keys]] tables",
        default=(),
    )

    def __post_init__(self) -> None:
        if self.frames != int(self.frames):
            raise ParameterError("frames", self.frames, f"a whole number, 1 to {MOST_FRAMES}")
        for name, other in (("start", "end"), ("end", "start")):
            if getattr(self, name) is None and getattr(self, other) is not None:
                raise ConflictError(other, f"requires {name}")
        paths = [key.path for key in self.keys]
        for path in paths:
            if paths.count(path) > 1:
                raise ParameterError("keys", path, "each path once")
        for one in self.keys:
            if one.path == EXPOSURE and not isinstance(one.value(0.0), float):
                raise ParameterError("keys", one.values, "exposures without a unit, in EV")
        joined = self.flight_keys
        for one in joined:
            if one.path.removeprefix(VIEW) not in UNITS or not one.path.startswith(VIEW):
                allowed = f"a flight of view.{', view.'.join(UNITS)}"
                raise ParameterError("keys", one.path, allowed)
            if one.times.tolist() != joined[0].times.tolist():
                raise ParameterError("keys", one.path, "the times of the other keys of the flight")
        self.flight  # noqa: B018  # refuses a flight with missing numbers

    @property
    def count(self) -> int:
        """Number of frames."""
        return int(self.frames)

    def normalised_time(self, number: int) -> float:
        """Normalised time of a frame, from 0 to 1. [1]"""
        return number / max(self.count - 1, 1)

    def changes(self, number: int) -> dict[str, Any]:
        """Values of all animated parameters at a frame, by path."""
        time = self.normalised_time(number)
        alone = [one for one in self.keys if one.law != FLIGHT and one.path != EXPOSURE]
        changes = {one.path: one.value(time) for one in alone}
        if self.flight is not None:
            # Fifteen digits: rounding errors of the path are not part of the value.
            view = self.flight.view(time).items()
            changes |= {f"{VIEW}{name}": f"{value:.15g} {UNITS[name]}" for name, value in view}
        return changes

    @property
    def flight_keys(self) -> tuple[KeyFrames, ...]:
        """Key frames that a flight joins."""
        return tuple(one for one in self.keys if one.law == FLIGHT)

    @cached_property
    def flight(self) -> FlightPath | None:
        """Flight of the key frames of its law; None without them."""
        keys = self.flight_keys
        if not keys:
            return None
        views = {one.path[len(VIEW) :]: one.numbers(UNITS[one.path[len(VIEW) :]]) for one in keys}
        return FlightPath(list(keys[0].times), views)

    def exposure(self, number: int) -> float | None:
        """Exposure of a frame by its key frames; None without them. [EV]"""
        return self.exposure_at(self.normalised_time(number))

    def exposure_at(self, time: float) -> float | None:
        """Exposure at a normalised time by its key frames; None without them. [EV]"""
        values = [one for one in self.keys if one.path == EXPOSURE]
        return float(values[0].value(time)) if values else None

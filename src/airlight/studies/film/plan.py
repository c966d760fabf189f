"""Table ``[film]`` of a film file: number of frames, clock and key frames."""

from __future__ import annotations

from typing import Any, Final

from airlight.errors import ConflictError, ParameterError
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.studies.film.key_frames import KeyFrames

#: Largest number of frames: five digits of their names.
MOST_FRAMES: Final = 99_999


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

    @property
    def count(self) -> int:
        """Number of frames."""
        return int(self.frames)

    def normalised_time(self, number: int) -> float:
        """Normalised time of a frame, from 0 to 1. [1]"""
        return number / max(self.count - 1, 1)

    def changes(self, number: int) -> dict[str, Any]:
        """Values of all animated parameters at a frame, by path."""
        return {key.path: key.value(self.normalised_time(number)) for key in self.keys}

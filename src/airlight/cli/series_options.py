"""Options of a place at one time or a series of times, and the planet that is solved there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import timedelta
from typing import TYPE_CHECKING, Any, Final

from airlight.cli.option_groups import given_options, named_errors, option
from airlight.cli.place_options import (
    MomentOptions,
    PlaceOptions,
    check_coordinates,
    on_floor,
)
from airlight.cli.planet_options import GroundOptions
from airlight.errors import ConflictError, ParameterError
from airlight.physics.units import MOST_VALUES, quantity

if TYPE_CHECKING:
    from datetime import datetime

    from airlight.planets.planet import Planet
    from airlight.scene import Scene

#: Step of a series without ``--step``.
_STEP: Final = "10min"


@dataclass(frozen=True, kw_only=True)
class TimesOptions(MomentOptions):
    """Options of a place at one time or a series of times."""

    start: str | None = option("First time of a series, with --at; forms of --time.", "TIME")
    end: str | None = option("Last time of a series.", "TIME")
    step: str | None = option("Step of a series, e.g. 1h (10min).", "DURATION")

    def _time_options(self) -> dict[str, Any]:
        return super()._time_options() | given_options(self, "start", "end", "step")


@dataclass(frozen=True, kw_only=True)
class SeriesOptions(TimesOptions, PlaceOptions):
    """Options of the observer and the sun, once or at a series of times."""

    def scenes(self, planet: Planet) -> list[Scene]:
        """Observers: one, or one for each time of the series."""
        if self.start is None and self.end is None and self.step is None:
            return [self.scene(planet)]
        for given in given_options(self, "time_", "season"):
            raise ConflictError(given, "cannot be combined with --start, --end and --step")
        if self.at is None or self.start is None or self.end is None:
            raise ConflictError("--start", "requires --at and --end")
        first = replace(self, time_=self.start, start=None, end=None, step=None)
        with named_errors(**{"--time": "--start"}):
            scene = first.scene(planet)
        with named_errors(**{"--time": "--end"}):
            last = replace(first, time_=self.end).scene(planet)
        assert scene.time is not None
        assert last.time is not None
        times = _times(scene.time, last.time, self.step or _STEP)
        return [scene, *(_at(planet, scene, one) for one in times[1:])]


def at_place(planet: GroundOptions, place: SeriesOptions) -> tuple[Planet, list[Scene]]:
    """Planet under the observer, lit from its distance at the first time, and the observers."""
    world = planet.load()
    scenes = place.scenes(world)
    check_coordinates(place)
    on_floor(world, scenes[0].altitude)
    world = place.lit(world, scenes[0])
    world, floor = scenes[0].on_basin_floor(world)
    scenes = [replace(one, altitude=floor.altitude) for one in scenes]
    if planet.ground_albedo is None and (place.timed or place.latitude is not None):
        from airlight.scene.local_ground import local_ground

        where = {"latitude": floor.latitude, "longitude": floor.longitude}
        world = local_ground(world, altitude=floor.altitude, **where)
    return world, scenes


def _at(planet: Planet, scene: Scene, moment: datetime) -> Scene:
    """Scene of the same place at another time."""
    from airlight.scene import Scene

    return Scene.at(
        planet,
        latitude=scene.latitude,
        longitude=scene.longitude,
        time=moment,
        altitude=scene.altitude,
    )


def _times(first: datetime, last: datetime, step: str) -> list[datetime]:
    """Times from the first to the last."""
    seconds = quantity(step, "s", "--step", bare=True)
    if not seconds > 0.0:
        raise ParameterError("--step", step, "a duration above 0, such as 10min")
    if last < first:
        raise ParameterError("--end", last.isoformat(), f"{first.isoformat()} or later")
    count = int((last - first).total_seconds() / seconds + 1e-9)
    if count >= MOST_VALUES:
        raise ParameterError("--step", step, f"a step with at most {MOST_VALUES} times")
    return [first + timedelta(seconds=k * seconds) for k in range(count + 1)]

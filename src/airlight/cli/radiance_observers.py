"""Options of the observers of radiances, and their cases: angles, a file, or places at times."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import typer

from airlight.cli import options
from airlight.cli.console import say
from airlight.cli.option_groups import (
    OptionGroup,
    given_options,
    given_values,
    option,
    option_name,
)
from airlight.cli.planet_options import LocalGroundOptions
from airlight.cli.series_options import SeriesOptions, TimesOptions, at_place
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.studies.sweep.cases import Cases


@dataclass(frozen=True, kw_only=True)
class ObserverOptions(OptionGroup):
    """Options of the observers: one, lists and ranges, or a file."""

    altitude: tuple[float, ...] | None = option(
        "Observer altitude above ground (0m). Lists (0m,2km) and ranges (0:10:2km), here and "
        "below, print a table.",
        "LENGTH",
        read=options.lengths,
    )
    sun_zenith: tuple[float, ...] | None = option(
        "Sun zenith angle at the observer.", "ANGLE", read=options.angles
    )
    view_zenith: tuple[float, ...] | None = option(
        "View zenith angle at the observer.", "ANGLE", read=options.angles
    )
    azimuth: tuple[float, ...] | None = option(
        "Azimuth between view and sun (0deg).", "ANGLE", read=options.angles
    )
    view_azimuth: tuple[float, ...] | None = option(
        "Compass bearing of the view, with --at, instead of --azimuth.",
        "ANGLE",
        read=options.angles,
    )
    sun_azimuth: float | None = option(
        "Compass bearing of the sun, with --latitude, for the shadow of rings.",
        "BEARING",
    )
    input_: str | None = option(
        "Input CSV with altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg; - is standard "
        "input.",
        "FILE",
    )
    output: str = option(
        "Output, with --input: .csv (the input with radiance_<nm>nm appended) or .nc (netCDF); - "
        "is standard output. An interrupted .csv is continued.",
        "FILE",
        "-",
        flags=("--output", "-o"),
    )

    @property
    def labelled(self) -> bool:
        """Whether the output is a netCDF file."""
        return self.output.lower().endswith(".nc")

    @property
    def from_file(self) -> bool:
        """Whether the observers are read from a file on disk."""
        return self.input_ not in (None, "-")

    def check_file(self, planet: LocalGroundOptions) -> None:
        """Raise an error for observer options with a file of observers, or an unwritable target."""
        from airlight.studies.sweep.cases import check_table
        from airlight.studies.sweep.grid import AXES

        where = given_options(planet, "latitude", "longitude")
        for given in {**given_options(self, *AXES, "sun_azimuth"), **where}:
            raise ConflictError(given, "cannot be combined with --input")
        check_table(self.output)

    def place(self, planet: LocalGroundOptions) -> dict[str, float]:
        """Latitude and compass bearing of the sun under rings; empty without them. [deg]"""
        if self.sun_azimuth is None:
            return {}
        if planet.latitude is None:
            raise ConflictError("--sun-azimuth", "requires --latitude")
        return {"latitude": planet.latitude, "sun_azimuth": self.sun_azimuth}

    def cases(self, planet: LocalGroundOptions) -> Cases:
        """Observers of the file, or of the options."""
        if self.input_ is None:
            return _observers(self)
        from airlight.studies.sweep.cases import read_cases

        self.check_file(planet)
        return read_cases(self.input_)


def timed_cases(
    planet: LocalGroundOptions, observers: ObserverOptions, when: TimesOptions
) -> tuple[Planet, Cases]:
    """Planet under the observer, and its views at each time."""
    import numpy as np

    from airlight.studies.sweep.cases import COLUMNS, Cases

    fixed = given_options(observers, "sun_zenith", "sun_azimuth", "input_")
    for given in {**fixed, **given_options(planet, "latitude", "longitude")}:
        raise ConflictError(given, "cannot be combined with --at")
    if observers.view_azimuth is not None and observers.azimuth is not None:
        raise ConflictError("--view-azimuth", "cannot be combined with --azimuth")
    height = observers.altitude
    if height is not None and len(height) > 1:
        raise ParameterError("--altitude", height, "a single altitude with --at")
    options_of = {one.name: getattr(when, one.name) for one in fields(when)}
    place = SeriesOptions(**options_of, altitude=None if height is None else height[0])
    world, scenes = at_place(planet, place)
    values, rows = [], []
    for scene in scenes:
        facing = 0.0 if observers.view_azimuth is None else scene.sun_azimuth
        turns = observers.azimuth or observers.view_azimuth or (0.0,)
        azimuths = [(turn - facing + 180.0) % 360.0 - 180.0 for turn in turns]
        sun = replace(observers, altitude=(scene.altitude,), sun_zenith=(scene.sun_zenith,))
        views = _observers(replace(sun, azimuth=tuple(azimuths), view_azimuth=None)).values
        values.append(views)
        moment = "" if scene.time is None else scene.time.isoformat()
        rows += [[moment, *(f"{number:.10g}" for number in row)] for row in views]
    found = np.concatenate(values)
    if len(found) == 1:
        say(place.line(world, scenes[0]))
        return world, Cases(comments=[], header=[], rows=[[]], values=found)
    return world, Cases(comments=[], header=["time", *COLUMNS], rows=rows, values=found)


def _observers(observers: ObserverOptions) -> Cases:
    """Observers of the options: one, or all combinations of lists and ranges."""
    import numpy as np

    from airlight.physics.units import MOST_VALUES
    from airlight.scene.limits import DEEPEST_ALTITUDE, within
    from airlight.studies.sweep.cases import COLUMNS, Cases
    from airlight.studies.sweep.grid import AXES

    if observers.output != "-":
        raise ParameterError("--output", observers.output, "only together with --input")
    filled = {"altitude": [0.0], "azimuth": [0.0]} | given_values(observers, *AXES)
    axes = []
    for name, (low, high, unit) in AXES.items():
        given = option_name(name)
        if name not in filled:
            raise typer.BadParameter(f"{given} is missing: an angle such as 60deg, or --input FILE")
        low = DEEPEST_ALTITUDE if name == "altitude" else low
        axes.append([within(given, number, low, high, unit) for number in filled[name]])
    values = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
    if len(values) > MOST_VALUES:
        allowed = f"at most {MOST_VALUES}; longer tables by --input or airlight sweep"
        raise ParameterError("number of observers", len(values), allowed)
    if len(values) == 1:
        return Cases(comments=[], header=[], rows=[[]], values=values)
    rows = [[f"{number:.10g}" for number in row] for row in values]
    return Cases(comments=[], header=list(COLUMNS), rows=rows, values=values)

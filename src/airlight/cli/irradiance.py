"""``airlight irradiance``: light that a plane receives, once or at a series of times."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from datetime import timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.dataset_table import say_table
from airlight.cli.option_groups import OptionGroup, given_options, named_errors, option
from airlight.cli.place_options import PlaceOptions, check_coordinates, on_floor
from airlight.cli.planet_options import GroundOptions
from airlight.cli.solve_options import SolveOptions, wavelengths_option
from airlight.errors import ConflictError, FileError, ParameterError
from airlight.physics.units import MOST_VALUES, quantity

if TYPE_CHECKING:
    from datetime import datetime

    from airlight.planets.planet import Planet
    from airlight.scene import Scene
    from airlight.studies.observables.plane_irradiance import Plane

EPILOG = examples(
    "airlight irradiance earth --at 40N,3.7W --time 2026-06-21T12:00Z",
    "airlight irradiance earth --sun-zenith 48.2 --tilt 37 --azimuth S",
    "airlight irradiance earth --sun-zenith 48.2 --spectral -o spectrum.csv",
    "airlight irradiance earth --at 40N,3.7W --start 2026-06-21T04:00Z --end 2026-06-21T20:00Z "
    "--step 10min -o day.nc",
    "airlight irradiance mars --at 4.59S,137.44E --ls 250 --time noon",
    "airlight irradiance earth --clouds cumulus --sun-zenith 40 -o cloudy.json",
)

#: Step of a series without ``--step``.
_STEP: Final = "10min"


@dataclass(frozen=True, kw_only=True)
class SeriesOptions(PlaceOptions):
    """Options of the observer and the sun, once or at a series of times."""

    start: str | None = option("First time of a series, with --at; forms of --time.", "TIME")
    end: str | None = option("Last time of a series.", "TIME")
    step: str | None = option("Step of a series, e.g. 1h (10min).", "DURATION")

    def _time_options(self) -> dict[str, Any]:
        return super()._time_options() | given_options(self, "start", "end", "step")

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


@dataclass(frozen=True, kw_only=True)
class ProductOptions(OptionGroup):
    """Options of what is computed."""

    spectral: bool = option(
        "Spectral irradiance at the wavelengths of the solution, instead of integrals.",
        default=False,
    )
    tilt: float | None = option("Tilted plane: angle between its normal and the zenith.", "ANGLE")
    azimuth: float | None = option("Compass bearing of the plane's normal (S).", "BEARING")

    def plane(self) -> Plane | None:
        """Tilted plane."""
        if self.tilt is None:
            if self.azimuth is not None:
                raise ConflictError("--azimuth", "requires --tilt")
            return None
        from airlight.studies.observables.plane_irradiance import Plane

        facing = 180.0 if self.azimuth is None else self.azimuth
        with named_errors("tilt", "azimuth"):
            return Plane(tilt=self.tilt, azimuth=facing)


@dataclass(frozen=True, kw_only=True)
class IrradianceSolveOptions(SolveOptions):
    """Options of a solution whose spectra are integrated."""

    wavelengths: str | None = wavelengths_option(
        "as many as integrals need, from 280 nm as far as the planet's data reach"
    )


def irradiance(
    planet: GroundOptions,
    place: SeriesOptions,
    product: ProductOptions,
    solve: IrradianceSolveOptions,
    output: Annotated[
        list[Path] | None,
        options.output_option(
            "FILE",
            "Output: .csv, .json or .nc (netCDF, CF); may be repeated. Default: print a table.",
        ),
    ] = None,
) -> None:
    """Compute irradiance: GHI, DNI, DHI, illuminance, PAR, UV index; horizontal or tilted.

    Broadband irradiances are integrals over the wavelengths of the planet's data, which are named.
    The light of the moon and eclipses are left out.
    """
    started = time.perf_counter()
    from airlight.studies.observables.irradiance import irradiance as computed
    from airlight.studies.observables.spectral_integrals import irradiance_wavelengths
    from airlight.studies.observables.spectrum_files import table_of, write_spectrum

    files = _checked(output or [])
    plane = product.plane()
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
    nm = solve.nm(world) or irradiance_wavelengths(world)

    from airlight.solver import solve as solved

    with shown_progress() as report, named_errors("wavelengths", "altitude"):
        data = computed(
            solved(world, wavelengths=nm, progress=report, **solve.keywords()),
            scenes,
            plane=plane,
            spectral=product.spectral,
            true_distance=place.sun_distance == "true",
            progress=report,
        )
    for path in files:
        write_spectrum(path, data)
        seconds = time.perf_counter() - started
        say(f"{path}  irradiance of {world.name}, {len(scenes)} times  {seconds:.1f} s")
    if not files:
        if len(scenes) == 1 and scenes[0].time is not None:
            say(place.line(world, scenes[0]))
        say_table(table_of(data))
    if data.attrs["notes"]:
        note(data.attrs["notes"])


def _checked(files: list[Path]) -> list[Path]:
    """Raise an error for files that cannot be written."""
    from airlight.files.atomic_file import check_target
    from airlight.studies.observables.spectrum_files import SUFFIXES

    for path in files:
        if path.suffix.lower() not in SUFFIXES:
            raise FileError(path, f"the name of a table ends in {', '.join(SUFFIXES)}")
        check_target(path)
    return files

"""``airlight irradiance``: light that a plane receives, once or at a series of times."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.dataset_table import say_table
from airlight.cli.option_groups import OptionGroup, named_errors, option
from airlight.cli.planet_options import GroundOptions
from airlight.cli.series_options import SeriesOptions, at_place
from airlight.cli.solve_options import BandOptions, Quality, wavelengths_option
from airlight.errors import ConflictError, FileError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.studies.observables.plane_irradiance import Plane

EPILOG = examples(
    "airlight irradiance earth --at 40N,3.7W --time 2026-06-21T12:00Z",
    "airlight irradiance earth --sun-zenith 48.2 --tilt 37 --azimuth S",
    "airlight irradiance earth --sun-zenith 48.2 --spectral -o spectrum.csv",
    "airlight irradiance earth --sun-zenith 75 --spectral --wavelengths 355:995:10 "
    "--bandwidth 10nm",
    "airlight irradiance earth --at 40N,3.7W --start 2026-06-21T04:00Z --end 2026-06-21T20:00Z "
    "--step 10min -o day.nc",
    "airlight irradiance mars --at 4.59S,137.44E --ls 250 --time noon",
    "airlight irradiance earth --clouds cumulus --sun-zenith 40 -o cloudy.json",
)


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
class IrradianceSolveOptions(BandOptions):
    """Options of a solution whose spectra are integrated."""

    wavelengths: str | None = wavelengths_option(
        "as many as integrals need, with bands where the planet's gases have lines, or adjacent "
        "bands, from 280 nm as far as the planet's data reach"
    )
    quality: Quality = "preview"

    def bands(self, planet: Planet) -> tuple[Any, dict[str, Any]]:
        """Wavelengths, or the default ones with the keyword of their bands. [nm]"""
        from airlight.studies.observables.spectral_integrals import (
            band_wavelengths,
            irradiance_bands,
        )

        nm = self.nm(planet)
        if nm is not None:
            return nm, {}
        if self.bandwidth is not None:
            return band_wavelengths(planet, self.bandwidth), {}
        chosen, widths = irradiance_bands(planet)
        return chosen, {} if widths is None else {"bandwidth": widths}


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
    from airlight.studies.observables.spectrum_files import table_of, write_spectrum

    files = _checked(output or [])
    plane = product.plane()
    world, scenes = at_place(planet, place)
    nm, bands = solve.bands(world)

    from airlight.solver import solve as solved

    with shown_progress() as report, named_errors("wavelengths", "bandwidth", "altitude"):
        data = computed(
            solved(world, wavelengths=nm, progress=report, **solve.keywords() | bands),
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

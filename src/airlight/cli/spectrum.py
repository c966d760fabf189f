"""``airlight spectrum``: disc-integrated and limb observables of a planet."""

from __future__ import annotations

import time
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.option_groups import (
    REQUIRED,
    OptionGroup,
    given_values,
    named_errors,
    option,
)
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.solve_options import BandOptions, wavelengths_option
from airlight.errors import FileError

if TYPE_CHECKING:
    import xarray

    from airlight.planets.planet import Planet

EPILOG = examples(
    "airlight spectrum earth --of geometric-albedo --wavelengths 380:780:20",
    "airlight spectrum exoplanet --of transmission --wavelengths 400:900:10 -o transit.csv "
    "-o transit.png",
    "airlight spectrum mars --of phase-curve --wavelengths rgb -o mars.nc",
    "airlight spectrum titan --of limb --tangent-heights 0:500:10km --sun-zenith 80 -o limb.csv",
    "airlight spectrum exoplanet --of disc --phase-angles 90 --wavelengths 680,550,440",
)

#: Suffixes of figures.
_FIGURES: Final = (".png", ".svg", ".pdf")
#: Default wavelengths: those at which the planet has data. [nm]
_FIRST, _LAST, _STEP = 360, 830, 10


@dataclass(frozen=True, kw_only=True)
class ObservableOptions(OptionGroup):
    """Options of an observable."""

    of: Literal[
        "geometric-albedo", "bond-albedo", "phase-curve", "transmission", "limb", "disc"
    ] = option(
        "Observable: geometric-albedo (brightness at full phase), bond-albedo (reflected fraction "
        "of the incident light), phase-curve (brightness over phase angle), transmission "
        "(effective radius in transit), limb (radiance over tangent height), disc "
        "(disc-integrated light, and contrast to the star).",
        default=REQUIRED,
    )
    phase_angles: tuple[float, ...] | None = option(
        "Phase angles of disc (0) and phase-curve (0:180:5).",
        "LIST|FROM:TO:STEP",
        read=options.angles,
    )
    tangent_heights: tuple[float, ...] | None = option(
        "Limb: tangent heights, e.g. 0:100:5km (60 heights).",
        "LIST|FROM:TO:STEP",
        read=options.lengths,
    )
    sun_zenith: float | None = option(
        "Limb: sun zenith angle at the tangent point (60deg).", "ANGLE"
    )
    azimuth: float | None = option("Limb: azimuth between line of sight and sun (90deg).", "ANGLE")
    radius: float | None = option(
        "Radius of the reference disc of albedos (that of the ground).", "LENGTH"
    )

    def numbers(self) -> dict[str, Any]:
        """Given arguments of ``observe``."""
        return given_values(self, *(one.name for one in fields(self) if one.name != "of"))


@dataclass(frozen=True, kw_only=True)
class SpectrumOptions(BandOptions):
    """Options of a solution at the wavelengths of a spectrum."""

    wavelengths: str | None = wavelengths_option("360:830:10")


def spectrum(
    planet: PlanetOptions,
    observable: ObservableOptions,
    solve: SpectrumOptions,
    output: Annotated[
        list[Path] | None,
        options.output_option(
            "FILE",
            "Output: .csv, .json, .nc (netCDF), or a figure (.png, .svg, .pdf); may be repeated. "
            "Default: print the numbers.",
        ),
    ] = None,
) -> None:
    """Compute observables of a planet: albedos, phase curve, transit, limb, disc.

    Quadrature errors of integrals are included.
    """
    started = time.perf_counter()
    from airlight.studies.observables import observe

    files = _checked(output or [])
    given = observable.numbers()
    world = planet.load()
    nm = solve.nm(world) or _known(world)

    from airlight.solver import solve as solved

    with shown_progress() as report:
        solution = solved(world, wavelengths=nm, progress=report, **solve.keywords())
        with named_errors(*given):
            data = observe(solution, observable.of, progress=report, **given)
    for path in files:
        _write(path, data)
        say(f"{path}  {observable.of} of {world.name}  {time.perf_counter() - started:.1f} s")
    if not files:
        _print(data)
    note(data.attrs["notes"])


def _checked(files: list[Path]) -> list[Path]:
    """Raise an error for files that cannot be written."""
    from airlight.files.atomic_file import check_target
    from airlight.studies.observables.spectrum_files import SUFFIXES

    for path in files:
        if path.suffix.lower() not in (*SUFFIXES, *_FIGURES):
            allowed = ", ".join((*SUFFIXES, *_FIGURES))
            raise FileError(path, f"the name of a spectrum ends in {allowed}")
        check_target(path)
    if any(path.suffix.lower() in _FIGURES for path in files):
        from airlight.studies.plots.figure import require_matplotlib

        require_matplotlib()
    return files


def _known(planet: Planet) -> tuple[float, ...]:
    """Default wavelengths within the range of the planet; the planet's if there are none. [nm]"""
    low, high = planet.wavelength_limits
    inside = tuple(float(nm) for nm in range(_FIRST, _LAST + 1, _STEP) if low <= nm <= high)
    return inside or tuple(planet.wavelengths)


def _write(path: Path, data: xarray.Dataset) -> None:
    suffix = path.suffix.lower()
    if suffix not in _FIGURES:
        from airlight.studies.observables.spectrum_files import write_spectrum

        write_spectrum(path, data)
        return
    from airlight.files.atomic_file import atomic_file
    from airlight.studies.plots.figure import write_figure
    from airlight.studies.plots.spectrum import spectrum as drawn

    with atomic_file(path) as part, part.open("wb") as file:
        write_figure(drawn(data), file, suffix.removeprefix("."), 150.0)


def _print(data: xarray.Dataset) -> None:
    """Print the first rows."""
    from airlight.cli.dataset_table import say_table
    from airlight.studies.observables.spectrum_files import table_of

    table = table_of(data)
    say_table(table)
    for label, (value, _, meant) in table.scalars.items():
        say(f"{label} {value:.4f}: {meant}")

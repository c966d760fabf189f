"""``airlight sweep``: radiances on a grid of planets, suns and views, as Zarr."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.option_groups import REQUIRED, OptionGroup, option, option_name
from airlight.cli.planet_options import FileChanges, load, overrides_of
from airlight.cli.solve_options import (
    AccuracyOptions,
    DistributionOptions,
    NoPolarisation,
    wavelengths_option,
)
from airlight.errors import ConflictError, ParameterError

EPILOG = examples(
    "airlight sweep earth --sun-zenith 0:90:5 --view-zenith 0:85:5 --azimuth 0:180:30 -o sky.zarr",
    "airlight sweep earth mars --altitude 0m,10km,400km --sun-zenith 0:100:10 "
    "--view-zenith 0:180:10 -o two.zarr",
    "airlight sweep mars --vary dust.particles.optical_depth=0.1,0.3,1,3 --sun-zenith 0:80:20 "
    "--view-zenith 0:80:20 --wavelengths 440,550,680 -o dust.zarr",
    "airlight sweep earth --clouds cumulus --vary clouds.cover=0.1,0.3,0.5 --sun-zenith 30:80:10 "
    "--view-zenith 0 -o cover.zarr",
    "airlight sweep earth --sun-zenith 60,90 --view-zenith 0:85:5 --azimuth 0:180:15 --stokes "
    "-o pattern.zarr",
)

#: Form of the values of an axis.
_FORM = "LIST|FROM:TO:STEP"


@dataclass(frozen=True, kw_only=True)
class AxisOptions(OptionGroup):
    """Options of the axes of a grid."""

    sun_zenith: tuple[float, ...] = option(
        "Sun zenith angles, e.g. 0:90:5.", _FORM, REQUIRED, read=options.angles
    )
    view_zenith: tuple[float, ...] = option(
        "View zenith angles.", _FORM, REQUIRED, read=options.angles
    )
    altitude: tuple[float, ...] = option(
        "Observer altitudes, e.g. 0m,2km.", _FORM, "0m", read=options.lengths
    )
    azimuth: tuple[float, ...] = option(
        "Azimuths between view and sun.", _FORM, "0deg", read=options.angles
    )
    vary: list[str] | None = option(
        "Values of a key of the planet files: an additional axis. May be repeated.", "PATH=A,B,C"
    )


@dataclass(frozen=True, kw_only=True)
class GridSolveOptions(AccuracyOptions):
    """Options of the solutions of a grid."""

    wavelengths: str | None = wavelengths_option("those of the first planet")
    no_polarisation: NoPolarisation = False
    stokes: bool = option("Also store Q, U, degree and angle of polarisation.", default=False)


def sweep(
    planets: Annotated[
        list[str], typer.Argument(metavar="PLANET…", help="Planets: presets or TOML files.")
    ],
    output: Annotated[
        Path, options.output_option("DIR", "Output Zarr folder: new, or the sweep to continue.")
    ],
    axes: AxisOptions,
    given: FileChanges,
    solve: GridSolveOptions,
    distribution: DistributionOptions,
) -> None:
    """Compute the missing or changed blocks of a grid of radiances, in W m⁻² sr⁻¹ nm⁻¹.

    Axes: planet, varied keys, altitude, sun, view, azimuth and wavelength.
    """
    started = time.perf_counter()
    from airlight.planets.reading.overrides import FIELD
    from airlight.studies.sweep import Grid
    from airlight.studies.sweep import sweep as computed
    from airlight.studies.sweep.grid import AXES
    from airlight.studies.sweep.store import check_store

    if solve.stokes and solve.no_polarisation:
        raise ConflictError("--stokes", "cannot be combined with --no-polarisation")
    check_store(output, "--output")
    first = load(planets[0], given.overrides)
    try:
        grid = Grid(
            planets=planets,
            vary=dict(_varied(text) for text in axes.vary or []),
            **{name: getattr(axes, name) for name in AXES},
            common=overrides_of(given.overrides),
            wavelengths=solve.nm(first),
        )
    except ParameterError as error:
        name = error.field.partition("[")[0]
        if name == FIELD:
            raise error.named("--vary") from None
        if name not in AXES:
            raise
        raise error.named(option_name(error.field)) from None
    with shown_progress() as report, distribution.named():
        done = computed(
            grid,
            output,
            quality=solve.quality,
            polarisation=not solve.no_polarisation,
            stokes=solve.stokes,
            on_message=note,
            progress=report,
            **distribution.keywords(),
        )
    size = " x ".join(f"{n} {name}" for n, name in zip(grid.shape, grid.dims, strict=True))
    seconds = time.perf_counter() - started
    blocks = f"{done.computed} blocks computed, {done.kept} unchanged"
    say(f"{done.path}  {size}  {blocks}  {seconds:.1f} s")


def _varied(text: str) -> tuple[str, list[Any]]:
    """Path and values of a ``--vary``."""
    from airlight.studies.sweep.grid import varied

    path, sign, values = text.partition("=")
    if not sign or not path.strip() or not values.strip():
        allowed = "PATH=A,B,C or PATH=FROM:TO:STEP, such as ground.albedo=0.1,0.3"
        raise ParameterError("--vary", text, allowed)
    try:
        return path.strip(), varied(values, "--vary")
    except ParameterError as error:
        raise ParameterError("--vary", text, error.allowed) from None

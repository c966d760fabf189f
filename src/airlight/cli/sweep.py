"""``airlight sweep``: radiances on a grid of planets, suns and views, as Zarr."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from airlight.cli import options
from airlight.cli.console import note, say
from airlight.cli.distribution_options import DistributionOptions
from airlight.cli.examples import examples
from airlight.cli.option_groups import option_name
from airlight.cli.planet_options import load
from airlight.cli.progress import shown_progress
from airlight.cli.solve_options import AccuracyOptions, NoPolarisation, wavelengths_option
from airlight.errors import ConflictError, ParameterError

EPILOG = examples(
    "airlight sweep earth --sun-zenith 0:90:5 --view-zenith 0:85:5 --azimuth 0:180:30 -o sky.zarr",
    "airlight sweep earth mars --altitude 0m,10km,400km --sun-zenith 0:100:10 "
    "--view-zenith 0:180:10 -o two.zarr",
    "airlight sweep mars --vary dust.particles.optical_depth=0.1,0.3,1,3 --sun-zenith 0:80:20 "
    "--view-zenith 0:80:20 --wavelengths 440,550,680 -o dust.zarr",
    "airlight sweep earth --sun-zenith 60,90 --view-zenith 0:85:5 --azimuth 0:180:15 --stokes "
    "-o pattern.zarr",
)


@dataclass(frozen=True, kw_only=True)
class AxisOptions:
    """Options of the axes of a grid."""

    sun_zenith: Annotated[
        str, typer.Option(metavar="LIST|FROM:TO:STEP", help="Sun zenith angles, e.g. 0:90:5.")
    ]
    view_zenith: Annotated[
        str, typer.Option(metavar="LIST|FROM:TO:STEP", help="View zenith angles.")
    ]
    altitude: Annotated[
        str, typer.Option(metavar="LIST|FROM:TO:STEP", help="Observer altitudes, e.g. 0m,2km.")
    ] = "0m"
    azimuth: Annotated[
        str, typer.Option(metavar="LIST|FROM:TO:STEP", help="Azimuths between view and sun.")
    ] = "0deg"
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATH=A,B,C",
            help="Values of a key of the planet files: an additional axis. May be repeated.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class GridSolveOptions(AccuracyOptions):
    """Options of the solutions of a grid."""

    wavelengths: Annotated[str | None, wavelengths_option("those of the first planet")] = None
    no_polarisation: NoPolarisation = False
    stokes: Annotated[
        bool,
        typer.Option("--stokes", help="Also store Q, U, degree and angle of polarisation."),
    ] = False


def sweep(
    planets: Annotated[
        list[str], typer.Argument(metavar="PLANET…", help="Planets: presets or TOML files.")
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            metavar="DIR",
            help="Output Zarr folder: new, or the sweep to continue.",
        ),
    ],
    axes: AxisOptions,
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
    from airlight.studies.sweep.store import check_store

    if solve.stokes and solve.no_polarisation:
        raise ConflictError("--stokes", "cannot be combined with --no-polarisation")
    check_store(output, "--output")
    first = load(planets[0])
    try:
        grid = Grid(
            planets=planets,
            vary=dict(_varied(text) for text in axes.vary or []),
            altitude=options.values(axes.altitude, "m", "--altitude"),
            sun_zenith=options.values(axes.sun_zenith, "deg", "--sun-zenith"),
            view_zenith=options.values(axes.view_zenith, "deg", "--view-zenith"),
            azimuth=options.values(axes.azimuth, "deg", "--azimuth"),
            wavelengths=solve.nm(first),
        )
    except ParameterError as error:
        name = error.field.partition("[")[0]
        if name == FIELD:
            raise error.named("--vary") from None
        if name not in ("altitude", "sun_zenith", "view_zenith", "azimuth"):
            raise
        raise error.named(option_name(error.field)) from None
    with shown_progress() as report, distribution.named():
        done = computed(
            grid, output, quality=solve.quality, polarisation=not solve.no_polarisation,
            stokes=solve.stokes, on_message=note, progress=report, **distribution.keywords(),
        )  # fmt: skip
    size = " x ".join(f"{n} {name}" for n, name in zip(grid.shape, grid.dims, strict=True))
    say(f"{done.path}  {size}  {done.computed} blocks computed, {done.kept} unchanged  "
          f"{time.perf_counter() - started:.1f} s")  # fmt: skip


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

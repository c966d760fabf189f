"""``airlight bake``: look-up tables for engines."""

from __future__ import annotations

import math
import re
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.bake_target import BakeSolveOptions, bake_target, check_options
from airlight.cli.console import note, say
from airlight.cli.examples import examples
from airlight.cli.option_groups import given_options
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.progress import shown_progress
from airlight.engines.targets import MODULES
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.engines.baking.bake import Baked

#: Layouts of tables, and programs.
LAYOUTS = ("bruneton", "atmosphere-plus", *MODULES)
EPILOG = examples(
    "airlight bake earth --layout bruneton -o earth-tables",
    "airlight bake mars --layout bruneton --mie combined --precision half -o mars-tables",
    "airlight bake earth --layout atmosphere-plus --size 32x128x32 -o plus",
    "airlight bake earth --layout atmosphere-plus --packing phase-included --azimuth 0 -o plane",
    "airlight bake earth --layout bruneton --order 1 -o first-order",
)


@dataclass(frozen=True, kw_only=True)
class TableOptions:
    """Options of the tables."""

    mapping: Annotated[
        Literal["linear", "power", "weighted-power"] | None,
        typer.Option(help="Atmosphere-plus: mapping of the axes (weighted-power)."),
    ] = None
    packing: Annotated[
        Literal["rgba", "separate", "phase-included"] | None,
        typer.Option(
            help="Atmosphere-plus: rgba (phase functions at look-up, particles in alpha, grey), "
            "separate (a table of the particles), phase-included (radiance at --azimuth)."
        ),
    ] = None
    azimuth: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Phase-included: azimuth from the sun (0deg)."),
    ] = None
    mie: Annotated[
        Literal["separate", "combined"] | None,
        typer.Option(
            help="Bruneton: single scattering of particles in a separate table, or in alpha with "
            "colours restored at look-up."
        ),
    ] = None
    size: Annotated[
        str | None,
        typer.Option(
            metavar="NxNxN",
            help="Table size: altitude x view x sun x angle (32x128x32x8), or altitude x view x "
            "sun (32x256x32).",
        ),
    ] = None
    lowest_sun: Annotated[
        str | None,
        typer.Option(
            "--lowest-sun",
            metavar="ANGLE",
            help="Bruneton: largest sun zenith angle in the tables, 90deg to 180deg (the end of "
            "twilight).",
        ),
    ] = None
    smooth_phase: Annotated[
        Literal["own", "rayleigh"] | None,
        typer.Option(
            help="Bruneton: phase function that divides all but the particles' single scattering: "
            "own (fitted, in phase-functions.npz), or rayleigh (for shaders with Bruneton's "
            "look-up, worse in dusty air) (own)."
        ),
    ] = None
    precision: Annotated[
        Literal["half", "single"], typer.Option(help="Number format; half is scaled.")
    ] = "single"
    order: Annotated[
        str,
        typer.Option(
            metavar="K|all", help="Scattering order K only, reflections included; or all."
        ),
    ] = "all"
    cumulative: Annotated[
        bool, typer.Option("--cumulative", help="Scattering orders up to K of --order.")
    ] = False

    def check(self, layout: str) -> None:
        """Raise an error for options of other layouts."""
        other = "bruneton" if layout != "bruneton" else "atmosphere-plus"
        foreign = {
            "bruneton": ("mie", "smooth_phase", "lowest_sun"),
            "atmosphere-plus": ("packing", "mapping"),
        }
        for option in given_options(self, *foreign[other]):
            raise ConflictError(option, f"requires --layout {other}")
        if self.azimuth is not None and self.packed(layout) != "phase-included":
            raise ConflictError("--azimuth", "requires --packing phase-included")

    def given(self) -> dict[str, Any]:
        """Texts of the given options, by field."""
        return {option[2:].replace("-", "_"): v for option, v in given_options(self).items()}

    def chosen(self) -> dict[str, Any]:
        """Given options by field, for an export target."""
        given = self.given()
        if self.size is not None:
            given["size"] = self.texels("bruneton")
        if self.lowest_sun is not None:
            given["lowest_sun"] = options.angle(self.lowest_sun, "--lowest-sun")
        return given

    def packed(self, layout: str) -> str:
        """Name of the packing."""
        return self.mie or "separate" if layout == "bruneton" else self.packing or "rgba"

    def mu_s_min(self) -> float | None:
        """Cosine of ``--lowest-sun``, at most 0. [1]"""
        if self.lowest_sun is None:
            return None
        zenith = options.angle(self.lowest_sun, "--lowest-sun")
        if not 90.0 <= zenith <= 180.0:
            raise ParameterError("--lowest-sun", self.lowest_sun, "90deg to 180deg")
        return min(math.cos(math.radians(zenith)), 0.0)

    def texels(self, layout: str) -> tuple[int, ...] | None:
        """Number of texels along each axis."""
        if self.size is None:
            return None
        count, example = (4, "32x128x32x8") if layout == "bruneton" else (3, "32x256x32")
        parts = re.split(r"[xX×]", self.size.replace(" ", ""))
        if len(parts) != count or not all(part.isdecimal() and len(part) < 7 for part in parts):
            raise ParameterError("--size", self.size, f"{count} whole numbers such as {example}")
        return tuple(int(part) for part in parts)

    def scattering_order(self) -> int | None:
        """Scattering order; None for all."""
        if self.order.strip().lower() == "all":
            if self.cumulative:
                raise ConflictError("--cumulative", "requires --order K")
            return None
        if not self.order.strip().isdecimal() or len(self.order) > 6 or int(self.order) < 1:
            raise ParameterError("--order", self.order, "all, or 1, 2, 3 …")
        return int(self.order)


def bake(
    planet: PlanetOptions,
    layout: Annotated[
        str,
        typer.Option(
            metavar="|".join(LAYOUTS),
            help="Table layout: bruneton (altitude, view, sun and the angle between them), "
            "atmosphere-plus (without that angle), or the files of a program.",
        ),
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", metavar="DIR", help="Output folder: new, empty, or with tables."
        ),
    ],
    tables: TableOptions,
    solve: BakeSolveOptions,
    overwrite: options.Overwrite = False,
) -> None:
    """Bake a planet's radiation to look-up tables: NPZ, EXR and a JSON manifest.

    The tables contain scattering, transmittance and irradiance; the manifest describes the look-ups
    and the error of the tables.
    """
    if layout not in LAYOUTS:
        raise ParameterError("--layout", layout, ", ".join(LAYOUTS))
    if layout in MODULES:
        check_options(layout, tables.given())
        bake_target(layout, planet, output, tables.chosen(), solve, overwrite=overwrite)
        return
    started = time.perf_counter()
    from airlight.engines.baking.bake import bake as fill
    from airlight.engines.baking.table_files import FILES, FORMAT, write_tables
    from airlight.files.atomic_folder import check_folder
    from airlight.planets import replace

    tables.check(layout)
    mu_s_min, texels, number = tables.mu_s_min(), tables.texels(layout), tables.scattering_order()
    check_folder(output, FORMAT, FILES, overwrite=overwrite)
    world = planet.load()
    if world.refraction != "none":
        note("tables ignore refraction")
        world = replace(world, refraction="none")
    nm = options.wavelengths(solve.wavelengths, world)

    from airlight.solver import solve as solved

    with shown_progress() as report:
        solution = solved(
            world, wavelengths=nm, solver=solve.solver, progress=report, **solve.keywords()
        )
        baked = fill(
            solution,
            layout,
            mapping=tables.mapping or "weighted-power",
            packing=tables.packed(layout),
            azimuth=0.0 if tables.azimuth is None else options.angle(tables.azimuth, "--azimuth"),
            size=texels,
            precision=tables.precision,
            order=number,
            cumulative=tables.cumulative,
            mu_s_min=mu_s_min,
            smooth_phase=tables.smooth_phase or "own",
            progress=report,
        )
        manifest = write_tables(output, baked, overwrite=overwrite)
    _print(manifest, baked)
    say()
    say(f"{manifest}  {time.perf_counter() - started:.1f} s")


def _print(manifest: Path, baked: Baked) -> None:
    from airlight.engines.baking.table_files import texture_size

    folder = manifest.parent
    say(f"{'table':<24} {'texture':>14} {'channels':>8} {'stored':>7} {'NPZ':>9} {'EXR':>9}")
    for name, table in baked.tables.items():
        texture = "x".join(str(n) for n in texture_size(table) if n > 1)
        sizes = [
            f"{(folder / f'{name}.{kind}').stat().st_size / 1e3:.0f} kB" for kind in ("npz", "exr")
        ]
        say(
            f"{name:<24} {texture:>14} {len(table.channels):>8} {table.precision:>7} "
            f"{sizes[0]:>9} {sizes[1]:>9}"
        )
    say()
    say(f"{'error against the solver':<30} {'median':>9} {'RMS':>9} {'95 %':>9} {'largest':>9}")
    for name, error in baked.errors.items():
        kind = "absolute" if "absolute" in error.quantity else "relative"
        values = (error.median, error.rms, error.percentile_95, error.maximum)
        say(f"{name:<30} " + " ".join(f"{value:>9.1e}" for value in values) + f"  {kind}")

"""``airlight bake``: look-up tables for engines."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.option_groups import (
    OptionGroup,
    given_options,
    named_errors,
    option,
    option_name,
)
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.solve_options import SolveOptions, wavelengths_option
from airlight.engines.targets import MODULES
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.engines.baking.bake import Baked
    from airlight.engines.targets.target import ErrorRow, Export, Target

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
class TableOptions(OptionGroup):
    """Options of the tables."""

    mapping: Literal["linear", "power", "weighted-power"] | None = option(
        "Atmosphere-plus: mapping of the axes (weighted-power)."
    )
    packing: Literal["rgba", "separate", "phase-included"] | None = option(
        "Atmosphere-plus: rgba (phase functions at look-up, particles in alpha, grey), separate "
        "(a table of the particles), phase-included (radiance at --azimuth).",
    )
    azimuth: float | None = option("Phase-included: azimuth from the sun (0deg).", "ANGLE")
    mie: Literal["separate", "combined"] | None = option(
        "Bruneton: single scattering of particles in a separate table, or in alpha with colours "
        "restored at look-up.",
    )
    size: str | None = option(
        "Table size: altitude x view x sun x angle (32x128x32x8), or altitude x view x sun "
        "(32x256x32).",
        "NxNxN",
    )
    lowest_sun: str | None = option(
        "Bruneton: largest sun zenith angle in the tables, 90deg to 180deg (the end of twilight).",
        "ANGLE",
        read=options.unread,
    )
    smooth_phase: Literal["own", "rayleigh"] | None = option(
        "Bruneton: phase function that divides all but the particles' single scattering: own "
        "(fitted, in phase-functions.npz), or rayleigh (for shaders with Bruneton's look-up, "
        "worse in dusty air) (own).",
    )
    precision: Literal["half", "single"] = option(
        "Number format; half is scaled.", default="single"
    )
    order: str = option("Scattering order K only, reflections included; or all.", "K|all", "all")
    cumulative: bool = option("Scattering orders up to K of --order.", default=False)

    def check(self, layout: str) -> None:
        """Raise an error for options of other layouts."""
        other = "bruneton" if layout != "bruneton" else "atmosphere-plus"
        foreign = {
            "bruneton": ("mie", "smooth_phase", "lowest_sun"),
            "atmosphere-plus": ("packing", "mapping"),
        }
        for given in given_options(self, *foreign[other]):
            raise ConflictError(given, f"requires --layout {other}")
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


@dataclass(frozen=True, kw_only=True)
class BakeSolveOptions(SolveOptions):
    """Options of the solution of tables."""

    wavelengths: str = wavelengths_option(default="rgb")
    solver: Literal["moments", "direct", "montecarlo"] = option("Solver.", default="moments")

    def keywords(self) -> dict[str, Any]:
        """Keyword arguments of ``airlight.solve``."""
        return {**super().keywords(), "solver": self.solver}


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
        Path, options.output_option("DIR", "Output folder: new, empty, or with tables.")
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
    from airlight.planets.without_clouds import check_clear

    tables.check(layout)
    mu_s_min, texels, number = tables.mu_s_min(), tables.texels(layout), tables.scattering_order()
    check_folder(output, FORMAT, FILES, overwrite=overwrite)
    world = planet.load()
    check_clear(world, "tables")
    if world.refraction != "none":
        note("tables ignore refraction")
        world = replace(world, refraction="none")
    nm = options.wavelengths(solve.wavelengths, world)

    from airlight.solver import solve as solved

    with shown_progress() as report:
        solution = solved(world, wavelengths=nm, progress=report, **solve.keywords())
        baked = fill(
            solution,
            layout,
            mapping=tables.mapping or "weighted-power",
            packing=tables.packed(layout),
            azimuth=tables.azimuth or 0.0,
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


def bake_target(
    name: str,
    planet: PlanetOptions,
    output: Path,
    chosen: Mapping[str, Any],
    solve: BakeSolveOptions,
    *,
    overwrite: bool,
) -> None:
    """Solve a planet and write it for a program.

    Parameters
    ----------
    name : str
        Name of the layout.
    planet, output, solve, overwrite
        Options of the command.
    chosen : mapping
        Given table options by field: ``size`` as numbers of texels, ``lowest_sun`` in degrees,
        others as texts.
    """
    started = time.perf_counter()
    from airlight.engines.targets import target_of
    from airlight.files.atomic_folder import check_folder
    from airlight.planets import replace
    from airlight.planets.without_clouds import check_clear

    program = target_of(name)
    wavelengths = None if solve.wavelengths == "rgb" else solve.wavelengths
    if wavelengths is not None and program.wavelengths is not None:
        fixed = ", ".join(f"{one:g}" for one in program.wavelengths)
        raise ConflictError(f"--layout {name}", f"takes no --wavelengths: they are {fixed} nm")
    check_folder(output, program.form, program.files, overwrite=overwrite)
    world = planet.load()
    check_clear(world, program.program)
    if world.refraction != "none" and not program.bends_light:
        note(f"{program.program} ignores refraction")
        world = replace(world, refraction="none")
    text = wavelengths or program.default_wavelengths
    nm = program.wavelengths or options.wavelengths(text, world)

    from airlight.solver import solve as solved

    with shown_progress() as report:
        solution = solved(world, wavelengths=nm, progress=report, **solve.keywords())
        with named_errors(*chosen):
            export = program.write(solution, output, overwrite=overwrite, progress=report, **chosen)
    print_export(program, export)
    say()
    say(f"{export.folder}  {time.perf_counter() - started:.1f} s")


def check_options(name: str, chosen: Mapping[str, Any]) -> None:
    """Raise an error for table options that a target does not support."""
    from airlight.engines.targets import target_of

    try:
        target_of(name).check_options(chosen)
    except ConflictError as error:
        raise ConflictError(f"--layout {name}", f"takes no {option_name(error.field)}") from None


def print_export(program: Target, export: Export) -> None:
    """Print the files of an export, with errors, fitted formulas and notes."""
    say(f"for {program.program} {program.version}")
    for name, size in export.files.items():
        say(f"  {name:<32} {_bytes(size):>10}")
    if export.errors:
        say()
        say(f"{'error against the solver':<40} {'median':>9} {'95 %':>9} {'largest':>9}")
        for row in export.errors:
            say(f"  {row.name:<38} {_statistics(row)}  {row.measure}; {row.where}")
    for fit in export.fitted:
        numbers = (f"{name} = {value:.4g}" for name, value in fit.parameters.items())
        say()
        say(f"fitted: {fit.name}: {', '.join((fit.form, *numbers))}; {fit.where}")
        for name, value in fit.errors.items():
            say(f"  {name:<38} {value:>9.1e}")
    if export.notes:
        say()
    for line in export.notes:
        say(f"note: {line}")


def _statistics(row: ErrorRow) -> str:
    values = (row.median, row.percentile_95, row.largest)
    return " ".join(f"{value:>9.1e}" for value in values)


def _bytes(size: int) -> str:
    return f"{size} B" if size < 1000 else f"{size / 1e3:.0f} kB"

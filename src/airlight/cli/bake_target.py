"""``airlight bake --layout PROGRAM``: files for an export target."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.console import note, say
from airlight.cli.option_groups import named_errors, option_name
from airlight.cli.progress import shown_progress
from airlight.cli.solve_options import SolveOptions, wavelengths_option
from airlight.errors import ConflictError

if TYPE_CHECKING:
    from airlight.cli.planet_options import PlanetOptions
    from airlight.engines.targets.target import ErrorRow, Export, Target


@dataclass(frozen=True, kw_only=True)
class BakeSolveOptions(SolveOptions):
    """Options of the solution of tables."""

    wavelengths: Annotated[str, wavelengths_option()] = "rgb"
    solver: Annotated[Literal["moments", "direct", "montecarlo"], typer.Option(help="Solver.")] = (
        "moments"
    )


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

    program = target_of(name)
    wavelengths = None if solve.wavelengths == "rgb" else solve.wavelengths
    if wavelengths is not None and program.wavelengths is not None:
        fixed = ", ".join(f"{one:g}" for one in program.wavelengths)
        raise ConflictError(f"--layout {name}", f"takes no --wavelengths: they are {fixed} nm")
    check_folder(output, program.form, program.files, overwrite=overwrite)
    world = planet.load()
    if world.refraction != "none" and not program.bends_light:
        note(f"{program.program} ignores refraction")
        world = replace(world, refraction="none")
    text = wavelengths or program.default_wavelengths
    nm = program.wavelengths or options.wavelengths(text, world)

    from airlight.solver import solve as solved

    with shown_progress() as report:
        solution = solved(
            world, wavelengths=nm, solver=solve.solver, progress=report, **solve.keywords()
        )
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

"""``airlight bake --layout PROGRAM``: files that a program loads as they are."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from airlight.cli import options
from airlight.cli.console import note, say
from airlight.cli.progress import shown_progress
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.targets.target import ErrorRow, Export, Target


def bake_target(
    name: str,
    planet: str,
    output: Path,
    *,
    chosen: Mapping[str, Any],
    wavelengths: str | None,
    solver: str,
    quality: str,
    polarisation: bool,
    set_: list[str] | None,
    cache: bool,
    overwrite: bool,
) -> None:
    """Solve a planet and write it for a program.

    Parameters
    ----------
    name : str
        Name of the layout.
    planet, output, solver, quality, set_
        Arguments of the command.
    chosen : mapping
        Options of tables that were given, by their names in Python: ``size`` as numbers of texels,
        ``lowest_sun`` in degrees, others as texts.
    wavelengths : str, optional
        Text of ``--wavelengths``, if it was given.
    polarisation, cache, overwrite : bool
        Whether light is polarised; whether solutions are read from disk and kept there; whether
        files that are not airlight's may be replaced.

    Raises
    ------
    ParameterError
        For an option that the program does not have.
    """
    started = time.perf_counter()
    from airlight.exports.atomic_folder import check_folder
    from airlight.planets import replace
    from airlight.targets import target_of

    program = target_of(name)
    if wavelengths is not None and program.wavelengths is not None:
        fixed = ", ".join(f"{one:g}" for one in program.wavelengths)
        raise ConflictError(f"--layout {name}", f"takes no --wavelengths: they are {fixed} nm")
    check_folder(output, program.form, program.files, overwrite=overwrite)
    world = options.planet(planet, set_)
    if world.refraction != "none" and not program.bends_light:
        note(f"{program.program} ignores refraction")
        world = replace(world, refraction="none")
    text = wavelengths or program.default_wavelengths
    nm = program.wavelengths or options.wavelengths(text, world)

    from airlight.solvers import solve

    with shown_progress() as report:
        solution = solve(
            world, wavelengths=nm, quality=quality, solver=solver, polarisation=polarisation,
            cache=cache, progress=report,
        )  # fmt: skip
        try:
            export = program.write(solution, output, overwrite=overwrite, progress=report, **chosen)
        except ParameterError as error:
            if error.field not in chosen:
                raise
            raise error.named("--" + error.field.replace("_", "-")) from None
    print_export(program, export)
    say()
    say(f"{export.folder}  {time.perf_counter() - started:.1f} s")


def check_options(name: str, chosen: Mapping[str, Any]) -> None:
    """Refuse options of tables that a program does not have."""
    from airlight.targets import target_of

    try:
        target_of(name).check_options(chosen)
    except ConflictError as error:
        option = "--" + error.field.replace("_", "-")
        raise ConflictError(f"--layout {name}", f"takes no {option}") from None


def print_export(program: Target, export: Export) -> None:
    """Print the files of a folder, their errors, fitted formulas and notes."""
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

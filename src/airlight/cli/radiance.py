"""``airlight radiance``: radiances of one observer, or of a file of observers."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.option_groups import (
    given_options,
    given_values,
    named_errors,
    option,
)
from airlight.cli.place_options import on_floor
from airlight.cli.planet_options import LocalGroundOptions
from airlight.cli.radiance_observers import ObserverOptions, timed_cases
from airlight.cli.series_options import TimesOptions
from airlight.cli.solve_options import BandOptions, DistributionOptions, wavelengths_option
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from airlight.cli.console import Report
    from airlight.planets.planet import Planet
    from airlight.studies.sweep.cases import Cases

EPILOG = examples(
    "airlight radiance earth --altitude 0m --sun-zenith 60 --view-zenith 30 --azimuth 90",
    "airlight radiance mars --altitude 2m --sun-zenith 45 --view-zenith 0 --wavelengths 600,450",
    "airlight radiance earth --sun-zenith 60 --view-zenith 0 --latitude 72 --longitude -40",
    "airlight radiance earth --at 40N,3.7W --time 2026-06-21T08:00Z --view-zenith 0:80:10 "
    "--view-azimuth 0",
    "airlight radiance earth --input cases.csv --output out.csv",
    "airlight radiance earth --input - --output - < cases.csv > out.csv",
    "airlight radiance earth --sun-zenith 92 --view-zenith 60 --solver montecarlo "
    "--relative-error 0.005",
    "airlight radiance earth --sun-zenith 80 --view-zenith 30 --azimuth 180 --stokes",
    "airlight radiance earth --sun-zenith 90:102:2 --view-zenith 0 --photometric",
    "airlight radiance saturn --sun-zenith 30 --view-zenith 20 --latitude 15 --sun-azimuth S",
)

#: Rows of a file per call of the solution.
BLOCK = 4096


@dataclass(frozen=True, kw_only=True)
class SolverOptions(BandOptions):
    """Options of the solution and of the solver."""

    wavelengths: str | None = wavelengths_option("those of the planet")
    stokes: bool = option(
        "Stokes parameters I, Q and U, degree (dolp) and angle of linear polarisation (aolp, from "
        "the meridian plane, counterclockwise, in degrees).",
        default=False,
    )
    photometric: bool = option(
        "Also luminance [cd m-2] and V surface brightness [mag arcsec-2], from 400:700:20 unless "
        "--wavelengths is given.",
        default=False,
    )
    solver: str = option(
        "Solver; montecarlo traces every radiance and adds its standard error.",
        "{solver.solve:SOLVERS}",
        "moments",
    )
    relative_error: float | None = option(
        "Monte Carlo: target relative standard error (preview 0.03, default 0.005, fine 0.001).",
        "NUMBER",
    )
    seed: int | None = option("Monte Carlo: seed of the random numbers (1).", "NUMBER")

    def chosen(self, planet: Planet) -> tuple[float, ...]:
        """Wavelengths of the option, of photometry or of the planet. [nm]"""
        given = self.nm(planet)
        if given is None and self.photometric:
            from airlight.studies.observables.brightness import BRIGHTNESS_WAVELENGTHS

            return BRIGHTNESS_WAVELENGTHS
        if self.photometric and given is not None and len(given) < 2:
            raise ParameterError("--wavelengths", self.wavelengths, "two or more for --photometric")
        return given or tuple(planet.wavelengths)

    def settings(self) -> Any:
        """Name of the quality, or Monte Carlo settings."""
        from airlight.solver.solve import SOLVERS

        if self.solver not in SOLVERS:
            raise ParameterError("--solver", self.solver, ", ".join(SOLVERS))
        if self.stokes and self.solver == "direct":
            raise ConflictError("--stokes", "requires --solver moments or montecarlo")
        if self.stokes and self.no_polarisation:
            raise ConflictError("--stokes", "cannot be combined with --no-polarisation")
        if self.photometric and (self.stokes or self.solver == "montecarlo"):
            other = "--stokes" if self.stokes else "--solver montecarlo"
            raise ConflictError("--photometric", f"cannot be combined with {other}")
        if self.solver == "montecarlo" and self.bandwidth is not None:
            raise ConflictError("--bandwidth", "cannot be combined with --solver montecarlo")
        if self.solver != "montecarlo":
            for one in given_options(self, "relative_error", "seed"):
                raise ConflictError(one, "requires --solver montecarlo")
            return self.quality
        from airlight.solver.montecarlo.settings import settings_for

        given = given_values(self, "relative_error", "seed")
        with named_errors(*given):
            return replace(settings_for(self.quality), **given)


def radiance(
    planet: LocalGroundOptions,
    observers: ObserverOptions,
    when: TimesOptions,
    solve: SolverOptions,
    distribution: DistributionOptions,
) -> None:
    """Compute spectral radiance along a line of sight, in W m⁻² sr⁻¹ nm⁻¹.

    The observer may be on the ground, within the atmosphere or outside.
    """
    started = time.perf_counter()
    settings, place = solve.settings(), {} if when.timed else observers.place(planet)
    if place and solve.solver == "montecarlo":
        raise ConflictError("--sun-azimuth", "cannot be combined with --solver montecarlo")
    long = observers.from_file and solve.solver == "moments" and not observers.labelled
    long = long and not solve.photometric and not when.timed
    for given in () if long else given_options(distribution):
        raise ConflictError(given, "requires --input FILE, a .csv output and --solver moments")
    if long:
        observers.check_file(planet)
        world = planet.load()
        _long_table(world, observers, solve.chosen(world), solve, distribution)
        _say_written(observers, started)
        return
    if when.timed:
        world, cases = timed_cases(planet, observers, when)
    else:
        if observers.view_azimuth is not None:
            raise ConflictError("--view-azimuth", "requires --at")
        cases = observers.cases(planet)
        world = planet.load()
        if place and not world.rings:
            raise ConflictError("--sun-azimuth", "requires a planet with rings")
        if observers.input_ is None:
            world = _ground_of(world, planet, observers, cases)
    nm = solve.chosen(world)
    sampled, stokes = solve.solver == "montecarlo", solve.stokes
    from airlight.solver import solve as solved
    from airlight.studies.sweep.cases import error_columns, radiance_columns, write_cases

    columns = radiance_columns(nm, stokes=stokes)
    columns += error_columns(nm, stokes=stokes) if sampled else []
    _warn_of_repeated(columns, cases.header)

    errors: NDArray[np.float64] | None = None
    histories: NDArray[np.int64] | None = None
    with shown_progress() as report, named_errors("bandwidth"):
        how = {**solve.keywords(), "quality": settings, "progress": report}
        if solve.solver == "moments":
            from airlight.kernel.first_compilation import FIRST_COMPILATION
            from airlight.solver.moments.loops import RADIANCE_LOOPS

            FIRST_COMPILATION.expect(RADIANCE_LOOPS)
        solution: Any = solved(world, wavelengths=nm, solver=solve.solver, **how)
        if sampled:
            values, errors, histories = _estimates(solution, cases, stokes)
        else:
            values = _answers(solution, cases, len(columns), report, stokes=stokes, **place)
    if solve.photometric:
        cases = _with_brightness(solution, cases, values)
    if observers.labelled:
        from airlight.studies.sweep.case_dataset import case_dataset, write_dataset

        data = case_dataset(
            cases, nm, values, errors, stokes=stokes, attributes=solution.provenance
        )
        write_dataset(observers.output, data)
    elif cases.header:
        write_cases(observers.output, cases, nm, values, errors, stokes=stokes)
    elif stokes:
        _print_stokes(nm, values[0], None if errors is None else errors[0], histories)
    else:
        _print(nm, values, errors, histories)
    _say_written(observers, started)
    missed = _missed(solution, cases)
    if missed:
        note(f"{missed} of {len(cases.values)} lines of sight miss the atmosphere: radiance 0")
    if solution.report.ground:
        note(solution.report.ground)
    if sampled and solution.report.unreached:
        note(solution.report)


def _say_written(observers: ObserverOptions, started: float) -> None:
    """Print the path of the output, if it is a file."""
    if observers.output != "-":
        say(f"{observers.output}  {time.perf_counter() - started:.1f} s")


def _ground_of(
    world: Planet, planet: LocalGroundOptions, observers: ObserverOptions, cases: Cases
) -> Planet:
    """Planet lowered to the observers, with their altitudes above its ground."""
    height = float(cases.values[0, 0])
    several = bool((cases.values[:, 0] != height).any())
    if planet.latitude is not None and several:
        raise ConflictError("--latitude", "requires a single --altitude")
    if several and cases.values[:, 0].min() < 0.0:
        raise ParameterError("--altitude", observers.altitude, "a single altitude if below 0")
    world, above = on_floor(world, height)
    if above != height:
        height = cases.values[:, 0] = above
    if observers.sun_azimuth is not None and planet.longitude is None:
        return world
    return planet.local(world, height)


def _with_brightness(solution: Any, cases: Cases, values: NDArray[np.float64]) -> Cases:
    """Table of observers with luminance and V; printed if there is none."""
    from airlight.studies.observables.brightness import COLUMNS, brightness

    luminance, magnitude = brightness(solution, values)
    if not cases.header:
        say(f"luminance  {luminance[0]:.6g} cd m⁻²")
        say(f"V  {magnitude[0]:.4f} mag arcsec⁻²")
        return cases
    found = zip(cases.rows, luminance, magnitude, strict=True)
    rows = [[*row, f"{light:.8g}", f"{v:.6g}"] for row, light, v in found]
    return replace(cases, header=[*cases.header, *COLUMNS], rows=rows)


def _print(
    nm: Sequence[float],
    values: NDArray[np.float64],
    errors: NDArray[np.float64] | None,
    histories: NDArray[np.int64] | None,
) -> None:
    """Print the radiance of an observer, a line per wavelength."""
    for k, wavelength in enumerate(nm):
        text = f"{wavelength:.10g} nm  {values[0, k]:.8e}"
        if errors is None or histories is None:
            say(f"{text} W m⁻² sr⁻¹ nm⁻¹")
        else:
            say(f"{text} ± {errors[0, k]:.1e} W m⁻² sr⁻¹ nm⁻¹  ({histories[0, k]} histories)")


def _print_stokes(
    nm: Sequence[float],
    values: NDArray[np.float64],
    errors: NDArray[np.float64] | None,
    histories: NDArray[np.int64] | None,
) -> None:
    """Print the Stokes parameters of an observer, a line per wavelength."""
    table = values.reshape(5, len(nm)).T
    spread = None if errors is None else errors.reshape(3, len(nm)).T
    for k, (wavelength, (*light, degree, angle)) in enumerate(zip(nm, table, strict=True)):
        texts = [f"{name} {value:.8e}" for name, value in zip("IQU", light, strict=True)]
        if spread is not None:
            texts = [f"{text} ± {one:.1e}" for text, one in zip(texts, spread[k], strict=True)]
        line = f"{wavelength:.10g} nm  {'  '.join(texts)} W m⁻² sr⁻¹ nm⁻¹"
        seen = f"{angle:.3f}".replace("-90.000", "90.000")  # one angle
        line += f"  dolp {degree:.5f}  aolp {seen}°"
        say(line if histories is None else f"{line}  ({histories[0, k]} histories)")


def _long_table(
    planet: Planet,
    observers: ObserverOptions,
    nm: Sequence[float],
    solve: SolverOptions,
    distribution: DistributionOptions,
) -> None:
    """Append radiances to the rows of a file, block by block."""
    from airlight.studies.sweep.cases import case_blocks, radiance_columns
    from airlight.studies.sweep.rows import answer_rows
    from airlight.studies.sweep.shared_solution import RadianceTask

    assert observers.input_ is not None
    with case_blocks(observers.input_, 1) as (head, _):
        _warn_of_repeated(radiance_columns(nm, stokes=solve.stokes), head.header)
    parallel = distribution.keywords()
    if not given_options(distribution):
        parallel["workers"] = 1
    task = RadianceTask(
        planet=planet, wavelengths=tuple(nm), stokes=solve.stokes, **solve.keywords()
    )
    with shown_progress() as report, distribution.named():
        kept = answer_rows(task, observers.input_, observers.output, progress=report, **parallel)
    if kept:
        note(f"{kept} rows had been computed before")


def _warn_of_repeated(columns: Sequence[str], header: Sequence[str]) -> None:
    """Warn about result columns that the input already has."""
    repeated = [column for column in columns if column in header]
    if repeated:
        note(
            f"the input already has {', '.join(repeated)}; computed values are in the last columns"
        )


def _answers(
    solution: Any, cases: Cases, count: int, report: Report, *, stokes: bool, **place: float
) -> NDArray[np.float64]:
    """Result columns of all rows, shape (n, count)."""
    import numpy as np

    from airlight.studies.sweep.shared_solution import stokes_layers

    total = len(cases.values)
    out = np.empty((total, count))
    for start in range(0, total, BLOCK):
        altitude, sun, view, azimuth = cases.values[start : start + BLOCK].T
        rays = {"altitude": altitude, "sun_zenith": sun, "view_zenith": view, "azimuth": azimuth}
        found = solution.radiance(**rays, stokes=stokes, **place)
        parts = stokes_layers(found) if stokes else [found]
        out[start : start + BLOCK] = np.concatenate(parts, axis=-1)
        report(min(start + BLOCK, total), total, "radiance")
    return out


def _missed(solution: Any, cases: Cases) -> int:
    """Number of lines of sight that miss the planet."""
    altitude, sun, view, azimuth = cases.values.T
    lines, _ = solution.lines_of_sight(
        altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth
    )
    return int(((lines.length <= 0.0) & ~lines.to_ground).sum())


def _estimates(
    solution: Any, cases: Cases, stokes: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Result columns, standard errors and histories of all rows."""
    import numpy as np

    from airlight.studies.sweep.shared_solution import stokes_layers

    altitude, sun, view, azimuth = cases.values.T
    where = {"altitude": altitude, "sun_zenith": sun, "view_zenith": view, "azimuth": azimuth}
    if not stokes:
        data = solution.estimate(**where)
        return data["radiance"].values, data["standard_error"].values, data["histories"].values
    data = solution.estimate(**where, stokes=True)
    errors = data["stokes_standard_error"].values
    return (
        np.concatenate(stokes_layers(data["stokes_radiance"]), axis=-1),
        errors.reshape(len(errors), -1),
        data["histories"].values,
    )

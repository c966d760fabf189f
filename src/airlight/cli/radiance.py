"""``airlight radiance``: radiances for one observer, or for a file of observers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from airlight.cli import options
from airlight.cli.console import note, say
from airlight.cli.distribution_options import DistributionOptions
from airlight.cli.examples import examples
from airlight.cli.option_groups import given_options, named_errors, option_name
from airlight.cli.place_options import on_floor
from airlight.cli.planet_options import LocalGroundOptions
from airlight.cli.progress import shown_progress
from airlight.cli.solve_options import SolveOptions, wavelengths_option
from airlight.errors import ConflictError, ParameterError
from airlight.files.input_files import LARGEST_CASES, check_input

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from airlight.cli.progress import Report
    from airlight.planets.planet import Planet
    from airlight.studies.sweep.cases import Cases

EPILOG = examples(
    "airlight radiance earth --altitude 0m --sun-zenith 60 --view-zenith 30 --azimuth 90",
    "airlight radiance mars --altitude 2m --sun-zenith 45 --view-zenith 0 --wavelengths 600,450",
    "airlight radiance earth --sun-zenith 60 --view-zenith 0 --latitude 72 --longitude -40",
    "airlight radiance earth --input cases.csv --output out.csv",
    "airlight radiance earth --input - --output - < cases.csv > out.csv",
    "airlight radiance earth --sun-zenith 92 --view-zenith 60 --solver montecarlo "
    "--relative-error 0.005",
    "airlight radiance earth --sun-zenith 80 --view-zenith 30 --azimuth 180 --stokes",
)

#: Solvers that can be selected.
SOLVERS = ("moments", "direct", "montecarlo")

#: Rows of a file per call of the solution.
BLOCK = 4096


@dataclass(frozen=True, kw_only=True)
class ObserverOptions:
    """Options of the observers: one, a table by lists and ranges, or a file."""

    altitude: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="Observer altitude above ground (0m). Lists (0m,2km) and ranges (0:10:2km), here "
            "and below, print a table.",
        ),
    ] = None
    sun_zenith: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Sun zenith angle at the observer.")
    ] = None
    view_zenith: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="View zenith angle at the observer."),
    ] = None
    azimuth: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Azimuth between view and sun (0deg)."),
    ] = None
    input_: Annotated[
        str | None,
        typer.Option(
            "--input",
            metavar="FILE",
            help="Input CSV with altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg; - is "
            "standard input.",
        ),
    ] = None
    output: Annotated[
        str,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Output, with --input: .csv (the input with radiance_<nm>nm appended) or .nc "
            "(netCDF); - is standard output. An interrupted .csv is continued.",
        ),
    ] = "-"

    @property
    def labelled(self) -> bool:
        """Whether the output is a netCDF file."""
        return self.output.lower().endswith(".nc")

    @property
    def from_file(self) -> bool:
        """Whether the observers are those of a file on disk."""
        return self.input_ not in (None, "-")

    def _texts(self) -> dict[str, str | None]:
        names = ("altitude", "sun_zenith", "view_zenith", "azimuth")
        return {option_name(name): getattr(self, name) for name in names}

    def check_file(self, planet: LocalGroundOptions) -> None:
        """Refuse options of one observer with a file of observers, and an unwritable target."""
        from airlight.studies.sweep.cases import check_table

        where = given_options(planet, "latitude", "longitude")
        for option, text in {**self._texts(), **where}.items():
            if text is not None:
                raise ConflictError(option, "cannot be combined with --input")
        check_table(self.output)

    def cases(self, planet: LocalGroundOptions) -> Cases:
        """Observers of the file, or of the options."""
        if self.input_ is None:
            return _observers(self._texts(), self.output)
        from airlight.studies.sweep.cases import read_cases

        self.check_file(planet)
        return read_cases(self.input_)


@dataclass(frozen=True, kw_only=True)
class SolverOptions(SolveOptions):
    """Options of the solution and of the solver."""

    wavelengths: Annotated[str | None, wavelengths_option("those of the planet")] = None
    stokes: Annotated[
        bool,
        typer.Option(
            "--stokes",
            help="Stokes parameters I, Q and U, degree (dolp) and angle of linear polarisation "
            "(aolp, from the meridian plane, counterclockwise, in degrees).",
        ),
    ] = False
    solver: Annotated[
        str,
        typer.Option(
            metavar="|".join(SOLVERS),
            help="Solver; montecarlo traces every radiance and adds its standard error.",
        ),
    ] = "moments"
    relative_error: Annotated[
        float | None,
        typer.Option(
            metavar="NUMBER",
            help="Monte Carlo: target relative standard error (preview 0.03, default 0.005, fine "
            "0.001).",
        ),
    ] = None
    seed: Annotated[
        int | None,
        typer.Option(metavar="NUMBER", help="Monte Carlo: seed of the random numbers (1)."),
    ] = None

    def settings(self) -> Any:
        """Name of the quality, or Monte Carlo settings made from it."""
        if self.solver not in SOLVERS:
            raise ParameterError("--solver", self.solver, ", ".join(SOLVERS))
        if self.stokes and self.solver == "direct":
            raise ConflictError("--stokes", "requires --solver moments or montecarlo")
        if self.stokes and self.no_polarisation:
            raise ConflictError("--stokes", "cannot be combined with --no-polarisation")
        if self.solver != "montecarlo":
            for option in given_options(self, "relative_error", "seed"):
                raise ConflictError(option, "requires --solver montecarlo")
            return self.quality
        from airlight.solver.montecarlo.settings import settings_for

        given = {"relative_error": self.relative_error, "seed": self.seed}
        given = {name: value for name, value in given.items() if value is not None}
        with named_errors(*given):
            return replace(settings_for(self.quality), **given)  # type: ignore[arg-type]


def radiance(
    planet: LocalGroundOptions,
    observers: ObserverOptions,
    solve: SolverOptions,
    distribution: DistributionOptions,
) -> None:
    """Compute spectral radiance along a line of sight, in W m⁻² sr⁻¹ nm⁻¹.

    The observer may be on the ground, in the air or outside it.
    """
    settings = solve.settings()
    if observers.from_file:
        check_input(str(observers.input_), LARGEST_CASES)
    long = observers.from_file and solve.solver == "moments" and not observers.labelled
    for option in () if long else given_options(distribution):
        raise ConflictError(option, "requires --input FILE, a .csv output and --solver moments")
    if long:
        observers.check_file(planet)
        world = planet.load()
        _long_table(world, observers, solve.nm(world) or world.wavelengths, solve, distribution)
        return
    cases = observers.cases(planet)
    world = planet.load()
    if observers.input_ is None:
        world = _ground_of(world, planet, observers, cases)
    nm = solve.nm(world) or world.wavelengths
    sampled, stokes = solve.solver == "montecarlo", solve.stokes
    from airlight.solver import solve as solved
    from airlight.studies.sweep.cases import error_columns, radiance_columns, write_cases

    columns = radiance_columns(nm, stokes=stokes)
    columns += error_columns(nm, stokes=stokes) if sampled else []
    _warn_of_repeated(columns, cases.header)

    errors: NDArray[np.float64] | None = None
    histories: NDArray[np.int64] | None = None
    with shown_progress() as report:
        solution: Any = solved(
            world, wavelengths=nm, solver=solve.solver, progress=report,
            **{**solve.keywords(), "quality": settings},
        )  # fmt: skip
        if sampled:
            values, errors, histories = _estimates(solution, cases, stokes)
        else:
            values = _answers(solution, cases, len(columns), stokes, report)
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
    missed = _missed(solution, cases)
    if missed:
        note(f"{missed} of {len(cases.values)} lines of sight miss the atmosphere: radiance 0")
    if solution.report.ground:
        note(solution.report.ground)
    if sampled and solution.report.unreached:
        note(solution.report)


def _ground_of(
    world: Planet, planet: LocalGroundOptions, observers: ObserverOptions, cases: Cases
) -> Planet:
    """Planet with the ground below the observers, whose altitudes become those above it."""
    height = float(cases.values[0, 0])
    several = bool((cases.values[:, 0] != height).any())
    if planet.latitude is not None and several:
        raise ConflictError("--latitude", "requires a single --altitude")
    if several and cases.values[:, 0].min() < 0.0:
        raise ParameterError("--altitude", observers.altitude, "a single altitude if below 0")
    world, above = on_floor(world, height)
    if above != height:
        height = cases.values[:, 0] = above
    return planet.local(world, height)


def _print(
    nm: Sequence[float],
    values: NDArray[np.float64],
    errors: NDArray[np.float64] | None,
    histories: NDArray[np.int64] | None,
) -> None:
    """Print the radiance of one observer, a line per wavelength."""
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
    """Print the polarised light of one observer, a line per wavelength."""
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
    """Answer the rows of a file block by block."""
    from airlight.studies.sweep.cases import case_blocks, radiance_columns
    from airlight.studies.sweep.rows import Lines, answer_rows

    assert observers.input_ is not None
    with case_blocks(observers.input_, 1) as (head, _):
        _warn_of_repeated(radiance_columns(nm, stokes=solve.stokes), head.header)
    parallel = distribution.keywords()
    if not given_options(distribution):
        parallel["workers"] = 1
    with shown_progress() as report, distribution.named():
        listed = tuple(float(one) for one in nm)
        lines = Lines(planet=planet, wavelengths=listed, stokes=solve.stokes, **solve.keywords())
        kept = answer_rows(lines, observers.input_, observers.output, progress=report, **parallel)
    if kept:
        note(f"{kept} rows had been computed before")


def _warn_of_repeated(columns: Sequence[str], header: Sequence[str]) -> None:
    """Warn of columns that the input has already."""
    repeated = [column for column in columns if column in header]
    if repeated:
        note(
            f"the input already has {', '.join(repeated)}; computed values are in the last columns"
        )


def _observers(texts: dict[str, str | None], output: str) -> Cases:
    """Parse the observers of the options: one, or a row for each of their lists and ranges."""
    import numpy as np

    from airlight.physics.units import MOST_VALUES
    from airlight.scene.limits import DEEPEST_ALTITUDE, within
    from airlight.studies.sweep.cases import COLUMNS, Cases

    if output != "-":
        raise ParameterError("--output", output, "only together with --input")
    filled = {"--altitude": "0m", "--azimuth": "0deg"}
    axes = []
    for (option, given), (low, high) in zip(texts.items(), COLUMNS.values(), strict=True):
        text = filled.get(option) if given is None else given
        if text is None:
            raise typer.BadParameter(
                f"{option} is missing: an angle such as 60deg, or --input FILE"
            )
        unit = "m" if option == "--altitude" else "deg"
        low = DEEPEST_ALTITUDE if option == "--altitude" else low
        numbers = options.values(text, unit, option)
        axes.append([within(option, number, low, high, unit) for number in numbers])
    values = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
    if len(values) > MOST_VALUES:
        allowed = f"at most {MOST_VALUES}; longer tables by --input or airlight sweep"
        raise ParameterError("number of observers", len(values), allowed)
    if len(values) == 1:
        return Cases(comments=[], header=[], rows=[[]], values=values)
    rows = [[f"{number:.10g}" for number in row] for row in values]
    return Cases(comments=[], header=list(COLUMNS), rows=rows, values=values)


def _answers(
    solution: Any, cases: Cases, count: int, stokes: bool, report: Report
) -> NDArray[np.float64]:
    """Cells of all rows, shape (n, count)."""
    import numpy as np

    from airlight.studies.sweep.cases import polarised_answers

    total = len(cases.values)
    out = np.empty((total, count))
    for start in range(0, total, BLOCK):
        altitude, sun, view, azimuth = cases.values[start : start + BLOCK].T
        found = solution.radiance(
            altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth, stokes=stokes
        )
        out[start : start + BLOCK] = polarised_answers(found) if stokes else found
        report(min(start + BLOCK, total), total, "radiance")
    return out


def _missed(solution: Any, cases: Cases) -> int:
    """Number of lines of sight that pass the planet by."""
    altitude, sun, view, azimuth = cases.values.T
    lines, _ = solution.lines_of_sight(
        altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth
    )
    return int(((lines.length <= 0.0) & ~lines.to_ground).sum())


def _estimates(
    solution: Any, cases: Cases, stokes: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Cells of all rows, standard errors and histories, (n, 5·, 3· or 1·wavelengths)."""
    from airlight.studies.sweep.cases import polarised_answers

    altitude, sun, view, azimuth = cases.values.T
    where = {"altitude": altitude, "sun_zenith": sun, "view_zenith": view, "azimuth": azimuth}
    if not stokes:
        data = solution.estimate(**where)
        return data["radiance"].values, data["standard_error"].values, data["histories"].values
    data = solution.estimate(**where, stokes=True)
    errors = data["stokes_standard_error"].values
    return (
        polarised_answers(data["stokes_radiance"]),
        errors.reshape(len(errors), -1),
        data["histories"].values,
    )

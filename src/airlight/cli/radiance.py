"""``airlight radiance``: numbers for one observer, or for a file of them."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer

from airlight.cli import options
from airlight.cli.cases import Cases, radiance_columns, read_cases, write_cases
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import ParameterError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from airlight.cli.progress import Report

EPILOG = examples(
    "airlight radiance earth --altitude 0m --sun-zenith 60 --view-zenith 30 --azimuth 90",
    "airlight radiance mars --altitude 2m --sun-zenith 45 --view-zenith 0 --wavelengths 600,450",
    "airlight radiance earth --input cases.csv --output out.csv",
    "airlight radiance earth --input - --output - < cases.csv > out.csv",
)

#: So many rows of a file are asked at once.
BLOCK = 4096


def radiance(
    planet: options.Planet_,
    altitude: Annotated[
        str | None,
        typer.Option(metavar="LENGTH", help="Of the observer above the ground (0m)."),
    ] = None,
    sun_zenith: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Zenith angle of the sun at the observer.")
    ] = None,
    view_zenith: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Zenith angle of the line of sight at the observer."),
    ] = None,
    azimuth: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Between view and sun; 0 is the sun's side (0deg)."),
    ] = None,
    input_: Annotated[
        str | None,
        typer.Option(
            "--input",
            metavar="FILE",
            help="A CSV with altitude_m, sun_zenith_deg, view_zenith_deg, azimuth_deg; - is "
            "the standard input.",
        ),
    ] = None,
    output: Annotated[
        str,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="With --input: the same CSV with radiance_<nm>nm appended; - is the standard "
            "output.",
        ),
    ] = "-",
    wavelengths: Annotated[
        str | None,
        typer.Option(
            metavar="LIST", help="In nm, such as 680,550,440; the planet's own if left out."
        ),
    ] = None,
    quality: options.Quality = "default",
    no_cache: options.NoCache = False,
) -> None:
    """Compute spectral radiance along a line of sight, in W m⁻² sr⁻¹ nm⁻¹.

    The observer may be on the ground, in the air or outside it.
    """
    from airlight.exports.whole_file import check_target

    single = {
        "--altitude": altitude,
        "--sun-zenith": sun_zenith,
        "--view-zenith": view_zenith,
        "--azimuth": azimuth,
    }
    if input_ is None:
        if output != "-":
            raise ParameterError("--output", output, "only together with --input")
        cases = _one_case(single)
    else:
        for option, text in single.items():
            if text is not None:
                raise ParameterError(option, text, "not together with --input")
        if output != "-":
            check_target(output)
        cases = read_cases(input_)

    from airlight.planets import load_planet

    world = load_planet(planet)
    nm = world.wavelengths if wavelengths is None else options.wavelengths(wavelengths, world)
    repeated = [column for column in radiance_columns(nm) if column in cases.header]
    if repeated:
        note = f"{', '.join(repeated)} stood in the input already; ours are the last columns"
        print(f"airlight: {note}", file=sys.stderr)

    from airlight.solvers import solve

    with shown_progress() as report:
        solution = solve(
            world, wavelengths=nm, quality=quality, cache=not no_cache, progress=report
        )
        values = _answers(solution, cases, len(nm), report)
    if input_ is not None:
        write_cases(output, cases, nm, values)
        return
    for wavelength, value in zip(nm, values[0], strict=True):
        print(f"{wavelength:.10g} nm  {value:.8e} W m⁻² sr⁻¹ nm⁻¹")


def _one_case(texts: dict[str, str | None]) -> Cases:
    import numpy as np

    from airlight.cli.cases import COLUMNS
    from airlight.scene.limits import within

    filled = {"--altitude": "0m", "--azimuth": "0deg"}
    row = []
    for (option, given), (low, high) in zip(texts.items(), COLUMNS.values(), strict=True):
        text = filled.get(option) if given is None else given
        if text is None:
            raise typer.BadParameter(
                f"{option} is missing: an angle such as 60deg, or --input FILE"
            )
        is_length = option == "--altitude"
        value = (options.length if is_length else options.angle)(text, option)
        row.append(within(option, value, low, high, "m" if is_length else "deg"))
    return Cases(comments=[], header=[], rows=[[]], values=np.array([row]))


def _answers(solution: Any, cases: Cases, count: int, report: Report) -> NDArray[np.float64]:
    import numpy as np

    total = len(cases.values)
    out = np.empty((total, count))
    for start in range(0, total, BLOCK):
        altitude, sun, view, azimuth = cases.values[start : start + BLOCK].T
        out[start : start + BLOCK] = solution.radiance(
            altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=azimuth
        )
        report(min(start + BLOCK, total), total, "radiance")
    return out

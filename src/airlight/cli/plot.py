"""``airlight plot``: a planet in figures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from airlight.cli import options
from airlight.cli.console import console, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import FileError, ParameterError
from airlight.plots.catalogue import KINDS, Choices, Work, check_choices, draw, kind_named

_KINDS = [f"{name}: {kind.sentence}" for name, kind in KINDS.items()]
EPILOG = "\n\n".join(
    [
        "Kinds:",
        *_KINDS,
        examples(
            "airlight plot earth density -o density.png",
            "airlight plot mars sky-profile --sun-zenith 80 -o sky.svg",
            "airlight plot earth limb --wavelengths 680,550,440 -o limb.pdf",
            "airlight plot earth polarisation-plane --sun-zenith 70 -o neutral-points.png",
            "airlight plot --list",
        ),
    ]
)

#: Suffixes of a plot's file name.
_SUFFIXES = (".png", ".svg", ".pdf")
#: Smallest and largest resolution. [pixel/inch]
_DPI = (20.0, 1200.0)


def _print_kinds(asked: bool) -> None:
    if not asked:
        return
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    table.add_column("kind", style="bold", no_wrap=True)
    table.add_column("description")
    for name, kind in KINDS.items():
        table.add_row(name, kind.sentence)
    console().print(table)
    raise typer.Exit


def plot(
    planet: options.Planet_,
    kind: Annotated[str, typer.Argument(metavar="KIND", help="Kind of figure; see --list.")],
    output: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="FILE", help="Output figure: .png, .svg or .pdf."),
    ],
    wavelengths: Annotated[
        str | None,
        typer.Option(
            metavar="rgb|N|LIST",
            help="Wavelengths: rgb (680, 550, 440 nm), a number over the visible, or a list in nm.",
        ),
    ] = None,
    sun_zenith: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Sun zenith angle.")
    ] = None,
    altitude: Annotated[
        str | None, typer.Option(metavar="LENGTH", help="Observer altitude above ground.")
    ] = None,
    quality: Annotated[
        Literal["preview", "default", "fine"] | None,
        typer.Option(help="Solver accuracy."),
    ] = None,
    no_polarisation: options.NoPolarisation = False,
    dpi: Annotated[
        float,
        typer.Option(
            metavar="NUMBER", help="Resolution in pixels per inch; figures are 8 inches wide."
        ),
    ] = 150.0,
    list_: Annotated[
        bool, typer.Option("--list", callback=_print_kinds, is_eager=True, help="List all kinds.")
    ] = False,
    set_: options.Set = None,
    no_cache: options.NoCache = False,
) -> None:
    """Plot a figure of a planet: star, atmosphere, radiation or tables.

    Options that the kind does not use are rejected.
    """
    from airlight.exports.atomic_file import atomic_file, check_target
    from airlight.plots.figure import require_matplotlib, write_figure

    kind_named(kind)
    suffix = output.suffix.lower()
    if suffix not in _SUFFIXES:
        raise FileError(output, f"the name of a plot ends in {', '.join(_SUFFIXES)}")
    check_target(output)
    if not _DPI[0] <= dpi <= _DPI[1]:
        raise ParameterError("--dpi", dpi, f"{_DPI[0]:g} to {_DPI[1]:g}")
    require_matplotlib()
    world = options.planet(planet, set_)
    choices = Choices(
        wavelengths=None if wavelengths is None else options.wavelengths(wavelengths, world),
        sun_zenith=None if sun_zenith is None else options.angle(sun_zenith, "--sun-zenith"),
        altitude=None if altitude is None else options.length(altitude, "--altitude"),
        quality=quality,
        polarisation=False if no_polarisation else None,
    )
    try:
        check_choices(kind, choices)
    except ParameterError as error:
        name = "no-polarisation" if error.field == "polarisation" else error.field
        raise error.named(f"--{name.replace('_', '-')}") from None
    with shown_progress() as report:
        figure = draw(world, kind, choices, Work(cache=not no_cache, progress=report))
    with atomic_file(output) as part, part.open("wb") as file:
        write_figure(figure, file, suffix.removeprefix("."), dpi)
    say(f"{output}  {kind} of {world.name}")

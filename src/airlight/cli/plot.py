"""``airlight plot``: figures of a planet."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from airlight.cli import options
from airlight.cli.console import console, say
from airlight.cli.examples import examples
from airlight.cli.option_groups import named_errors, read_options
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.progress import shown_progress
from airlight.cli.solve_options import NoCache, NoPolarisation, wavelengths_option
from airlight.errors import FileError, ParameterError
from airlight.studies.plots.catalogue import KINDS, Choices, Work, check_choices, draw, kind_named

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

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


@dataclass(frozen=True, kw_only=True)
class ChoiceOptions:
    """Options of some kinds of figures."""

    wavelengths: Annotated[str | None, wavelengths_option("those of the kind")] = None
    sun_zenith: Annotated[str | None, typer.Option(metavar="ANGLE", help="Sun zenith angle.")] = (
        None
    )
    altitude: Annotated[
        str | None, typer.Option(metavar="LENGTH", help="Observer altitude above ground.")
    ] = None
    quality: Annotated[
        Literal["preview", "default", "fine"] | None,
        typer.Option(help="Solver accuracy (that of the kind)."),
    ] = None
    no_polarisation: NoPolarisation = False

    def choices(self, planet: Planet) -> Choices:
        """Values of the options; None for omitted ones."""
        nm = self.wavelengths
        return Choices(
            wavelengths=None if nm is None else options.wavelengths(nm, planet),
            **read_options(self, {"sun_zenith": options.angle, "altitude": options.length}),
            quality=self.quality,
            polarisation=False if self.no_polarisation else None,
        )


def plot(
    planet: PlanetOptions,
    kind: Annotated[str, typer.Argument(metavar="KIND", help="Kind of figure; see --list.")],
    output: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="FILE", help="Output figure: .png, .svg or .pdf."),
    ],
    chosen: ChoiceOptions,
    no_cache: NoCache = False,
    dpi: Annotated[
        float,
        typer.Option(
            metavar="NUMBER", help="Resolution in pixels per inch; figures are 8 inches wide."
        ),
    ] = 150.0,
    list_: Annotated[
        bool, typer.Option("--list", callback=_print_kinds, is_eager=True, help="List all kinds.")
    ] = False,
) -> None:
    """Plot a figure of a planet: star, atmosphere, radiation or tables.

    Options that the kind does not use are rejected.
    """
    from airlight.files.atomic_file import atomic_file, check_target
    from airlight.studies.plots.figure import require_matplotlib, write_figure

    kind_named(kind)
    suffix = output.suffix.lower()
    if suffix not in _SUFFIXES:
        raise FileError(output, f"the name of a plot ends in {', '.join(_SUFFIXES)}")
    check_target(output)
    if not _DPI[0] <= dpi <= _DPI[1]:
        raise ParameterError("--dpi", dpi, f"{_DPI[0]:g} to {_DPI[1]:g}")
    require_matplotlib()
    world = planet.load()
    choices = chosen.choices(world)
    texts = ("wavelengths", "sun_zenith", "altitude", "quality")
    with named_errors(*texts, polarisation="--no-polarisation"):
        check_choices(kind, choices)
    with shown_progress() as report:
        figure = draw(world, kind, choices, Work(cache=not no_cache, progress=report))
    with atomic_file(output) as part, part.open("wb") as file:
        write_figure(figure, file, suffix.removeprefix("."), dpi)
    say(f"{output}  {kind} of {world.name}")

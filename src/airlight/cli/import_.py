"""``airlight import``: planet files from users' own tables."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from airlight.cli import options
from airlight.cli.console import examples, note, say
from airlight.cli.option_groups import OptionGroup, given_values, named_errors, option
from airlight.errors import ConflictError, FileError, ParameterError

EPILOG = examples(
    "airlight import atmosphere afglms.dat -o summer.toml",
    "airlight import aerosol dust.csv --planet summer.toml --optical-depth 0.3 -o dusty.toml",
    "airlight import aerosol site.aod site.ssa site.pfn -o site.toml",
    "airlight import albedo sand.spectrum.txt -o desert.toml",
    'airlight import star flux.txt --header "wavelength [nm], irradiance [mW/m^2/nm]" -o star.toml',
)

#: Options by the field that errors name.
_FIELDS: Final = {"planet": "--planet", "units": "--unit", "select": "--select"}


@dataclass(frozen=True, kw_only=True)
class ColumnOptions(OptionGroup):
    """Options of the table."""

    unit: list[str] | None = option(
        "Unit of a column, instead of that of the header: 'pressure=hPa'. May be repeated.",
        "COLUMN=UNIT",
    )
    header: str | None = option(
        "Names and units of a text file without them, with commas between.", "NAMES"
    )
    select: list[str] | None = option(
        "Coordinate of a NetCDF file at which the nearest element is taken: reff=10. May be "
        "repeated.",
        "NAME=NUMBER",
    )

    def keywords(self) -> dict[str, Any]:
        """Arguments of ``import_table``."""
        select = {}
        for name, text in _pairs(self.select, "--select").items():
            try:
                select[name] = float(text)
            except ValueError:
                allowed = "NAME=NUMBER, such as reff=10"
                raise ParameterError("--select", f"{name}={text}", allowed) from None
        units = _pairs(self.unit, "--unit")
        return {"units": units, "header": self.header, "select": select}


@dataclass(frozen=True, kw_only=True)
class PartOptions(OptionGroup):
    """Options of the part that is replaced."""

    name: str = option("Constituent of aerosol and profile.", "NAME", "aerosol")
    ground_altitude: float | None = option(
        "Altitude in the table of the planet's ground, of atmosphere and profile (0m).", "LENGTH"
    )
    optical_depth: float | None = option(
        "Vertical optical depth of an aerosol at 550 nm, to which its extinction is scaled."
    )
    angular_radius: float | None = option("Angular radius of a star's disc.", "ANGLE")


def import_(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="KIND", help="Kind of table: {planets.importing.import_table:KINDS}."
        ),
    ],
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE...",
            help="Text file (CSV, blanks between columns, AFGL, Wyoming, WOUDC, AERONET, "
            "ECOSTRESS, USGS) or NetCDF. Of an aerosol, several complete each other.",
        ),
    ],
    output: Annotated[
        Path | None, options.output_option("FILE", "Planet file to write. Default: print it.")
    ] = None,
    base: Annotated[
        str,
        typer.Option(
            "--planet", metavar="PLANET", help="Preset or planet file that has the other parts."
        ),
    ] = "earth",
    *,
    table: ColumnOptions,
    part: PartOptions,
) -> None:
    """Write a planet file from a table: atmosphere, aerosol, profile, albedo or star.

    Units stand in the header: pressure [hPa], p(mb), temperature_C. Rows are thinned to what
    solvers need; the error is printed and stands in the file.
    """
    from airlight.planets.importing.import_table import import_table

    if output is not None and output.suffix.lower() != ".toml":
        raise FileError(output, "the name of a planet file ends in .toml")
    if output is not None and output.exists() and output.resolve() == Path(base).resolve():
        raise ConflictError("--output", "requires another file than --planet, whose comments go")
    details = given_values(part, "ground_altitude", "optical_depth", "angular_radius")
    with named_errors("optical_depth", "ground_altitude", "name", **_FIELDS):
        made = import_table(
            kind, *files, planet=base, name=part.name, **table.keywords(), **details
        )
    if output is None:
        for line in made.text.splitlines():
            say(line)
        return
    for path in made.save(output):
        say(f"{path}  {made.planet.name}")
    for line in made.notes:
        note(line)


def _pairs(texts: list[str] | None, name: str) -> dict[str, str]:
    """Names and values of texts ``NAME=VALUE``."""
    pairs = {}
    for text in texts or []:
        key, equals, value = text.partition("=")
        if not equals or not key.strip() or not value.strip():
            raise ConflictError(name, f"requires NAME=VALUE, not {text!r}")
        pairs[key.strip()] = value.strip()
    return pairs

"""A planet from a user's table: one function for files and objects of Python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import FileError, ParameterError
from airlight.files.atomic_file import atomic_file, check_target
from airlight.physics.data_tables.any_table import data_table
from airlight.physics.data_tables.data_table import DataTable
from airlight.physics.units import quantity
from airlight.planets.importing.aerosols import import_aerosol
from airlight.planets.importing.atmospheres import import_atmosphere
from airlight.planets.importing.planet_tables import PlanetTables
from airlight.planets.importing.profiles import import_profile
from airlight.planets.importing.surfaces_and_stars import import_albedo, import_star
from airlight.planets.parameters import inside
from airlight.planets.reading.reader import read_planet
from airlight.planets.spectral import PerWavelength

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Kinds of table, each with what is read.
KINDS: Final = {
    "atmosphere": "pressure, temperature and ozone over altitude",
    "aerosol": "optical properties over wavelength",
    "profile": "density or extinction of a constituent over altitude",
    "albedo": "reflectance of the ground over wavelength",
    "star": "irradiance over wavelength",
}


#: Further parameters of each kind.
_DETAILS: Final = {
    "atmosphere": ("ground_altitude",),
    "aerosol": ("optical_depth",),
    "profile": ("ground_altitude",),
    "albedo": (),
    "star": ("angular_radius",),
}
#: Words for what is replaced, in the name of the planet.
_PARTS: Final = {"atmosphere": "air", "albedo": "ground"}
#: Number of wavelengths from which the spectrum of a star has a file of its own.
_LONG: Final = 120


@dataclass(frozen=True, eq=False)
class ImportedPlanet:
    """Planet made of a table; accepted wherever a planet is.

    Attributes
    ----------
    planet : Planet
        Planet.
    tables : PlanetTables
        Tables of its file, with comments.

    Examples
    --------
    >>> table = {"wavelength [nm]": [400.0, 800.0], "reflectance": [0.2, 0.4]}
    >>> desert = import_table("albedo", table, planet="earth-bruneton")
    >>> desert.planet.ground.albedos([600.0]).round(6)
    array([0.3])
    """

    planet: Planet
    tables: PlanetTables

    @property
    def notes(self) -> tuple[str, ...]:
        """What was kept, with errors, and what was left out."""
        return tuple(self.tables.notes)

    @property
    def text(self) -> str:
        """Text of the planet file."""
        return self.tables.text()

    def save(self, path: str | Path) -> tuple[Path, ...]:
        """Write the planet file, and beside it the spectrum of its star if that is long.

        Returns
        -------
        tuple of Path
            Files.
        """
        path = Path(path)
        star = self.tables.tables["star"]
        law = self.planet.star.irradiance
        check_target(path)
        if not isinstance(law, PerWavelength) or len(law.wavelengths) < _LONG:
            _write(path, self.text)
            return (path,)
        beside = path.with_name(f"{path.stem}-star.csv")
        check_target(beside)
        rows = "".join(
            f"{nm:.8g},{one:.6g}\n" for nm, one in zip(law.wavelengths, law.values, strict=True)
        )
        head = f"# unit: W m-2 nm-1\n# source: {self.tables.source}\nwavelength,irradiance\n"
        self.tables.tables["star"] = {
            "irradiance": beside.name,
            "angular_radius": star["angular_radius"],
        }
        try:
            text = self.text
        finally:
            self.tables.tables["star"] = star
        _write(beside, head + rows)
        _write(path, text)
        return path, beside


def _write(path: Path, text: str) -> None:
    with atomic_file(path) as part:
        part.write_text(text, encoding="utf-8")


def import_table(
    kind: str,
    *tables: object,
    planet: str | Path = "earth",
    name: str = "aerosol",
    units: Mapping[str, str] | None = None,
    header: str | None = None,
    select: Mapping[str, float] | None = None,
    **details: Any,
) -> ImportedPlanet:
    """Planet with a part replaced by a table.

    Parameters
    ----------
    kind : str
        ``atmosphere``, ``aerosol``, ``profile``, ``albedo`` or ``star``.
    *tables : path, xarray.Dataset, pandas.DataFrame or mapping
        Table, see ``data_table``; of an aerosol several may complete each other.
    planet : str or Path
        Preset or planet file that has the other parts.
    name : str
        Constituent of ``aerosol`` and ``profile``; added if the planet has none of this name.
    units, header, select : mapping, str, mapping, optional
        Units by column, header of a text file without one, coordinates at which the nearest
        element of a dataset is taken.
    **details
        ``ground_altitude`` of an atmosphere: altitude in the table of the planet's ground [m];
        ``optical_depth`` of an aerosol at 550 nm, to which its extinction is scaled;
        ``angular_radius`` of a star. [deg]

    Returns
    -------
    ImportedPlanet
        Planet, text of its file, and notes.

    Raises
    ------
    FileError, ParameterError
        If a column or unit is missing or wrong, with file, line, column, value and what is allowed.

    Examples
    --------
    >>> haze = {"wavelength [nm]": [440.0, 680.0], "extinction [1/km]": [0.2, 0.1],
    ...         "ssa": [0.95, 0.93], "g": [0.7, 0.65]}
    >>> hazy = import_table("aerosol", haze, planet="earth-bruneton")
    >>> [one.name for one in hazy.planet.constituents]
    ['air', 'aerosol', 'ozone']
    """
    if kind not in KINDS:
        raise ParameterError("kind", kind, ", ".join(KINDS))
    if not tables or (len(tables) > 1 and kind != "aerosol"):
        allowed = "one or more" if kind == "aerosol" else "one"
        raise ParameterError("tables", len(tables), allowed)
    read = [data_table(one, units=units, header=header, select=select) for one in tables]
    for one in read:
        if not all(column.values.size for column in one.columns):
            raise FileError(one.source, "has no rows")
    changed = PlanetTables(planet, ", ".join(Path(one.source).name for one in read))
    _change(kind, changed, read, name, details)
    changed.rename(name if kind in ("aerosol", "profile") else _PARTS.get(kind, kind))
    made = read_planet(changed.text(), changed.source, changed.folder)
    return ImportedPlanet(made, changed)


def _change(
    kind: str,
    planet: PlanetTables,
    tables: Sequence[DataTable],
    name: str,
    details: Mapping[str, Any],
) -> None:
    """Replace the part of the planet."""
    allowed = _DETAILS[kind]
    for key in details:
        if key not in allowed:
            words = ", ".join(allowed) or "none"
            raise ParameterError(f"details of {kind}", key, words)
    given = {key: one for key, one in details.items() if one is not None}
    ground = quantity(given.get("ground_altitude", 0.0), "m", "ground_altitude", bare=True)
    if kind == "atmosphere":
        import_atmosphere(planet, tables[0], ground)
    elif kind == "profile":
        import_profile(planet, tables[0], name, ground)
    elif kind == "aerosol":
        depth = given.get("optical_depth")
        if depth is not None:
            depth = inside(depth, "optical_depth", 0.0, 1e4, "", above=False, below=False)
        import_aerosol(planet, tables, name, depth)
    elif kind == "albedo":
        import_albedo(planet, tables[0])
    else:
        radius = given.get("angular_radius")
        if radius is not None:
            degrees = quantity(radius, "deg", "angular_radius", bare=True)
            radius = f"{degrees:.6g} deg"
        import_star(planet, tables[0], radius)

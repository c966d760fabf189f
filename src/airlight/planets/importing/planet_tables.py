"""Tables of a planet file that imports change, with comments and notes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import ParameterError
from airlight.planets.reading.nested_tables import Tables
from airlight.planets.reading.planet_file import planet_file
from airlight.planets.reading.reader import declared_planet, nested_tables, planet_text

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Keys of what a constituent is made of.
_MATTER: Final = (
    *("wavelengths", "scattering", "absorption", "extinction", "single_scattering_albedo"),
    *("optical_depth", "gas", "particles", "turbidity", "turbidity_literal", "phase_function"),
)
#: Order of the keys of a constituent.
_ORDER: Final = ("name", "gas", "wavelengths")


class PlanetTables:
    """Tables of a planet file under change.

    Parameters
    ----------
    base : str or Path
        Name of a preset, or path of a planet file, whose parts are kept where they are not
        replaced.
    source : str
        Name of the table, for comments.
    """

    def __init__(self, base: str | Path, source: str) -> None:
        text, file, folder = planet_text(base)
        self.tables: Tables = _with_whole_paths(nested_tables(text, file), folder)
        self.folder = folder
        self.base: Planet = declared_planet(self.tables, folder)
        self.base_file = file
        self.source = source
        self.notes: list[str] = []
        self.comments: dict[str, str] = {}

    def constituent_of(self, name: str, *, gas: bool = False) -> tuple[dict[str, Any], str]:
        """Table of a constituent, new if there is none, and its name.

        Parameters
        ----------
        name : str
            Name.
        gas : bool
            Whether the first constituent that is a gas is meant where none has the name.
        """
        found: list[dict[str, Any]] = self.tables.setdefault("constituents", [])
        for one in found:
            if one.get("name") == name:
                return one, name
        if gas:
            for one in found:
                if "gas" in one or _is_rayleigh(one):
                    return one, str(one["name"])
        made: dict[str, Any] = {"name": name}
        found.append(made)
        return made, name

    def matter(self, place: dict[str, Any], values: Mapping[str, Any]) -> None:
        """Replace what a constituent is made of, and its profile if one is given."""
        for key in _MATTER:
            place.pop(key, None)
        place.update(values)
        first = [key for key in _ORDER if key in place]
        ordered = {key: place[key] for key in (*first, *(k for k in place if k not in first))}
        place.clear()
        place.update(ordered)

    def rename(self, part: str) -> None:
        """Name and description that say what is replaced by what."""
        self.tables["name"] = f"{self.base.name}, {part} of {self.source}"[:60]
        self.tables["description"] = f"{self.base.name} with {part} of {self.source}."

    def comment(self, path: str, line: str) -> None:
        """Comment on a table, by the name of its constituent or its key."""
        self.comments[path] = line

    def text(self) -> str:
        """Text of the planet file."""
        head = (
            str(self.tables["description"]),
            f"Other parts are those of {Path(self.base_file).name}, whose file has their sources.",
            *(f"{note[0].upper()}{note[1:]}." for note in self.notes),
        )
        return planet_file(self.tables, head, self.comments)


def _with_whole_paths(value: Any, folder: Path | None) -> Any:
    """Copy of nested tables with whole paths of the files that the planet file names."""
    if isinstance(value, dict):
        copy = {key: _with_whole_paths(one, folder) for key, one in value.items()}
        if isinstance(copy.get("file"), str) and folder is not None:
            copy["file"] = str((folder / copy["file"]).resolve())
        return copy
    if isinstance(value, list):
        return [_with_whole_paths(one, folder) for one in value]
    if isinstance(value, str) and value.endswith(".csv") and folder is not None:
        return str((folder / value).resolve())
    return value


def _is_rayleigh(table: Mapping[str, Any]) -> bool:
    phase, scattering = table.get("phase_function"), table.get("scattering")
    return (isinstance(phase, dict) and phase.get("kind") == "rayleigh") or (
        isinstance(scattering, dict) and ("rayleigh" in scattering or "refractivity" in scattering)
    )


def numbers_text(values: Iterable[float], unit: str, digits: int) -> str:
    """Numbers with commas between them and a unit at the end, different ones as different texts.

    Examples
    --------
    >>> numbers_text([0.0, 1.5], "km", 4)
    '0, 1.5 km'
    """
    numbers = [float(one) for one in values]
    texts = [f"{one:.{digits}g}" for one in numbers]
    if len(set(texts)) < len(set(numbers)):
        texts = [repr(one) for one in numbers]
    if len(texts) < 2:
        raise ParameterError("values", len(texts), "two numbers or more")
    return f"{', '.join(texts)} {unit}"

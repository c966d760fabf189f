"""Reader of planet files: from TOML with units to a ``Planet``."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, Final, Protocol, TypeAlias

from numpy.typing import ArrayLike

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.planets.reading.overrides import overridden, with_hint
from airlight.planets.schema.toml_table import TomlTable, suggestion

#: Largest size of a planet file. [byte]
LARGEST_FILE: Final = 4_000_000


class HasPlanet(Protocol):
    """Object with a planet, such as a solution."""

    @property
    def planet(self) -> Planet | None:
        """Planet that was solved."""


#: Accepted types of a planet.
PlanetLike: TypeAlias = Planet | str | Path | HasPlanet


@cache
def planet_names() -> tuple[str, ...]:
    """Names of the planets in the package.

    Examples
    --------
    >>> "earth" in planet_names()
    True
    """
    folder = resources.files("airlight.planets") / "presets"
    found = [entry.name for entry in folder.iterdir() if entry.name.endswith(".toml")]
    return tuple(sorted(name.removesuffix(".toml") for name in found))


def load_planet(
    name_or_path: PlanetLike,
    overrides: Mapping[str, Any] | None = None,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Planet:
    """Load a planet by the name of a preset, or from a planet file.

    Parameters
    ----------
    name_or_path : str, Path, Planet or Solution
        One of ``planet_names()``, or the path of a TOML file (``docs/planet-files.md``). Of a
        solution its planet is returned, and a planet itself.
    overrides : mapping, optional
        Values of keys by path, as in the file: constituents by name, None to remove a key.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``; Mie computations take seconds.

    Raises
    ------
    FileError
        If the file does not exist, cannot be read, or is not TOML.
    ParameterError
        If the name is unknown, the file is invalid, or overrides are given for a planet object.

    Examples
    --------
    >>> load_planet("earth-atmosphere-plus").top_radius
    6460000.0
    >>> load_planet("earth", {"ground.albedo": 0.3, "shell.top_radius": "6500 km"}).ground.albedo
    0.3
    """
    made = name_or_path if isinstance(name_or_path, Planet) else None
    made = getattr(name_or_path, "planet", None) if made is None else made
    if isinstance(made, Planet):
        if overrides:
            raise ConflictError("overrides", "do not apply to a Planet object: use replace()")
        return made
    if not isinstance(name_or_path, (str, Path)):
        allowed = "a Planet, a solution, the name of a preset, or the path to a TOML file"
        raise ParameterError("planet", name_or_path, allowed)
    text, file, folder = planet_text(name_or_path)
    return read_planet(text, file, folder, overrides, progress=progress, cancel=cancel)


def planet_text(name_or_path: str | Path) -> tuple[str, str, Path | None]:
    """Text of a planet file, by the name of a preset or its path.

    Parameters
    ----------
    name_or_path : str or Path
        Name or path, as for ``load_planet``.

    Returns
    -------
    text : str
        TOML.
    file : str
        Name in errors.
    folder : Path or None
        Folder of named files; None for a preset.

    Examples
    --------
    >>> planet_text("mars")[1]
    'mars.toml'
    """
    if isinstance(name_or_path, str) and name_or_path in planet_names():
        file = resources.files("airlight.planets") / "presets" / f"{name_or_path}.toml"
        return file.read_text(encoding="utf-8"), f"{name_or_path}.toml", None
    if not isinstance(name_or_path, (str, Path)) or not str(name_or_path):
        raise ParameterError("planet", name_or_path, "a name, or the path to a TOML file")
    path = Path(name_or_path)
    try:
        there = path.exists()
    except (OSError, ValueError):
        there = False
    if isinstance(name_or_path, str) and not there and path.suffix != ".toml":
        names = suggestion(name_or_path, planet_names())
        raise ParameterError("planet", name_or_path, f"{names}; or the path to a TOML file")
    return file_text(path), str(path), path.parent


def file_text(path: Path) -> str:
    """Text of a file, of limited size.

    Raises
    ------
    FileError
        If it does not exist, cannot be read, is too large, or is not UTF-8.
    """
    try:
        if path.is_dir():
            raise FileError(path, "is a folder; allowed: a TOML file")
        if path.exists() and not path.is_file():
            raise FileError(path, "is not a regular file; allowed: a TOML file")
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise FileError(path, (error.strerror or type(error).__name__).lower()) from None
    except ValueError:  # a null character within the name
        raise FileError(repr(str(path)), "is not a file name") from None
    if len(content) > LARGEST_FILE:
        raise FileError(path, f"is larger than {LARGEST_FILE} bytes; allowed: a planet file")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(path, f"is not UTF-8 text at byte {error.start}") from None


def _own_wavelengths(planet: Planet) -> tuple[float, ...]:
    return planet.wavelengths


def read_planet(
    text: str,
    file: str,
    folder: Path | None = None,
    overrides: Mapping[str, Any] | None = None,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Planet:
    """Read a planet from the text of a planet file.

    Parameters
    ----------
    text : str
        Text in TOML.
    file : str
        Name in errors.
    folder : Path, optional
        Folder of named files; default: the working directory.
    overrides : mapping, optional
        Changes as for ``load_planet``.
    """
    tables = nested_tables(text, file)
    return read_tables(tables, file, folder, overrides, progress=progress, cancel=cancel)


def read_tables(
    tables: Mapping[str, Any],
    file: str,
    folder: Path | None = None,
    overrides: Mapping[str, Any] | None = None,
    *,
    wavelengths: Callable[[Planet], ArrayLike] = _own_wavelengths,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Planet:
    """Read a planet from the nested tables of a planet file.

    Parameters
    ----------
    tables : mapping
        Tables from ``nested_tables``; not modified.
    file, folder, overrides, progress, cancel
        See ``read_planet``.
    wavelengths : callable
        ``wavelengths(planet)``, at which the planet's medium is computed for validation and cached;
        default: the planet's. [nm]
    """
    try:
        changed = tables if overrides is None else overridden(tables, overrides)
        planet = declared_planet(changed, folder)
        # Raise the error here, where the file is known.
        clear = planet.without_clouds
        Medium.from_planet(clear, wavelengths(planet), progress=progress, cancel=cancel)
        return planet
    except ParameterError as error:
        if overrides:
            error = with_hint(error, tables, overrides)
        raise error.in_file(file) from None


def declared_planet(tables: Mapping[str, Any], folder: Path | None = None) -> Planet:
    """Planet from the nested tables of a file, without validation of its medium."""
    return Planet.read(TomlTable(tables, folder=folder))


def nested_tables(text: str, file: str) -> dict[str, Any]:
    """Nested tables of a planet file, unchecked."""
    try:
        return tomllib.loads(text.replace("\r\n", "\n"))
    except RecursionError:
        raise FileError(file, "is not TOML: nested too deeply") from None
    except ValueError as error:  # TOMLDecodeError, and integers of thousands of digits
        raise FileError(file, f"is not TOML: {error}") from None

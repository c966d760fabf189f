"""Table of a planet file: typed reads, and a check for unknown keys."""

from __future__ import annotations

import contextlib
import difflib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from airlight.errors import Collector, ParameterError, changed
from airlight.physics.units import quantities, quantity
from airlight.planets.parameters import MISSING, numbers
from airlight.planets.spectral import (
    LONGEST,
    SHORTEST,
    PerWavelength,
    Spectral,
    check_wavelength_list,
)

#: Longest list of a file.
LONGEST_LIST = 10_000


class TomlTable:
    """Table of a TOML file, with its path in the file.

    Parameters
    ----------
    values : dict
        Contents from the TOML parser.
    path : str
        Path for errors: ``constituents[1].profile``; empty for the file.
    folder : Path, optional
        Folder of the planet file and of files named in it.
    thickness : float, optional
        Thickness of the shell, over which optical depths are spread. [m]
    """

    def __init__(
        self,
        values: Any,
        path: str = "",
        folder: Path | None = None,
        thickness: float | None = None,
    ) -> None:
        if not isinstance(values, dict):
            raise ParameterError(path, values, "a table with keys and values")
        self._values: dict[str, Any] = values
        self._read: list[str] = []
        self.path = path
        self.folder = folder
        self.thickness = thickness

    def name_of(self, key: str) -> str:
        """Full path of a key."""
        return f"{self.path}.{key}" if self.path else key

    def __contains__(self, key: str) -> bool:
        self.note((key,))
        return key in self._values

    def note(self, keys: Iterable[str]) -> None:
        """Mark keys as read."""
        self._read += [key for key in keys if key not in self._read]

    @property
    def names(self) -> tuple[str, ...]:
        """Keys of a table whose keys are names."""
        return tuple(self._values)

    def raw(self, key: str) -> Any:
        """Value from the TOML parser, or None."""
        self.note((key,))
        return self._values.get(key)

    def required(self, key: str, allowed: str) -> Any:
        """Value from the TOML parser; an error if absent."""
        if key not in self:
            raise ParameterError(self.name_of(key), MISSING, allowed)
        return self._values[key]

    def text(self, key: str, allowed: str, default: str | None = None) -> str:
        """Text, or the default if the key is absent."""
        if key not in self and default is not None:
            return default
        value = self.required(key, allowed)
        if not isinstance(value, str):
            raise ParameterError(self.name_of(key), value, allowed)
        return value

    def choice(self, key: str, options: tuple[str, ...]) -> str:
        """Word from a list; the error suggests the nearest word."""
        value = self.text(key, f"one of {', '.join(options)}")
        if value not in options:
            raise ParameterError(self.name_of(key), value, suggestion(value, options))
        return value

    def switch(self, key: str) -> bool:
        """Boolean; False if the key is absent."""
        value = self.raw(key) if key in self else False
        if not isinstance(value, bool):
            raise ParameterError(self.name_of(key), value, "true or false")
        return value

    def number(self, key: str, unit: str, example: str) -> float:
        """Quantity in the unit, as text with a unit, or zero."""
        allowed = f"a number such as {example!r}" if unit == "1" else f"such as {example!r}"
        return quantity(self.required(key, allowed), unit, self.name_of(key))

    def optional_number(self, key: str, unit: str) -> float | None:
        """Quantity in the unit, or None if the key is absent."""
        return quantity(self.raw(key), unit, self.name_of(key)) if key in self else None

    def numbers(self, key: str, unit: str, example: str) -> tuple[float, ...]:
        """List of quantities, or comma-separated text."""
        value = self.required(key, f"a list such as {example!r}")
        return quantity_list(value, unit, self.name_of(key))

    def wavelengths(self) -> tuple[float, ...] | None:
        """Wavelengths of the lists of this table, or None. [nm]"""
        if "wavelengths" not in self:
            return None
        field = self.name_of("wavelengths")
        given = self.numbers("wavelengths", "nm", "680, 550, 440 nm")
        wavelengths = numbers(given, field, SHORTEST, LONGEST, "nm")
        check_wavelength_list(wavelengths, field)
        return wavelengths

    def spectral(
        self, key: str, unit: str, example: str, wavelengths: tuple[float, ...] | None
    ) -> Spectral:
        """Quantity for all wavelengths, or a list with one per wavelength."""
        value = self.required(key, f"such as {example!r}, or a list with one for each wavelength")
        return spectral_of(value, unit, self.name_of(key), wavelengths)

    def table(self, key: str, allowed: str) -> TomlTable:
        """Table within this table."""
        value = self.required(key, allowed)
        if not isinstance(value, dict):
            raise ParameterError(self.name_of(key), value, allowed)
        return TomlTable(value, self.name_of(key), self.folder, self.thickness)

    def tables(self, key: str, allowed: str) -> list[TomlTable]:
        """List of tables within this table."""
        value = self.required(key, allowed)
        if not isinstance(value, list) or len(value) > LONGEST_LIST:
            raise ParameterError(self.name_of(key), value, allowed)
        names = [f"{self.name_of(key)}[{i}]" for i in range(len(value))]
        return [
            TomlTable(item, name, self.folder, self.thickness)
            for item, name in zip(value, names, strict=True)
        ]

    def beside(self, file: str) -> Path:
        """Path of a file named in this file, relative to its folder."""
        return Path(file) if self.folder is None else self.folder / file

    def finish(self) -> None:
        """Raise an error for keys that were not read, with suggestions."""
        collector = Collector()
        for key in self._values:
            with collector:
                if key not in self._read:
                    where = f"a key of {self.path}" if self.path else "a key of the file"
                    raise ParameterError(where, key, suggestion(key, tuple(self._read)))
        collector.raise_all()

    @contextlib.contextmanager
    def prefix_errors(self) -> Iterator[None]:
        """Prefix the field of errors raised inside with the path of this table."""
        try:
            yield
        except ParameterError as error:
            raise changed(error, self._prefixed) from None

    def _prefixed(self, error: ParameterError) -> ParameterError:
        complete = self.path, f"a key of {self.path}"
        if error.file is not None or (self.path and error.field.startswith(complete)):
            return error
        return error.named(self.name_of(error.field))


def quantity_list(value: Any, unit: str, field: str, *, bare: bool = False) -> tuple[float, ...]:
    """List of quantities, or comma-separated text, of limited length; ``bare`` as in units."""
    too_long = (isinstance(value, list) and len(value) > LONGEST_LIST) or (
        isinstance(value, str) and len(value) > 20 * LONGEST_LIST
    )
    if too_long:
        raise ParameterError(field, len(value), f"a list of at most {LONGEST_LIST}")
    return tuple(quantities(value, unit, field, bare=bare))


def spectral_of(
    value: Any, unit: str, field: str, wavelengths: tuple[float, ...] | None
) -> Spectral:
    """Quantity for all wavelengths, or a list with one per wavelength."""
    listed = isinstance(value, list) or (isinstance(value, str) and "," in value)
    if not listed:
        return quantity(value, unit, field)
    values = quantity_list(value, unit, field)
    if wavelengths is None:
        raise ParameterError(field, value, "one value, or a list for a list of wavelengths")
    if len(values) != len(wavelengths):
        raise ParameterError(
            field, value, f"{len(wavelengths)} values, one for each of the wavelengths"
        )
    return PerWavelength(wavelengths=wavelengths, values=values)


def suggestion(given: str, options: tuple[str, ...]) -> str:
    """Text of the allowed words, with the nearest to a misspelt word."""
    near = difflib.get_close_matches(given[:60], options, n=1, cutoff=0.6)
    listed = ", ".join(options)
    return f"{listed} (did you mean {near[0]!r}?)" if near else listed

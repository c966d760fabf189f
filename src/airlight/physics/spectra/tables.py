"""Spectral tables that ship with the package, read from CSV with a cited header."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import FileError, ParameterError
from airlight.physics.data_tables.any_table import data_table
from airlight.physics.data_tables.data_table import Quantity
from airlight.physics.data_tables.text_tables import read_text_table
from airlight.physics.units import values_in

#: Range beyond a table's ends over which its end value is used. [nm]
ALLOWANCE: Final = 10.0
#: Largest file size of a table. [byte]
LARGEST_FILE: Final = 4_000_000
_WAVELENGTH: Final = Quantity(
    name="wavelength", unit="nm", names=("wavelengths",), low=0.0, above=True, bare=True
)


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Quantity tabulated over wavelength.

    Parameters
    ----------
    name : str
        Name of the table.
    wavelengths : array, shape (n,)
        Wavelengths, ascending. [nm]
    values : array, shape (n,) or (n, k)
        Values at the wavelengths. [unit]
    columns : tuple of str, length k
        Names of the columns; one name if ``values`` has one axis.
    licence : str
        Terms of the source.
    distance : str
        Distance from the star to which an irradiance refers, with its unit; empty if not stated.
    """

    name: str
    wavelengths: NDArray[np.float64]
    values: NDArray[np.float64]
    unit: str
    source: str
    columns: tuple[str, ...]
    licence: str = ""
    distance: str = ""

    def at(self, wavelengths: ArrayLike, *, field: str = "wavelengths") -> NDArray[np.float64]:
        """Values at any wavelengths, linear between rows.

        Parameters
        ----------
        wavelengths : array, shape (...)
            Wavelengths, at most 10 nm beyond the table's ends, where the end value is used. [nm]
        field : str
            Field named in the error.

        Returns
        -------
        array, shape (...) or (..., k)
            [unit]

        Raises
        ------
        ParameterError
            If a wavelength is not a number or lies further outside.

        Examples
        --------
        >>> float(read_spectrum("astm-g173").at(550.0))  # as printed in the standard
        1.863
        """
        at = values_in(wavelengths, "nm", "wavelengths")
        first, last = float(self.wavelengths[0]), float(self.wavelengths[-1])
        outside = ~((at >= first - ALLOWANCE) & (at <= last + ALLOWANCE))
        if outside.any():
            raise ParameterError(
                field,
                float(at[outside].flat[0]),
                f"{first - ALLOWANCE:g} to {last + ALLOWANCE:g} nm ({self.name})",
            )
        if self.values.ndim == 1:
            return np.asarray(np.interp(at, self.wavelengths, self.values))
        columns = [np.interp(at, self.wavelengths, column) for column in self.values.T]
        return np.stack(columns, axis=-1)


def spectrum_names() -> tuple[str, ...]:
    """Names that ``read_spectrum`` accepts.

    Examples
    --------
    >>> spectrum_names()[:4]
    ('astm-g173', 'carbon-dioxide-transmission', 'cie-1931', 'earth-albedo')
    """
    folder = files("airlight.physics.spectra") / "data"
    found = (entry.name.removesuffix(".csv") for entry in folder.iterdir() if ".csv" in entry.name)
    return tuple(sorted(found))


@cache
def read_spectrum(name: str) -> Spectrum:
    """Spectral table of the package.

    Parameters
    ----------
    name : str
        One of ``spectrum_names()``.

    Returns
    -------
    Spectrum
        Spectrum with read-only arrays; a single column of values has one axis.

    Raises
    ------
    ParameterError
        If there is no such table.

    Examples
    --------
    >>> read_spectrum("cie-1931").values.shape
    (471, 3)
    """
    known = spectrum_names()
    if name not in known:
        raise ParameterError("spectrum", name, ", ".join(known))
    text = (files("airlight.physics.spectra") / "data" / f"{name}.csv").read_text(encoding="utf-8")
    return _spectrum(text, name)


def read_spectrum_file(path: Path) -> Spectrum:
    """Spectral table from a file, in the format of the package's or as ``data_table`` reads it.

    Lines ``# unit: …`` and ``# source: …``, for a star also ``# distance: …``, stand above the
    names of the columns; the unit of a single column of values may stand in its heading.
    Wavelengths without a unit are in nm.

    Parameters
    ----------
    path : Path
        Path of the file.

    Returns
    -------
    Spectrum
        Spectrum with read-only arrays; a single column of values has one axis.

    Raises
    ------
    FileError, ParameterError
        If the file does not exist or has another format, with the line of what is wrong.
    """
    table = data_table(path, largest=LARGEST_FILE)
    nm = table.numbers(_WAVELENGTH)
    columns = [one for one in table.columns if not _WAVELENGTH.names_column(one.heading)]
    if not nm.size or not columns:
        raise FileError(path, "is not a table of wavelengths and values in CSV")
    if not np.all(np.diff(nm) > 0.0):
        raise FileError(path, "has wavelengths that do not ascend")
    values = [table.own_numbers(Quantity(name=c.heading.name, unit="1"), c) for c in columns]
    header = dict(table.notes)
    if len(columns) == 1 and columns[0].heading.unit:
        header.setdefault("unit", columns[0].heading.unit)
    for key in ("unit", "source"):
        if key not in header:
            raise FileError(path, f"has no line '# {key}: …' before the table")
    return _made(path.stem, nm, np.stack(values, axis=1), [c.heading.text for c in columns], header)


def _spectrum(text: str, name: str) -> Spectrum:
    """Spectral table of the package."""
    table = read_text_table(text, name)
    first, *columns = table.columns
    values = np.stack([one.values for one in columns], axis=1)
    names = [one.heading.text for one in columns]
    return _made(name, first.values, values, names, table.notes)


def _made(
    name: str,
    wavelengths: NDArray[np.float64],
    values: NDArray[np.float64],
    columns: Sequence[str],
    header: Mapping[str, str],
) -> Spectrum:
    values = values[:, 0] if values.shape[1] == 1 else values
    for array in (wavelengths, values):
        array.flags.writeable = False
    return Spectrum(
        name=name,
        wavelengths=wavelengths,
        values=values,
        unit=header["unit"],
        source=header["source"],
        columns=tuple(columns),
        licence=header.get("licence", ""),
        distance=header.get("distance", ""),
    )

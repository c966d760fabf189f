"""Spectral tables that ship with the package, read from CSV with a cited header."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import FileError, ParameterError
from airlight.physics.units import values_in

#: Range beyond a table's ends over which its end value is used. [nm]
ALLOWANCE: Final = 10.0
#: Largest file size of a table. [byte]
LARGEST_FILE: Final = 4_000_000


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
    ('astm-g173', 'cie-1931', 'earth-albedo', 'methane-bands')
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
    """Spectral table from a file in the format of the package's.

    Lines ``# unit: …`` and ``# source: …`` first, for a star also ``# distance: …``, then the names
    of the columns, then rows of a wavelength in nm and its values, ascending.

    Parameters
    ----------
    path : Path
        Path of a CSV file of at most 4 MB.

    Returns
    -------
    Spectrum
        Spectrum with read-only arrays; a single column of values has one axis.

    Raises
    ------
    FileError
        If the file does not exist or has another format.
    """
    try:
        if not path.is_file():
            raise FileError(path, "is not a file; allowed: a table in CSV")
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise FileError(path, (error.strerror or type(error).__name__).lower()) from None
    except ValueError:  # a null character in the name
        raise FileError(repr(str(path)), "is not a file name") from None
    if len(content) > LARGEST_FILE:
        raise FileError(path, f"is larger than {LARGEST_FILE} bytes; allowed: a table in CSV")
    try:
        spectrum = _spectrum(content.decode("utf-8-sig"), path.stem)
    except KeyError as error:
        raise FileError(path, f"has no line '# {error.args[0]}: …' before the table") from None
    except (ValueError, IndexError):
        raise FileError(path, "is not a table of wavelengths and values in CSV") from None
    nm = spectrum.wavelengths
    if not (np.all(np.isfinite(spectrum.values)) and np.all(np.isfinite(nm))):
        raise FileError(path, "has a value that is not finite")
    if not np.all(np.diff(nm) > 0.0):
        raise FileError(path, "has wavelengths that do not ascend")
    return spectrum


def _spectrum(text: str, name: str) -> Spectrum:
    lines = text.splitlines()
    header: dict[str, str] = {}
    for line in lines:
        if not line.startswith("#"):
            break
        key, _, value = line.removeprefix("#").partition(":")
        header[key.strip()] = f"{header.get(key.strip(), '')} {value.strip()}".strip()
    body = lines[sum(line.startswith("#") for line in lines) :]
    rows = np.array([line.split(",") for line in body[1:]], dtype=np.float64)
    values = rows[:, 1] if rows.shape[1] == 2 else rows[:, 1:]
    rows.flags.writeable = False
    values.flags.writeable = False
    return Spectrum(
        name=name,
        wavelengths=rows[:, 0],
        values=values,
        unit=header["unit"],
        source=header["source"],
        columns=tuple(body[0].split(",")[1:]),
        licence=header.get("licence", ""),
        distance=header.get("distance", ""),
    )

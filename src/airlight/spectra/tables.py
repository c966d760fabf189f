"""Spectral tables that ship with the package, read from CSV with a cited header."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError

#: How far beyond a table's ends its end value still stands. [nm]
ALLOWANCE: Final = 10.0


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A quantity tabulated over wavelength.

    Parameters
    ----------
    name : str
        The table's name.
    wavelengths : array, shape (n,)
        Ascending. [nm]
    values : array, shape (n,) or (n, k)
        [unit]
    unit : str
        The unit of the values.
    source : str
        Where the values come from.
    columns : tuple of str, length k
        What each column is; one name if ``values`` has one axis.
    licence : str
        The terms of the source.
    """

    name: str
    wavelengths: NDArray[np.float64]
    values: NDArray[np.float64]
    unit: str
    source: str
    columns: tuple[str, ...]
    licence: str = ""

    def at(self, wavelengths: ArrayLike, *, field: str = "wavelengths") -> NDArray[np.float64]:
        """The values at any wavelengths, linear between rows.

        Parameters
        ----------
        wavelengths : array, shape (...)
            At most 10 nm beyond the table's ends, where the end value stands. [nm]
        field : str
            Named in the error.

        Returns
        -------
        array, shape (...) or (..., k)
            [unit]

        Raises
        ------
        ParameterError
            If a wavelength is no number or lies further outside.

        Examples
        --------
        >>> float(read_spectrum("astm-g173").at(550.0))  # as printed in the standard
        1.863
        """
        at = np.asarray(wavelengths, dtype=np.float64)
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
    """The names that ``read_spectrum`` knows.

    Examples
    --------
    >>> spectrum_names()
    ('astm-g173', 'cie-1931', 'earth-albedo', 'ozone-293k')
    """
    folder = files("airlight.spectra") / "data"
    found = (entry.name.removesuffix(".csv") for entry in folder.iterdir() if ".csv" in entry.name)
    return tuple(sorted(found))


@cache
def read_spectrum(name: str) -> Spectrum:
    """One of the package's tables.

    Parameters
    ----------
    name : str
        One of ``spectrum_names()``.

    Returns
    -------
    Spectrum
        Its arrays cannot be written to; one column of values comes with one axis.

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
    text = (files("airlight.spectra") / "data" / f"{name}.csv").read_text(encoding="utf-8")
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
        licence=header["licence"],
    )

"""Tables of complex refractive indices of particle materials: CSV with a cited header."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import FileError, ParameterError
from airlight.files.input_files import read_text
from airlight.physics.data_tables.data_table import Quantity
from airlight.physics.data_tables.text_tables import read_text_table
from airlight.physics.optics.data_files import data_names, data_text
from airlight.physics.spectra.power_law import power_law
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

#: Range beyond a table's ends over which its end value is used. [nm]
ALLOWANCE: Final = 10.0
#: Prefix of the file names of the tables that ship with the package.
_PREFIX: Final = "index-"
#: Columns of a table.
_COLUMNS: Final = (
    Quantity(name="wavelength", unit="nm", low=0.0, above=True, units="nm, um"),
    Quantity(name="real", unit="1", names=("n",)),
    Quantity(name="imaginary", unit="1", names=("k",), low=0.0),
)


@dataclass(frozen=True, eq=False)
class IndexTable:
    """Refractive index over wavelength.

    Parameters
    ----------
    name : str
        Name of the table, or its path.
    wavelengths : array, shape (n,)
        Wavelengths, ascending. [nm]
    real, imaginary : array, shape (n,)
        n and k of n + ik, k 0 or more. [1]
    """

    name: str
    wavelengths: FloatArray
    real: FloatArray
    imaginary: FloatArray
    source: str

    @property
    def limits(self) -> tuple[float, float]:
        """Wavelength range of the table, extended by 10 nm at both ends. [nm]"""
        return float(self.wavelengths[0]) - ALLOWANCE, float(self.wavelengths[-1]) + ALLOWANCE

    def at(self, wavelengths: npt.ArrayLike) -> ComplexArray:
        """n + ik at wavelengths within ``limits`` [nm], shape (...).

        n is linear between the rows; k, which varies over decades, is a power law, and linear next
        to a row with k = 0.

        Examples
        --------
        >>> table = read_index("water")
        >>> f"{complex(table.at(589.3)).real:.2f}"
        '1.33'
        """
        nm = values_in(wavelengths, "nm", "wavelengths")
        real = np.interp(nm, self.wavelengths, self.real)
        return np.asarray(real + 1j * power_law(nm, self.wavelengths, self.imaginary))


@cache
def index_names() -> tuple[str, ...]:
    """Names of the tables that ship with the package.

    Examples
    --------
    >>> "water" in index_names()
    True
    """
    return data_names(_PREFIX)


@cache
def read_index(name: str) -> IndexTable:
    """Refractive index table of the package, or from a CSV file of the same format.

    Parameters
    ----------
    name : str
        One of ``index_names()``, or the path to a CSV file with the columns ``wavelength_nm`` (or
        ``wavelength [um]``), ``real`` and ``imaginary``, wavelengths ascending.

    Returns
    -------
    IndexTable
        Table with read-only arrays.

    Raises
    ------
    ParameterError
        If there is no such table.
    FileError
        If the file cannot be read or is not of this format.
    """
    if name in index_names():
        return _parsed(data_text(_PREFIX, name), name)
    path = Path(name)
    if path.suffix != ".csv":
        known = ", ".join(index_names())
        raise ParameterError("index", name, f"{known}; or the path to a CSV file")
    return _parsed(read_text(path), name)


def _parsed(text: str, name: str) -> IndexTable:
    table = read_text_table(text, name)
    nm, real, imaginary = (table.numbers(one) for one in _COLUMNS)
    if not nm.size or not (np.diff(nm) > 0.0).all():
        raise FileError(name, "is not a table of refractive indices: wavelengths must ascend")
    for array in (nm, real, imaginary):
        array.flags.writeable = False
    return IndexTable(name, nm, real, imaginary, table.notes.get("source", ""))

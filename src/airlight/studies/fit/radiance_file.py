"""CSV files of measured radiances, one value or spectrum per line, with units in the header.

A line of the long form is a radiance at a wavelength; a line of the wide form is a direction, with
a column per wavelength.
"""

from __future__ import annotations

from collections.abc import Iterator
from datetime import date
from pathlib import Path
from typing import Final

import numpy as np

from airlight.errors import FileError, ParameterError
from airlight.physics.data_tables.any_table import data_table
from airlight.physics.data_tables.data_table import DataColumn, DataTable, Quantity
from airlight.studies.fit.measurements import Measurements

#: Unit of radiances.
RADIANCE: Final = "W/m^2/sr/nm"

_ANGLES: Final = {
    "sun_zenith": Quantity(name="sun_zenith", unit="deg", low=0.0, high=180.0, bare=True),
    "view_zenith": Quantity(name="view_zenith", unit="deg", low=0.0, high=180.0, bare=True),
    "azimuth": Quantity(name="azimuth", unit="deg", low=-360.0, high=360.0, bare=True),
}
_ALTITUDE: Final = Quantity(name="altitude", unit="m", low=0.0, high=1e9, bare=True)
_WAVELENGTH: Final = Quantity(name="wavelength", unit="nm", low=10.0, high=1e6, bare=True)
_RADIANCE: Final = Quantity(name="radiance", unit=RADIANCE, low=0.0, high=1e12, bare=True)
_UNCERTAINTY: Final = Quantity(
    name="uncertainty",
    unit=RADIANCE,
    names=("standarderror",),
    low=0.0,
    high=1e12,
    above=True,
    bare=True,
)
_BANDWIDTH: Final = Quantity(
    name="bandwidth", unit="nm", names=("fwhm",), low=0.0, high=100.0, above=True, bare=True
)
_SOLAR: Final = Quantity(
    name="solar_irradiance", unit="W/m^2/nm", low=0.0, high=1e9, above=True, bare=True
)
_DATE: Final = Quantity(name="date", unit="1")
_TIME: Final = Quantity(name="time", unit="1")
_SCAN: Final = Quantity(name="scan", unit="1")
#: Largest number of radiances. [1]
MOST_VALUES: Final = 2_000_000


def read_radiance_file(path: str | Path) -> Measurements:
    """Read measured radiances from a CSV file.

    Parameters
    ----------
    path : str or Path
        File in UTF-8; lines that begin with ``#`` are comments. Columns: ``wavelength``,
        ``sun_zenith``, ``view_zenith``, ``azimuth``, ``radiance`` and optionally ``uncertainty``,
        ``altitude``, ``scan``, ``bandwidth``, ``solar_irradiance``, ``date``, with units as
        ``name [unit]`` or ``wavelength_nm``, ``sun_zenith_deg``, ``altitude_m``; the default
        unit of radiances is W m⁻² sr⁻¹ nm⁻¹.
        Alternative to ``wavelength`` and ``radiance``: ``radiance_550nm`` with
        ``standard_error_550nm`` or ``uncertainty_550nm``.

    Returns
    -------
    Measurements
        Measurements; without a column ``scan``, lines with the same sun are one scan.
    """
    table = data_table(path)
    if not table.lines.size:
        raise FileError(path, "contains no radiance")
    wide = table.by_wavelength(_RADIANCE)
    for angle in _ANGLES.values():
        table.required(angle, "_deg")
    spectra = [*_spectra(table, wide)] if wide else [_long(table)]
    if len(spectra) * table.lines.size > MOST_VALUES:
        raise FileError(path, f"has more than {MOST_VALUES} radiances")
    return _measurements(table, spectra)


#: Wavelengths, radiances, uncertainties and irradiances of the star of the rows of a table.
_Spectrum = tuple[np.ndarray, np.ndarray, np.ndarray | None, np.ndarray | None]


def _long(table: DataTable) -> _Spectrum:
    """Columns of the long form. [nm], [W m⁻² sr⁻¹ nm⁻¹]"""
    table.required(_WAVELENGTH, "_nm")
    errors, star = _optional(table, _UNCERTAINTY), _optional(table, _SOLAR)
    return table.numbers(_WAVELENGTH), table.numbers(_RADIANCE), errors, star


def _optional(table: DataTable, wanted: Quantity) -> np.ndarray | None:
    """Numbers of a column, or None without one. [unit]"""
    return None if table.find(wanted) is None else table.numbers(wanted)


def _spectra(table: DataTable, wide: list[DataColumn]) -> Iterator[_Spectrum]:
    """Columns of the wide form, wavelength by wavelength."""
    errors, stars = (_beside(table, one, wide) for one in (_UNCERTAINTY, _SOLAR))
    for column in wide:
        nm = column.heading.wavelength
        error = table.numbers(_UNCERTAINTY, errors[nm]) if errors else None
        star = table.numbers(_SOLAR, stars[nm]) if stars else None
        wavelengths = np.full(table.lines.size, nm)
        yield wavelengths, table.numbers(_RADIANCE, column), error, star


def _beside(table: DataTable, wanted: Quantity, wide: list[DataColumn]) -> dict[float, DataColumn]:
    """Columns of a quantity by wavelength [nm], all of those of the radiances or none."""
    found = {one.heading.wavelength: one for one in table.by_wavelength(wanted)}
    if found and any(one.heading.wavelength not in found for one in wide):
        raise FileError(table.source, f"has {wanted.name} for some wavelengths only")
    return found


def _dates(table: DataTable) -> np.ndarray | None:
    """Dates of a column ``date``, or ``time`` if that begins with one, shape (n,)."""
    column = table.find(_DATE) or table.find(_TIME)
    if column is None:
        return None
    name, found = column.heading.name, []
    for row, cell in enumerate(column.cells):
        try:
            found.append(np.datetime64(date.fromisoformat(cell.strip()[:10]), "D"))
        except ValueError:
            if not found and column is not table.find(_DATE):
                return None  # a time of day
            where = f"{table.place(row)}, {name}"
            raise ParameterError(where, cell, "a date such as 2013-05-27", table.source) from None
    return np.array(found)


def _measurements(table: DataTable, spectra: list[_Spectrum]) -> Measurements:
    """Measurements, row by row and within a row by wavelength."""

    def woven(k: int) -> np.ndarray:
        parts = [part for one in spectra if (part := one[k]) is not None]
        return np.stack(parts, axis=1).ravel()

    count = len(spectra)
    angles = {name: table.numbers(one).repeat(count) for name, one in _ANGLES.items()}
    dates, width = _dates(table), _optional(table, _BANDWIDTH)
    altitude = np.zeros(table.lines.size)
    if table.find(_ALTITUDE) is not None:
        altitude = table.numbers(_ALTITUDE)
    scans = table.find(_SCAN)
    if scans is None:
        labels = np.array([f"sun {angle:g}°" for angle in angles["sun_zenith"]])
    else:
        labels = np.array([cell.strip() for cell in scans.cells]).repeat(count)
    names, first, number = np.unique(labels, return_index=True, return_inverse=True)
    order = np.argsort(first)  # scans in the file's order
    rank = np.empty(order.size, dtype=np.int64)
    rank[order] = np.arange(order.size)
    return Measurements(
        source=table.source,
        wavelength=woven(0),
        altitude=altitude.repeat(count),
        **angles,
        radiance=woven(1),
        uncertainty=None if spectra[0][2] is None else woven(2),
        scan=rank[number],
        scans=tuple(str(names[k]) for k in order),
        line=table.lines.repeat(count),
        bandwidth=None if width is None else width.repeat(count),
        solar_irradiance=None if spectra[0][3] is None else woven(3),
        date=None if dates is None else dates.repeat(count),
    )

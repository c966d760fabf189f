"""CSV files of measured radiances, one value or spectrum per line, with units in the header.

A line of the long form is a radiance at a wavelength; a line of the wide form is a direction, with
a column per wavelength.
"""

from __future__ import annotations

import csv
import difflib
import io
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from airlight.errors import FileError, ParameterError
from airlight.files.input_files import LARGEST_DATA, read_text
from airlight.physics.units import quantity
from airlight.studies.fit.measurements import Measurements

#: Unit of radiances.
RADIANCE: Final = "W/m^2/sr/nm"


@dataclass(frozen=True, kw_only=True)
class Column:
    """Column of the file.

    Attributes
    ----------
    name : str
        Name without the unit.
    unit : str
        Unit of the values; empty for a text.
    suffix : str
        Suffix of the name with that unit.
    low, high : float
        Allowed range. [unit]
    needed : bool
        Whether the column is required.
    """

    name: str
    unit: str
    suffix: str = ""
    low: float = -math.inf
    high: float = math.inf
    needed: bool = False


_ALTITUDE: Final = Column(name="altitude", unit="m", suffix="_m", low=0.0, high=1e9)
_SUN: Final = Column(name="sun_zenith", unit="deg", suffix="_deg", low=0.0, high=180.0, needed=True)
_VIEW: Final = Column(
    name="view_zenith", unit="deg", suffix="_deg", low=0.0, high=180.0, needed=True
)
_AZIMUTH: Final = Column(
    name="azimuth", unit="deg", suffix="_deg", low=-360.0, high=360.0, needed=True
)
_WAVELENGTH: Final = Column(
    name="wavelength", unit="nm", suffix="_nm", low=10.0, high=1e6, needed=True
)
_RADIANCE: Final = Column(name="radiance", unit=RADIANCE, low=0.0, high=1e12, needed=True)
_UNCERTAINTY: Final = Column(name="uncertainty", unit=RADIANCE, low=0.0, high=1e12)
_SCAN: Final = Column(name="scan", unit="")
#: Columns of the long form.
COLUMNS: Final = (_WAVELENGTH, _SUN, _VIEW, _AZIMUTH, _RADIANCE, _UNCERTAINTY, _ALTITUDE, _SCAN)
_DIRECTION: Final = (_SUN, _VIEW, _AZIMUTH, _ALTITUDE, _SCAN)

_HEADING: Final = re.compile(r"\s*([^\[\]]+?)\s*(?:\[([^\[\]]*)\])?\s*")
_SPECTRAL: Final = re.compile(r"(radiance|uncertainty|standard_error)_(\d+(?:\.\d+)?)nm")
#: Largest number of radiances. [1]
MOST_VALUES: Final = 2_000_000


@dataclass(frozen=True)
class _Place:
    """Column of a file: declaration, index, factor of the unit, wavelength in the wide form."""

    column: Column
    index: int
    factor: float
    wavelength: float = math.nan


def read_radiance_file(path: str | Path) -> Measurements:
    """Read measured radiances from a CSV file.

    Parameters
    ----------
    path : str or Path
        File in UTF-8; lines that begin with ``#`` are comments. Columns: ``wavelength``,
        ``sun_zenith``, ``view_zenith``, ``azimuth``, ``radiance`` and optionally ``uncertainty``,
        ``altitude``, ``scan``, with units as ``name [unit]`` or ``wavelength_nm``,
        ``sun_zenith_deg``, ``altitude_m``; the default unit of radiances is W m⁻² sr⁻¹ nm⁻¹.
        Alternative to ``wavelength`` and ``radiance``: ``radiance_550nm`` with
        ``standard_error_550nm`` or ``uncertainty_550nm``.

    Returns
    -------
    Measurements
        Measurements; without a column ``scan``, lines with the same sun are one scan.
    """
    text = io.StringIO(read_text(path, LARGEST_DATA), newline="")
    lines = [(n, line) for n, line in enumerate(text, 1) if line.strip()]
    lines = [(n, line) for n, line in lines if not line.lstrip().startswith("#")]
    if not lines:
        raise FileError(path, "has no header")
    try:
        cells = [next(csv.reader([line], strict=True)) for _, line in lines]
    except csv.Error as error:
        raise FileError(path, f"is not valid CSV: {error}") from error
    places = _places(cells[0], path)
    rows = list(_rows(places, cells, [n for n, _ in lines], path))
    if not rows:
        raise FileError(path, "contains no radiance")
    return _measurements(rows, str(path))


def _places(header: list[str], path: str | Path) -> list[_Place]:
    found: list[_Place] = []
    for index, cell in enumerate(header):
        match = _HEADING.fullmatch(cell)
        if match is None:
            continue
        spectral = _SPECTRAL.fullmatch(match[1])
        if spectral is not None:
            column = _RADIANCE if spectral[1] == "radiance" else _UNCERTAINTY
            factor = _factor(column, match[2], match[1], path)
            found.append(_Place(column, index, factor, float(spectral[2])))
            continue
        for column in COLUMNS:
            if match[1] in (column.name, column.name + column.suffix):
                if any(one.column is column and math.isnan(one.wavelength) for one in found):
                    raise FileError(path, f"has the column {column.name} more than once")
                found.append(_Place(column, index, _factor(column, match[2], match[1], path)))
    wide = any(not math.isnan(one.wavelength) for one in found)
    needed = [one for one in (_DIRECTION if wide else COLUMNS) if one.needed]
    there = [one.column for one in found]
    for column in needed:
        if column not in there:
            near = difflib.get_close_matches(column.name, header, n=1, cutoff=0.6)
            hint = f" (did you mean {near[0]!r}?)" if near else ""
            named = f"{column.name}{column.suffix}"
            raise FileError(path, f"has no column {named} in its header{hint}")
    return found


def _factor(column: Column, unit: str | None, name: str, path: str | Path) -> float:
    """Factor from the unit of the header to that of the column."""
    if not unit or not column.unit:
        return 1.0
    spelled = unit.replace("⁻²", "^-2").replace("⁻¹", "^-1").strip()
    try:
        return quantity(f"1 {spelled}", column.unit, f"unit of {name}")
    except ParameterError as error:
        raise ParameterError(error.field, unit, f"a unit such as {column.unit}", path) from None


def _rows(
    places: list[_Place], cells: list[list[str]], lines: list[int], path: str | Path
) -> Iterator[dict[str, float | str]]:
    """Each radiance as a mapping from the name of a column to its number."""
    single = [one for one in places if math.isnan(one.wavelength)]
    wide = [one for one in places if one.column is _RADIANCE and not math.isnan(one.wavelength)]
    errors = {
        one.wavelength: one
        for one in places
        if one.column is _UNCERTAINTY and not math.isnan(one.wavelength)
    }
    count = 0
    for line, row in zip(lines[1:], cells[1:], strict=True):
        if len(row) != len(cells[0]):
            allowed = f"{len(cells[0])}, as in the header"
            raise ParameterError(f"line {line}", f"{len(row)} cells", allowed, path)
        base: dict[str, float | str] = {"line": float(line)}
        for one in single:
            base[one.column.name] = _cell(row[one.index], one, line, path)
        spectrum: list[_Place | None] = [*wide] or [None]
        for place in spectrum:
            found = dict(base)
            if place is not None:
                found["wavelength"] = place.wavelength
                found["radiance"] = _cell(row[place.index], place, line, path)
                if place.wavelength in errors:
                    found["uncertainty"] = _cell(
                        row[errors[place.wavelength].index], errors[place.wavelength], line, path
                    )
            count += 1
            if count > MOST_VALUES:
                raise FileError(path, f"has more than {MOST_VALUES} radiances")
            yield found


def _cell(text: str, place: _Place, line: int, path: str | Path) -> float | str:
    column = place.column
    if not column.unit:
        return text.strip()
    name = column.name
    if not math.isnan(place.wavelength):
        name = f"{name} at {place.wavelength:g} nm"
    try:
        value = float(text) * place.factor
    except ValueError:
        value = math.nan
    strict = column is _UNCERTAINTY
    if not column.low <= value <= column.high or (strict and value == 0.0):
        least = f"more than {column.low:g}" if strict else f"{column.low:g}"
        allowed = f"{least} to {column.high:g} {column.unit}"
        raise ParameterError(f"line {line}, {name}", text.strip(), allowed, path)
    return value


def _measurements(rows: list[dict[str, float | str]], source: str) -> Measurements:
    def numbers(name: str, default: float) -> np.ndarray:
        return np.array([row.get(name, default) for row in rows], dtype=np.float64)

    errors = [row.get("uncertainty") for row in rows]
    if any(one is None for one in errors) and any(one is not None for one in errors):
        raise FileError(source, "has an uncertainty for some wavelengths only")
    sun = numbers("sun_zenith", 0.0)
    if "scan" in rows[0]:
        labels = np.array([str(row["scan"]) for row in rows])
    else:
        labels = np.array([f"sun {angle:g}°" for angle in sun])
    names, first, number = np.unique(labels, return_index=True, return_inverse=True)
    order = np.argsort(first)  # scans in the file's order
    rank = np.empty(order.size, dtype=np.int64)
    rank[order] = np.arange(order.size)
    return Measurements(
        source=source,
        wavelength=numbers("wavelength", math.nan),
        altitude=numbers("altitude", 0.0),
        sun_zenith=sun,
        view_zenith=numbers("view_zenith", 0.0),
        azimuth=numbers("azimuth", 0.0),
        radiance=numbers("radiance", math.nan),
        uncertainty=None if errors[0] is None else numbers("uncertainty", math.nan),
        scan=rank[number],
        scans=tuple(str(names[k]) for k in order),
        line=numbers("line", 0.0).astype(np.int64),
    )

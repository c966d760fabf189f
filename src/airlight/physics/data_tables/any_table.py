"""Tables from files and from objects of Python: one entrance for all."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from airlight.errors import FileError, ParameterError
from airlight.files.datasets import damaged_dataset, open_dataset
from airlight.files.input_files import LARGEST_DATA, read_text
from airlight.physics.data_tables.data_table import DataColumn, DataTable, number_of
from airlight.physics.data_tables.headings import Heading, heading
from airlight.physics.data_tables.text_tables import read_text_table

#: Suffixes of files with labelled arrays.
_DATASETS: Final = (".nc", ".nc4", ".cdf", ".h5", ".zarr")
#: Start of the first line of a spectrum of the USGS spectral library, and its mark of no value.
_USGS: Final = "splib0"
_USGS_DELETED: Final = -1e30


def data_table(
    table: object,
    *,
    units: Mapping[str, str] | None = None,
    header: str | None = None,
    select: Mapping[str, float] | None = None,
    largest: int = LARGEST_DATA,
) -> DataTable:
    """Table of a file or an object.

    Parameters
    ----------
    table : path, xarray.Dataset, pandas.DataFrame, mapping or DataTable
        Text file, NetCDF file or Zarr folder; or columns by name: arrays, quantities, labelled
        arrays. Units are those of headings (``pressure [hPa]``, ``pressure_hPa``), quantities and
        attributes ``units``.
    units : mapping, optional
        Units by name of the column, instead of its own.
    header : str, optional
        Names and units of a text file without them.
    select : mapping, optional
        Coordinates of a dataset at which the nearest element is taken, by name.
    largest : int
        Largest size of a text file. [byte]
    """
    if isinstance(table, (str, Path)):
        found = _of_file(Path(table), header, select or {}, largest)
    elif isinstance(table, DataTable):
        found = table
    elif hasattr(table, "data_vars"):
        found = _of_dataset(table, type(table).__name__, select or {})
    elif isinstance(table, Mapping) or hasattr(table, "columns"):
        found = _of_mapping(table)
    else:
        allowed = "a path, a Dataset of xarray, a DataFrame, or a mapping of arrays"
        raise ParameterError("table", type(table).__name__, allowed)
    return found.with_units(units) if units else found


def _of_file(
    path: Path, header: str | None, select: Mapping[str, float], largest: int
) -> DataTable:
    if path.suffix.lower() in _DATASETS:
        with open_dataset(path, "a table") as data:
            try:
                return _of_dataset(data.load(), str(path), select)
            except (OSError, RuntimeError, ValueError) as error:
                if isinstance(error, ParameterError):
                    raise
                raise damaged_dataset(path, "a table", error) from error
    text = read_text(path, largest)
    if text.lstrip().startswith(_USGS) and header is None:
        return _usgs(path, text)
    return read_text_table(text, str(path), header)


def _of_dataset(data: Any, source: str, select: Mapping[str, float]) -> DataTable:
    for name, at in select.items():
        if name not in data.variables or data[name].ndim != 1:
            allowed = ", ".join(str(one) for one in data.variables if data[one].ndim == 1)
            raise ParameterError("select", name, f"coordinates of {source}: {allowed}")
        nearest = int(np.abs(np.asarray(data[name].data, float) - at).argmin())
        data = data.isel({data[name].dims[0]: nearest})
    columns = []
    for name, one in data.variables.items():
        if one.dtype.kind in "fiu":
            own = heading(str(name))
            unit = str(getattr(one.data, "units", "") or one.attrs.get("units", "") or own.unit)
            values = np.asarray(getattr(one.data, "magnitude", one.data), np.float64)
            found = Heading(own.name, unit, own.wavelength)
            columns.append(DataColumn(found, values, (), tuple(map(str, one.dims))))
    return DataTable(source, tuple(columns), layout="dataset")


def _of_mapping(table: Any) -> DataTable:
    columns = []
    for name in table.keys() if isinstance(table, Mapping) else table.columns:
        one: Any = table[name]
        attributes = getattr(one, "attrs", {}) or {}
        own = heading(str(name))
        unit = getattr(one, "units", None) or getattr(one, "unit", None)
        unit = str(unit or attributes.get("units", "") or own.unit)
        magnitude = getattr(one, "magnitude", getattr(one, "value", one))
        try:
            values = np.asarray(magnitude, np.float64)
        except (TypeError, ValueError):
            continue  # texts, times
        dims = tuple(map(str, getattr(one, "dims", ())))
        columns.append(DataColumn(Heading(own.name, unit, own.wavelength), values, (), dims))
    if not columns:
        raise ParameterError("table", list(table), "columns of numbers")
    return DataTable(type(table).__name__, tuple(columns))


def _usgs(path: Path, text: str) -> DataTable:
    """Reflectances of the USGS library, one a line, with its file of wavelengths beside it.

    References
    ----------
    Kokaly et al. (2017), USGS Spectral Library Version 7, Data Series 1035. doi:10.3133/ds1035
    """
    first, *lines = text.strip().splitlines()
    values = np.array([number_of(line) for line in lines])
    for folder in (path.parent, path.parent.parent):
        for other in sorted(folder.glob("*Wavelengths*.txt")):
            nm = [number_of(line) for line in read_text(other).strip().splitlines()[1:]]
            if len(nm) == len(values):
                kept = values > _USGS_DELETED
                columns = (
                    DataColumn(Heading("wavelength", "um"), np.array(nm)[kept]),
                    DataColumn(Heading("reflectance", "1"), values[kept]),
                )
                rows = np.flatnonzero(kept) + 2
                return DataTable(str(path), columns, rows, 1, {"Name": first}, "spectral library")
    allowed = f"the library's file *Wavelengths*.txt of {len(values)} channels beside it"
    raise FileError(path, f"requires {allowed}")

"""Datasets of observables as CSV and JSON, one row per value of the axes, and as netCDF."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file
from airlight.files.provenance import version
from airlight.plain_text import plain

if TYPE_CHECKING:
    import xarray

#: Suffixes of the files.
SUFFIXES: Final = (".csv", ".nc", ".json")


@dataclass(frozen=True)
class DatasetTable:
    """Rows of a dataset, one per value of its axes.

    Attributes
    ----------
    units : dict
        Unit of each column by its name, axes first.
    rows : list of tuple
        Numbers, and times as text in UTC.
    scalars : dict
        Variables without axes: name, then value, unit and long name.
    """

    units: dict[str, str]
    rows: list[tuple[float | str, ...]]
    scalars: dict[str, tuple[float, str, str]]


def table_of(data: xarray.Dataset) -> DatasetTable:
    """DatasetTable of a dataset, with the wavelength as its last axis."""
    dims = [str(name) for name in data.sizes if name != "wavelength"]
    dims += ["wavelength"] if "wavelength" in data.sizes else []
    axes = [name for name in dims if name in data.coords]
    others = [str(name) for name in data.coords if name not in dims and data[name].ndim]
    names = axes + others + [str(name) for name in data.data_vars if data[name].ndim]
    whole = data[names].broadcast_like(data) if names else data
    shape = tuple(data.sizes[name] for name in dims)
    columns = [
        _cells(
            whole[name]
            .expand_dims({d: data.sizes[d] for d in dims if d not in whole[name].dims})
            .transpose(*dims)
            .to_numpy()
            .reshape(int(np.prod(shape)))
        )
        for name in names
    ]
    scalars = {
        str(name): (one.item(), one.attrs["units"], one.attrs["long_name"])
        for name, one in data.data_vars.items()
        if not one.ndim
    }
    units = {name: data[name].attrs.get("units", "UTC") for name in names}
    return DatasetTable(units, list(zip(*columns, strict=True)), scalars)


def _cells(values: np.ndarray[Any, Any]) -> list[float | str]:
    if values.dtype.kind == "M":
        return [f"{one}Z" for one in values.astype("datetime64[s]")]
    return list(values.tolist())


def write_spectrum(path: str | Path, data: xarray.Dataset) -> None:
    """Write a spectrum.

    Parameters
    ----------
    path : str or Path
        Path ending in ``.csv``, with title, notes and units in the header, ``.json``, with the
        same, or ``.nc``, with all attributes.
    data : xarray.Dataset
        Dataset with units, from ``observe`` or ``irradiance``.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise FileError(path, f"the name of a spectrum ends in {', '.join(SUFFIXES)}")
    with atomic_file(path) as part:
        if suffix == ".nc":
            data.to_netcdf(part, engine="scipy")
        elif suffix == ".json":
            _write_json(part, data)
        else:
            _write_csv(part, data)


def _write_csv(path: Path, data: xarray.Dataset) -> None:
    table = table_of(data)
    with path.open("w", encoding="utf-8", newline="") as stream:
        stream.write(f"# {plain(data.attrs['title'])}\n# airlight {version()}\n")
        for name in ("solver", "notes"):
            stream.write(f"# {name}: {plain(data.attrs[name])}\n")
        for label, (value, unit, meant) in table.scalars.items():
            stream.write(f"# {label}: {value:.8g} {unit} ({meant})\n")
        for name, unit in table.units.items():
            stream.write(f"# unit of {name}: {unit}\n")
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(table.units)
        for row in table.rows:
            writer.writerow([one if isinstance(one, str) else f"{one:.8g}" for one in row])


def _write_json(path: Path, data: xarray.Dataset) -> None:
    """Attributes, units, and rows by column; numbers that are not finite as null."""
    table = table_of(data)
    rows = [
        {
            name: one if isinstance(one, str) or np.isfinite(one) else None
            for name, one in zip(table.units, row, strict=True)
        }
        for row in table.rows
    ]
    scalars = {name: value for name, (value, _, _) in table.scalars.items()}
    units = table.units | {name: unit for name, (_, unit, _) in table.scalars.items()}
    whole = {**{str(k): v for k, v in data.attrs.items()}, "units": units, **scalars, "rows": rows}
    path.write_text(json.dumps(whole, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")

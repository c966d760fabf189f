"""Spectra of observables as CSV, one row per value of the axes, and as netCDF."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file
from airlight.files.provenance import version
from airlight.plain_text import plain

if TYPE_CHECKING:
    import xarray

#: Suffixes of the files.
SUFFIXES: Final = (".csv", ".nc")


def write_spectrum(path: str | Path, data: xarray.Dataset) -> None:
    """Write a spectrum.

    Parameters
    ----------
    path : str or Path
        Path ending in ``.csv``, with title, notes and units in the header, or ``.nc``, with all
        attributes.
    data : xarray.Dataset
        Variables over ``wavelength`` and at most one other dimension, from ``observe``.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise FileError(path, f"the name of a spectrum ends in {', '.join(SUFFIXES)}")
    with atomic_file(path) as part:
        if suffix == ".nc":
            data.to_netcdf(part, engine="scipy")
        else:
            _write_csv(part, data)


def _write_csv(path: Path, data: xarray.Dataset) -> None:
    dims = [str(name) for name in data.sizes if name != "wavelength"] + ["wavelength"]
    columns = [*dims, *(str(name) for name in data.data_vars if data[name].ndim)]
    axes = data.wavelength, data[dims[0]]
    whole = [data[name].broadcast_like(axes[0]).broadcast_like(axes[1]) for name in columns]
    grids = [one.transpose(*dims).to_numpy().ravel() for one in whole]
    with path.open("w", encoding="utf-8", newline="") as stream:
        stream.write(f"# {plain(data.attrs['title'])}\n# airlight {version()}\n")
        for name in ("solver", "notes"):
            stream.write(f"# {name}: {plain(data.attrs[name])}\n")
        for label, one in data.data_vars.items():
            if not one.ndim:
                meant = one.attrs["long_name"]
                stream.write(f"# {label}: {one.item():.8g} {one.attrs['units']} ({meant})\n")
        for name in columns:
            stream.write(f"# unit of {name}: {data[name].attrs['units']}\n")
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        for row in np.stack(grids, axis=-1):
            writer.writerow([f"{value:.8g}" for value in row])

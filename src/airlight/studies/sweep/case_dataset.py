"""Radiances of a table of observers as a labelled dataset, written as netCDF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file
from airlight.solver.named_axes import COORDINATES, WAVELENGTH
from airlight.solver.stokes_frame import STOKES
from airlight.studies.sweep.cases import COLUMNS, Cases
from airlight.studies.sweep.store_layout import POLARISED, UNIT

if TYPE_CHECKING:
    import xarray

#: Dimension of the rows.
ROWS: Final = "case"


def case_dataset(
    cases: Cases,
    wavelengths: Sequence[float],
    radiance: NDArray[np.float64],
    standard_error: NDArray[np.float64] | None = None,
    *,
    stokes: bool = False,
    attributes: Mapping[str, str] | None = None,
) -> xarray.Dataset:
    """Labelled dataset of the radiances of a table of observers.

    Parameters
    ----------
    cases, wavelengths, radiance, standard_error, stokes :
        Arguments of ``write_cases``.
    attributes : mapping of str to str, optional
        Attributes from ``airlight.files.provenance``.

    Returns
    -------
    xarray.Dataset
        ``radiance``, and ``Q``, ``U``, ``dolp``, ``aolp``, over ``case`` and ``wavelength``;
        columns of the table over ``case``, renamed ``input_…`` in case of conflict.
    """
    import xarray

    nm = np.asarray(wavelengths, float)
    about = {"radiance": (UNIT, "spectral radiance of air and ground")}
    about |= POLARISED if stokes else {}
    found = np.split(radiance, len(about), axis=-1)
    data: dict[str, Any] = {
        name: ((ROWS, "wavelength"), part, {"units": unit, "long_name": words})
        for part, (name, (unit, words)) in zip(found, about.items(), strict=True)
    }
    if standard_error is not None:
        names = [f"standard_error_{one}" for one in STOKES] if stokes else ["standard_error"]
        parts = np.split(standard_error, len(names), axis=-1)
        for name, part in zip(names, parts, strict=True):
            data[name] = ((ROWS, "wavelength"), part, {"units": UNIT, "long_name": name})
    coordinates: dict[str, Any] = {"wavelength": ("wavelength", nm, WAVELENGTH)}
    for column, values in zip(COLUMNS, cases.values.T, strict=True):
        name, _, unit = column.rpartition("_")
        coordinates[name] = (ROWS, values, {"units": unit, **COORDINATES[name]})
    for k, column in enumerate(cases.header):
        if column not in COLUMNS:
            name = column.replace("/", "_")  # which netCDF does not allow
            while not name or name in data or name in coordinates:
                name = f"input_{name}"
            data[name] = (ROWS, _cells([row[k] for row in cases.rows]))
    lines = [comment.lstrip("# ") for comment in cases.comments]
    comment = {"comment": "\n".join(lines)} if lines else {}
    return xarray.Dataset(data, coordinates, {**(attributes or {}), **comment})


def _cells(texts: list[str]) -> NDArray[Any]:
    """Numbers of a column of the input, or its texts if any is not a number."""
    try:
        return np.array([float(text) for text in texts])
    except ValueError:
        return np.array(texts)


def write_dataset(path: str, data: xarray.Dataset) -> None:
    """Write a dataset as netCDF."""
    with atomic_file(path) as part:
        try:
            data.to_netcdf(part, engine="scipy")
        except ValueError as error:
            raise FileError(path, f"cannot be written: {error}") from error

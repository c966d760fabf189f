"""Files of a sweep's Zarr group: metadata, coordinates and chunks."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.reading.declared_keys import key_at, spelled_out
from airlight.planets.reading.overrides import indexed_path, overridden
from airlight.planets.reading.reader import PlanetLike, nested_tables, planet_text
from airlight.planets.schema.field import Field
from airlight.planets.schema.measures import DOBSON, number_in
from airlight.solver.named_axes import COORDINATES, WAVELENGTH
from airlight.studies.sweep.grid import AXES, Grid

#: Attribute that holds the axes, by which a later run recognises its grid.
AXES_ATTRIBUTE: Final = "airlight_axes"
#: Name of the array with the fingerprint and the checksum of each block.
MARKS: Final = "block_marks"
#: Unit of radiances.
UNIT: Final = "W m-2 sr-1 nm-1"
#: Arrays of polarised light beside the radiance, in their order: unit, name.
POLARISED: Final = {
    "Q": (UNIT, "Stokes parameter Q: upright less level, in the meridian plane of the view"),
    "U": (UNIT, "Stokes parameter U: at 45 deg counterclockwise from upright less at -45 deg"),
    "dolp": ("1", "degree of linear polarisation"),
    "aolp": ("deg", "angle of polarisation from the vertical plane, counterclockwise"),
}
#: Compression of radiances; other arrays have none.
COMPRESSOR: Final = {"id": "blosc", "cname": "lz4", "clevel": 5, "shuffle": 1, "blocksize": 0}


def array_names(stokes: bool) -> tuple[str, ...]:
    """Names of the data arrays, radiance first."""
    return ("radiance", *(POLARISED if stokes else ()))


def axes_text(grid: Grid, *, stokes: bool) -> str:
    """Axes of a grid and additional arrays, as the text of ``AXES_ATTRIBUTE``."""
    vary = {path: [str(value) for value in values] for path, values in grid.vary.items()}
    angles = {name: list(getattr(grid, name)) for name in AXES}
    axes = {"planet": list(grid.names), "vary": vary, **angles, "wavelength": list(grid.nm)}
    return json.dumps(axes | ({"stokes": list(POLARISED)} if stokes else {}), sort_keys=True)


def metadata(grid: Grid, *, stokes: bool) -> dict[str, dict[str, Any]]:
    """Contents of the metadata of each array, by their path in the group.

    References
    ----------
    Zarr storage specification version 2, https://zarr-specs.readthedocs.io/en/latest/v2/v2.0.html
    """
    found: dict[str, dict[str, Any]] = {}
    for name, (values, about) in _coordinates(grid).items():
        shape, kind = values.shape, values.dtype.str
        fill = "NaN" if values.dtype.kind == "f" else None
        found |= _array(name, shape, shape, kind, fill, None, (name,), about)
    for name, (unit, words) in (
        {"radiance": (UNIT, "spectral radiance of air and ground")} | (POLARISED if stokes else {})
    ).items():
        about = {"units": unit, "long_name": words}
        found |= _array(
            name, grid.shape, chunk_shape(grid), "<f4", "NaN", COMPRESSOR, grid.dims, about
        )
    variants = len(grid.variants)
    names = (*grid.dims[:variants], "altitude", "sun_block", "view_block", "mark")
    shape = (*grid.blocks, 2)
    chunks = (*(1 for _ in grid.variants), *shape[variants:])
    about = {"long_name": "fingerprint and checksum of each block, 0 where there is none"}
    return found | _array(MARKS, shape, chunks, "<u8", 0, None, names, about)


def contents(grid: Grid) -> dict[str, bytes]:
    """Chunks of the coordinates, by their path in the group."""
    return {f"{name}/0": values.tobytes() for name, (values, _) in _coordinates(grid).items()}


def chunk_shape(grid: Grid) -> tuple[int, ...]:
    """Shape of a chunk: a block, with the full number of suns and views."""
    return (*(1 for _ in grid.variants), 1, *grid.steps, len(grid.azimuth), len(grid.nm))


def chunk_file(array: str, block: tuple[int, ...]) -> str:
    """Path of a block's chunk of a data array, in the group."""
    return f"{array}/{'.'.join(map(str, (*block, 0, 0)))}"


def marks_file(variant: tuple[int, ...]) -> str:
    """Path of the chunk with the marks of one planet of the grid, in the group."""
    return f"{MARKS}/{'.'.join(map(str, (*variant, 0, 0, 0, 0)))}"


def _coordinates(grid: Grid) -> dict[str, tuple[NDArray[Any], dict[str, Any]]]:
    """Values and attributes of the axes."""
    found: dict[str, tuple[Any, dict[str, Any]]] = {"planet": (np.array(grid.names), {})}
    for name, values in grid.vary.items():
        if "/" in name or "\\" in name:
            raise ParameterError(
                "vary", name, "a key without a slash: it names a folder of the store"
            )
        numbers, unit = varied_axis(grid.planets[0], name, values, grid.common)
        found[name] = numbers, {"units": unit} if unit else {}
    for name, (_, _, unit) in AXES.items():
        found[name] = np.array(getattr(grid, name)), {"units": unit, **COORDINATES[name]}
    found["wavelength"] = np.array(grid.nm), dict(WAVELENGTH)
    return {name: (_stored(values), about) for name, (values, about) in found.items()}


def _stored(values: NDArray[Any]) -> NDArray[Any]:
    """Values of an axis as little-endian numbers or as texts."""
    if values.ndim != 1 or values.dtype.kind not in "fiuU":
        values = np.array([str(one) for one in values])
    if values.dtype.kind == "f":
        values = values.astype(float)
    return values.astype(values.dtype.newbyteorder("<"))


def _array(
    name: str,
    shape: tuple[int, ...],
    chunks: tuple[int, ...],
    kind: str,
    fill: Any,
    compressor: Mapping[str, Any] | None,
    dims: tuple[str, ...],
    about: Mapping[str, Any],
) -> dict[str, dict[str, Any]]:
    array = {
        "zarr_format": 2,
        "shape": list(shape),
        "chunks": list(chunks),
        "dtype": kind,
        "compressor": compressor and dict(compressor),
        "fill_value": fill,
        "order": "C",
        "filters": None,
        "dimension_separator": ".",
    }
    return {f"{name}/.zarray": array, f"{name}/.zattrs": {"_ARRAY_DIMENSIONS": list(dims), **about}}


#: Number and the symbol of its unit; other units are converted.
_TEXT: Final = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([A-Za-zµ]+|%)\s*")
_POWERS: Final = str.maketrans("⁻¹²³", "-123")


def varied_axis(
    planet: PlanetLike, path: str, values: Sequence[Any], common: Mapping[str, Any] | None = None
) -> tuple[NDArray[Any], str]:
    """Values of a key as an axis.

    Parameters
    ----------
    planet : str, Path, Planet or Solution
        Preset or planet file with the key.
    path : str
        Path of the key, as for overrides.
    values : sequence
        Numbers, texts with a unit, or words, as in a planet file.
    common : mapping, optional
        Overrides of the file, which may make the key.

    Returns
    -------
    values : array, shape (n,)
        Numbers in the unit; texts if one of the values is not a number.
    unit : str
        Common unit of the values, otherwise the SI unit of the key, by the CF conventions; empty
        for texts.

    Examples
    --------
    >>> numbers, unit = varied_axis("earth", "ozone.absorption.ozone", ["200 DU", "300 DU"])
    >>> numbers.tolist(), unit
    ([200.0, 300.0], 'DU')
    >>> numbers, unit = varied_axis("earth", "shell.top_radius", ["6460 km", 6.5e6])
    >>> numbers.tolist(), unit
    ([6460000.0, 6500000.0], 'm')
    """
    matches = [_TEXT.fullmatch(one) if isinstance(one, str) else None for one in values]
    symbols = {match[2] if match else "" for match in matches}
    if len(symbols) == 1 and "" not in symbols:
        return np.array([float(match[1]) for match in matches if match]), symbols.pop()
    key = _key(planet, path, common or {})
    if key is None or key.kind != "number":
        words = [isinstance(one, (str, bool)) for one in values]
        return np.array([str(one) for one in values] if any(words) else values), ""
    unit = DOBSON if key.shown_unit == DOBSON else key.unit
    try:
        numbers = [number_in(one, unit, key.unit, path) for one in values]
    except ParameterError:
        return np.array([str(one) for one in values]), ""
    return np.array(numbers), replace(key, unit=unit).unit_words.translate(_POWERS) or "1"


def _key(planet: PlanetLike, path: str, common: Mapping[str, Any]) -> Field | None:
    """Declaration of the key; None if the planet has no file or not this key."""
    if not isinstance(planet, (str, Path)):
        return None
    text, file, folder = planet_text(planet)
    tables = spelled_out(overridden(nested_tables(text, file), common), folder)
    try:
        return key_at(tables, indexed_path(tables, path))
    except ParameterError:
        return None

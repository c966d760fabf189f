"""A sweep on disk: a Zarr group that xarray opens, with the fingerprint of each block."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping
from importlib import util
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.exports.whole_folder import check_folder_name
from airlight.solvers.named_axes import COORDINATES, WAVELENGTH
from airlight.solvers.provenance import software
from airlight.sweep.grid import AXES, Grid
from airlight.sweep.varied_axis import varied_axis

#: Attribute that holds the axes, by which a later run knows its own grid.
_AXES: Final = "airlight_axes"
#: Name of the array of fingerprints; 0 is a block that is missing.
_BLOCKS: Final = "block_fingerprint"
#: Unit of radiances.
UNIT: Final = "W m-2 sr-1 nm-1"
#: Arrays of polarised light beside the radiance, in their order: unit, name.
POLARISED: Final = {
    "Q": (UNIT, "Stokes parameter Q: upright less level, in the meridian plane of the view"),
    "U": (UNIT, "Stokes parameter U: at 45 deg counterclockwise from upright less at -45 deg"),
    "dolp": ("1", "degree of linear polarisation"),
    "aolp": ("deg", "angle of polarisation from the vertical plane, counterclockwise"),
}


def check_store(path: Path, field: str) -> None:
    """Refuse, before anything is solved, a place where a sweep cannot be written.

    Raises
    ------
    ParameterError
        If zarr is not installed.
    FileError
        If there is something else.
    """
    if util.find_spec("zarr") is None:
        allowed = "a sweep beside zarr: pip install airlight[sweep]"
        raise ParameterError(field, str(path), allowed)
    check_folder_name(path, ".zarr")
    try:
        parent = path.resolve().parent
        there = parent.is_dir()
    except (OSError, ValueError, RuntimeError) as error:  # a null character, a cycle of links
        raise FileError(path, str(error)) from error
    if not there:
        raise FileError(path, f"there is no folder {parent}")
    if path.exists() and not (path / ".zgroup").is_file() and any(_inside(path)):
        raise FileError(path, "is no sweep; allowed: a new folder, or the sweep to go on with")


def _inside(path: Path) -> list[Path]:
    return list(path.iterdir()) if path.is_dir() else [path]


class SweepStore:
    """Radiances of a grid on disk.

    Parameters
    ----------
    path : Path
        Folder of the Zarr group; made if it is new.
    grid : Grid
        Grid.
    about : mapping of str to str
        Attributes beside planets and version: what was computed, and its settings.
    stokes : bool
        Whether it holds ``POLARISED`` too.

    Raises
    ------
    FileError
        If the folder holds a sweep of another grid.
    """

    def __init__(
        self, path: Path, grid: Grid, about: Mapping[str, str], *, stokes: bool = False
    ) -> None:
        import zarr

        self.path = path
        polarised = {"stokes": list(POLARISED)} if stokes else {}
        axes = json.dumps(_axes(grid) | polarised, sort_keys=True)
        part = path.with_name(f".{path.name}.part")
        shutil.rmtree(part, ignore_errors=True)
        if not (path / ".zgroup").is_file():
            _made(part, grid, axes, stokes=stokes)
            part.replace(path)
        group: Any = zarr.open_group(str(path), mode="r+", zarr_format=2)
        if group.attrs.get(_AXES) != axes:
            raise FileError(path, "holds the sweep of another grid; name another folder")
        group.attrs.update({"planet": ", ".join(grid.names), **about, **software()})
        zarr.consolidate_metadata(str(path), zarr_format=2)
        self._arrays = [group[name] for name in ("radiance", *(POLARISED if stokes else ()))]
        self._blocks = group[_BLOCKS]
        self._known: NDArray[np.uint64] = np.asarray(self._blocks[...])

    def has(self, block: tuple[int, ...], fingerprint: int) -> bool:
        """Whether a block is there with this fingerprint."""
        return int(self._known[block]) == fingerprint

    def write(
        self, region: tuple[Any, ...], block: tuple[int, ...], values: NDArray[np.float32],
        fingerprint: int,
    ) -> None:  # fmt: skip
        """Write the arrays of a block, radiance first, and then its fingerprint."""
        for array, one in zip(self._arrays, values, strict=True):
            array[region] = one
        self._known[block] = fingerprint
        self._blocks[block] = np.uint64(fingerprint)


def _axes(grid: Grid) -> dict[str, Any]:
    vary = {path: [str(value) for value in values] for path, values in grid.vary.items()}
    angles = {name: list(getattr(grid, name)) for name in AXES}
    return {"planet": list(grid.names), "vary": vary, **angles, "wavelength": list(grid.nm)}


def _made(path: Path, grid: Grid, axes: str, *, stokes: bool) -> None:
    """Make the group: coordinates by xarray, and arrays to be filled."""
    import xarray
    import zarr

    coordinates: dict[str, Any] = {"planet": ("planet", np.array(grid.names))}
    for name, values in grid.vary.items():
        numbers, unit = varied_axis(grid.planets[0], name, values)
        coordinates[name] = (name, numbers, {"units": unit} if unit else {})
    for name, (_, _, unit) in AXES.items():
        about = {"units": unit, **COORDINATES[name]}
        coordinates[name] = (name, np.array(getattr(grid, name)), about)
    coordinates["wavelength"] = ("wavelength", np.array(grid.nm), WAVELENGTH)
    xarray.Dataset(coords=coordinates, attrs={_AXES: axes}).to_zarr(
        path, mode="w", zarr_format=2, consolidated=False
    )
    group: Any = zarr.open_group(str(path), mode="r+", zarr_format=2)
    suns, views = grid.steps
    inner = (1, suns, views, len(grid.azimuth), len(grid.nm))
    arrays = {"radiance": (UNIT, "spectral radiance of air and ground")}
    for array, (unit, words) in (arrays | (POLARISED if stokes else {})).items():
        group.create_array(
            array, shape=grid.shape, chunks=(*(1 for _ in grid.variants), *inner),
            dtype="float32", fill_value=np.nan,
            attributes={"_ARRAY_DIMENSIONS": list(grid.dims), "units": unit, "long_name": words},
        )  # fmt: skip
    names = [*grid.dims[: len(grid.variants)], "altitude", "sun_block", "view_block"]
    group.create_array(
        _BLOCKS, shape=grid.blocks, chunks=(*(1 for _ in grid.variants), *grid.blocks[-3:]),
        dtype="uint64", fill_value=0,
        attributes={"_ARRAY_DIMENSIONS": names, "long_name": "fingerprint of each block, 0 none"},
    )  # fmt: skip

"""NetCDF files and Zarr folders of others, opened without executing what they contain."""

from __future__ import annotations

import inspect
import os
import re
import stat
from importlib import metadata, util
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import ConflictError, FileError
from airlight.files.input_files import LARGEST_PICTURE, check_input

if TYPE_CHECKING:
    import xarray as xr

#: Largest number of files of a Zarr folder.
_MOST_FILES: Final = 1_000_000


def open_dataset(path: Path, what: str) -> xr.Dataset:
    """Dataset of a NetCDF file or a Zarr folder; values are not read yet.

    Parameters
    ----------
    path : Path
        Path of the file or folder.
    what : str
        What it is read as, named in errors.
    """
    import xarray as xr

    engine = _engine(path)
    options: dict[str, Any] = {"mask_and_scale": True, "decode_times": False}
    if "create_default_indexes" in inspect.signature(xr.open_dataset).parameters:
        options["create_default_indexes"] = False  # coordinates of any length are not read here
    try:
        if engine == "zarr":
            options["consolidated"] = False  # arrays have metadata of their own as well
        return xr.open_dataset(path, engine=engine, decode_coords=False, cache=False, **options)
    except Exception as error:  # whatever the library of the format raises
        raise damaged_dataset(path, what, error) from error


def _engine(path: Path) -> str:
    """Engine of xarray for a file, by its first bytes."""
    if path.is_dir():
        if util.find_spec("zarr") is None or not _safe_numcodecs():
            raise ConflictError(str(path), "requires zarr: pip install airlight[clouds]")
        _check_folder(path)
        return "zarr"
    check_input(path, LARGEST_PICTURE)
    with path.open("rb") as stream:
        start = stream.read(8)
    if start[:4] in (b"CDF\x01", b"CDF\x02"):
        return "scipy"
    if start[:4] == b"CDF\x05" or start == b"\x89HDF\r\n\x1a\n":
        for module, engine in (("netCDF4", "netcdf4"), ("h5netcdf", "h5netcdf")):
            if util.find_spec(module) is not None:
                return engine
        raise ConflictError(str(path), "requires netCDF4: pip install airlight[clouds]")
    raise FileError(path, "is neither a NetCDF file nor a Zarr folder")


def _safe_numcodecs() -> bool:
    """Whether numcodecs executes no code of a store: GHSA-jqc8-qjfv-5m6r."""
    try:
        version = metadata.version("numcodecs")
    except metadata.PackageNotFoundError:
        return False
    numbers = tuple(int(part) for part in re.findall(r"\d+", version)[:3])
    return numbers >= (0, 16, 6) and numbers != (0, 17, 0)


def _check_folder(path: Path) -> None:
    """Raise an error for links, devices, and more files than a field has."""
    count = 0
    for folder, folders, files in os.walk(path):
        for name in (*folders, *files):
            count += 1
            mode = (Path(folder) / name).lstat().st_mode
            if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
                raise FileError(Path(folder) / name, "is neither a file nor a folder")
        if count > _MOST_FILES:
            raise FileError(path, f"has too many files; allowed: at most {_MOST_FILES}")


def damaged_dataset(path: str | Path, what: str, error: Exception) -> FileError:
    """Error of a library of a format, in one line."""
    lines = str(error).strip().splitlines() or [type(error).__name__]
    return FileError(path, f"cannot be read as {what}: {lines[0][:120]}")

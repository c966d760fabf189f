"""Arrays too large for memory, mapped to an anonymous file.

The file lies in the folder of the cache and ends with the array, whatever ends the process. The
array is one like any other; loops that pass over it band by band call ``release``, so that only
what they work on is resident. Nothing is lost by that: the system keeps what it can in its own
memory and writes the rest.
"""

from __future__ import annotations

import contextlib
import math
import mmap
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import DTypeLike, NDArray

from airlight.files.cache_folders import cache_folder, make_folder

#: Size from which an array is kept in a file. [byte]
LARGE: Final = 1 << 27
#: Amount of an array that is used before the system may take it back. [byte]
_RESIDENT: Final = 1 << 25
#: Size of a band of rows. [byte]
_BAND: Final = 1 << 22


class FileMemory(mmap.mmap):
    """Memory-mapped file, which the system may page out.

    Attributes
    ----------
    used : int
        Amount used since it was taken back. [byte]
    """

    used: int = 0


def zeros(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """Return an array of zeros: in memory, or in a file if it is large and the disk has room.

    Parameters
    ----------
    shape : tuple of int
        Shape.
    dtype : dtype
        Type of its numbers.

    Examples
    --------
    >>> zeros((2, 3), np.float32).sum()
    np.float32(0.0)
    """
    size = math.prod(shape) * np.dtype(dtype).itemsize
    file = _file(size) if size >= LARGE else None
    return np.zeros(shape, dtype) if file is None else np.ndarray(shape, dtype, buffer=file)


def release(array: NDArray[Any]) -> None:
    """Allow the system to page out an array.

    Parameters
    ----------
    array : array
        Part of an array, as long as it was used; only those in files are concerned.
    """
    owner: Any = array
    while isinstance(owner, np.ndarray):
        owner = owner.base
    if not isinstance(owner, FileMemory) or not hasattr(mmap, "MADV_DONTNEED"):
        return
    owner.used += array.nbytes
    if owner.used >= _RESIDENT:
        owner.used = 0
        owner.madvise(mmap.MADV_DONTNEED)


def bands(array: NDArray[Any], rows: int = 0) -> Iterator[NDArray[Any]]:
    """Bands of rows of an array, each released at the next.

    Parameters
    ----------
    array : array, shape (height, ...)
        Array.
    rows : int
        Rows at a time; by default as many as have four million bytes.

    Yields
    ------
    array, shape (at most rows, ...)
        View of the next rows.

    Examples
    --------
    >>> [len(band) for band in bands(np.zeros((5, 2)), rows=2)]
    [2, 2, 1]
    """
    rows = rows or max(1, _BAND // max(1, array[:1].nbytes))
    for first in range(0, len(array), rows):
        band = array[first : first + rows]
        yield band
        release(band)


def free_disk() -> float:
    """Room for large arrays; 0 where there are none, or nothing can be written. [byte]"""
    if not hasattr(mmap, "MADV_DONTNEED") or not hasattr(os, "posix_fallocate"):
        return 0.0
    folder = cache_folder()
    with contextlib.suppress(OSError):
        while not folder.exists() and folder != folder.parent:
            folder = folder.parent
        if os.access(folder, os.W_OK | os.X_OK):
            return float(shutil.disk_usage(folder).free)
    return 0.0


def _file(size: int) -> FileMemory | None:
    """Memory of a file of zeros, or None where the disk has too little room."""
    if free_disk() < size:
        return None
    try:
        folder: Path = cache_folder()
        make_folder(folder)
        with tempfile.TemporaryFile(dir=folder) as file:
            # A page that finds no room later would end the process.
            os.posix_fallocate(file.fileno(), 0, size)
            return FileMemory(file.fileno(), size)
    except OSError:
        return None

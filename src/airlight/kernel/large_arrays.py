"""Arrays too large for memory, mapped to an anonymous file.

The file is in the cache folder and is deleted with the array. Loops that process an array band by
band call ``release``, so that only the current band is resident.
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

#: Size from which an array is stored in a file. [byte]
LARGE: Final = 1 << 27
#: Amount of an array that is used before the system may release it. [byte]
_RESIDENT: Final = 1 << 25
#: Size of a band of rows. [byte]
_BAND: Final = 1 << 22


class FileMemory(mmap.mmap):
    """Memory-mapped file, which the system can page out.

    Attributes
    ----------
    used : int
        Memory used since the last release. [byte]
    """

    used: int = 0


def zeros(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """Array of zeros: in memory, or in a file if it is large and the disk has room.

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
        Array or part of one; ignored unless in a file.
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
    """Bands of rows of an array, each released when the next is taken.

    Parameters
    ----------
    array : array, shape (height, ...)
        Array.
    rows : int
        Rows of a band; by default as many as have four million bytes.

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
    """Disk space for large arrays; 0 if unsupported or not writable. [byte]"""
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
    """Memory-mapped file of zeros; None if the disk has too little space."""
    if free_disk() < size:
        return None
    try:
        folder: Path = cache_folder()
        make_folder(folder)
        with tempfile.TemporaryFile(dir=folder) as file:
            # A later page fault without free space would end the process.
            os.posix_fallocate(file.fileno(), 0, size)
            return FileMemory(file.fileno(), size)
    except OSError:
        return None

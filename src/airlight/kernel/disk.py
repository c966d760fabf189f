"""Cache on disk: named arrays under a key.

Files are written atomically, and key and checksums are verified: a truncated, damaged or foreign
file counts as absent. Large arrays can be memory-mapped, shared by all processes.
"""

from __future__ import annotations

import contextlib
import mmap
import os
import tempfile
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.files.cache_folders import cache_folder, make_folder, open_trusted, trusted_folder
from airlight.kernel.large_arrays import FileMemory, release

#: Total size of a folder above which its oldest results are removed. [bytes]
LARGEST_TOTAL: Final = 1_000_000_000
#: Default folder.
_SOLUTIONS: Final = "solutions"
#: Size of the header of a member of an archive, and where it has the lengths of the two texts that
#: follow it. [bytes]
_HEADER: Final = 30
_LENGTHS: Final = slice(26, 30)


def load(
    key: str, folder: str = _SOLUTIONS, *, in_place: bool = False
) -> dict[str, NDArray[Any]] | None:
    """Cached arrays of a key; None unless valid and of this user.

    Parameters
    ----------
    key : str
        Fingerprint: letters and digits.
    folder : str
        Folder of the cache.
    in_place : bool
        Whether arrays of bytes are memory-mapped, copy-on-write.
    """
    home = trusted_folder(cache_folder(), folder)
    if home is None:
        return None
    file = home / f"{key}.npz"
    try:
        # Opened here: NumPy forgets to close a file that is not an archive.
        with open_trusted(file) as stream, np.load(stream, allow_pickle=False) as stored:
            arrays = _in_place(stream) if in_place else {}
            for name in set(stored.files) - set(arrays):
                arrays[name] = stored[name]  # zip checks each CRC-32
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, NotImplementedError):
        return None
    if str(arrays.pop("key", "")) != key:
        return None
    with contextlib.suppress(OSError):
        os.utime(file)
    return arrays


def _in_place(stream: IO[bytes]) -> dict[str, NDArray[Any]]:
    """Memory-mapped arrays of bytes of an uncompressed archive."""
    memory = FileMemory(stream.fileno(), 0, access=mmap.ACCESS_COPY)
    arrays: dict[str, NDArray[Any]] = {}
    with zipfile.ZipFile(stream) as archive:
        for member in archive.infolist():
            header = memory[member.header_offset : member.header_offset + _HEADER]
            texts = np.frombuffer(header[_LENGTHS], "<u2")
            first = member.header_offset + _HEADER + int(texts.sum())
            stream.seek(first)
            if np.lib.format.read_magic(stream) != (1, 0):
                continue
            shape, _, dtype = np.lib.format.read_array_header_1_0(stream)
            if dtype != np.uint8 or member.compress_type != zipfile.ZIP_STORED:
                continue
            with memoryview(memory) as whole:
                found = zlib.crc32(whole[first : first + member.file_size])
            if found != member.CRC:
                raise zipfile.BadZipFile(member.filename)
            array = np.ndarray(shape, dtype, buffer=memory, offset=stream.tell())
            release(array)
            arrays[member.filename.removesuffix(".npy")] = array
    return arrays


def save(key: str, arrays: Mapping[str, NDArray[Any]], folder: str = _SOLUTIONS) -> None:
    """Store arrays under a key; no effect if the folder is not writable or not trusted."""
    file = cache_folder() / folder / f"{key}.npz"
    try:
        if trusted_folder(cache_folder(), folder) is None:
            return
        make_folder(file.parent)
        handle, name = tempfile.mkstemp(dir=file.parent, prefix=".", suffix=".part")
    except OSError:
        return
    part = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            np.savez(stream, key=np.array(key), **arrays)  # type: ignore[arg-type]
        part.replace(file)
        _remove_oldest(file.parent)
    except OSError:
        return
    finally:
        part.unlink(missing_ok=True)


def _remove_oldest(folder: Path) -> None:
    files = sorted(folder.glob("*.npz"), key=lambda file: file.stat().st_mtime, reverse=True)
    total = 0
    for file in files:
        total += file.stat().st_size
        if total > LARGEST_TOTAL:
            file.unlink(missing_ok=True)

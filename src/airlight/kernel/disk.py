"""Results kept on disk between runs: named arrays under a key.

A file is written beside its target and renamed, so that it is complete or absent. The key and a
checksum of every array are verified before anything is used: a truncated, damaged or foreign file
counts as absent.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import cache_folder

#: Total size above which the oldest results are removed. [bytes]
LARGEST_TOTAL: Final = 1_000_000_000


def _file(key: str) -> Path:
    return cache_folder() / "solutions" / f"{key}.npz"


def load(key: str) -> dict[str, NDArray[Any]] | None:
    """Load the arrays kept under a key, or None if there are no valid ones.

    Parameters
    ----------
    key : str
        Fingerprint: letters and digits.
    """
    file = _file(key)
    try:
        # Opened here: NumPy forgets to close a file that is not an archive.
        with file.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}  # zip checks each CRC-32
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, NotImplementedError):
        return None
    if str(arrays.pop("key", "")) != key:
        return None
    with contextlib.suppress(OSError):
        os.utime(file)
    return arrays


def save(key: str, arrays: Mapping[str, NDArray[Any]]) -> None:
    """Keep arrays under a key; if the folder cannot be written to, do nothing."""
    file = _file(key)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
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

"""Reading of user files: regular files of limited size only.

Devices, pipes and sockets, which may be endless or block, are rejected before reading.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Final

from airlight.errors import FileError

#: Largest planet, scene, film or camera file, manifest or table of a spectrum. [byte]
LARGEST_TEXT: Final = 32_000_000
#: Largest table of measured radiances. [byte]
LARGEST_DATA: Final = 250_000_000
#: Largest table of observers, which is read block by block. [byte]
LARGEST_CASES: Final = 64_000_000_000
#: Largest map of a planet, 200 million pixels of floats and their offsets. [byte]
LARGEST_MAP: Final = 4_000_000_000
#: Largest picture with its passes. [byte]
LARGEST_PICTURE: Final = 16_000_000_000


def check_input(path: str | Path, largest: int) -> None:
    """Raise an error unless a path is a regular file of limited size.

    Parameters
    ----------
    path : str or Path
        Path of the file; links are followed.
    largest : int
        Largest size. [byte]

    Examples
    --------
    >>> check_input("/dev/null", LARGEST_TEXT)
    Traceback (most recent call last):
    ...
    airlight.errors.FileError: /dev/null: is not a regular file, so it cannot be read
    """
    try:
        about = Path(path).stat()
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from error
    except ValueError as error:  # a null character
        raise FileError(path, f"cannot be read: {error}") from error
    _check(path, about, largest)


def read_bytes(path: str | Path, largest: int) -> bytes:
    """Contents of a regular file.

    Parameters
    ----------
    path, largest :
        Arguments of ``check_input``.
    """
    check_input(path, largest)
    try:
        # a pipe that has taken the file's place since is opened without waiting for its writer
        handle = os.open(
            path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
        )
        with os.fdopen(handle, "rb") as stream:
            _check(path, os.fstat(handle), largest)
            content = stream.read(largest + 1)
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from error
    if len(content) > largest:  # files of /proc have a size of 0
        raise FileError(path, f"is too large; allowed: at most {_size(largest)}")
    return content


def read_text(path: str | Path, largest: int = LARGEST_TEXT) -> str:
    """Text of a regular file in UTF-8, with or without a byte order mark."""
    try:
        return read_bytes(path, largest).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(path, f"is not UTF-8 text: {error.reason} at byte {error.start}") from error


def _check(path: str | Path, about: os.stat_result, largest: int) -> None:
    if stat.S_ISDIR(about.st_mode):
        raise FileError(path, "is a folder, not a file")
    if not stat.S_ISREG(about.st_mode):
        raise FileError(path, "is not a regular file, so it cannot be read")
    if about.st_size > largest:
        size = _size(about.st_size)
        raise FileError(path, f"is too large, {size}; allowed: at most {_size(largest)}")


def _size(count: int) -> str:
    return f"{count / 1e9:.3g} GB" if count >= 1e9 else f"{count / 1e6:.3g} MB"

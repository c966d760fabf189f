"""Fingerprints of tasks: hashes of all inputs of a result."""

from __future__ import annotations

import dataclasses
import hashlib
import socket
from collections.abc import Iterable, Mapping
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from airlight.errors import FileError, WorkerError
from airlight.kernel.fingerprints import fingerprint


def digest(value: Any, files: Iterable[Path] = ()) -> str:
    """Hash of parameter objects, numbers, texts, lists and arrays, and of the contents of files.

    Parameters
    ----------
    value : object
        Value; mappings are hashed independently of the order of their keys.
    files : iterable of Path
        Files whose contents are included.

    Returns
    -------
    str
        Thirty-two hexadecimal digits.

    Examples
    --------
    >>> digest({"a": 1.0, "b": (2, None)}) == digest({"b": (2, None), "a": 1.0})
    True
    >>> digest([1.0, 2.0]) == digest([2.0, 1.0])
    False
    """
    state = hashlib.sha256()
    _add(state, value)
    for file in files:
        state.update(_content(file, *_stamp(file)))
    return state.hexdigest()[:32]


@cache
def code_digest(*files: Path) -> str:
    """Hash of source files, of all files of the package that they import, and of the compiler.

    Machines that share a computation, and runs that resume it, have to agree on it.
    """
    return digest([fingerprint(file) for file in files])


def check_code(code: str, *files: Path) -> None:
    """Raise an error on a worker whose source code differs from the sender's.

    Parameters
    ----------
    code : str
        Hash of the sender's source code.
    """
    if code != code_digest(*files):
        raise WorkerError(
            f"a different version of airlight or Numba is installed on {socket.gethostname()}"
        )


def _stamp(file: Path) -> tuple[int, int]:
    try:
        status = file.stat()
    except OSError as error:
        raise FileError(file, (error.strerror or type(error).__name__).lower()) from None
    return status.st_size, status.st_mtime_ns


@cache
def _content(file: Path, size: int, changed: int) -> bytes:
    """Hash of a file's contents, cached by size and modification time."""
    try:
        with file.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").digest()
    except OSError as error:
        raise FileError(file, (error.strerror or type(error).__name__).lower()) from None


def _add(state: Any, value: Any) -> None:
    """Add a value with its type and length, so that encodings are unique."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        state.update(f"{type(value).__qualname__} ".encode())
        fields = {one.name: getattr(value, one.name) for one in dataclasses.fields(value)}
        _add(state, {name: item for name, item in fields.items() if name != "folder"})
    elif isinstance(value, Mapping):
        state.update(f"map {len(value)} ".encode())
        for key in sorted(value):
            _add(state, key)
            _add(state, value[key])
    elif isinstance(value, (list, tuple)):
        state.update(f"list {len(value)} ".encode())
        for item in value:
            _add(state, item)
    elif isinstance(value, np.ndarray):
        state.update(f"array {value.dtype.str} {value.shape} ".encode())
        state.update(np.ascontiguousarray(value).tobytes())
    elif isinstance(value, datetime):
        state.update(f"time {value.isoformat()} ".encode())
    elif value is None or isinstance(value, (str, bool, int, float, np.generic)):
        plain = value.item() if isinstance(value, np.generic) else value
        text = repr(plain)
        state.update(f"{type(plain).__name__} {len(text)} {text} ".encode())
    else:
        raise TypeError(f"{type(value).__name__} has no fingerprint")

"""Lock on an output: a single writer at a time; a killed process releases it."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from airlight.errors import FileError
from airlight.files.partial_outputs import partial_output

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

#: Errors of a lock held by another process; other errors come from a file system without locks.
_HELD: Final = (errno.EAGAIN, errno.EACCES, errno.EWOULDBLOCK)
#: Time between two attempts. [s]
_PAUSE: Final = 0.02


def hidden_file(output: Path, suffix: str) -> Path:
    """Path of the hidden file of an output in its folder, equal in all runs.

    Parameters
    ----------
    suffix : str
        Purpose, such as ``part``.
    """
    # A hash, since a name may already be as long as the file system allows.
    key = hashlib.sha256(os.fsencode(output.name.casefold())).hexdigest()[:16]
    return output.with_name(f".{key}.{suffix}")


@contextlib.contextmanager
def output_lock(output: Path, lock: Path | None = None, *, wait: float = 0.0) -> Iterator[None]:
    """Context with the lock on an output, released by the system if the process is killed.

    Without effect on file systems without locks.

    Parameters
    ----------
    output : Path
        Path of the file or folder, without links.
    lock : Path, optional
        Path of the locked file, removed at the end; default: a hidden file next to the output.
    wait : float
        Time to wait for another writer. [s]
    """
    lock = lock or hidden_file(output, "lock")
    until = time.monotonic() + wait
    while (handle := _locked(output, lock)) is None:
        if time.monotonic() >= until:
            reason = "is being written by another process; start again when that has ended"
            raise FileError(output, reason)
        time.sleep(_PAUSE)
    try:
        with partial_output(lock):
            yield
    finally:
        os.close(handle)


def _locked(output: Path, lock: Path) -> int | None:
    """Handle of the locked file, or None if another process has locked it."""
    flags = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        handle = os.open(lock, flags, 0o666)
    except OSError as error:
        reason = f"cannot be written: {(error.strerror or str(error)).lower()} ({lock.parent})"
        raise FileError(output, reason) from None
    try:
        if _held(handle) or not os.path.samestat(os.fstat(handle), lock.stat()):
            os.close(handle)
            return None
    except FileNotFoundError:  # removed by its owner after it was opened here
        os.close(handle)
        return None
    return handle


def _held(handle: int) -> bool:
    """Try to take the lock; returns whether another process or thread holds it."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno in _HELD
    return False

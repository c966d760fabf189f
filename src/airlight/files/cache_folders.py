"""Cache folders, and checks of their owner and permissions.

Cached compiled code and pickled indices are executed when loaded. Every cache folder and file must
therefore belong to this user or to root and not be writable by others, as ssh requires of its
files. A checksum would not help, as whoever writes a file can write that too. On Windows the user's
folders are private.
"""

from __future__ import annotations

import contextlib
import os
import stat
from pathlib import Path
from typing import IO, Final

from airlight.errors import warn

#: Cache folders about which a warning has been issued.
_said: Final[set[Path]] = set()


def cache_folder() -> Path:
    """Cache folder of airlight.

    The environment variable ``AIRLIGHT_CACHE`` overrides it.
    """
    named = os.environ.get("AIRLIGHT_CACHE")
    if named:
        return Path(named)
    import platformdirs

    return Path(platformdirs.user_cache_dir("airlight", appauthor=False))


def make_folder(folder: Path) -> None:
    """Make a folder and missing parents, private to this user (mode 0700)."""
    missing = [one for one in (folder, *folder.parents) if not one.exists()]
    for one in reversed(missing):
        one.mkdir(mode=stat.S_IRWXU, exist_ok=True)


def trusted_folder(cache: Path, *names: str) -> Path | None:
    """Folder of the cache; None, with a warning, if others could have written to it.

    Parameters
    ----------
    names : str
        Names of nested folders, all of which are checked.

    Returns
    -------
    Path or None
        Path of the last folder, which may not exist.

    Warns
    -----
    AirlightWarning
        Once for a cache: which folder or file is not used, why, and what to do.
    """
    folder = cache
    for name in ("", *names):
        folder = folder / name
        with contextlib.suppress(OSError):
            # a link can be redirected to another folder by its owner
            if _distrusted(folder, folder.lstat()) or _distrusted(folder, folder.stat()):
                return None
    return folder


def open_trusted(file: Path) -> IO[bytes]:
    """Open a file of the cache for reading."""
    stream = file.open("rb")
    if _distrusted(file, os.fstat(stream.fileno())):
        stream.close()
        raise PermissionError(f"{file} may belong to others")
    return stream


def read_trusted(file: Path) -> bytes:
    """Content of a file opened by ``open_trusted``."""
    with open_trusted(file) as stream:
        return stream.read()


def _distrusted(path: Path, found: os.stat_result) -> bool:
    """Whether others could have written to a file or folder; warns if so."""
    if os.name != "posix":
        return False
    if found.st_uid not in (0, os.geteuid()):  # root has all permissions anyway
        reason = "belongs to another user"
    elif found.st_mode & (stat.S_IWGRP | stat.S_IWOTH) and not stat.S_ISLNK(found.st_mode):
        reason = "can be written by others"
    else:
        return False
    cache = cache_folder()
    if cache not in _said:
        _said.add(cache)
        warn(
            f"{path} {reason}, and is not used: nothing is cached, and code is compiled in "
            "memory; remove it, or set AIRLIGHT_CACHE to a folder of your own"
        )
    return True

"""Folders of what is kept between runs, and whom they may belong to.

What lies there is trusted: compiled code is run, and indices are unpickled, which runs what they
say; solutions and maps become light. Only what nobody else can have written is read: each folder,
from the cache down, and each file must belong to this user or to root, and be closed to writing by
group and others, as ssh asks of its files. A checksum would not do: who writes a file writes that
too. Windows keeps the folders of a user to that user.
"""

from __future__ import annotations

import contextlib
import os
import stat
from pathlib import Path
from typing import IO, Final

from airlight.errors import warn

#: Cache folders of which it was said that something in them is not used.
_said: Final[set[Path]] = set()


def cache_folder() -> Path:
    """Folder for everything that airlight keeps between runs.

    ``AIRLIGHT_CACHE`` names another folder.
    """
    named = os.environ.get("AIRLIGHT_CACHE")
    if named:
        return Path(named)
    import platformdirs

    return Path(platformdirs.user_cache_dir("airlight", appauthor=False))


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it that are missing, for this user alone (mode 0700).

    Raises
    ------
    OSError
        If that is not possible.
    """
    missing = [one for one in (folder, *folder.parents) if not one.exists()]
    for one in reversed(missing):
        one.mkdir(mode=stat.S_IRWXU, exist_ok=True)


def trusted_folder(cache: Path, *names: str) -> Path | None:
    """Return a folder of the cache, or None, with a warning, if others can have written to it.

    Parameters
    ----------
    cache : Path
        Folder of the cache.
    names : str
        Names of the folders below it, each of which is checked too.

    Returns
    -------
    Path or None
        Path of the last, which need not exist.

    Warns
    -----
    AirlightWarning
        Once for a cache: which folder or file is not used, why, and what to do.
    """
    folder = cache
    for name in ("", *names):
        folder = folder / name
        with contextlib.suppress(OSError):
            # a link is a name, which whoever owns it can turn to another folder
            if _distrusted(folder, folder.lstat()) or _distrusted(folder, folder.stat()):
                return None
    return folder


def open_trusted(file: Path) -> IO[bytes]:
    """Open a file of the cache for reading.

    Raises
    ------
    OSError
        If it cannot be read, or others can have written it, which is warned of.
    """
    stream = file.open("rb")
    if _distrusted(file, os.fstat(stream.fileno())):
        stream.close()
        raise PermissionError(f"{file} may be of others")
    return stream


def read_trusted(file: Path) -> bytes:
    """Content of a file, as ``open_trusted`` opens it."""
    with open_trusted(file) as stream:
        return stream.read()


def _distrusted(path: Path, found: os.stat_result) -> bool:
    """Whether others can have written to a file or folder, which is warned of."""
    if os.name != "posix":
        return False
    if found.st_uid not in (0, os.geteuid()):  # root may do all anyway
        reason = "belongs to another user"
    elif found.st_mode & (stat.S_IWGRP | stat.S_IWOTH) and not stat.S_ISLNK(found.st_mode):
        reason = "can be written by others"
    else:
        return False
    cache = cache_folder()
    if cache not in _said:
        _said.add(cache)
        warn(
            f"{path} {reason}, and is not used: nothing there is read or kept, code is compiled in "
            "memory; remove it, or name a folder of your own by AIRLIGHT_CACHE"
        )
    return True

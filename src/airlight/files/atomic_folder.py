"""Atomically written folders with a JSON manifest."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from airlight.errors import FileError
from airlight.files.manifest import MANIFEST, check_replaceable, own_files
from airlight.files.output_lock import hidden_file, output_lock
from airlight.files.partial_outputs import partial_output, remove

#: Time that the writer of a folder waits for another one of the same folder. [s]
WAIT: Final = 60.0
#: Suffixes of files.
_FORMAT: Final = re.compile(r"\.[A-Za-z]+\d?")


def check_folder_name(folder: str | Path, suffix: str = "") -> None:
    """Raise an error for a new folder named like a file of some format, such as ``sky.nc``.

    Parameters
    ----------
    folder : str or Path
        Folder; an existing one may have any name.
    suffix : str
        Allowed suffix.
    """
    path = Path(folder)
    if path.exists() or path.suffix.lower() == suffix or not _FORMAT.fullmatch(path.suffix):
        return
    allowed = f"ends in {suffix}, or has no suffix" if suffix else "has no suffix"
    raise FileError(folder, f"names a file; allowed: a folder whose name {allowed}")


def check_folder(
    folder: str | Path, form: str, files: tuple[str, ...] = ("*",), *, overwrite: bool = False
) -> Path:
    """Resolved path of a folder to be written; an error if it cannot be.

    Parameters
    ----------
    folder : str or Path
        New or empty folder, or one with a manifest of this format.
    form : str
        Format named in the manifest.
    files : tuple of str
        Names or patterns of the files, such as ``*.exr``.
    overwrite : bool
        Whether to replace files that airlight did not write or that were modified.
    """
    check_folder_name(folder)
    try:
        target = Path(folder).resolve()
        if target.exists() and not target.is_dir():
            raise FileError(folder, "is a file, not a folder")
        if not target.parent.is_dir():
            raise FileError(folder, f"there is no folder {target.parent}")
        there = sorted(target.iterdir()) if target.is_dir() else []
        if there and not (target / MANIFEST).is_file() and not overwrite:
            reason = f"holds {there[0].name}, but no {MANIFEST}: name a new or empty folder"
            raise FileError(folder, f"{reason}, or allow overwriting")
        own = own_files(target / MANIFEST, form, overwrite=overwrite)
        check_replaceable(target, (), (MANIFEST, *own), patterns=files, overwrite=overwrite)
        for place in (target.parent, *((target,) if target.is_dir() else ())):
            if not os.access(place, os.W_OK | os.X_OK):
                raise FileError(folder, f"the folder {place} cannot be written to")
    except (OSError, ValueError, RuntimeError) as error:  # a null character, a cycle of links
        raise FileError(folder, str(error)) from error
    return target


@contextlib.contextmanager
def atomic_folder(
    folder: str | Path, form: str, files: tuple[str, ...] = ("*",), *, overwrite: bool = False
) -> Iterator[Path]:
    """Context with a temporary folder, whose files are moved to ``folder`` if the block succeeds.

    Unmodified files of an older manifest are removed.
    """
    target = Path(folder).resolve()
    if not target.parent.is_dir():
        raise FileError(folder, f"there is no folder {target.parent}")
    part = hidden_file(target, "part")
    with output_lock(target, wait=WAIT), partial_output(part):
        check_folder(folder, form, files, overwrite=overwrite)  # no one replaces its files now
        try:
            remove(part)  # of a run that was killed
            part.mkdir()
            yield part
            _put(part, target, form, overwrite)
        except OSError as error:
            raise FileError(folder, f"cannot be written: {error.strerror or error}") from error


def _put(part: Path, target: Path, form: str, overwrite: bool) -> None:
    if not target.exists():
        part.rename(target)
        return
    stale = own_files(target / MANIFEST, form, overwrite=overwrite)
    files = sorted(part.iterdir(), key=lambda path: path.name != MANIFEST)
    names = [file.name for file in files]
    check_replaceable(target, names, (MANIFEST, *stale), overwrite=overwrite)
    # At each moment a manifest lists what is there: a process that is killed leaves files missing,
    # which the same command replaces.
    for name in stale:
        (target / name).unlink(missing_ok=True)
    for file in files:
        file.replace(target / file.name)

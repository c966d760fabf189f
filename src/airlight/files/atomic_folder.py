"""Folders of files with a JSON manifest, which appear whole: the manifest comes last."""

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
    """Refuse the name of a new folder that says a format of files, such as ``sky.nc``.

    Parameters
    ----------
    folder : str or Path
        Folder; what is there may have any name.
    suffix : str
        Suffix that it may have.

    Raises
    ------
    FileError
        If its suffix has letters alone, or letters and one digit, and is another.
    """
    path = Path(folder)
    if path.exists() or path.suffix.lower() == suffix or not _FORMAT.fullmatch(path.suffix):
        return
    allowed = f"ends in {suffix}, or has no suffix" if suffix else "has no suffix"
    raise FileError(folder, f"names a file; allowed: a folder whose name {allowed}")


def check_folder(
    folder: str | Path, form: str, files: tuple[str, ...] = ("*",), *, overwrite: bool = False
) -> Path:
    """Resolve a folder and check that it can be written, before long work.

    Parameters
    ----------
    folder : str or Path
        Folder to create, an empty one, or one with a manifest of this format.
    form : str
        Format that the manifest names.
    files : tuple of str
        Names of files that will be written, or patterns of them such as ``*.exr``.
    overwrite : bool
        Whether files that airlight has not written, or that were changed since, may be replaced.

    Raises
    ------
    FileError
        If it is named as a file, or is one, its parent is missing, it or its parent cannot be
        written to, it holds files but no such manifest, or one of the files is not airlight's to
        replace.
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
    """Yield a temporary folder whose files are moved to ``folder`` if the block succeeds.

    Files that an older manifest lists are removed if they are unchanged; others stay.

    Parameters
    ----------
    folder, form, files, overwrite :
        Arguments of ``check_folder``.

    Raises
    ------
    FileError
        If the folder cannot be written, or another process writes it for longer than ``WAIT``; it
        is then unchanged.
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
    files = sorted(part.iterdir(), key=lambda path: path.name == MANIFEST)
    stale = own_files(target / MANIFEST, form, overwrite=overwrite)
    names = [file.name for file in files]
    check_replaceable(target, names, (MANIFEST, *stale), overwrite=overwrite)
    (target / MANIFEST).unlink(missing_ok=True)  # from here on the folder is marked as incomplete
    for name in stale:
        (target / name).unlink(missing_ok=True)
    for file in files:
        file.replace(target / file.name)

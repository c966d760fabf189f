"""Folders of files with a JSON manifest, which appear whole: the manifest comes last."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from airlight.errors import FileError
from airlight.exports.beginnings import begun, remove
from airlight.exports.output_lock import hidden_file, output_lock

#: Name of the manifest in its folder.
MANIFEST: Final = "manifest.json"
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
    raise FileError(folder, f"names a file; allowed: a folder, whose name {allowed}")


def check_folder(folder: str | Path, form: str) -> Path:
    """Resolve a folder and check that it can be written, before long work.

    Parameters
    ----------
    folder : str or Path
        Folder to create, an empty one, or one with a manifest of this format.
    form : str
        Format that the manifest names.

    Raises
    ------
    FileError
        If it is named as a file, or is one, its parent is missing, it or its parent cannot be
        written to, or it holds files but no such manifest.
    """
    check_folder_name(folder)
    try:
        target = Path(folder).resolve()
        if target.exists() and not target.is_dir():
            raise FileError(folder, "is a file, not a folder")
        if not target.parent.is_dir():
            raise FileError(folder, f"there is no folder {target.parent}")
        if target.is_dir() and any(target.iterdir()) and not (target / MANIFEST).is_file():
            raise FileError(folder, f"holds files, but no {MANIFEST}: name a new or empty folder")
        if (target / MANIFEST).is_file():
            read_manifest(target / MANIFEST, form)
        for place in (target.parent, *((target,) if target.is_dir() else ())):
            if not os.access(place, os.W_OK | os.X_OK):
                raise FileError(folder, f"the folder {place} cannot be written to")
    except (OSError, ValueError, RuntimeError) as error:  # a null character, a cycle of links
        raise FileError(folder, str(error)) from error
    return target


@contextlib.contextmanager
def whole_folder(folder: str | Path, form: str) -> Iterator[Path]:
    """Yield a temporary folder whose files move to ``folder`` if the block ends well.

    Files of an older manifest are removed; others stay.

    Parameters
    ----------
    folder, form :
        Arguments of ``check_folder``.

    Raises
    ------
    FileError
        If the folder cannot be written, or another process writes it for longer than ``WAIT``; it
        is then unchanged.
    """
    target = check_folder(folder, form)
    part = hidden_file(target, "part")
    with output_lock(target, wait=WAIT), begun(part):
        try:
            remove(part)  # of a run that was killed
            part.mkdir()
            yield part
            _put(part, target, form)
        except OSError as error:
            raise FileError(folder, f"cannot be written: {error.strerror or error}") from error


def write_manifest(folder: Path, manifest: dict[str, Any]) -> None:
    """Write the manifest of a folder.

    Parameters
    ----------
    folder : Path
        Folder from ``whole_folder``.
    manifest : dict
        Its content; ``files`` anywhere in it are names of files with their ``fingerprint``.
    """
    text = json.dumps(manifest, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    (folder / MANIFEST).write_text(text, encoding="utf-8")


def read_manifest(path: Path, form: str) -> dict[str, Any]:
    """Read a manifest.

    Parameters
    ----------
    path : Path
        Path of the manifest.
    form : str
        Format that it must name.

    Raises
    ------
    FileError
        If it cannot be read, or names another format.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FileError(path, f"cannot be read: {error}") from error
    if not isinstance(content, dict) or content.get("format") != form:
        raise FileError(path, f"is no manifest of the format {form!r}")
    return content


def fingerprint(path: Path) -> dict[str, Any]:
    """Size and SHA-256 of a file.

    Parameters
    ----------
    path : Path
        Path of the file.
    """
    return {
        "bytes": path.stat().st_size,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
    }


def _put(part: Path, target: Path, form: str) -> None:
    if not target.exists():
        part.rename(target)
        return
    old = target / MANIFEST
    if old.is_file():
        stale = _files_in(read_manifest(old, form))
        old.unlink()  # from here on the folder is marked as incomplete
        for name in stale:
            (target / name).unlink(missing_ok=True)
    for file in sorted(part.iterdir(), key=lambda path: path.name == MANIFEST):
        file.replace(target / file.name)


def _files_in(content: Any) -> list[str]:
    """Names of all files of a manifest."""
    if not isinstance(content, dict):
        return []
    own = content.get("files")
    names = [Path(name).name for name in own] if isinstance(own, dict) else []
    return names + [name for one in content.values() for name in _files_in(one)]

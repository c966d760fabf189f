"""Manifests: JSON files that list the accompanying files, each with its SHA-256.

airlight replaces or deletes a file only if an unmodified manifest lists it and its checksum
matches. Manifests are not trusted: a listed name must be that of a file in the same folder.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Final

from airlight.errors import FileError
from airlight.files.input_files import read_text
from airlight.plain_text import is_plain

#: Name of the manifest in its folder.
MANIFEST: Final = "manifest.json"
#: Key of the manifest's own SHA-256, over its other keys.
SEAL: Final = "manifest_sha256"
#: Longest name of a file that a manifest may list. [character]
_LONGEST: Final = 255
#: Largest number of files named in one message.
_NAMED: Final = 3
_LINK: Final = "is a link, which is neither followed nor replaced"
#: Advice for files that airlight did not write.
_ADVICE: Final = "name another output, or allow overwriting"


def sealed(content: Mapping[str, Any]) -> dict[str, Any]:
    """Manifest with its own checksum.

    Examples
    --------
    >>> from airlight.files.manifest import is_sealed, sealed
    >>> manifest = sealed({"format": "airlight sky 1"})
    >>> is_sealed(manifest), is_sealed(manifest | {"format": "mine"}), is_sealed({})
    (True, False, False)
    """
    return {**content, SEAL: _checksum(content)}


def is_sealed(content: Mapping[str, Any]) -> bool:
    """Whether the checksum of a manifest is valid."""
    return SEAL in content and content[SEAL] == _checksum(content)


def _checksum(content: Mapping[str, Any]) -> str:
    own = {name: value for name, value in content.items() if name != SEAL}
    text = json.dumps(own, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def write_manifest(folder: Path, manifest: dict[str, Any]) -> None:
    """Write the manifest of a folder.

    Parameters
    ----------
    folder : Path
        Folder from ``atomic_folder``.
    manifest : dict
        Content, in which any ``files`` are file names with their ``fingerprint``.
    """
    text = json.dumps(sealed(manifest), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    (folder / MANIFEST).write_text(text, encoding="utf-8")


def read_manifest(path: Path, form: str) -> dict[str, Any]:
    """Read a manifest.

    Parameters
    ----------
    form : str
        Required format.

    Raises
    ------
    FileError
        If it cannot be read, is larger than 32 MB, names another format, or lists a file outside
        its folder.
    """
    text = read_text(path)
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileError(path, f"cannot be read as JSON: {error}") from error
    if not isinstance(content, dict) or content.get("format") != form:
        raise FileError(path, f"is not a manifest of the format {form!r}")
    for name in listed(content):
        if not _is_name(name):
            reason = f"lists {name[:60]!r}; allowed: names of files in its own folder"
            raise FileError(path, reason)
    return content


def fingerprint(path: Path) -> dict[str, Any]:
    """Size and SHA-256 of a file."""
    with path.open("rb") as stream:
        checksum = hashlib.file_digest(stream, "sha256").hexdigest()
    return {"bytes": path.stat().st_size, "sha256": checksum}


def fingerprint_of(content: bytes) -> dict[str, Any]:
    """Size and SHA-256 of a file's content."""
    return {"bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}


def listed(content: Any) -> dict[str, Any]:
    """Files listed by a manifest, with their sizes and checksums."""
    if not isinstance(content, dict):
        return {}
    own = content.get("files")
    found = dict(own) if isinstance(own, dict) else {}
    for name, one in content.items():
        if name != "files":
            found |= listed(one)
    return found


def own_files(manifest: Path, form: str, *, overwrite: bool = False) -> tuple[str, ...]:
    """Files that airlight may replace or delete: listed and unmodified.

    Parameters
    ----------
    manifest : Path
        Path of the manifest, which may not exist.
    overwrite : bool
        Whether a foreign manifest counts as empty rather than as an error.

    Returns
    -------
    tuple of str
        Names of existing files, without the manifest.
    """
    if manifest.is_symlink():
        raise FileError(manifest, _LINK)
    if not manifest.is_file():
        return ()
    try:
        content = read_manifest(manifest, form)
    except FileError as error:
        if overwrite:
            return ()
        raise FileError(manifest, f"{error.reason}; {_ADVICE}") from None
    folder, found = manifest.parent, listed(content)
    there = [name for name in found if (folder / name).exists() or (folder / name).is_symlink()]
    changed = [name for name in there if not _is_listed(folder / name, found[name])]
    if not overwrite and changed:
        raise _not_ours(folder, changed, f"not what {manifest.name} lists")
    if not is_sealed(content):
        if overwrite:
            return ()
        raise _not_ours(folder, [manifest.name], "modified since airlight wrote it")
    return tuple(name for name in there if name not in changed)


def check_replaceable(
    folder: Path,
    names: Iterable[str],
    own: Iterable[str],
    *,
    patterns: Iterable[str] = (),
    overwrite: bool = False,
) -> None:
    """Raise an error if a file that is not airlight's would be replaced.

    Parameters
    ----------
    folder : Path
        Folder of the output.
    names : iterable of str
        Names of the files to be written.
    own : iterable of str
        Replaceable names, from ``own_files``.
    patterns : iterable of str
        Patterns of further names, such as ``*.exr``.
    overwrite : bool
        Whether any file may be replaced; folders and links never.
    """
    if not folder.is_dir():
        return
    named = {name for name in names if os.path.lexists(folder / name)}
    named |= {
        file.name for one in patterns for file in folder.iterdir() if fnmatchcase(file.name, one)
    }
    there = [folder / name for name in sorted(named - set(own))]
    for file in there:
        if file.is_symlink():
            raise FileError(file, _LINK)
        if file.is_dir():
            raise FileError(file, "is a folder, where a file is to be written")
    if there and not overwrite:
        raise _not_ours(
            folder, [file.name for file in there], "not listed by a manifest of airlight's"
        )


def _not_ours(folder: Path, names: list[str], reason: str) -> FileError:
    more = "" if len(names) <= _NAMED else f" and {len(names) - _NAMED} more"
    others = "".join(f", {name}" for name in names[1:_NAMED]) + more
    beside = f" (also{others.removeprefix(',')})" if others else ""
    return FileError(folder / names[0], f"is {reason}{beside}; {_ADVICE}")


def _is_listed(path: Path, said: Any) -> bool:
    """Whether a file matches its entry in a manifest; False for a link."""
    if path.is_symlink() or not path.is_file() or not isinstance(said, dict):
        return False
    if said.get("bytes") != path.stat().st_size:  # which spares reading a large one
        return False
    return bool(said.get("sha256") == fingerprint(path)["sha256"])


def _is_name(name: str) -> bool:
    """Whether a name is a plain file name on every operating system."""
    usual = 0 < len(name) <= _LONGEST and is_plain(name) and name.strip(" .") != ""
    return usual and not re.search(r"[/\\:]", name) and name.casefold() != MANIFEST

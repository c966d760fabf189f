"""Pictures and tables of a report in Markdown: a folder with a manifest."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Final

from airlight.errors import FileError
from airlight.files.atomic_file import check_target
from airlight.files.atomic_folder import atomic_folder, check_folder
from airlight.files.manifest import (
    MANIFEST,
    check_replaceable,
    fingerprint,
    fingerprint_of,
    read_manifest,
    write_manifest,
)

#: Format named in the manifest.
FORMAT: Final = "airlight report pictures 1"
_FILES: Final = ("*.png", "*.csv")


def check_pictures(folder: Path, page: Path | None = None, *, overwrite: bool = False) -> None:
    """Raise an error if pictures cannot be written.

    Parameters
    ----------
    folder : Path
        New or empty folder, or one of such pictures.
    page : Path, optional
        Page that is written with them.
    overwrite : bool
        Whether to replace files that airlight did not write or that were modified.
    """
    target = folder
    if folder.parent.exists():  # else it is made, and nothing is there
        target = check_folder(folder, FORMAT, _FILES, overwrite=overwrite)
    if page is None:
        return
    check_target(page)
    own: tuple[str, ...] = ()
    if (target / MANIFEST).is_file() and page.is_file() and not page.is_symlink() and not overwrite:
        now = {"name": page.name, "sha256": fingerprint(page)["sha256"]}
        own = (page.name,) if read_manifest(target / MANIFEST, FORMAT).get("page") == now else ()
    check_replaceable(page.parent, [page.name], own, overwrite=overwrite)


def write_pictures(
    folder: Path,
    pictures: Mapping[str, bytes],
    page: Path | None = None,
    text: str = "",
    *,
    overwrite: bool = False,
) -> None:
    """Write pictures and their manifest.

    Parameters
    ----------
    folder, page, overwrite :
        Arguments of ``check_pictures``, which is called first.
    pictures : mapping of str to bytes
        Contents of PNG and CSV files by name.
    text : str
        Text of the page, whose checksum identifies it later.
    """
    check_pictures(folder, page, overwrite=overwrite)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(folder, f"cannot be created: {error.strerror or error}") from error
    with atomic_folder(folder, FORMAT, _FILES, overwrite=overwrite) as part:
        for name, png in pictures.items():
            (part / name).write_bytes(png)
        checksum = fingerprint_of(text.encode())["sha256"]
        about = {"name": page.name, "sha256": checksum} if page is not None else None
        files = {name: fingerprint(part / name) for name in pictures}
        write_manifest(part, {"format": FORMAT, "page": about, "files": files})

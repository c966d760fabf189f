"""Folder of a film's frames: file names, existing frames, and a lock."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from airlight.errors import FileError
from airlight.files.atomic_file import atomic_file
from airlight.files.output_lock import hidden_file, output_lock
from airlight.files.partial_outputs import remove
from airlight.image.header import PREFIX
from airlight.render.picture import read_picture_metadata
from airlight.studies.film.frame_checksum import has_checksum, is_whole

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress

#: Name of a frame's fingerprint in the header of its file.
FINGERPRINT: Final = "frame_fingerprint"
_LOCK: Final = ".airlight-film"
#: Largest size of a frame. [byte]
_LARGEST: Final = 1 << 32
#: First bytes of PNG and OpenEXR.
_SIGNATURES: Final = (b"\x89PNG\r\n\x1a\n", b"\x76\x2f\x31\x01")


@dataclass(frozen=True, kw_only=True)
class Present:
    """Existing frames of a folder.

    Attributes
    ----------
    fingerprints : dict of int to str
        Fingerprints of the intact frames, by number.
    damaged : frozenset of int
        Numbers of the frames with a wrong checksum.
    """

    fingerprints: dict[int, str]
    damaged: frozenset[int]


class FramesFolder:
    """Folder with the frames ``NAME_00001.png``, ``NAME_00002.png`` …, as for fulldome players.

    Parameters
    ----------
    folder : Path
        Folder; created if its parent exists.
    name : str
        Name of the film.
    suffix : str
        ``.png`` or ``.exr``.
    """

    def __init__(self, folder: Path, name: str, suffix: str, count: int) -> None:
        self.folder, self.stem, self.suffix, self.count = folder, file_stem(name), suffix, count

    def path(self, number: int) -> Path:
        """Path of a frame, counted from 0."""
        return self.folder / f"{self.stem}_{number + 1:05d}{self.suffix}"

    @property
    def paths(self) -> list[Path]:
        """Paths of all frames, in order."""
        return [self.path(number) for number in range(self.count)]

    def present(self, progress: Progress | None = None) -> Present:
        """Existing frames, verified by their checksums."""
        there = {entry.name for entry in os.scandir(self.folder)}
        numbers = [n for n, path in enumerate(self.paths) if path.name in there]
        fingerprints: dict[int, str] = {}
        damaged: set[int] = set()
        for done, number in enumerate(numbers):
            path = self.path(number)
            content = _content(path)
            if content is None:
                damaged.add(number)
            elif is_whole(content):
                fingerprints[number] = read_picture_metadata(path).get(PREFIX + FINGERPRINT, "")
            elif _is_foreign(path, content):
                reason = "is not a frame of a film; move it, or choose another folder"
                raise FileError(path, reason)
            elif has_checksum(content) or not _is_picture(path):
                damaged.add(number)
            if progress is not None:
                progress(done + 1, len(numbers), "verifying")
        return Present(fingerprints=fingerprints, damaged=frozenset(damaged))

    def write(self, number: int, content: bytes) -> None:
        """Write a frame atomically."""
        with atomic_file(self.path(number)) as part:
            part.write_bytes(content)

    def others(self) -> list[Path]:
        """Frames of an earlier, longer version of the film."""
        named = re.compile(rf"{re.escape(self.stem)}_\d{{5}}\.(png|exr)")
        own = set(self.paths)
        return sorted(
            file for file in self.folder.iterdir() if named.fullmatch(file.name) and file not in own
        )

    @contextlib.contextmanager
    def claimed(self) -> Iterator[None]:
        """Context that creates and locks the folder and removes partial files."""
        try:
            self.folder.mkdir(exist_ok=True)
        except OSError as error:
            raise FileError(self.folder, (error.strerror or str(error)).lower()) from None
        with output_lock(self.folder, self.folder / _LOCK):
            there = {entry.name for entry in os.scandir(self.folder)}
            for path in self.paths:
                part = hidden_file(path, "part")
                if part.name in there:
                    remove(part)
            yield


def _content(path: Path) -> bytes | None:
    """Bytes of a frame's file; None if it is unreadable or too large."""
    if path.is_symlink() or not path.is_file():
        raise FileError(path, "is not a regular file; remove it, or choose another folder")
    try:
        return path.read_bytes() if path.stat().st_size <= _LARGEST else None
    except OSError:
        return None


def _is_foreign(path: Path, content: bytes) -> bool:
    """Whether a file is neither a frame nor a damaged frame."""
    if PREFIX.encode() + FINGERPRINT.encode() in content or not content.strip(b"\0"):
        return False
    return not content.startswith(_SIGNATURES) or _is_picture(path)


def _is_picture(path: Path) -> bool:
    try:
        read_picture_metadata(path)
    except FileError:
        return False
    return True


def file_stem(name: str) -> str:
    """File name stem of a film: letters, digits, hyphens.

    Examples
    --------
    >>> file_stem("Sunset over the Sahara, 2°N")
    'sunset-over-the-sahara-2-n'
    """
    plain = re.sub(r"[^a-z0-9]+", "-", name.lower().encode("ascii", "replace").decode())
    return plain.strip("-")[:60] or "film"

"""Folder of a film's frames: their names, the frames that are there, and one film at a time."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from airlight.errors import FileError
from airlight.exports.header import PREFIX
from airlight.exports.picture import read_picture_metadata
from airlight.exports.whole_file import whole_file

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

#: Name of a frame's fingerprint in the header of its file.
FINGERPRINT: Final = "frame_fingerprint"
_LOCK: Final = ".airlight-film"


class FramesFolder:
    """Folder with the frames ``NAME_00001.png``, ``NAME_00002.png`` …, as fulldome players want.

    Parameters
    ----------
    folder : Path
        Folder; it is made if the folder above it is there.
    name : str
        Name of the film.
    suffix : str
        ``.png`` or ``.exr``.
    count : int
        Number of frames.
    """

    def __init__(self, folder: Path, name: str, suffix: str, count: int) -> None:
        self.folder, self.stem, self.suffix, self.count = folder, file_stem(name), suffix, count

    def path(self, number: int) -> Path:
        """Path of a frame, number 0 the first."""
        return self.folder / f"{self.stem}_{number + 1:05d}{self.suffix}"

    @property
    def paths(self) -> list[Path]:
        """Paths of all frames, in order."""
        return [self.path(number) for number in range(self.count)]

    def fingerprint(self, number: int) -> str | None:
        """Fingerprint of a frame that is there, or None."""
        try:
            return read_picture_metadata(self.path(number)).get(PREFIX + FINGERPRINT)
        except FileError:
            return None

    def write(self, number: int, content: bytes) -> None:
        """Write a frame, whole or not at all."""
        with whole_file(self.path(number)) as part:
            part.write_bytes(content)

    def others(self) -> list[Path]:
        """Frames of the same name that are not of this film, which was longer before."""
        named = re.compile(rf"{re.escape(self.stem)}_\d{{5}}\.(png|exr)")
        own = set(self.paths)
        return sorted(
            file for file in self.folder.iterdir() if named.fullmatch(file.name) and file not in own
        )

    @contextlib.contextmanager
    def claimed(self) -> Iterator[None]:
        """Make the folder, keep other films out of it, and clear what a killed one left.

        Raises
        ------
        FileError
            If the folder cannot be made or written to, or another film is at work in it.
        """
        try:
            self.folder.mkdir(exist_ok=True)
            lock: Any = (self.folder / _LOCK).open("a")
        except OSError as error:
            raise FileError(self.folder, (error.strerror or str(error)).lower()) from None
        with lock:
            if fcntl is not None:
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except OSError:
                    raise FileError(self.folder, "another film is being written here") from None
            for part in self.folder.glob(".*.part"):
                part.unlink(missing_ok=True)
            try:
                yield
            finally:
                (self.folder / _LOCK).unlink(missing_ok=True)


def file_stem(name: str) -> str:
    """Name of a film as files can have it: letters, digits, hyphens.

    Examples
    --------
    >>> file_stem("Sunset over the Sahara, 2°N")
    'sunset-over-the-sahara-2-n'
    """
    plain = re.sub(r"[^a-z0-9]+", "-", name.lower().encode("ascii", "replace").decode())
    return plain.strip("-")[:60] or "film"

"""Store of a sweep: a Zarr group with a checksum of each block.

Existing metadata have to be those of this grid; blocks are verified by their checksums, and damaged
ones are computed again.
"""

from __future__ import annotations

import enum
import hashlib
import json
import os
import shutil
from collections.abc import Mapping
from functools import cached_property
from importlib import util
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, FileError
from airlight.files.atomic_folder import check_folder_name
from airlight.files.output_lock import hidden_file
from airlight.files.partial_outputs import partial_output, remove
from airlight.files.provenance import software
from airlight.studies.sweep.grid import Grid
from airlight.studies.sweep.store_layout import (
    AXES_ATTRIBUTE,
    COMPRESSOR,
    MARKS,
    array_names,
    axes_text,
    chunk_file,
    chunk_shape,
    contents,
    marks_file,
    metadata,
)

#: Metadata of the group itself.
_GROUP: Final = {"zarr_format": 2}
#: Allowance for the metadata of attributes added by others. [byte]
_ADDED: Final = 1 << 20
#: Smallest size of a file on disk. [byte]
_SECTOR: Final = 4096
_REMEDY: Final = (
    "the store is damaged, or not of this airlight: remove it, or choose another folder"
)


def check_store(path: Path, field: str) -> None:
    """Raise an error, before the computation, if a sweep cannot be written to a path."""
    if util.find_spec("zarr") is None:
        raise ConflictError(field, "requires zarr: pip install airlight[sweep]")
    check_folder_name(path, ".zarr")
    try:
        parent = path.resolve().parent
        there = parent.is_dir()
        if path.exists() and not (path / ".zgroup").is_file() and any(_inside(path)):
            raise FileError(path, "is not a sweep; allowed: a new folder, or a sweep to resume")
    except (OSError, ValueError, RuntimeError) as error:  # a null character, a cycle of links
        raise FileError(path, str(error)) from error
    if not there:
        raise FileError(path, f"there is no folder {parent}")
    for folder in (path, parent) if path.exists() else (parent,):
        if not os.access(folder, os.W_OK | os.X_OK):
            raise FileError(path, f"the folder {folder} cannot be written to")


def _inside(path: Path) -> list[Path]:
    return list(path.iterdir()) if path.is_dir() else [path]


def size_on_disk(grid: Grid, *, stokes: bool) -> int:
    """Upper limit of the size of a store. [byte]"""
    chunk = 4 * int(np.prod(chunk_shape(grid)))
    sectors = -(-chunk // _SECTOR)
    return int(np.prod(grid.blocks, dtype=object)) * len(array_names(stokes)) * sectors * _SECTOR


def check_room(path: Path, needed: int) -> None:
    """Raise an error if a store exceeds its present size plus the free disk space.

    Parameters
    ----------
    path : Path
        Folder of the group.
    needed : int
        Size of the whole store. [byte]
    """
    free = shutil.disk_usage(path.parent).free
    if needed <= free:
        return
    taken = sum(
        entry.stat(follow_symlinks=False).st_size
        for name in (array_names(stokes=True) if path.is_dir() else ())
        if (path / name).is_dir()
        for entry in os.scandir(path / name)
    )
    if needed > free + taken:
        have = f"needs up to {in_words(needed - taken)}, and the disk has {in_words(free)} free"
        raise FileError(path, f"{have}: choose fewer values, or another disk")


def in_words(size: float) -> str:
    """Size in words, to two digits.

    Examples
    --------
    >>> [in_words(size) for size in (2.1e6, 1.7e12)]
    ['2.1 MB', '1.7 TB']
    """
    for unit, name in ((1e12, "TB"), (1e9, "GB"), (1e6, "MB")):
        if size >= unit:
            return f"{size / unit:.3g} {name}"
    return f"{size / 1e3:.3g} kB"


class State(enum.Enum):
    """State of a block: absent, computed from other inputs, damaged, or intact."""

    MISSING = "missing"
    CHANGED = "changed"
    DAMAGED = "damaged"
    WHOLE = "whole"


class SweepStore:
    """Radiances of a grid on disk; the folder appears with the first block.

    Parameters
    ----------
    path : Path
        Folder of the Zarr group.
    about : mapping of str to str
        Further attributes: quantity and settings.
    stokes : bool
        Whether it contains ``POLARISED``.
    """

    def __init__(
        self, path: Path, grid: Grid, about: Mapping[str, str], *, stokes: bool = False
    ) -> None:
        self.path, self._folder, self._grid = path, path.resolve(), grid
        self._names = array_names(stokes)
        self._metadata = metadata(grid, stokes=stokes)
        self._contents = contents(grid)
        self._attributes = {
            AXES_ATTRIBUTE: axes_text(grid, stokes=stokes),
            "planet": ", ".join(grid.names),
            **about,
            **software(),
        }
        self._marks = np.zeros((*grid.blocks, 2), np.uint64)
        self._there = (path / ".zgroup").is_file()
        self._whole = 0
        if self._there:
            self._check_metadata()
            self._read_marks()

    def state(self, block: tuple[int, ...], fingerprint: int) -> State:
        """State of a block, for its expected fingerprint; all bytes are read.

        Parameters
        ----------
        fingerprint : int
            Hash of all inputs of the block, 1 to 2^63.
        """
        written, checksum = map(int, self._marks[block])
        if not written and not checksum:
            return State.MISSING
        largest = 4 * int(np.prod(chunk_shape(self._grid))) + _ADDED
        files = [_content(self._folder / chunk_file(name, block), largest) for name in self._names]
        if None in files or checksum != _checksum(written, [one for one in files if one]):
            return State.DAMAGED
        if written != fingerprint:
            return State.CHANGED
        self._whole += 1
        return State.WHOLE

    def renew(self) -> list[str]:
        """Rewrite differing attributes and coordinates of an existing group.

        Returns
        -------
        list of str
            Names of damaged coordinates.
        """
        damaged = []
        texts = {name: text.encode() for name, text in self._texts.items()}
        for name, content in ((texts | self._contents) if self._there else {}).items():
            if _content(self._folder / name, len(content)) == content:
                continue
            if name in self._contents:
                damaged.append(name.partition("/")[0])
            try:
                _put(self._folder / name, content)
            except OSError as error:
                reason = f"cannot be written: {error.strerror or error}"
                raise FileError(self.path, reason) from error
        return damaged

    def write(self, block: tuple[int, ...], values: NDArray[np.float32], fingerprint: int) -> None:
        """Write the arrays of a block, then its fingerprint and checksum.

        Parameters
        ----------
        values : array, shape (n, suns, views, azimuths, wavelengths)
            Radiance first. [W m⁻² sr⁻¹ nm⁻¹]

        Raises
        ------
        FileError
            If the disk is full, or the folder cannot be written to; earlier blocks are unharmed.
        """
        chunks = [self._chunk(one) for one in values]
        self._marks[block] = np.array([fingerprint, _checksum(fingerprint, chunks)], np.uint64)
        try:
            if self._there:
                self._put_block(self._folder, block, chunks)
            else:
                part = hidden_file(self._folder, "part")
                with partial_output(part):
                    remove(part)  # of a run that was killed
                    part.mkdir()
                    self._lay_out(part)
                    self._put_block(part, block, chunks)
                    part.replace(self._folder)
                self._there = True
        except OSError as error:
            kept = f"; {self._whole} blocks are kept, and the same command computes the others"
            reason = f"cannot be written: {error.strerror or error}{kept if self._whole else ''}"
            raise FileError(self.path, reason) from error
        self._whole += 1

    def _chunk(self, values: NDArray[np.float32]) -> bytes:
        """Compressed chunk of a block, which may be smaller at the ends of the axes."""
        from numcodecs.registry import get_codec

        chunk = np.full(chunk_shape(self._grid)[-4:], np.nan, "<f4")
        chunk[: values.shape[0], : values.shape[1]] = values
        return bytes(get_codec(dict(COMPRESSOR)).encode(chunk))

    def _put_block(self, folder: Path, block: tuple[int, ...], chunks: list[bytes]) -> None:
        for name, chunk in zip(self._names, chunks, strict=True):
            _put(folder / chunk_file(name, block), chunk)
        variant = block[: len(self._grid.variants)]
        _put(folder / marks_file(variant), self._marks[variant].astype("<u8").tobytes())

    # --- a new group --------------------------------------------------------------------------

    @cached_property
    def _texts(self) -> dict[str, str]:
        """Metadata of group and arrays as JSON, by their path."""
        own = {".zgroup": _GROUP, ".zattrs": self._attributes, **self._metadata}
        together = {"metadata": own, "zarr_consolidated_format": 1}
        return {name: json.dumps(one) for name, one in (own | {".zmetadata": together}).items()}

    def _lay_out(self, folder: Path) -> None:
        for name in (*self._names, MARKS, *(name.partition("/")[0] for name in self._contents)):
            (folder / name).mkdir()
        for name, text in self._texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        for name, content in self._contents.items():
            (folder / name).write_bytes(content)

    # --- a group that is there ----------------------------------------------------------------

    def _check_metadata(self) -> None:
        """Raise an error if the metadata are not those of this grid."""
        self._check_files("")
        attributes = self._read(".zattrs")
        if attributes.get(AXES_ATTRIBUTE) != self._attributes[AXES_ATTRIBUTE]:
            raise FileError(self.path, "contains a sweep of another grid; choose another folder")
        for name in self._metadata:
            if name.endswith("/.zarray"):
                self._check_files(name.partition("/")[0])
        self._attributes = {**attributes, **self._attributes}
        self._compare(".zgroup", _GROUP, self._read(".zgroup"))
        for name, expected in self._metadata.items():
            found = self._read(name)
            self._compare(name, expected, found)
            if name.endswith(".zattrs"):
                self._metadata[name] = {**found, **expected}
            elif len(found) > len(expected):
                raise self._damaged(f"{name} has the field {min(set(found) - set(expected))!r}")

    def _check_files(self, name: str) -> None:
        """Raise an error for links, devices, and metadata of a later version of Zarr."""
        try:
            entries = list(os.scandir(self._folder / name))
        except OSError as error:
            raise self._damaged(f"{name} cannot be read: {error.strerror}") from None
        for entry in entries:
            folder = not name and entry.is_dir(follow_symlinks=False)
            if entry.name != "zarr.json" and (folder or entry.is_file(follow_symlinks=False)):
                continue
            what = "a link" if entry.is_symlink() else "not a file of a sweep"
            raise self._damaged(f"{name}/{entry.name} is {what}".lstrip("/"))

    def _read(self, name: str) -> dict[str, Any]:
        file = self._folder / name
        try:
            if file.stat().st_size > _ADDED + len(self._texts[name]):
                raise self._damaged(f"{name} is too large")
            found = json.loads(file.read_bytes())
        except OSError as error:
            raise self._damaged(f"{name} cannot be read: {error.strerror}") from None
        except (ValueError, RecursionError):
            raise self._damaged(f"{name} is not valid JSON") from None
        if not isinstance(found, dict):
            raise self._damaged(f"{name} is not a JSON object")
        return found

    def _compare(self, name: str, expected: Mapping[str, Any], found: Mapping[str, Any]) -> None:
        for field, value in expected.items():
            if field not in found or found[field] != value:
                shown = repr(found.get(field, "missing"))[:60]
                raise self._damaged(f"{name}: {field} is {shown}; allowed: {value!r}")

    def _damaged(self, reason: str) -> FileError:
        return FileError(self.path, f"{reason}; {_REMEDY}")

    def _read_marks(self) -> None:
        """Read fingerprints and checksums; damaged files count as absent."""
        for variant in np.ndindex(*self._grid.variants):
            one = self._marks[variant]
            content = _content(self._folder / marks_file(variant), one.nbytes)
            if content is not None and len(content) == one.nbytes:
                self._marks[variant] = np.frombuffer(content, "<u8").reshape(one.shape)


def _checksum(fingerprint: int, files: list[bytes]) -> int:
    """Sixty-four bits of the SHA-256 of a block's fingerprint and files, never 0."""
    state = hashlib.sha256(fingerprint.to_bytes(8, "little"))
    for content in files:
        state.update(len(content).to_bytes(8, "little"))
        state.update(content)
    return int.from_bytes(state.digest()[:8], "little") or 1


def _content(file: Path, largest: int) -> bytes | None:
    """Content of a file of the group; None if absent, unreadable or too large."""
    try:
        return file.read_bytes() if file.stat().st_size <= largest else None
    except OSError:
        return None


def _put(file: Path, content: bytes) -> None:
    """Replace a file of the group atomically, under a lock."""
    part = hidden_file(file, "part")
    with partial_output(part):
        part.write_bytes(content)
        part.replace(file)

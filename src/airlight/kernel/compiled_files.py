"""Compiled code on disk with a checksum: damaged files are recompiled.

Numba's cache has no checksum, treats an unreadable index or a full disk as an error, writes to a
folder before it reads from it, and lets processes compile the same function at once. The checksum
detects damage; ``airlight.files.cache_folders`` ensures that only this user can write.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import pickle
import secrets
import stat
import time
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import IO, Any, Final

from numba.core.caching import IndexDataCacheFile, _CacheLocator

from airlight.files.cache_folders import make_folder

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

#: Longest time to wait for another process that compiles the same function, and polling interval.
#: [s]
_LONGEST_WAIT: Final = 600.0
_POLL: Final = 0.02
#: Files that this process has locked: a second lock would wait for the first.
_held: Final[set[Path]] = set()
#: Length of the checksum at the end of a file. [byte]
_LENGTH: Final = 32


class CompiledFolder(_CacheLocator):
    """Folder of the code compiled from one source file; may be read-only.

    Parameters
    ----------
    folder : Path
        Path that contains the source's fingerprint, which excludes outdated code.
    line : int
        Line of the function, which distinguishes functions of equal name.
    """

    def __init__(self, folder: Path, line: int) -> None:
        self._folder, self._line = folder, line

    def from_function(self, py_func: Any, py_file: str) -> CompiledFolder:
        """The folder itself, as it belongs to one function."""
        return self

    def ensure_cache_path(self) -> None:
        """Make the folder if possible."""
        with contextlib.suppress(OSError):
            make_folder(self._folder)

    def get_cache_path(self) -> str:
        """Path of the folder."""
        return str(self._folder)

    def get_source_stamp(self) -> str:
        """Constant: the fingerprint is part of the path."""
        return ""

    def get_disambiguator(self) -> str:
        """Line of the function."""
        return str(self._line)


def check_files(files: Any, read: Callable[[Path], bytes]) -> None:
    """Make the cache of a function verify checksums, and ignore failed writes.

    Numba numbers code files by its index at that moment: two processes that compile a function for
    different types at once would take the same number. File names are therefore unique; at worst an
    entry of the index is lost and its code is compiled again.

    Parameters
    ----------
    read : callable
        Function that reads a file, or raises ``OSError`` if it is not trusted.
    """
    pattern = files._data_name_pattern
    files._data_name_pattern = pattern.replace("{number:d}", f"{_process()}-{{number:d}}")

    def load_data(name: str) -> Any:
        return pickle.loads(_sound(name, read(Path(files._data_path(name)))))

    def save_data(name: str, data: Any) -> None:
        content: bytes = files._dump(data)
        with files._open_for_write(files._data_path(name)) as stream:
            if hasattr(os, "fchmod"):  # files that others can write are not read
                os.fchmod(stream.fileno(), stat.S_IRUSR | stat.S_IWUSR)
            stream.write(content + _checksum(name, content))

    def load_index() -> dict[Any, str]:
        try:
            version, entries = load_data(files._index_name)
        except Exception:  # pickle raises many kinds for the file of another version
            return {}
        return dict(entries) if version == files._version else {}

    def save_index(entries: dict[Any, str]) -> None:
        save_data(files._index_name, (files._version, entries))

    def save(key: Any, data: Any) -> None:
        entries = load_index()
        others = {name for one, name in entries.items() if one != key}
        names = (files._data_name(k) for k in range(1, len(others) + 2))
        name = entries.get(key) or next(one for one in names if one not in others)
        with contextlib.suppress(OSError):  # a full or closed disk: the code remains in memory
            save_data(name, data)  # before its index entry, from which other processes find it
            save_index({**entries, key: name})

    files._load_data, files._save_data = load_data, save_data
    files._load_index, files._save_index, files.save = load_index, save_index, save


def copy_code(index: Path, folder: Path, wanted: Callable[[Any], bool]) -> int:
    """Copy compiled code of one function, for some types, compressed to another folder.

    Parameters
    ----------
    folder : Path
        Target of index and code; made if needed.
    wanted : callable
        Predicate of a cached entry.

    Returns
    -------
    int
        Number of types whose code was copied. [1]
    """
    base = index.name.removesuffix(".nbi")
    here, there = (IndexDataCacheFile(str(one), base, "") for one in (index.parent, folder))
    for one in (here, there):
        check_files(one, Path.read_bytes)
    import lzma

    chosen = {}
    for key, name in here._load_index().items():
        if wanted(here._load_data(name)):
            folder.mkdir(parents=True, exist_ok=True)
            content = (index.parent / name).read_bytes()
            (folder / name).write_bytes(lzma.compress(content, preset=9))
            chosen[key] = name
    if chosen:
        there._save_index(chosen)
    return len(chosen)


def read_copied(file: Path) -> bytes:
    """Content of a file of ``copy_code``, whose code is compressed and whose index is not."""
    content = file.read_bytes()
    if file.suffix != ".nbc":
        return content
    try:
        import lzma
    except ImportError as missing:  # some builds of Python lack it
        raise OSError("Python lacks lzma") from missing
    try:
        return lzma.decompress(content)
    except lzma.LZMAError as damage:
        raise OSError(f"{file} is damaged") from damage


@contextlib.contextmanager
def one_process(file: Path) -> Iterator[None]:
    """Inter-process lock of a block, for a limited time; re-entrant.

    Parameters
    ----------
    file : Path
        Locked file, left empty. The block runs unlocked after ten minutes, or if locks are
        unsupported.
    """
    if file in _held:
        yield
        return
    try:
        stream = file.open("a")
    except OSError:  # a closed or full disk
        yield
        return
    with stream:
        end = time.monotonic() + _LONGEST_WAIT
        while not _locked(stream) and time.monotonic() < end:
            time.sleep(_POLL)
        _held.add(file)
        try:
            yield
        finally:
            _held.remove(file)


def _locked(stream: IO[str]) -> bool:
    """Whether a file is locked now, or cannot be."""
    if fcntl is not None:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:  # a file system without locks
            pass
    return True


@cache
def _process() -> str:
    return secrets.token_hex(6)


def _checksum(name: str, content: bytes) -> bytes:
    """Checksum of a file and its name, which also rejects another function's file."""
    return hashlib.sha256(name.encode() + b"\0" + content).digest()


def _sound(name: str, whole: bytes) -> bytes:
    """Content of a file without its checksum."""
    content = whole[:-_LENGTH]
    if whole[-_LENGTH:] != _checksum(name, content):
        raise OSError(f"{name} is damaged")
    return content

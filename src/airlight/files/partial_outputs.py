"""Registry of files and folders being written, which a process that ends removes."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Final

_partial: Final[set[Path]] = set()


@contextlib.contextmanager
def partial_output(path: Path) -> Iterator[None]:
    """Register a path while it is written, and remove what remains of it at the end."""
    _partial.add(path)
    try:
        yield
    finally:
        remove(path)
        _partial.discard(path)


def remove_all() -> None:
    """Remove all partial outputs, before the process ends without its ``finally`` blocks."""
    for path in tuple(_partial):
        remove(path)


def remove(path: Path) -> None:
    """Remove a file, a link, or a folder with all that is in it, if it is there."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)

"""Registry of partially written files and folders, removed when the process ends."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Final

_partial: Final[set[Path]] = set()


@contextlib.contextmanager
def partial_output(path: Path) -> Iterator[None]:
    """Context that registers a path while it is written, and removes it at the end."""
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
    """Remove a file, a link, or a folder with its contents, if it exists."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)

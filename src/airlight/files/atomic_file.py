"""Atomic writes: files are written next to their target, then renamed."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from airlight.errors import FileError
from airlight.files.output_lock import hidden_file, output_lock
from airlight.files.partial_outputs import partial_output, remove

#: Time that the writer of a file waits for another one of the same file. [s]
WAIT: Final = 60.0


def check_target(path: str | Path) -> Path:
    """Resolved path of a file to be written; an error if it cannot be.

    To be called before long computations.

    Parameters
    ----------
    path : str or Path
        Path of the file; links are followed.
    """
    try:
        target = Path(path).resolve()
        if target.is_dir():
            raise FileError(path, "is a folder")
        if target.exists() and not target.is_file():
            raise FileError(path, "is not a regular file, so it cannot be replaced")
        if target.exists() and not os.access(target, os.W_OK):
            raise FileError(path, "is write-protected")
        if not target.parent.is_dir():
            raise FileError(path, f"there is no folder {target.parent}")
        if not os.access(target.parent, os.W_OK | os.X_OK):
            raise FileError(path, f"the folder {target.parent} cannot be written to")
    except (
        OSError,
        ValueError,
        RuntimeError,
    ) as error:  # too long, a null character, a cycle of links
        raise FileError(path, str(error)) from error
    return target


@contextlib.contextmanager
def atomic_file(path: str | Path) -> Iterator[Path]:
    """Context with a temporary path, renamed to ``path`` if the block succeeds.

    Concurrent writers wait; remains of killed ones are removed.

    Parameters
    ----------
    path : str or Path
        Path of the file.

    Yields
    ------
    Path
        Path of an empty temporary file in the same folder.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> with atomic_file(folder / "note.txt") as part:
    ...     _ = part.write_text("done")
    >>> [file.name for file in folder.iterdir()]
    ['note.txt']
    """
    target = check_target(path)
    part = hidden_file(target, "part")
    with output_lock(target, wait=WAIT), partial_output(part):
        try:
            for left in (part, part.with_suffix(".band")):
                remove(left)
            part.touch(exist_ok=False)
            yield part
            part.replace(target)
        except OSError as error:
            old = "; the old file is unchanged" if target.exists() else ""
            raise FileError(path, f"cannot be written: {error.strerror or error}{old}") from error

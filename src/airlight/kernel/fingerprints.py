"""Fingerprints of source files and of their imports: keys of the caches on disk.

Numba checks only the file of the outermost function. A fingerprint covers every file of the package
that is imported directly or indirectly, and no other: a change of the renderer does not recompile
the solver.
"""

from __future__ import annotations

import hashlib
import re
from functools import cache
from pathlib import Path
from typing import Final

import numba

_PACKAGE: Final = Path(__file__).parent.parent
_IMPORTS: Final = re.compile(
    rb"^([ \t]*)(?:from[ \t]+(airlight[\w.]*)[ \t]+import[ \t]+(\([^)]*\)|[^\n]*)"
    rb"|import[ \t]+(airlight[\w.]*))",
    re.MULTILINE,
)


@cache
def fingerprint(file: Path, late: bool = True) -> str:
    """Hash of a source file, of all files of the package that it imports, and of the compiler.

    Parameters
    ----------
    file : Path
        Path of a Python source file.
    late : bool
        Whether indented imports count: those of functions and of type checking, which compiled code
        cannot depend on.

    Returns
    -------
    str
        Hash of sixteen hexadecimal digits.
    """
    digest = hashlib.sha256(numba.__version__.encode())
    for one in sorted(_reached(file, late)):
        digest.update(one.name.encode() + _read(one)[0])
    return digest.hexdigest()[:16]


def _reached(file: Path, late: bool) -> set[Path]:
    """The file and all files of the package that it imports, directly or indirectly."""
    found = {file}
    waiting = [file]
    while waiting:
        _, early, every = _read(waiting.pop())
        fresh = (every if late else early) - found
        found |= fresh
        waiting += fresh
    return found


@cache
def _read(file: Path) -> tuple[bytes, frozenset[Path], frozenset[Path]]:
    """Hash of a file, and the files of the package that it imports: all but late ones, and all."""
    text = file.read_bytes()
    early: set[Path] = set()
    late: set[Path] = set()
    for indent, module, names, plain in _IMPORTS.findall(text):
        found = late if indent else early
        found |= _files(module or plain)
        for name in re.findall(rb"\w+", names):
            found |= _files(module + b"." + name)
    return hashlib.sha256(text).digest(), frozenset(early), frozenset(early | late)


@cache
def _files(module: bytes) -> frozenset[Path]:
    """File of a module of the package; none for a name that is not a module."""
    path = _PACKAGE.joinpath(*module.decode().split(".")[1:])
    files = (path.with_suffix(".py"), path / "__init__.py")
    return frozenset(file for file in files if path != _PACKAGE and file.is_file())

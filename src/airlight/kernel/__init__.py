"""The ``@kernel`` decorator: a scalar formula, compiled once for solvers, renderer and NumPy.

Compiled code is cached on disk in a folder named for the ``fingerprint`` of its source file and of
all that this imports.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import warnings
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, Final

import numba
import platformdirs

from airlight.kernel.fingerprints import fingerprint

#: Fast-math flags that keep the meaning of NaN and infinity; inputs are checked at the door.
FAST: Final = frozenset({"contract", "reassoc", "nsz", "arcp", "afn"})

#: How many fingerprints of a source file's compiled code stay on disk.
_KEPT_FINGERPRINTS: Final = 8


def cache_folder() -> Path:
    """The folder for everything that airlight keeps between runs.

    ``AIRLIGHT_CACHE`` names another one.
    """
    named = os.environ.get("AIRLIGHT_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("airlight", appauthor=False))


@cache
def _compiled_folder(source: str) -> Path | None:
    """Folder of the code compiled from a source file, or None if nothing can be written there."""
    try:
        key = fingerprint(Path(source))
        kernels = cache_folder() / "kernels" / Path(source).stem
        folder = kernels / key
        folder.mkdir(parents=True, exist_ok=True)
        folder.touch()
        if not os.access(folder, os.W_OK):
            return None
        others = sorted(kernels.iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)
        for stale in others[_KEPT_FINGERPRINTS:]:
            shutil.rmtree(stale, ignore_errors=True)
    except OSError:
        return None
    return folder


@contextlib.contextmanager
def _numba_cache(folder: Path) -> Iterator[None]:
    """Point Numba at the folder while a function is being declared, and only then."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def _declare(
    make: Callable[..., Any], function: Callable[..., Any], kind: str, **options: Any
) -> Any:
    folder = _compiled_folder(function.__code__.co_filename)
    if folder is None:
        return make(**options)(function)
    # A ufunc and a function of one name would share Numba's cache entry, and a process that finds
    # the one where it wants the other crashes: each kind has a folder of its own.
    with _numba_cache(folder / kind):
        try:
            return make(cache=True, **options)(function)
        except RuntimeError:  # a function typed at a prompt has no file to key the cache by
            return make(**options)(function)


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a scalar formula so that other kernels and compiled loops inline it.

    The function takes and returns scalars (or tuples of them), in restricted Python: floats
    and ints, ``if``/``else``, bounded ``for`` loops, ``math`` and other kernels.
    ``vectorized`` turns it into a NumPy ufunc.

    Examples
    --------
    >>> @kernel
    ... def double(x):
    ...     return 2.0 * x
    >>> double(3.0)
    6.0
    """
    return _declare(
        numba.njit, function, "functions", fastmath=set(FAST), error_model="numpy", nogil=True
    )


def inlined(function: Callable[..., Any]) -> Any:
    """A part of a compiled loop that is always inlined: for what takes arrays in a hot loop."""
    return _declare(
        numba.njit,
        function,
        "functions",
        fastmath=set(FAST),
        error_model="numpy",
        nogil=True,
        forceinline=True,
    )


def compiled_loop(function: Callable[..., Any]) -> Any:
    """Compile a loop over arrays; it runs without the interpreter's lock, for threads."""
    return _declare(
        numba.njit, function, "functions", fastmath=set(FAST), error_model="numpy", nogil=True
    )


def vectorized(scalar: Any) -> Any:
    """The NumPy ufunc of a kernel: the same formula, broadcasting over arrays.

    Parameters
    ----------
    scalar : kernel
        What ``kernel`` returned.

    Returns
    -------
    ufunc
        Compiled at the first call with given types.
    """
    return _ufunc(scalar.py_func)


@cache
def _ufunc(function: Callable[..., Any]) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", numba.NumbaWarning)
        return _declare(numba.vectorize, function, "ufuncs")

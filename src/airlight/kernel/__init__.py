"""The ``@kernel`` decorator: a scalar formula, compiled once for solvers, renderer and NumPy.

Compiled code is cached on disk in a folder named by the ``fingerprint`` of its source file and of
everything that it imports.
"""

from __future__ import annotations

import contextlib
import math
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Final

import numba
import numpy as np

from airlight.files.cache_folders import cache_folder, make_folder, trusted_folder
from airlight.kernel.fingerprints import fingerprint
from airlight.kernel.lowering import CompiledKernel

#: Fast-math flags that keep the meaning of NaN and infinity; inputs are checked at the public
#: functions.
FAST: Final = frozenset({"contract", "reassoc", "nsz", "arcp", "afn"})

_OPTIONS: Final[dict[str, Any]] = {
    "fastmath": set(FAST),
    "error_model": "numpy",
    "nogil": True,
    "no_cfunc_wrapper": True,  # for calls from C, which are not used
}

#: Number of fingerprints per source file whose compiled code is kept on disk.
_KEPT_FINGERPRINTS: Final = 8


@cache
def _compiled_folder(source: str, kind: str) -> tuple[Path, bool] | None:
    """Folder of compiled code of a source file, and whether it is trusted; None without a file."""
    try:
        key = fingerprint(Path(source), late=False)
    except OSError:  # typed at a prompt
        return None
    names = "kernels", Path(source).stem, key, kind
    folder = cache_folder().joinpath(*names)
    if trusted_folder(cache_folder(), *names) is None:
        return folder, False
    with contextlib.suppress(OSError):  # an unwritable folder may be readable
        make_folder(folder)
        folder.parent.touch()
        kernels = folder.parents[1]
        others = sorted(kernels.iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)
        for stale in others[_KEPT_FINGERPRINTS:]:
            shutil.rmtree(stale, ignore_errors=True)
    return folder, trusted_folder(cache_folder(), *names) is not None  # as stored on disk


def _declare(function: Callable[..., Any], kind: str, **options: Any) -> Any:
    if numba.config.DISABLE_JIT:
        return function
    declared = CompiledKernel(function, **_OPTIONS, **options)
    # A formula and its loop have one name and one line, by which Numba identifies a cache
    # entry: each kind has a folder of its own.
    found = _compiled_folder(function.__code__.co_filename, kind)
    if found is not None:
        declared.keep_in(*found)
    return declared


def kernel(function: Callable[..., Any]) -> Any:
    """Compiled scalar formula, inlined by other kernels and compiled loops.

    The function takes and returns scalars (or tuples of them), in restricted Python: floats and
    ints, ``if``/``else``, bounded ``for`` loops, ``math`` and other kernels. An array index counts
    from the start: unless it is a negative literal, one below 0 reads outside the array.
    ``vectorized`` makes a function of arrays.

    Examples
    --------
    >>> @kernel
    ... def double(x):
    ...     return 2.0 * x
    >>> double(3.0)
    6.0
    """
    return _declare(function, "functions")


def inlined(function: Callable[..., Any]) -> Any:
    """Function of arrays that is always inlined in compiled loops."""
    return _declare(function, "functions", forceinline=True)


def in_shaders(function: Any, other: Callable[..., Any]) -> None:
    """Let shaders have another function instead of one whose lanes have no counterpart there.

    Parameters
    ----------
    function : kernel or inlined function
        Function of the CPU.
    other : callable
        Plain function with the same parameters and meaning.
    """
    function.py_func.in_shaders = getattr(other, "py_func", other)


def compiled_loop(function: Callable[..., Any]) -> Any:
    """Compiled loop over arrays, which releases the interpreter's lock."""
    return _declare(function, "functions")


@cache
def vectorized(scalar: Any) -> Callable[..., Any]:
    """Function of arrays from a kernel, with NumPy's broadcasting.

    Numba's ufuncs take 40 ms per process and function; this loop is loaded from the cache in 5 ms.

    Parameters
    ----------
    scalar : kernel
        Function returned by ``kernel``.

    Returns
    -------
    callable
        Function of arrays or numbers, compiled at the first call with given types.

    Examples
    --------
    >>> @kernel
    ... def double(x):
    ...     return 2.0 * x
    >>> vectorized(double)([[1.0], [2.0]])
    array([[2.],
           [4.]])
    """
    loop = _elementwise_loop(scalar)

    def function(*arguments: Any) -> Any:
        arrays = [np.asarray(argument) for argument in arguments]
        shape = np.broadcast_shapes(*(array.shape for array in arrays))
        count = math.prod(shape)
        if count == 0:  # only the type of the result is needed
            return np.empty(shape, loop(1, *(np.ones(1, a.dtype) for a in arrays)).dtype)
        flat = [a if a.size == 1 or a.shape == shape else np.broadcast_to(a, shape) for a in arrays]
        return loop(count, *(a.reshape(-1) for a in flat)).reshape(shape)[()]

    return function


def _elementwise_loop(scalar: Any) -> Any:
    """Function ``loop(count, *arrays)``: the kernel of every element; arrays of length 1 broadcast.

    Generated for the kernel's number of arguments, since Numba has no lists of arrays of several
    types, under its name and line, by which Numba caches.
    """
    function = scalar.py_func
    code = function.__code__
    arrays = [f"a{k}" for k in range(code.co_argcount)]
    # A step that is known to be 1 lets the compiler take several elements at once.
    steps = [f"s{k}" for k in range(len(arrays))] if len(arrays) > 1 else ["1"]
    text = f"""
def {function.__name__}(count, {", ".join(arrays)}):
    {"; ".join(f"s{k} = min({a}.size - 1, 1)" for k, a in enumerate(arrays))}
    out = np.full(count, scalar({", ".join(f"{a}[0]" for a in arrays)}))
    for k in range(1, count):
        out[k] = scalar({", ".join(f"{a}[k * {s}]" for a, s in zip(arrays, steps, strict=True))})
    return out
"""
    scope = {"np": np, "scalar": scalar, "__name__": function.__module__}
    lines = "\n" * (code.co_firstlineno - 2)
    exec(compile(lines + text, code.co_filename, "exec"), scope)
    return _declare(scope[function.__name__], "elementwise")

"""Compiled code that comes with the package, for all processors of one family.

``builders/compiled_code.py`` puts it beside the source before a wheel is built. It is for a set of
features that nearly all processors of a family have, and is found by the source's fingerprint, the
version of Numba and that of Python: where any of these differs, code is compiled as in a checkout,
which has none of it. It is trusted as the source beside it is: who can write the one can write the
other.
"""

from __future__ import annotations

import platform
from functools import cache, partial
from pathlib import Path
from typing import Any, Final, NamedTuple

from llvmlite import binding
from numba.core.caching import FunctionCache

from airlight.kernel.compiled_files import check_files, copy_code

#: Folder of the code: ``<source>/<fingerprint>/<kind>`` as in the cache.
SHIPPED: Final = Path(__file__).parents[1] / "compiled"


class Target(NamedTuple):
    """Processors that code is compiled for.

    Attributes
    ----------
    processor : str
        LLVM's name of the least of them.
    features : tuple of str
        LLVM's names of the features that they need.
    """

    processor: str
    features: tuple[str, ...]

    @property
    def written(self) -> str:
        """Features as LLVM and Numba take them."""
        return ",".join(f"+{one}" for one in self.features)


_V3: Final = ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
#: Targets by the family's name, in small letters.
_TARGETS: Final = {
    "x86_64": Target("x86-64-v3", _V3),
    "amd64": Target("x86-64-v3", _V3),
    "aarch64": Target("generic", ("neon",)),
    "arm64": Target("generic", ("neon",)),
}


@cache
def target() -> Target | None:
    """Target whose code runs on this CPU; None if there is none."""
    found = _TARGETS.get(platform.machine().lower())
    if found is None:
        return None
    has = binding.get_host_cpu_features()
    return found if all(has.get(one, False) for one in found.features) else None


class ShippedCode(FunctionCache):
    """Compiled code of one function that comes with the package.

    Parameters
    ----------
    py_func : function
        The function.
    implementation : type
        Numba's implementation of a cache, which takes a function and a folder.
    folder : Path
        Folder of its code.
    made_for : Target
        Target of the code.
    """

    def __init__(self, py_func: Any, implementation: Any, folder: Path, made_for: Target) -> None:
        self._impl_class = partial(implementation, folder=folder)
        self._target = made_for
        super().__init__(py_func)
        check_files(self._cache_file, Path.read_bytes)

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        signature, (system, *_), *code = super()._index_key(sig, codegen)
        return (signature, (system, self._target.processor, self._target.written), *code)


def shipped_code(py_func: Any, implementation: Any, kept_in: Path) -> ShippedCode | None:
    """Code of a function that comes with the package; None if there is none for this CPU.

    Parameters
    ----------
    py_func, implementation :
        See ``ShippedCode``.
    kept_in : Path
        Folder of what this machine compiles of it, whose last three names are those here too.
    """
    folder = SHIPPED.joinpath(*kept_in.parts[-3:])
    if not folder.is_dir():
        return None
    made_for = target()
    return None if made_for is None else ShippedCode(py_func, implementation, folder, made_for)


def copy_machine_code(cache: Path, to: Path) -> int:
    """Copy what Python can call from a cache of compiled code, without intermediate code.

    Parameters
    ----------
    cache : Path
        Folder of ``<source>/<fingerprint>/<kind>``, with code made for one ``Target``.
    to : Path
        Folder like it, for instance ``SHIPPED``; what is in it stays.

    Returns
    -------
    int
        Number of functions and types whose code was copied. [1]
    """
    count = 0
    for index in sorted(cache.glob("*/*/*/*.nbi")):
        folder = to.joinpath(*index.parent.parts[-3:])
        count += copy_code(index, folder, lambda payload: payload[0][1] == "object")
    return count

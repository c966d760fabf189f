"""Cache of compiled code in the package, for all CPUs of a family.

``builders/compiled_code.py`` places it beside the source before a wheel is built. It uses features
that nearly all CPUs of a family have, and is found by the source's fingerprint and the versions of
Numba and Python; otherwise code is compiled. It is as trustworthy as the source beside it.
"""

from __future__ import annotations

import platform
from functools import cache, partial
from pathlib import Path
from typing import Any, Final, NamedTuple

from llvmlite import binding
from numba.core.caching import FunctionCache

from airlight.kernel.compiled_files import check_files, copy_code, read_copied

#: Folder of the code: ``<source>/<fingerprint>/<kind>`` as in the cache.
PREBUILT: Final = Path(__file__).parents[1] / "compiled"


class CpuTarget(NamedTuple):
    """CPUs that code is compiled for.

    Attributes
    ----------
    cpu : str
        LLVM's name of the oldest CPU.
    features : tuple of str
        LLVM's names of the required features.
    """

    cpu: str
    features: tuple[str, ...]

    @property
    def written(self) -> str:
        """Features in the syntax of LLVM and Numba."""
        return ",".join(f"+{one}" for one in self.features)


_V3: Final = ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
#: Targets by the lower-case name of the family.
_TARGETS: Final = {
    "x86_64": CpuTarget("x86-64-v3", _V3),
    "amd64": CpuTarget("x86-64-v3", _V3),
    "aarch64": CpuTarget("generic", ("neon",)),
    "arm64": CpuTarget("generic", ("neon",)),
}


@cache
def target() -> CpuTarget | None:
    """Target whose code runs on this CPU; None if there is none."""
    found = _TARGETS.get(platform.machine().lower())
    if found is None:
        return None
    has = binding.get_host_cpu_features()
    return found if all(has.get(one, False) for one in found.features) else None


class PrebuiltCache(FunctionCache):
    """Prebuilt code of one function.

    Parameters
    ----------
    implementation : type
        Numba's implementation of a cache, which takes a function and a folder.
    """

    def __init__(
        self, py_func: Any, implementation: Any, folder: Path, cpu_target: CpuTarget
    ) -> None:
        self._impl_class = partial(implementation, folder=folder)
        self._target = cpu_target
        super().__init__(py_func)
        check_files(self._cache_file, read_copied)

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        signature, (system, *_), *code = super()._index_key(sig, codegen)
        return (signature, (system, self._target.cpu, self._target.written), *code)


def prebuilt_cache(py_func: Any, implementation: Any, cache_folder: Path) -> PrebuiltCache | None:
    """Prebuilt code of a function; None if there is none for this CPU.

    Parameters
    ----------
    cache_folder : Path
        Cache folder of the function on this machine; the prebuilt code has the same last three
        folder names.
    """
    folder = PREBUILT.joinpath(*cache_folder.parts[-3:])
    if not folder.is_dir():
        return None
    cpu_target = target()
    return (
        None if cpu_target is None else PrebuiltCache(py_func, implementation, folder, cpu_target)
    )


def copy_machine_code(cache: Path, to: Path) -> int:
    """Copy machine code of a cache, without intermediate code.

    Parameters
    ----------
    cache : Path
        Folder of ``<source>/<fingerprint>/<kind>``, with code made for one ``Target``.
    to : Path
        Target folder, for instance ``PREBUILT``; existing code is preserved.

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

"""Denormals flushed to zero (FTZ, DAZ) while a thread runs blocks of work.

Exponentially attenuated radiance reaches the denormals of single precision, 1e-38 to 1e-45, on
which x86 CPUs take some hundred cycles per operation. The mode belongs to a thread; the caller's is
restored, since other libraries may rely on it.
"""

from __future__ import annotations

import platform
from typing import Any, Final

from llvmlite import ir
from numba import config, types
from numba.core import cgutils
from numba.extending import intrinsic

from airlight.kernel import compiled_loop

#: Bits of the control register MXCSR: FTZ (denormal results) and DAZ (denormal operands).
_AS_ZERO: Final = 0x8000 | 0x0040
_WORD: Final = ir.IntType(32)
#: Whether the CPU has that register.
_HAS_REGISTER: Final = platform.machine().lower() in ("x86_64", "amd64", "i386", "i686")


@intrinsic
def _exchanged(typing_context: Any, bits: Any, kept: Any) -> Any:
    """Set the control register's bits outside the mask ``kept``; returns its old value."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        if not _HAS_REGISTER:
            return context.get_constant(types.int64, 0)
        place = cgutils.alloca_once(builder, _WORD)
        kind = ir.FunctionType(ir.VoidType(), [place.type])
        read, write = (
            cgutils.get_or_insert_function(builder.module, kind, f"llvm.x86.sse.{name}")
            for name in ("stmxcsr", "ldmxcsr")
        )
        builder.call(read, [place])
        before = builder.load(place)
        given, mask = (builder.trunc(argument, _WORD) for argument in arguments)
        builder.store(builder.or_(builder.and_(before, mask), given), place)
        builder.call(write, [place])
        return builder.zext(before, ir.IntType(64))

    return types.int64(types.int64, types.int64), build


@compiled_loop
def _exchange(bits, kept):
    return _exchanged(bits, kept)


def flush_denormals() -> int:
    """Set flush-to-zero mode for this thread; returns the previous mode."""
    return 0 if config.DISABLE_JIT else int(_exchange(_AS_ZERO, -1))


def restore(mode: int) -> None:
    """Restore the mode of this thread that ``flush_denormals`` returned."""
    if not config.DISABLE_JIT:
        _exchange(mode, 0)

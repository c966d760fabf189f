"""Subnormal numbers count as zero while a thread runs blocks of work.

Light that fades by exponentials passes through the last numbers of single precision, from 1e-38 to
1e-45, which have fewer digits the smaller they are. Processors of the x86 family, those of Intel
above all, take some hundred cycles for an operation on one of them, unless told to count it as
zero, as GPUs do. No light that anybody sees is as small. The mode belongs to a thread;
the caller's is given back, since other libraries may rely on it.
"""

from __future__ import annotations

import platform
from typing import Any, Final

from llvmlite import ir
from numba import config, types
from numba.core import cgutils
from numba.extending import intrinsic

from airlight.kernel import compiled_loop

#: Bits of the control register MXCSR: subnormal results become zero, and subnormal operands.
_AS_ZERO: Final = 0x8000 | 0x0040
_WORD: Final = ir.IntType(32)
#: Whether the CPU has that register.
_HAS_REGISTER: Final = platform.machine().lower() in ("x86_64", "amd64", "i386", "i686")


@intrinsic
def _exchanged(typing_context: Any, bits: Any, kept: Any) -> Any:
    """Replace bits of the control register that the mask ``kept`` lacks; its value before.

    0 on a processor without the register.
    """

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


def count_as_zero() -> int:
    """Count subnormal numbers as zero in this thread from now on; returns its mode before."""
    return 0 if config.DISABLE_JIT else int(_exchange(_AS_ZERO, -1))


def restore(mode: int) -> None:
    """Give this thread the mode back that ``count_as_zero`` returned."""
    if not config.DISABLE_JIT:
        _exchange(mode, 0)

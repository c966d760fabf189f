"""Reader of untrusted NPZ files: sizes are checked before unpacking."""

from __future__ import annotations

import io
import struct
import tokenize
import zipfile
import zlib
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.kernel.memory import check_memory

#: Kinds of NumPy types that are read: booleans, integers, floats, texts. No objects.
_KINDS: Final = "biufU"
#: Errors of damaged archives and headers.
_DAMAGE: Final = (
    zipfile.BadZipFile, zlib.error, struct.error, EOFError, OSError, ValueError, KeyError,
    TypeError, RuntimeError, NotImplementedError, SyntaxError, RecursionError, MemoryError,
    OverflowError, tokenize.TokenError,
)  # fmt: skip


def read_arrays(path: Path, content: bytes, largest: int) -> dict[str, NDArray[Any]]:
    """Arrays of an NPZ file.

    Parameters
    ----------
    path : Path
        Path for error messages.
    largest : int
        Largest total size of the arrays. [byte]
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = archive.infolist()
            size = sum(member.file_size for member in members)
            if size > largest:
                words = f"unpacks to {size} bytes; allowed: at most {largest}"
                raise FileError(path, words)
            check_memory(2.0 * size, f"{path}")
            arrays = {one.filename.removesuffix(".npy"): _array(archive, one) for one in members}
    except _DAMAGE as error:
        reason = f"is damaged or not an NPZ file of numbers: {type(error).__name__} {error}"
        raise FileError(path, reason) from error
    for name, array in arrays.items():
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            count = np.count_nonzero(~np.isfinite(array))
            raise FileError(path, f"contains {count} values of {name} that are not finite")
    return arrays


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> NDArray[Any]:
    with archive.open(member) as stream:
        data = stream.read(member.file_size)
    head = io.BytesIO(data)
    version = npy.read_magic(head)
    read = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}
    shape, fortran, kind = read[version](head)
    rest = len(data) - head.tell()
    count = 1
    for side in shape:  # whole numbers of Python: no product overflows
        count *= side
    if kind.kind not in _KINDS or min(shape, default=0) < 0 or count * kind.itemsize != rest:
        raise ValueError(f"{member.filename} of {kind} and shape {shape} in {rest} bytes")
    flat = np.frombuffer(data, kind, count, head.tell())
    return flat.reshape(shape, order="F" if fortran else "C").copy()

"""Tables as text, for a page with embedded data."""

from __future__ import annotations

import base64
import zlib
from typing import Final

import numpy as np
from numpy.typing import NDArray

Float32Array = NDArray[np.float32]

#: Significant bits of radiances and of columns: 1e-4, a tenth of a display's precision.
DIGITS: Final = 12


def as_text(values: Float32Array, stride: int = 1) -> str:
    """Encode numbers as base64 of deflated differences, for ``web/drawing/package.js``.

    Differences of the bit patterns are zigzag-encoded, and their bytes grouped by significance, as
    neighbours in a smooth table differ only in their last bytes.

    Parameters
    ----------
    values : array
        Values; their shape is not encoded.
    stride : int
        Distance from a number to its predecessor in the differences, in numbers.

    Returns
    -------
    str
        Stride, semicolon, base64.

    Examples
    --------
    >>> from_text(as_text(np.array([1.0, 2.5], np.float32)))
    array([1. , 2.5], dtype=float32)
    """
    bits = np.ascontiguousarray(values, "<f4").reshape(-1).view(np.uint32)
    step = bits.copy()
    step[stride:] -= bits[:-stride]
    signed = step.view(np.int32)
    folded = (step << np.uint32(1)) ^ (signed >> np.int32(31)).view(np.uint32)
    places = folded.astype("<u4").view(np.uint8).reshape(-1, 4).T
    return f"{stride};{base64.b64encode(zlib.compress(places.tobytes(), 9)).decode('ascii')}"


def from_text(text: str) -> Float32Array:
    """Decode the text of ``as_text`` to a flat array."""
    stride, _, data = text.partition(";")
    places = np.frombuffer(zlib.decompress(base64.b64decode(data)), np.uint8).reshape(4, -1)
    folded = np.ascontiguousarray(places.T).view("<u4").reshape(-1)
    step = (folded >> np.uint32(1)) ^ (np.uint32(0) - (folded & np.uint32(1)))
    bits = np.empty(step.shape, np.uint32)
    for first in range(min(int(stride), step.size)):
        bits[first :: int(stride)] = np.cumsum(step[first :: int(stride)], dtype=np.uint32)
    return bits.view(np.float32)


def rounded(values: Float32Array, digits: int) -> Float32Array:
    """Round the mantissas of numbers, for a shorter text.

    Parameters
    ----------
    values : array
        Finite numbers.
    digits : int
        Mantissa bits, 1 to 22; the relative error is at most 2^(-digits - 1).
    """
    last = np.uint32(1) << np.uint32(23 - digits)
    bits = np.ascontiguousarray(values, np.float32).view(np.uint32)
    near = (bits + (last >> np.uint32(1))) & ~(last - np.uint32(1))
    return near.view(np.float32)


def deflated(text: str) -> str:
    """Encode a text as base64 of its deflated bytes."""
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode("ascii")

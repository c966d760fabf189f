"""Tables as text: for a page that carries its numbers in itself."""

from __future__ import annotations

import base64
import zlib

import numpy as np
from numpy.typing import NDArray

Float32Array = NDArray[np.float32]


def as_text(values: Float32Array, digits: int = 23) -> str:
    """Numbers as base64 of their deflated bytes, as ``web/package.js`` reads them.

    The bytes are sorted by their place within a number: the first bytes of all numbers, sign and
    most of the exponent, differ little from one number to the next and deflate well.

    Parameters
    ----------
    values : array
        Of any shape; only the order of the numbers is kept.
    digits : int
        Binary digits that are kept of each number behind its first, 1 to 23: all of them, or fewer
        where a shorter text is worth a relative error of 2 to the power of -digits - 1.

    Examples
    --------
    >>> from_text(as_text(np.array([1.0, 2.5], np.float32)))
    array([1. , 2.5], dtype=float32)
    """
    flat = _rounded(np.ascontiguousarray(values, "<f4").reshape(-1), digits)
    places = flat.view(np.uint8).reshape(-1, 4).T
    return base64.b64encode(zlib.compress(places.tobytes(), 9)).decode("ascii")


def _rounded(values: Float32Array, digits: int) -> Float32Array:
    if digits >= 23:
        return values
    last = np.uint32(1) << np.uint32(23 - digits)
    bits = values.view(np.uint32)
    # Half of the last digit is added, and what is behind it taken away; no number is so large
    # that it would become infinite by that.
    near = (bits + (last >> np.uint32(1))) & ~(last - np.uint32(1))
    return near.view(np.float32)


def deflated(text: str) -> str:
    """A text as base64 of its deflated bytes."""
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode("ascii")


def from_text(text: str) -> Float32Array:
    """The numbers that ``as_text`` was given, flat."""
    places = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8).reshape(4, -1)
    return np.ascontiguousarray(places.T).view("<f4").reshape(-1).astype(np.float32)

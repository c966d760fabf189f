"""Checksum of a frame, stored in its file and computed without the stored value."""

from __future__ import annotations

import hashlib
import re
import zlib
from typing import Final

from airlight.image.header import PREFIX

#: Name of the checksum in the header of a file.
CHECKSUM: Final = "frame_checksum"
#: Placeholder until the other bytes are known.
BLANK: Final = "0" * 64
_SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"
#: Name and text, between which PNG and OpenEXR have zeros, a type, a length.
_TEXT: Final = re.compile(
    re.escape((PREFIX + CHECKSUM).encode()) + rb".{1,16}?([0-9a-f]{64})", re.S
)


def with_checksum(content: bytes) -> bytes:
    """File with ``BLANK`` in its header replaced by the checksum.

    Parameters
    ----------
    content : bytes
        File in PNG or OpenEXR.

    Returns
    -------
    bytes
        File of the same length.

    References
    ----------
    SHA-256: FIPS 180-4. CRC of a chunk: PNG specification, third edition (W3C 2025), section 5.5.
    """
    match = _TEXT.search(content)
    if match is None:
        raise ValueError("the file has no place for a checksum")
    first, last = match.span(1)
    text = _checksum(content, first, last)
    sealed = content[:first] + text + content[last:]
    if not content.startswith(_SIGNATURE):
        return sealed
    crc = zlib.crc32(sealed[match.start() - 4 : last])  # type and data of the chunk
    return sealed[:last] + crc.to_bytes(4, "big") + sealed[last + 4 :]


def has_checksum(content: bytes) -> bool:
    """Whether a file has a checksum, valid or not."""
    return _TEXT.search(content) is not None


def is_whole(content: bytes) -> bool:
    """Whether the checksum of a file is valid."""
    match = _TEXT.search(content)
    return match is not None and match[1] == _checksum(content, *match.span(1))


def _checksum(content: bytes, first: int, last: int) -> bytes:
    """SHA-256 without the stored value and, in PNG, without its CRC."""
    state = hashlib.sha256(content[:first])
    state.update(content[last + (4 if content.startswith(_SIGNATURE) else 0) :])
    return state.hexdigest().encode()

"""Band-by-band reader and writer of large OpenEXR pictures: single part, scan lines.

OpenEXR's Python module needs the whole picture in memory. Blocks of scan lines are compressed
independently, so bands are written by OpenEXR as separate pictures, and their blocks are renumbered
and joined.

References
----------
OpenEXR file layout, https://openexr.com/en/latest/OpenEXRFileLayout.html
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
from numpy.typing import NDArray

from airlight.files.partial_outputs import partial_output
from airlight.kernel.large_arrays import release

#: Lines of a band: a multiple of the number of lines per block of every compression.
_LINES: Final = 256
#: Attributes with the last line of the picture, boxes of two points of two int32.
_BOXES: Final = (b"dataWindow", b"displayWindow")


def write_bands(
    path: Path, attributes: Mapping[str, Any], channels: Mapping[str, NDArray[Any]], kind: Any
) -> None:
    """Write channels as ``OpenEXR.File`` would, with the memory of a band.

    Parameters
    ----------
    path : Path
        Path of the file, which is replaced.
    attributes : mapping
        Attributes as for ``OpenEXR.File``.
    channels : mapping of str to array, shape (height, width) or (height, width, 3)
        Channels as for ``OpenEXR.File``, of any type.
    kind : type
        Type in the file, float16 or float32.
    """
    height = len(next(iter(channels.values())))
    places: list[int] = []
    with path.open("wb") as out:
        table = 0
        for first, band in _bands(path, attributes, channels, kind, height):
            header, blocks = _parsed(band)
            if first == 0:
                count = -(-height // -(-min(_LINES, height) // len(blocks)))
                out.write(_with_height(header, height))
                table = out.tell()
                out.write(bytes(8 * count))
            for line, data in blocks:
                places.append(out.tell())
                out.write(struct.pack("<ii", first + line, len(data)))
                out.write(data)
        out.seek(table)
        out.write(struct.pack(f"<{len(places)}Q", *places))


def _bands(
    path: Path,
    attributes: Mapping[str, Any],
    channels: Mapping[str, NDArray[Any]],
    kind: Any,
    height: int,
) -> Iterator[tuple[int, bytes]]:
    """First line and temporary file of each band."""
    import OpenEXR

    part = path.with_suffix(".band")
    with partial_output(part):
        for first in range(0, height, _LINES):
            lines = {name: one[first : first + _LINES] for name, one in channels.items()}
            with np.errstate(over="ignore"):
                pixels = {
                    name: np.ascontiguousarray(one.astype(kind, copy=False))
                    for name, one in lines.items()
                }
            OpenEXR.File(dict(attributes), pixels).write(str(part))
            for one in lines.values():
                release(one)
            yield first, part.read_bytes()


def _parsed(band: bytes) -> tuple[bytes, list[tuple[int, memoryview]]]:
    """Header of a scan-line file, and line number and data of each block."""
    stream = BytesIO(band)
    stream.seek(8)
    while _word(stream):
        _word(stream)
        stream.seek(struct.unpack("<i", stream.read(4))[0], 1)
    end = stream.tell()
    (first,) = struct.unpack_from("<Q", band, end)
    places = struct.unpack_from(f"<{(first - end) // 8}Q", band, end)
    view, blocks = memoryview(band), []
    for place in places:
        line, size = struct.unpack_from("<ii", band, place)
        blocks.append((line, view[place + 8 : place + 8 + size]))
    return band[:end], blocks


def _with_height(header: bytes, height: int) -> bytes:
    """Header with another height."""
    changed = bytearray(header)
    for name in _BOXES:
        box = header.index(name + b"\0box2i\0") + len(name) + len(b"\0box2i\0") + 4
        struct.pack_into("<i", changed, box + 12, height - 1)
    return bytes(changed)


def _word(stream: BinaryIO) -> bytes:
    """Null-terminated text."""
    word = bytearray()
    while (letter := stream.read(1)) not in (b"\0", b""):
        word += letter
    return bytes(word)

"""PNG files: eight or sixteen bits per channel, with metadata in text chunks."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.files.atomic_file import atomic_file
from airlight.files.input_files import LARGEST_PICTURE, check_input
from airlight.image.header import header
from airlight.kernel.large_arrays import LARGE, bands

#: Chunks in front of the pixels, as type and data.
Chunks = list[tuple[bytes, bytes]]

#: cICP of Display P3: its primaries, the curve of sRGB, no matrix, full range. [ITU-T H.273, 8.1 to
#: 8.3; PNG specification, third edition (W3C 2025), section 11.3.2.6]
_DISPLAY_P3: Final = bytes([12, 13, 0, 1])

#: Effort of the compression, 0 to 9.
_LEVEL: Final = 5

#: The last chunk, IEND. [PNG specification, section 11.2.5]
_END: Final = b"\0\0\0\0IEND\xaeB\x60\x82"


def colour_chunks(encoding: str, primaries: str = "srgb") -> Chunks:
    """Colour-space chunks of a picture, most specific first.

    Parameters
    ----------
    encoding : str
        Encoding of the pixels, ``srgb`` or ``gamma`` (1/2.2).
    primaries : str
        Name from ``PRIMARIES``.

    Returns
    -------
    list of (bytes, bytes)
        Type and data: sRGB with perceptual intent for that space; otherwise cICP, if defined, and
        gAMA and cHRM for older readers.

    References
    ----------
    PNG specification, third edition (W3C 2025), sections 11.3.2.1, 2, 5 and 6.
    """
    from airlight.image.gamut import PRIMARIES, WHITE

    if encoding not in ("srgb", "gamma"):
        raise ParameterError("encoding", encoding, "srgb, gamma")
    if primaries not in PRIMARIES:
        raise ParameterError("primaries", primaries, ", ".join(PRIMARIES))
    if (encoding, primaries) == ("srgb", "srgb"):
        return [(b"sRGB", b"\x00")]
    # gAMA only holds powers: sRGB's curve is nearest to 1/2.2.
    chunks: Chunks = [(b"gAMA", _numbers(1.0 / 2.2))]
    if primaries != "srgb":
        places = (WHITE, *PRIMARIES[primaries])
        chunks.append((b"cHRM", _numbers(*(value for place in places for value in place))))
        if encoding == "srgb":
            chunks.insert(0, (b"cICP", _DISPLAY_P3))
    return chunks


def _numbers(*values: float) -> bytes:
    return b"".join(round(1e5 * value).to_bytes(4, "big") for value in values)


def write_png(
    path: str | Path,
    pixels: NDArray[Any],
    metadata: Mapping[str, str] | None = None,
    *,
    encoding: str = "srgb",
    primaries: str = "srgb",
) -> None:
    """Write a picture that is ready for display.

    Parameters
    ----------
    pixels : array, shape (h, w, 3), uint8 or uint16
        Encoded red, green, blue, 0 to 255 or 0 to 65535.
    metadata : mapping of str to str, optional
        Text chunks to add, each name prefixed with ``airlight.``.
    encoding : str
        Encoding of the pixels, ``srgb`` or ``gamma`` (1/2.2), recorded in the file.
    primaries : str
        Primaries of the pixels, ``srgb`` or ``display-p3``, recorded in the file.

    Raises
    ------
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    if pixels.dtype not in (np.uint8, np.uint16) or pixels.ndim != 3 or pixels.shape[2] != 3:
        shown = f"{pixels.dtype} {pixels.shape}"
        raise ParameterError("pixels", shown, "uint8 or uint16, shape (height, width, 3)")
    chunks = colour_chunks(encoding, primaries)
    texts = header(metadata or {})
    pixels = np.ascontiguousarray(pixels)
    with atomic_file(path) as part, part.open("wb") as stream:
        if pixels.dtype == np.uint16 or pixels.nbytes >= LARGE:
            _write_bands(stream, pixels, chunks, texts)
        else:
            _write_eight_bits(stream, pixels, chunks, texts)


def _write_eight_bits(
    stream: Any, pixels: NDArray[np.uint8], chunks: Chunks, texts: Mapping[str, str]
) -> None:
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    info = PngInfo()
    for kind, data in chunks:
        info.add(kind, data)
    for name, text in texts.items():
        info.add_text(name, text)
    image: Any = Image.fromarray(pixels)
    image.save(stream, format="png", pnginfo=info, compress_level=_LEVEL)


def _write_bands(
    stream: BinaryIO, pixels: NDArray[Any], chunks: Chunks, texts: Mapping[str, str]
) -> None:
    """Write band by band: large pictures, and 16 bits per channel, which Pillow does not write.

    References
    ----------
    PNG specification, third edition (W3C 2025), sections 10.1 and 11.2.1.
    """
    import png

    height, width = pixels.shape[:2]
    bits, lines = (16, _plain_lines) if pixels.dtype == np.uint16 else (8, _filtered_lines)
    stream.write(png.signature)
    png.write_chunk(stream, b"IHDR", struct.pack(">IIBBBBB", width, height, bits, 2, 0, 0, 0))
    for kind, data in chunks:
        png.write_chunk(stream, kind, data)
    for name, text in texts.items():
        png.write_chunk(stream, b"iTXt", _worded(name, text))
    packed = zlib.compressobj(_LEVEL)
    for band in lines(pixels):
        if data := packed.compress(band):
            png.write_chunk(stream, b"IDAT", data)
    png.write_chunk(stream, b"IDAT", packed.flush())
    stream.write(_END)


def _plain_lines(pixels: NDArray[np.uint16]) -> Iterator[bytes]:
    """Lines of bands, each with the filter type 0 (none)."""
    for band in bands(pixels):
        numbers = band.astype(">u2").reshape(len(band), -1).view(np.uint8)
        yield np.pad(numbers, ((0, 0), (1, 0))).tobytes()


def _filtered_lines(pixels: NDArray[np.uint8]) -> Iterator[bytes]:
    """Lines of bands, filtered by Pillow, each with its filter type.

    Each band is filtered together with the last line of the previous one, to which filters refer.
    """
    import png
    from PIL import Image

    first = 0
    for band in bands(pixels):
        above = min(first, 1)
        plain = io.BytesIO()
        image = Image.fromarray(pixels[first - above : first + len(band)])
        image.save(plain, format="png", compress_level=0)
        read = png.Reader(bytes=plain.getvalue()).chunks()
        lines = zlib.decompress(b"".join(data for kind, data in read if kind == b"IDAT"))
        yield lines[above * (1 + band[:1].nbytes) :]
        first += len(band)


def _worded(name: str, text: str) -> bytes:
    """Data of an iTXt chunk: keyword, uncompressed, no language, text in UTF-8."""
    return name.encode("latin-1") + b"\0\0\0\0\0" + text.encode()


def read_png_metadata(path: str | Path) -> dict[str, str]:
    """Read the text chunks of a PNG."""
    from PIL import Image

    check_input(path, LARGEST_PICTURE)
    with Image.open(path) as image:
        image.load()  # text may stand after the pixels
        return {str(k): str(v) for k, v in image.info.items() if isinstance(v, str)}


def read_png_header(path: str | Path) -> dict[str, str]:
    """Text chunks before the pixels of a complete PNG."""
    from PIL import Image

    with Path(path).open("rb") as stream:
        stream.seek(-len(_END), io.SEEK_END)
        if stream.read() != _END:
            raise OSError("truncated")
        stream.seek(0)
        with Image.open(stream, formats=("PNG",)) as image:
            return {str(k): str(v) for k, v in image.info.items() if isinstance(v, str)}

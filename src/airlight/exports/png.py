"""PNG: eight bits per channel, for viewing, with the scene in its text chunks."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.exports.header import header
from airlight.exports.whole_file import whole_file

#: sRGB chunk with the perceptual intent; gAMA chunk with 1/2.2 in units of 1e-5.
#: [PNG specification, third edition (W3C 2025), sections 11.3.2.5 and 11.3.2.2]
_ENCODING_CHUNKS = {
    "srgb": (b"sRGB", b"\x00"),
    "gamma": (b"gAMA", round(1e5 / 2.2).to_bytes(4, "big")),
}


def write_png(
    path: str | Path,
    pixels: NDArray[np.uint8],
    metadata: Mapping[str, str] | None = None,
    *,
    encoding: str = "srgb",
) -> None:
    """Write a picture that is ready for display.

    Parameters
    ----------
    path : str or Path
        Path of the file.
    pixels : array, shape (h, w, 3)
        Encoded red, green, blue, 0 to 255.
    metadata : mapping of str to str, optional
        Text chunks to add, each name prefixed with ``airlight.``.
    encoding : str
        How the pixels are encoded, ``srgb`` or ``gamma`` (1/2.2), recorded in the file.

    Raises
    ------
    ParameterError
        If the shape or type is not that.
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3:
        shown = f"{pixels.dtype} {pixels.shape}"
        raise ParameterError("pixels", shown, "uint8, shape (height, width, 3)")
    if encoding not in _ENCODING_CHUNKS:
        raise ParameterError("encoding", encoding, ", ".join(_ENCODING_CHUNKS))
    info = PngInfo()
    info.add(*_ENCODING_CHUNKS[encoding])
    for name, text in header(metadata or {}).items():
        info.add_text(name, text)
    image: Any = Image.fromarray(np.ascontiguousarray(pixels))
    with whole_file(path) as part, part.open("wb") as stream:
        image.save(stream, format="png", pnginfo=info, compress_level=5)


def read_png_metadata(path: str | Path) -> dict[str, str]:
    """Read the text chunks of a PNG.

    Parameters
    ----------
    path : str or Path
        Path of the file.

    Returns
    -------
    dict of str to str
        Texts by name, with the prefix ``airlight.``.
    """
    from PIL import Image

    with Image.open(path) as image:
        image.load()  # text may stand after the pixels
        return {str(k): str(v) for k, v in image.info.items() if isinstance(v, str)}

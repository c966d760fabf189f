"""Radiance pictures, ``.hdr``: three mantissas of eight bits and a common exponent per pixel.

Rows are written without run-length encoding, which all readers accept: the largest mantissa of a
normalised pixel, at least 128, excludes confusion with a run.

References
----------
Ward (1991), Real pixels, Graphics Gems II, 80. Radiance, "File Formats": Picture.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError, ParameterError
from airlight.files.atomic_file import atomic_file
from airlight.files.input_files import LARGEST_PICTURE, check_input
from airlight.image.header import PREFIX, header

#: Chromaticities of sRGB in the order of the format: red, green, blue and white. [IEC 61966-2-1]
_PRIMARIES: Final = "0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290"
_MAGIC: Final = b"#?RADIANCE\n"
#: Bias of the exponent, and bits of a mantissa.
_BIAS: Final = 128
_BITS: Final = 8
#: Largest header that is read. [byte]
_LONGEST: Final = 1 << 16


def write_hdr(
    path: str | Path,
    rgb: NDArray[np.float32],
    metadata: Mapping[str, str] | None = None,
    *,
    scale: float = 1.0,
) -> None:
    """Write linear radiance.

    Parameters
    ----------
    rgb : array, shape (h, w, 3)
        Linear sRGB radiance times the scale, weighted by the colour-matching functions. Negative
        channels, outside the gamut, are written as 0; the error of others is 0.4 % of the pixel's
        largest. [W m⁻² sr⁻¹]
    metadata : mapping of str to str, optional
        Texts to add, each name prefixed with ``airlight.``.
    scale : float
        Factor of the values, recorded as ``EXPOSURE``, by which readers divide. [1]

    Raises
    ------
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    pixels = rgbe(rgb)
    height, width, _ = rgb.shape
    texts = {"FORMAT": "32-bit_rle_rgbe", "PRIMARIES": _PRIMARIES, "EXPOSURE": f"{scale:.9g}"}
    texts |= header(metadata or {})
    lines = "".join(f"{name}={text}\n" for name, text in texts.items())
    with atomic_file(path) as part, part.open("wb") as stream:
        stream.write(_MAGIC + lines.encode("utf-8", "replace"))
        stream.write(f"\n-Y {height} +X {width}\n".encode("ascii"))
        stream.write(pixels.tobytes())


def rgbe(rgb: NDArray[Any]) -> NDArray[np.uint8]:
    """Mantissas and exponent of each pixel, shape (h, w, 4).

    Parameters
    ----------
    rgb : array, shape (h, w, 3)
        Values; negative ones become 0.

    Raises
    ------
    ParameterError
        If a value is not finite, or at least 2¹²⁷.

    Examples
    --------
    >>> rgbe(np.array([[[1.0, 0.5, 0.25]]])).tolist()
    [[[128, 64, 32, 129]]]
    """
    values = np.maximum(np.asarray(rgb, np.float64), 0.0)
    largest = values.max(axis=-1)
    if not (largest < 2.0 ** (_BIAS - 1)).all():
        raise ParameterError("rgb", float(largest.max()), "finite radiance below 1.7e38")
    exponent = np.frexp(largest)[1]
    exponent += np.rint(np.ldexp(largest, _BITS - exponent)) == 1 << _BITS  # 255.5 is rounded up
    mantissas = np.rint(np.ldexp(values, (_BITS - exponent)[..., None]))
    there = (largest > 0.0) & (exponent > -_BIAS)
    pixels = np.zeros((*largest.shape, 4), np.uint8)
    pixels[..., :3] = np.where(there[..., None], mantissas, 0.0)
    pixels[..., 3] = np.where(there, exponent + _BIAS, 0)
    return pixels


def read_hdr_header(path: str | Path) -> dict[str, str]:
    """Texts in the header of a file written by ``write_hdr``."""
    check_input(path, LARGEST_PICTURE)
    with Path(path).open("rb") as stream:
        start = stream.read(_LONGEST)
    head, _, rest = start.partition(b"\n\n")
    size = rest.partition(b"\n")[0].split()
    if not head.startswith(_MAGIC.rstrip()) or len(size) != 4 or size[0] != b"-Y":
        raise FileError(path, "is not a Radiance picture")
    before = len(head) + 2 + len(rest.partition(b"\n")[0]) + 1
    if Path(path).stat().st_size < before + 4 * int(size[1]) * int(size[3]):
        raise FileError(path, "ends before its last pixel")
    lines = [line.partition("=") for line in head.decode("utf-8", "replace").splitlines()]
    return {name: text for name, _, text in lines if name.startswith(PREFIX)}

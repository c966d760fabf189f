"""Picture file of a map, checked by its header before decoding."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.files.input_files import LARGEST_MAP, check_input
from airlight.kernel.memory import DECODED, MOST_PIXELS, check_picture

if TYPE_CHECKING:
    from PIL.Image import Image

#: Pillow's modes with at least sixteen bits per channel.
_DEEP: Final = ("I", "I;16", "I;16B", "I;16L", "I;16N", "F")
#: Memory of a pixel of these: Pillow's own, and three float64 during the conversion to eight bits.
#: [byte]
_DEEP_PIXEL: Final = 32
#: Folder of the packaged maps.
MAPS: Final = Path(__file__).parents[1] / "scene" / "data"


def packaged_map(name: str, suffix: str) -> Path:
    """Path of a map, packaged (``NAME`` and a suffix) or a file, which may not exist.

    Examples
    --------
    >>> packaged_map("earth", "-lights.jpg").name, packaged_map("./earth", "-lights.jpg").name
    ('earth-lights.jpg', 'earth')
    """
    packaged = MAPS / f"{name}{suffix}"
    return packaged if "/" not in name and packaged.is_file() else Path(name)


def map_pixels(file: Path, *, grey: bool = False) -> NDArray[np.uint8]:
    """Read the pixels of an equirectangular picture.

    Grey, palette and CMYK pictures are converted to RGB, 16-bit channels to 8 bits; transparency is
    ignored.

    Parameters
    ----------
    file : Path
        Picture file of any format that Pillow reads.
    grey : bool
        Whether to return a single channel; that of a grey picture is not converted.

    Returns
    -------
    array of uint8, shape (h, w, 3), or (h, w) if ``grey``
        Pixels.

    Raises
    ------
    FileError
        If it is not a picture, is larger than 4 GB or 200 million pixels, is not twice as wide as
        high, or has floats outside 0 to 1.
    """
    from PIL import Image, UnidentifiedImageError

    if not file.exists():
        raise FileNotFoundError(file)
    check_input(file, LARGEST_MAP)
    try:
        # Pillow warns of large pictures, and refuses larger ones, when it opens them; the check
        # here is stricter.
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            picture = Image.open(file)
        with picture:
            _check_size(file, *picture.size, _DEEP_PIXEL if picture.mode in _DEEP else DECODED)
            return _as_bytes(file, picture, "L" if grey else "RGB")
    except FileNotFoundError:
        raise
    except Image.DecompressionBombError as error:
        raise FileError(file, f"has too many pixels; allowed: {MOST_PIXELS}") from error
    except (OSError, ValueError, SyntaxError, UnidentifiedImageError) as error:
        raise FileError(file, f"cannot be read as a picture: {_one_line(error)}") from error


def _check_size(file: Path, width: int, height: int, each: int) -> None:
    check_picture(file, width, height, each)
    if abs(width - 2 * height) > 1:
        raise FileError(
            file,
            f"has {width} x {height} pixels; allowed: twice as wide as high, equirectangular",
        )


def _as_bytes(file: Path, picture: Image, mode: str) -> NDArray[np.uint8]:
    if picture.mode in _DEEP:
        values = np.asarray(picture, dtype=np.float64)
        # Files of sixteen bits are recognised by values above 255; floats are 0 to 1.
        largest = 1.0 if picture.mode == "F" else 65535.0
        _check_values(file, values, largest)
        grey = np.asarray(np.rint(values * (255.0 / largest)), dtype=np.uint8)
        return grey if mode == "L" else np.repeat(grey[..., None], 3, axis=2)
    if picture.mode == mode:
        return np.asarray(picture)
    if picture.mode in ("P", "PA"):
        picture = picture.convert("RGBA")  # directly to RGB, Pillow warns of transparent palettes
    return np.asarray(picture.convert(mode))


def _check_values(file: Path, values: NDArray[np.float64], largest: float) -> None:
    """Raise an error for markers of missing data, such as NaN or -9999."""
    # floats that round to 0 or to 255 are overshoots of an enlargement
    half = 0.4999 / 255.0 if largest == 1.0 else 0.0
    wrong = ~((values >= -half) & (values <= largest + half))
    if wrong.any():
        row, column = np.argwhere(wrong)[0]
        raise FileError(
            file,
            f"has {np.count_nonzero(wrong)} pixels out of range, the first {values[row, column]:g} "
            f"at column {column}, row {row}; allowed: 0 to {largest:g}; fill missing data first",
        )


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())

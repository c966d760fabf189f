"""Pictures as files in the format of their suffix."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from airlight.errors import FileError
from airlight.exports.exr import write_exr
from airlight.exports.png import write_png
from airlight.exports.whole_file import check_target

#: Suffixes of the formats that can be written.
SUFFIXES = (".png", ".exr")


@dataclass(frozen=True, kw_only=True)
class Written:
    """Written picture.

    Parameters
    ----------
    path : Path
        Path of the file.
    size : int
        Size of the file. [byte]
    exposure : float or None
        Exposure used, or None for a linear file. [EV]
    """

    path: Path
    size: int
    exposure: float | None


def picture_suffix(path: str | Path) -> str:
    """Return the suffix of a picture to be written, after checking that it can be written.

    Parameters
    ----------
    path : str or Path
        Path of the future file.

    Returns
    -------
    str
        Suffix, one of ``SUFFIXES``.

    Raises
    ------
    FileError
        If the suffix is unknown, or nothing can be written there.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise FileError(path, f"the name of a picture ends in {' or '.join(SUFFIXES)}")
    check_target(path)
    return suffix


def write_picture(
    path: str | Path,
    rgb: NDArray[np.float32],
    metadata: Mapping[str, str] | None = None,
    *,
    exposure: float | str = -2.5,
    tone_map: str = "hable",
    encoding: str = "srgb",
) -> Written:
    """Write a frame's colours as PNG (exposed, tone mapped, encoded) or EXR (linear, untouched).

    Parameters
    ----------
    path : str or Path
        Path ending in ``.png`` or ``.exr``.
    rgb : array, shape (h, w, 3)
        Linear sRGB radiance, weighted by the colour-matching functions, float32. [W m⁻² sr⁻¹]
    metadata : mapping of str to str, optional
        Facts of how the frame was made, recorded in the file.
    exposure : float or "auto"
        The colours are multiplied by 2 to this power; ``auto`` takes it from the mean of the
        logarithm of the luminance. Only for PNG. [EV]
    tone_map, encoding : str
        Names of ``airlight.color``. Only for PNG.

    Returns
    -------
    Written
        Path, size, and the exposure used.

    Raises
    ------
    ParameterError
        For an unknown tone map or encoding, or an exposure that is not a number.
    FileError
        If the file cannot be written; an existing file is then unchanged.
    """
    suffix = picture_suffix(path)
    used: float | None = None
    if suffix == ".exr":
        write_exr(path, rgb, metadata)
    else:
        from airlight.color.display import resolve_exposure, to_display

        used = resolve_exposure(rgb, exposure, tone_map)
        pixels = to_display(rgb, exposure=used, tone_map=tone_map, encoding=encoding)
        display = {"exposure": f"{used:.10g} EV", "tone_map": tone_map, "encoding": encoding}
        write_png(path, pixels, {**(metadata or {}), **display}, encoding=encoding)
    return Written(path=Path(path), size=Path(path).stat().st_size, exposure=used)

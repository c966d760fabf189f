"""A frame's colours to a file: the suffix says which kind."""

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

#: What can be written, by the file's suffix.
SUFFIXES = (".png", ".exr")


@dataclass(frozen=True, kw_only=True)
class Written:
    """Written picture.

    Parameters
    ----------
    path : Path
        Of the file.
    size : int
        Of the file. [byte]
    exposure : float or None
        That was used, or None for a linear file. [EV]
    """

    path: Path
    size: int
    exposure: float | None


def picture_suffix(path: str | Path) -> str:
    """The suffix of a picture to be written, after a look whether it can be.

    Parameters
    ----------
    path : str or Path
        Of the file to come.

    Returns
    -------
    str
        One of ``SUFFIXES``.

    Raises
    ------
    FileError
        If the suffix is another one, or nothing can be written there.
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
        Ends in ``.png`` or ``.exr``.
    rgb : array, shape (h, w, 3)
        Linear sRGB radiance, weighted by the colour-matching functions, float32. [W m⁻² sr⁻¹]
    metadata : mapping of str to str, optional
        How the frame was made; stands in the file.
    exposure : float or "auto"
        The colours are multiplied by 2 to this power; ``auto`` takes it from the mean of the
        logarithm of the luminance. Only for PNG. [EV]
    tone_map, encoding : str
        As ``airlight.color`` names them. Only for PNG.

    Returns
    -------
    Written
        Where, how large, and the exposure used.

    Raises
    ------
    ParameterError
        For an unknown tone map or encoding, or an exposure that is no number.
    FileError
        If the file cannot be written; then there is none, or the old one.
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

"""Linear light to the 8-bit values of a picture: exposure, tone map, encoding."""

from __future__ import annotations

from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.color.encoding import encoding_named
from airlight.color.exposure import DEFAULT_EXPOSURE, automatic_exposure, exposure_factor
from airlight.color.tone_maps import tone_map_named
from airlight.errors import ParameterError
from airlight.kernel.threads import run_blocks

#: Pixels per block; the workspace of a block takes about 12 MB.
_BLOCK: Final = 65_536


def resolve_exposure(
    rgb: NDArray[np.floating], exposure: float | str, tone_map: str = "hable"
) -> float:
    """Exposure in EV: the number itself, or measured on the picture if ``"auto"``.

    Raises
    ------
    ParameterError
        If it is neither, or outside -100 to 100 EV.
    """
    if isinstance(exposure, str):
        if exposure != "auto":
            raise ParameterError("exposure", exposure, '-100 to 100 EV, or "auto"')
        return automatic_exposure(rgb, tone_map)
    exposure_factor(exposure)
    return float(exposure)


def to_display(
    rgb: NDArray[np.floating],
    exposure: float | Literal["auto"] = DEFAULT_EXPOSURE,
    tone_map: str = "hable",
    encoding: str = "srgb",
) -> NDArray[np.uint8]:
    """Convert a frame of linear light to an 8-bit picture.

    Blocks of rows run on all cores; memory beyond input and output stays bounded.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB of any magnitude; negative values and NaN are black. [W m⁻² sr⁻¹]
    exposure : float or "auto"
        Exposure, or "auto" to measure it. [EV]
    tone_map : str
        Tone map, one of ``TONE_MAPS``.
    encoding : str
        Encoding, ``"srgb"`` or ``"gamma"``.

    Returns
    -------
    array, shape (height, width, 3), uint8

    Raises
    ------
    ParameterError
        If the array has another shape, or a name or the exposure is not allowed.

    Examples
    --------
    >>> to_display(np.full((1, 1, 3), 1.0), exposure=0.0)[0, 0]  # Hable(1) = 0.4929
    array([186, 186, 186], dtype=uint8)
    """
    if rgb.ndim != 3 or rgb.shape[-1] != 3:
        raise ParameterError("rgb", rgb.shape, "an array of shape (height, width, 3)")
    shape = tone_map_named(tone_map).forward
    encode = encoding_named(encoding).encode
    factor = exposure_factor(resolve_exposure(rgb, exposure, tone_map))
    height, width = rgb.shape[:2]
    picture = np.empty((height, width, 3), dtype=np.uint8)
    rows = max(1, _BLOCK // max(1, width))

    def show(index: int) -> None:
        block = rgb[index * rows : (index + 1) * rows]
        with np.errstate(over="ignore"):  # infinite light is very bright light
            exposed = block * block.dtype.type(factor)
        shown = encode(np.clip(shape(exposed), 0.0, 1.0))
        picture[index * rows : (index + 1) * rows] = (255.0 * shown + 0.5).astype(np.uint8)

    run_blocks(show, -(-height // rows))
    return picture

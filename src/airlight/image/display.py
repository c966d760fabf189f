"""Display chain: from linear light to pixel values."""

from __future__ import annotations

import math
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.displayed import Display, displayed
from airlight.image.encoding import ENCODINGS, encoding_named
from airlight.image.exposure import automatic_exposure, exposure_factor
from airlight.image.gamut import primaries_number
from airlight.image.glare import Glare
from airlight.image.tone_maps import TONE_MAPS, tone_map_named
from airlight.kernel import compiled_loop
from airlight.kernel.large_arrays import release, zeros
from airlight.kernel.threads import run_blocks

#: Default tone map of pictures.
DEFAULT_TONE_MAP: Final = "natural"
#: Pixels per block of rows.
_BLOCK: Final = 16_384
#: Array types of pictures by bits per channel.
_TYPES: Final[dict[int, Any]] = {8: np.uint8, 16: np.uint16}


def resolve_exposure(
    rgb: NDArray[np.floating],
    exposure: float | str,
    weights: NDArray[np.floating] | None = None,
) -> float:
    """Exposure: a number, or metered on the picture for ``"auto"``. [EV]

    Parameters
    ----------
    rgb, weights :
        Arguments of ``automatic_exposure``.
    exposure : float or "auto"
        Exposure. [EV]

    Raises
    ------
    ParameterError
        If it is neither, or outside -100 to 100 EV.
    """
    if isinstance(exposure, str):
        if exposure != "auto":
            raise ParameterError("exposure", exposure, '-100 to 100 EV, or "auto"')
        return automatic_exposure(rgb, weights)
    exposure_factor(exposure)
    return float(exposure)


def display_of(
    exposure: float,
    tone_map: str = DEFAULT_TONE_MAP,
    encoding: str | None = "srgb",
    *,
    eye: bool = False,
    primaries: str = "srgb",
    step: float = 1.0 / 255.0,
) -> Display:
    """Parameters of a display from names.

    Parameters
    ----------
    exposure : float
        Exposure. [EV]
    tone_map : str
        Name from ``TONE_MAPS``.
    encoding : str or None
        Name from ``ENCODINGS``; None for a target with its own encoding.
    eye : bool
        Whether to simulate mesopic vision.
    primaries : str
        Name from ``PRIMARIES``.
    step : float
        Quantisation step for dither; 0 for none. [1]

    Raises
    ------
    ParameterError
        If a name or the exposure is not allowed.
    """
    tone_map_named(tone_map)
    if encoding is not None:
        encoding_named(encoding)
    return Display(
        exposure=exposure_factor(exposure),
        eye=eye,
        tone_map=list(TONE_MAPS).index(tone_map),
        primaries=primaries_number(primaries),
        encoding=-1 if encoding is None else list(ENCODINGS).index(encoding),
        dither=float(step),
    )


@compiled_loop
def display_rows(rgb, picture, first, left, most, display):
    """Rows of a picture by ``displayed``.

    Parameters
    ----------
    rgb : array, shape (rows, width, 3)
        Linear sRGB. [W m⁻² sr⁻¹]
    picture : array, shape (rows, width, 3)
        Receives integer pixel values.
    first, left : int
        Row and column of the first pixel in the whole picture.
    most : float
        Pixel value of white.
    """
    for row in range(rgb.shape[0]):
        for column in range(rgb.shape[1]):
            red, green, blue = displayed(
                np.float64(rgb[row, column, 0]),
                np.float64(rgb[row, column, 1]),
                np.float64(rgb[row, column, 2]),
                np.float64(left + column),
                np.float64(first + row),
                display,
            )
            picture[row, column, 0] = math.floor(most * red + 0.5)
            picture[row, column, 1] = math.floor(most * green + 0.5)
            picture[row, column, 2] = math.floor(most * blue + 0.5)


def to_display(
    rgb: NDArray[np.floating],
    exposure: float | Literal["auto"] = "auto",
    tone_map: str = DEFAULT_TONE_MAP,
    encoding: str = "srgb",
    *,
    eye: bool | None = None,
    primaries: str = "srgb",
    bits: int = 8,
    dither: bool = True,
    glare: float = 1.0,
    pixel_angle: float = 0.0,
    circle: tuple[int, int] | None = None,
    origin: tuple[int, int] = (0, 0),
) -> NDArray[Any]:
    """Integer pixel values of a frame of linear light.

    Parallel over rows. Glare needs memory of two thirds of the input.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB; channels outside the gamut are negative, NaN is black. [W m⁻² sr⁻¹]
    exposure : float or "auto"
        Exposure; ``"auto"``: ``automatic_exposure`` of the picture. For scenes see
        ``scene_exposure``. [EV]
    tone_map : str
        Tone map, one of ``TONE_MAPS``.
    encoding : str
        Encoding, ``"srgb"`` or ``"gamma"``.
    eye : bool, optional
        Whether to simulate mesopic vision below 4 cd m⁻², see ``mesopic``; default: with automatic
        exposure.
    primaries : str
        Primaries of the display, one of ``PRIMARIES``.
    bits : int
        Bits per channel, 8 or 16.
    dither : bool
        Whether to add reproducible dither of one quantisation step.
    glare : float
        Amount of glare, 0 to 10: 1 is that of a lens. [1]
    pixel_angle : float
        Angle of a pixel, ``Frame.pixel_angle``; 0 for no glare. [rad]
    circle : (int, int), optional
        Width and height of the whole picture of a dome, ``Frame.circle``; black outside the circle.
        [pixel]
    origin : (int, int)
        Column and row of the first pixel in a larger picture. [pixel]

    Raises
    ------
    ParameterError
        If the array has another shape, or a name, the bits, the exposure or the glare are not
        allowed.

    Examples
    --------
    >>> to_display(np.full((1, 1, 3), 0.18), exposure=0.0, dither=False)[0, 0]
    array([118, 118, 118], dtype=uint8)
    """
    if rgb.ndim != 3 or rgb.shape[-1] != 3:
        raise ParameterError("rgb", rgb.shape, "an array of shape (height, width, 3)")
    if bits not in _TYPES:
        raise ParameterError("bits", bits, "8 or 16")
    most = 2.0**bits - 1.0
    display = display_of(
        resolve_exposure(rgb, exposure),
        tone_map,
        encoding,
        eye=exposure == "auto" if eye is None else eye,
        primaries=primaries,
        step=1.0 / most if dither else 0.0,
    )
    lens = Glare(rgb, pixel_angle, glare, circle, origin)
    height, width = rgb.shape[:2]
    picture = zeros((height, width, 3), _TYPES[bits])
    rows = max(1, _BLOCK // max(1, width))

    def show(index: int) -> None:
        chosen = slice(index * rows, min((index + 1) * rows, height))
        light = lens.rows(chosen.start, chosen.stop)
        display_rows(light, picture[chosen], origin[1] + index * rows, origin[0], most, display)
        release(light)
        release(picture[chosen])

    run_blocks(show, -(-height // rows))
    return picture

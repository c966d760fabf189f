"""Display chain: from linear light to pixel values."""

from __future__ import annotations

import math
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.display_settings import DisplaySettings, display_settings
from airlight.image.displayed import Display, displayed
from airlight.image.encoding import encoding_named
from airlight.image.exposure import automatic_exposure, exposure_factor
from airlight.image.gamut import RGB_TO_P3
from airlight.image.glare import Glare
from airlight.image.natural import STYLES, natural_inverse
from airlight.image.tone_maps import tone_map_named
from airlight.image.white_balance import White, adapt, scene_white
from airlight.kernel import compiled_loop
from airlight.kernel.large_arrays import release, zeros
from airlight.kernel.threads import run_blocks

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
    rgb: NDArray[np.floating],
    exposure: float,
    settings: DisplaySettings,
    star_white: White | None = None,
) -> Display:
    """Parameters of ``displayed`` for a frame.

    Parameters
    ----------
    rgb, settings, star_white :
        Arguments of ``to_display``.
    exposure : float
        Exposure. [EV]
    """
    mean = None
    if settings.white_balance == "scene":
        mean = scene_white(rgb, exposure_factor(exposure))
    return settings.display(exposure, star_white, mean)


def decoded_light(values: NDArray[np.floating], settings: DisplaySettings) -> NDArray[Any]:
    """Displayed light from displayed values: the inverse of encoding and primaries.

    Parameters
    ----------
    values, settings :
        Arguments of ``exposed_light``.

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same floating type. [1]
    """
    light = values
    if settings.encoding is not None:
        light = encoding_named(settings.encoding).decode(values)
    return light if settings.primaries == "srgb" else light @ np.linalg.inv(RGB_TO_P3).T


def exposed_light(
    values: NDArray[np.floating],
    settings: DisplaySettings,
    gains: tuple[float, float, float] = (1.0, 1.0, 1.0),
) -> NDArray[Any]:
    """Light after exposure from displayed values: the inverse of the steps of ``displayed``.

    Not undone: mesopic vision, which darkens and fades what is below 4 cd m⁻²; glare, 3 % of the
    light; dither, half a step.

    Parameters
    ----------
    values : array, shape (..., 3)
        Encoded values, 0 to 1. [1]
    settings : DisplaySettings
        Settings that they were displayed with.
    gains : (float, float, float)
        Gains of their white balance, see ``adapt``. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB after exposure, same floating type. [1]

    Examples
    --------
    >>> shown = to_display(np.full((1, 1, 3), 0.18), 0.0, bits=16, dither=False)
    >>> exposed_light(shown / 65535.0, DisplaySettings()).round(4)[0, 0]
    array([0.18, 0.18, 0.18])
    """
    light = decoded_light(values, settings)
    if settings.tone_map == "natural":
        light = natural_inverse(light, STYLES[settings.style])
    else:
        light = tone_map_named(settings.tone_map).inverse(light)
    long, medium, short = gains
    return adapt(light, (1.0 / long, 1.0 / medium, 1.0 / short))


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
    tone_map: str | None = None,
    encoding: str | None = None,
    *,
    settings: DisplaySettings | None = None,
    pixel_angle: float = 0.0,
    circle: tuple[int, int] | None = None,
    origin: tuple[int, int] = (0, 0),
    star_white: White | None = None,
    **changes: Any,
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
    tone_map, encoding : str, optional
        Fields of ``settings``.
    settings : DisplaySettings, optional
        Tone map, mesopic vision, encoding, primaries, bits, dither and glare.
    pixel_angle : float
        Angle of a pixel, ``Frame.pixel_angle``; 0 for no glare. [rad]
    circle : (int, int), optional
        Width and height of the whole picture of a dome, ``Frame.circle``; black outside the circle.
        [pixel]
    origin : (int, int)
        Column and row of the first pixel in a larger picture. [pixel]
    star_white : (float, float), optional
        Chromaticity of the star's light, ``Frame.star_white``; without it the white balance
        ``auto`` is the display's own white.
    **changes :
        Single fields of ``settings``: ``eye=False``, ``bits=16``.

    Raises
    ------
    ParameterError
        If the array has another shape, or the exposure or a setting is not allowed.

    Examples
    --------
    >>> to_display(np.full((1, 1, 3), 0.18), exposure=0.0, style="soft", dither=False)[0, 0]
    array([118, 118, 118], dtype=uint8)
    """
    if rgb.ndim != 3 or rgb.shape[-1] != 3:
        raise ParameterError("rgb", rgb.shape, "an array of shape (height, width, 3)")
    changes |= {"tone_map": tone_map, "encoding": encoding}
    chosen = display_settings(settings, **changes).adapted(exposure)
    most, used = chosen.white_level, resolve_exposure(rgb, exposure)
    display = display_of(rgb, used, chosen, star_white)
    lens = Glare(rgb, pixel_angle, chosen.glare, circle, origin)
    height, width = rgb.shape[:2]
    picture = zeros((height, width, 3), _TYPES[chosen.bits])
    rows = max(1, _BLOCK // max(1, width))

    def show(index: int) -> None:
        chosen = slice(index * rows, min((index + 1) * rows, height))
        light = lens.rows(chosen.start, chosen.stop)
        display_rows(light, picture[chosen], origin[1] + index * rows, origin[0], most, display)
        release(light)
        release(picture[chosen])

    run_blocks(show, -(-height // rows))
    return picture

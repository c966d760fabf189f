"""Displayed values of a pixel, common to CPU and shaders."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from airlight.image.dither import dithered
from airlight.image.encoding import encoded
from airlight.image.eye import seen_by_eye
from airlight.image.tone_maps import shown_light
from airlight.kernel import inlined
from airlight.kernel.shader_fields import CHOICE


class Display(NamedTuple):
    """Parameters of the display chain, for CPU and shaders.

    Attributes
    ----------
    exposure : float
        Factor of the exposure. [1]
    eye : bool
        Whether to simulate mesopic vision, see ``mesopic``.
    tone_map : int
        Index in ``TONE_MAPS``.
    primaries : int
        Index in ``PRIMARIES``.
    encoding : int
        Index in ``ENCODINGS``; -1 for a target with its own encoding.
    dither : float
        Quantisation step for dither; 0 for none. [1]
    """

    exposure: float
    eye: Annotated[bool, CHOICE]
    tone_map: Annotated[int, CHOICE]
    primaries: Annotated[int, CHOICE]
    encoding: Annotated[int, CHOICE]
    dither: float


@inlined
def displayed(red, green, blue, px, py, display):
    """Displayed values of linear light: vision, exposure, tone map, gamut, encoding, dither. [1]

    Parameters
    ----------
    red, green, blue : float
        Linear sRGB; channels may be negative. [W m⁻² sr⁻¹]
    px, py : float
        Position from the picture's left and top edge. [pixel]
    display : Display
        Exposure, eye, tone map, primaries, encoding and dither.

    Returns
    -------
    red, green, blue : float
        Encoded values, 0 to 1. [1]
    """
    if display.eye:
        red, green, blue = seen_by_eye(red, green, blue, display.exposure)
    red, green, blue = shown_light(
        display.tone_map,
        display.primaries,
        red * display.exposure,
        green * display.exposure,
        blue * display.exposure,
    )
    if display.encoding < 0:
        return red, green, blue
    red = encoded(display.encoding, red)
    green = encoded(display.encoding, green)
    blue = encoded(display.encoding, blue)
    return (
        dithered(red, px, py, 0, display.dither),
        dithered(green, px, py, 1, display.dither),
        dithered(blue, px, py, 2, display.dither),
    )

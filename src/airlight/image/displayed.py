"""Displayed values of a pixel, common to CPU and shaders."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from airlight.image.dither import dither_noise, dither_place, dithered
from airlight.image.encoding import encoded
from airlight.image.eye import cones_and_rods, with_rods
from airlight.image.tone_maps import shown_light
from airlight.image.white_balance import white_balanced
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
    style : int
        Index in ``STYLES``.
    primaries : int
        Index in ``PRIMARIES``.
    encoding : int
        Index in ``ENCODINGS``; -1 for a target with its own encoding.
    dither : float
        Quantisation step for dither; 0 for none. [1]
    gain_long, gain_medium, gain_short : float
        Gains of the cone responses from ``white_gains``. [1]
    """

    exposure: float
    eye: Annotated[bool, CHOICE]
    tone_map: Annotated[int, CHOICE]
    style: Annotated[int, CHOICE]
    primaries: Annotated[int, CHOICE]
    encoding: Annotated[int, CHOICE]
    dither: float
    gain_long: float
    gain_medium: float
    gain_short: float


@inlined
def displayed(red, green, blue, px, py, display):
    """Displayed values of linear light. [1]

    Mesopic vision, white balance, exposure, tone map, gamut, encoding and dither, in this order.

    Parameters
    ----------
    red, green, blue : float
        Linear sRGB; channels may be negative. [W m⁻² sr⁻¹]
    px, py : float
        Position from the picture's left and top edge. [pixel]
    display : Display
        Parameters of all steps.

    Returns
    -------
    red, green, blue : float
        Encoded values, 0 to 1. [1]
    """
    cones, rods = 1.0, 0.0
    if display.eye:
        cones, rods = cones_and_rods(red, green, blue, display.exposure)
    # Cones adapt to the white of the scene; what rods see has no colour to adapt.
    red, green, blue = white_balanced(
        red, green, blue, display.gain_long, display.gain_medium, display.gain_short
    )
    if display.eye:
        red, green, blue = with_rods(red, green, blue, cones, rods)
    red, green, blue = shown_light(
        display.tone_map,
        display.primaries,
        display.style,
        red * display.exposure,
        green * display.exposure,
        blue * display.exposure,
    )
    if display.encoding < 0:
        return red, green, blue
    red = encoded(display.encoding, red)
    green = encoded(display.encoding, green)
    blue = encoded(display.encoding, blue)
    if display.dither <= 0.0:
        return red, green, blue
    for_red, for_green, for_blue = dither_noise(dither_place(px, py))
    return (
        dithered(red, for_red, display.dither),
        dithered(green, for_green, display.dither),
        dithered(blue, for_blue, display.dither),
    )

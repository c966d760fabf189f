"""Natural tone map: hue is held, bright colours pale to white, the gamut is approached softly.

Works in OKLab, where chroma alone can be scaled: a red sun stays red until it is white-hot, instead
of turning yellow as channels saturate one after another.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.color.floating import BRIGHTEST, each_pixel, physical
from airlight.color.oklab import cone_roots, lab_of, rgb_of_cones
from airlight.kernel import compiled_loop, kernel
from airlight.kernel.cube_root import cube_root

#: Light up to which the curve is the identity; beyond, an exponential shoulder approaches 1. [1]
SHOULDER: Final = 0.25
#: Share of the way from grey to the edge of the gamut up to which chroma is kept. [1]
KNEE: Final = 0.8
#: Newton steps to the chroma of a given share; the last changes it by less than 1e-12.
_STEPS: Final = 8
#: Least distance of the grey from white and from black, by which shares are divided. [1]
_LEAST: Final = 1e-6
#: Displayed light that counts as white. [1]
_WHITEST: Final = 1.0 - 1e-9


@kernel
def signed_light(light):
    """Light of any sign clamped to ±``BRIGHTEST``; NaN is 0."""
    if light > 0.0:
        return light if light < BRIGHTEST else BRIGHTEST
    if light < 0.0:
        return light if light > -BRIGHTEST else -BRIGHTEST
    return 0.0


@kernel
def natural_curve(light):
    """Displayed light of a grey: the identity, then a shoulder that never reaches 1. [1]"""
    over = light - SHOULDER
    if over <= 0.0:
        return light
    return SHOULDER + (1.0 - SHOULDER) * (1.0 - math.exp(-over / (1.0 - SHOULDER)))


@kernel
def softened(share):
    """Share of the gamut that is shown: the identity up to the knee, then towards 1. [1]"""
    if share <= KNEE:
        return share
    return KNEE + (1.0 - KNEE) * (1.0 - math.exp((KNEE - share) / (1.0 - KNEE)))


@kernel
def gamut_share(lightness, red, green, blue):
    """Share of the way from the grey of its lightness to the edge of the gamut. [1]

    Parameters
    ----------
    lightness : float
        Lightness in OKLab, above 0. [1]
    red, green, blue : float
        The colour, in linear sRGB. [1]

    Returns
    -------
    float
        Largest share of the channels, each of its way to 0 or to 1; 1 on the edge. [1]
    """
    grey = lightness * lightness * lightness
    above = max(red, max(green, blue)) - grey
    below = grey - min(red, min(green, blue))
    return max(above / max(1.0 - grey, _LEAST), below / max(grey, _LEAST))


@kernel
def share_at(lightness, by_long, by_medium, by_short, amount):
    """Share of the gamut at an amount of the chroma, and its derivative by the amount.

    Parameters
    ----------
    lightness : float
        Lightness in OKLab, above 0. [1]
    by_long, by_medium, by_short : float
        Cube roots of the cones' responses, less the lightness, at an amount of 1. [1]
    amount : float
        Factor of the chroma. [1]

    Returns
    -------
    (float, float)
        Share of ``gamut_share``, and its derivative. [1]
    """
    x = lightness + amount * by_long
    y = lightness + amount * by_medium
    z = lightness + amount * by_short
    red, green, blue = rgb_of_cones(x * x * x, y * y * y, z * z * z)
    by_red, by_green, by_blue = rgb_of_cones(
        3.0 * x * x * by_long, 3.0 * y * y * by_medium, 3.0 * z * z * by_short
    )
    grey = lightness * lightness * lightness
    up = 1.0 / max(1.0 - grey, _LEAST)
    down = -1.0 / max(grey, _LEAST)
    scale = up if red > grey else down
    share, slope = (red - grey) * scale, by_red * scale
    scale = up if green > grey else down
    if (green - grey) * scale > share:
        share, slope = (green - grey) * scale, by_green * scale
    scale = up if blue > grey else down
    if (blue - grey) * scale > share:
        share, slope = (blue - grey) * scale, by_blue * scale
    return share, slope


@kernel
def amount_of_share(lightness, by_long, by_medium, by_short, wanted):
    """Amount of the chroma at which a colour reaches a share of the gamut. [1]

    Parameters
    ----------
    lightness, by_long, by_medium, by_short : float
        Arguments of ``share_at``.
    wanted : float
        Share to reach. [1]

    Returns
    -------
    float
        Factor of the chroma, from Newton's method that starts at 1. [1]
    """
    amount = 1.0
    for _step in range(_STEPS):
        share, slope = share_at(lightness, by_long, by_medium, by_short, amount)
        step = amount + (wanted - share) / (slope if slope > _LEAST else share / amount)
        # A step from far outside may pass the grey.
        amount = max(step, 0.25 * amount)
    return amount


@kernel
def natural_color(red, green, blue):
    """Scalar form of ``natural``."""
    r, g, b = signed_light(red), signed_light(green), signed_light(blue)
    lightness, green_red, blue_yellow = lab_of(r, g, b)
    if not lightness > 0.0:
        return 0.0, 0.0, 0.0
    light = lightness * lightness * lightness
    if light > SHOULDER:
        # The lightness falls by the third power of the compression, the chroma by its square.
        darker = cube_root(natural_curve(light) / light)
        lightness = lightness * darker
        green_red = green_red * darker * darker
        blue_yellow = blue_yellow * darker * darker
        x, y, z = cone_roots(lightness, green_red, blue_yellow)
        r, g, b = rgb_of_cones(x * x * x, y * y * y, z * z * z)
    share = gamut_share(lightness, r, g, b)
    if share > KNEE:
        x, y, z = cone_roots(0.0, green_red, blue_yellow)
        amount = amount_of_share(lightness, x, y, z, softened(share))
        x, y, z = lightness + amount * x, lightness + amount * y, lightness + amount * z
        r, g, b = rgb_of_cones(x * x * x, y * y * y, z * z * z)
    return min(max(r, 0.0), 1.0), min(max(g, 0.0), 1.0), min(max(b, 0.0), 1.0)


@compiled_loop
def natural_pixels(colors, out):
    """Apply ``natural_color`` to every colour."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = natural_color(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )


@compiled_loop
def natural_light_pixels(colors, out):
    """Invert ``natural_color`` for every colour."""
    for i in range(colors.shape[0]):
        lightness, green_red, blue_yellow = lab_of(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )
        light = min(lightness * lightness * lightness, _WHITEST)
        out[i, 0], out[i, 1], out[i, 2] = 0.0, 0.0, 0.0
        if light > 0.0:
            shown = gamut_share(lightness, colors[i, 0], colors[i, 1], colors[i, 2])
            amount = 1.0
            if shown > KNEE:
                kept = max(1.0 - (shown - KNEE) / (1.0 - KNEE), _LEAST)
                x, y, z = cone_roots(0.0, green_red, blue_yellow)
                wanted = KNEE - (1.0 - KNEE) * math.log(kept)
                amount = amount_of_share(lightness, x, y, z, wanted)
            brighter = 1.0
            if light > SHOULDER:
                kept = 1.0 - (light - SHOULDER) / (1.0 - SHOULDER)
                exposed = SHOULDER - (1.0 - SHOULDER) * math.log(kept)
                brighter = cube_root(exposed / light)
            lightness = lightness * brighter
            amount = amount * brighter * brighter
            x, y, z = cone_roots(lightness, amount * green_red, amount * blue_yellow)
            out[i, 0], out[i, 1], out[i, 2] = rgb_of_cones(x * x * x, y * y * y, z * z * z)


def natural(rgb: ArrayLike) -> NDArray[Any]:
    r"""Map lightness by a curve with a shoulder, holding the hue, and bring colours into sRGB.

    In OKLab, with the light :math:`x = L^3` of the grey of equal lightness:

    .. math:: x_d = x 	ext{ for } x \le s, \quad
              x_d = s + (1 - s)(1 - e^{-(x - s)/(1 - s)}), \quad
              C_d = C\,(x_d/x)^{2/3}

    Chroma falls faster than lightness, so that bright colours pale to white. What is still
    farther from grey than 0.8 of the way to the edge of the gamut is brought into it along the
    same hue and lightness, softly. Dim colours well within the gamut are unchanged.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure; channels may be negative. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, 0 to 1, same floating type. [1]

    References
    ----------
    Ottosson (2020), "A perceptual color space for image processing": OKLab. Curve, paling and
    approach to the gamut are ours.

    Examples
    --------
    >>> natural([[0.18, 0.18, 0.18], [1.0, 1.0, 1.0]]).round(4)
    array([[0.18  , 0.18  , 0.18  ],
           [0.7241, 0.7241, 0.7241]])
    """
    return each_pixel(natural_pixels, rgb)


def natural_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Invert ``natural``: the exposed light of a displayed colour, exact where it was not clipped.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB of the display, 0 to 1. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same floating type; white is the light whose curve is 1 within 1e-9. [1]
    """
    return each_pixel(natural_light_pixels, np.clip(physical(rgb), 0.0, 1.0))

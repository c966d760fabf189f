"""Natural tone map: constant hue, bright colours desaturate to white, soft gamut mapping.

In OKLab, so that a red sun does not turn yellow as channels saturate one after another.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.image.floating import each_pixel, physical
from airlight.image.gamut import (
    EDGE,
    KNEE,
    amount_of_share,
    gamut_share,
    light_of_cones,
    signed_light,
    to_white,
    with_primaries,
    within_gamut,
)
from airlight.image.oklab import cone_roots, cone_roots_of, lab_of, lightness_of, rgb_of_cones
from airlight.kernel import compiled_loop, kernel
from airlight.kernel.cube_root import cube_root

#: Linear value up to which the curve is the identity; beyond, an exponential shoulder approaches 1.
#: [1]
SHOULDER: Final = 0.25
#: Smallest fraction left to the end of the gamut's soft boundary in the inverse. [1]
_LEAST_KEPT: Final = 1e-6
#: Largest factor of the chroma in the inverse. [1]
_MOST_CHROMA: Final = 64.0
#: Displayed linear value that counts as white. [1]
_WHITEST: Final = 1.0 - 1e-9


@kernel
def natural_curve(light):
    """Displayed light of a grey: the identity, then a shoulder that is asymptotic to 1. [1]"""
    over = light - SHOULDER
    if over <= 0.0:
        return light
    return SHOULDER + (1.0 - SHOULDER) * (1.0 - math.exp(-over / (1.0 - SHOULDER)))


@kernel
def natural_shown(primaries, red, green, blue):
    """Displayed light of exposed light: ``natural`` for a display of any primaries.

    Parameters
    ----------
    primaries : int
        Index in ``PRIMARIES``.
    red, green, blue : float
        Linear sRGB after exposure; channels may be negative. [1]

    Returns
    -------
    red, green, blue : float
        Linear light of the display's primaries, 0 to 1. [1]
    """
    r, g, b = signed_light(red), signed_light(green), signed_light(blue)
    long, medium, short = cone_roots_of(r, g, b)
    lightness = lightness_of(long, medium, short)
    if not lightness > 0.0:
        return 0.0, 0.0, 0.0
    by_long, by_medium, by_short = long - lightness, medium - lightness, short - lightness
    light = lightness * lightness * lightness
    if light > SHOULDER:
        # The lightness falls by the third power of the compression, the chroma by its square.
        darker = cube_root(natural_curve(light) / light)
        paler = darker * darker
        lightness = lightness * darker
        by_long, by_medium, by_short = by_long * paler, by_medium * paler, by_short * paler
        x, y, z = lightness + by_long, lightness + by_medium, lightness + by_short
        r, g, b = light_of_cones(primaries, x * x * x, y * y * y, z * z * z)
    else:
        r, g, b = with_primaries(primaries, r, g, b)
    up = to_white(lightness * lightness * lightness, True)
    return within_gamut(primaries, lightness, up, by_long, by_medium, by_short, r, g, b, True)


@kernel
def natural_color(red, green, blue):
    """Scalar form of ``natural``."""
    return natural_shown(0, red, green, blue)


@compiled_loop
def natural_pixels(colors, out):
    """``natural_color`` of all colours."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = natural_color(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )


@compiled_loop
def natural_light_pixels(colors, out):
    """Inverse of ``natural_color`` of all colours."""
    for i in range(colors.shape[0]):
        lightness, green_red, blue_yellow = lab_of(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )
        light = min(lightness * lightness * lightness, _WHITEST)
        out[i, 0], out[i, 1], out[i, 2] = 0.0, 0.0, 0.0
        if light > 0.0:
            up = to_white(light, True)
            shown = gamut_share(light, up, colors[i, 0], colors[i, 1], colors[i, 2])
            amount = 1.0
            if shown > KNEE:
                kept = max(1.0 - (shown - KNEE) / (EDGE - KNEE), _LEAST_KEPT)
                x, y, z = cone_roots(0.0, green_red, blue_yellow)
                wanted = KNEE - (EDGE - KNEE) * math.log(kept)
                amount = amount_of_share(0, lightness, up, x, y, z, wanted, 1.0, _MOST_CHROMA)
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
    r"""Natural tone map of exposed light.

    In OKLab, with the light :math:`x = L^3` of the grey of equal lightness:

    .. math:: x_d = x \text{ for } x \le s, \quad
              x_d = s + (1 - s)(1 - e^{-(x - s)/(1 - s)}), \quad
              C_d = C\,(x_d/x)^{2/3}

    Chroma decreases faster than lightness, so that bright colours desaturate to white. Colours
    outside are mapped into the gamut by ``in_gamut``. Dim colours well within the gamut are
    unchanged.

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
    Ottosson (2020), "A perceptual color space for image processing": OKLab. Curve, desaturation and
    gamut mapping are airlight's.

    Examples
    --------
    >>> natural([[0.18, 0.18, 0.18], [1.0, 1.0, 1.0]]).round(4)
    array([[0.18  , 0.18  , 0.18  ],
           [0.7241, 0.7241, 0.7241]])
    """
    return each_pixel(natural_pixels, rgb)


def natural_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Inverse of ``natural``, exact where it does not clip.

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

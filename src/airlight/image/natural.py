"""Natural tone map: constant hue, contrast, bright colours desaturate to white, soft gamut mapping.

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

#: Linear value that the curve keeps; beyond, an exponential shoulder approaches 1. [1]
SHOULDER: Final = 0.25
#: Contrast of the toe by style: its largest slope, of logarithms. ``soft`` has no toe. [1]
STYLES: Final[dict[str, float]] = {"neutral": 1.2, "punchy": 1.4, "soft": 1.0}
_NEUTRAL, _PUNCHY, _SOFT = STYLES.values()
#: Light about which the toe darkens shadows, and about which it leaves deep shadows visible. [1]
_TOE: Final = 0.07
_DEEP: Final = 0.006
#: Steepness of the toe per contrast above 1, within 0.1 % for ``STYLES``. [1]
_STEEPNESS: Final = 0.4427
#: Increase of the chroma over that of the contrast: curves of single channels increase both. [1]
_CHROMA: Final = 0.5
#: Light above the shoulder, relative to its range, at which the slope of the toe has faded, so that
#: the glow of a sun keeps its size. [1]
_FADE: Final = 0.3
#: Smallest fraction left to the end of the gamut's soft boundary in the inverse. [1]
_LEAST_KEPT: Final = 1e-6
#: Steps of the inverse of the toe, which reduce the error at least to two fifths each.
_INVERSE_STEPS: Final = 40
#: Largest factor of the chroma in the inverse. [1]
_MOST_CHROMA: Final = 64.0
#: Displayed linear value that counts as white. [1]
_WHITEST: Final = 1.0 - 1e-9


@kernel
def toe(light, contrast):
    """Displayed over exposed lightness of a grey below the shoulder, by a single division. [1]

    Parameters
    ----------
    light : float
        Exposed light, up to the shoulder. [1]
    contrast : float
        Argument of ``natural_curve``.
    """
    more = 1.0 + _STEEPNESS * (contrast - 1.0)
    less = 2.0 - more
    above = (more * light + _TOE * less) * (less * light + _DEEP * more)
    below = (less * light + _TOE * more) * (more * light + _DEEP * less)
    end_above = (more * SHOULDER + _TOE * less) * (less * SHOULDER + _DEEP * more)
    end_below = (less * SHOULDER + _TOE * more) * (more * SHOULDER + _DEEP * less)
    return above * end_below / (below * end_above)


@kernel
def shoulder_slope(contrast):
    """Slope of the toe at the shoulder. [1]"""
    more = 1.0 + _STEEPNESS * (contrast - 1.0)
    less = 2.0 - more
    toe_ends = (more * SHOULDER + _TOE * less) * (less * SHOULDER + _TOE * more)
    deep_ends = (more * SHOULDER + _DEEP * less) * (less * SHOULDER + _DEEP * more)
    steeper = (_TOE * deep_ends - _DEEP * toe_ends) / (toe_ends * deep_ends)
    return 1.0 + 3.0 * SHOULDER * (more * more - less * less) * steeper


@kernel
def vividness(contrast):
    """Factor of the chroma. [1]"""
    return 1.0 + _CHROMA * (contrast - 1.0)


@kernel
def natural_curve(light, contrast):
    """Displayed light of a grey: a toe, and from 0.25 a shoulder that is asymptotic to 1. [1]

    Parameters
    ----------
    light : float
        Exposed light. [1]
    contrast : float
        Largest slope of the toe, of logarithms, 0.5 to 1.5; 1 for none. [1]
    """
    if light <= SHOULDER:
        darker = toe(light, contrast)
        return light * darker * darker * darker
    slope = shoulder_slope(contrast)
    over = (light - SHOULDER) / (1.0 - SHOULDER)
    rise = over * (over + slope * _FADE) / (over + _FADE)
    return SHOULDER + (1.0 - SHOULDER) * (1.0 - math.exp(-rise))


@kernel
def natural_curve_inverse(shown, contrast):
    """Exposed light of a grey from its displayed light, below 1. [1]"""
    if shown <= SHOULDER:
        # The slope of the logarithms is between 0.6 and 1.4: a fixed-point iteration converges.
        light = shown
        for _step in range(_INVERSE_STEPS):
            light = light * shown / natural_curve(light, contrast)
        return light
    slope = shoulder_slope(contrast)
    rise = -math.log(1.0 - (shown - SHOULDER) / (1.0 - SHOULDER))
    half = 0.5 * (rise - slope * _FADE)
    over = half + math.sqrt(half * half + rise * _FADE)
    return SHOULDER + (1.0 - SHOULDER) * over


@kernel
def style_contrast(style):
    """Contrast by index in ``STYLES``. [1]"""
    if style == 1:
        return _PUNCHY
    if style == 2:
        return _SOFT
    return _NEUTRAL


@kernel
def natural_shown(primaries, contrast, red, green, blue):
    """Displayed light of exposed light: ``natural`` for a display of any primaries.

    Parameters
    ----------
    primaries : int
        Index in ``PRIMARIES``.
    contrast : float
        Contrast of the toe; 1 for none. [1]
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
    if light > SHOULDER or contrast != 1.0:
        # The lightness falls by the third power of the compression, the chroma of bright colours by
        # its square; in the toe chroma and lightness fall alike.
        if light > SHOULDER:
            darker = cube_root(natural_curve(light, contrast)) / lightness
            paler = darker * darker * vividness(contrast)
        else:
            darker = toe(light, contrast)
            paler = darker * vividness(contrast)
        lightness = lightness * darker
        by_long, by_medium, by_short = by_long * paler, by_medium * paler, by_short * paler
        x, y, z = lightness + by_long, lightness + by_medium, lightness + by_short
        r, g, b = light_of_cones(primaries, x * x * x, y * y * y, z * z * z)
    else:
        r, g, b = with_primaries(primaries, r, g, b)
    return within_gamut(primaries, lightness, True, by_long, by_medium, by_short, r, g, b, True)


@kernel
def natural_color(red, green, blue):
    """Scalar form of ``natural`` in its default style."""
    return natural_shown(0, _NEUTRAL, red, green, blue)


@compiled_loop
def natural_pixels(colors, out, contrast):
    """``natural_shown`` of all colours."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = natural_shown(
            0,
            contrast,
            np.float64(colors[i, 0]),
            np.float64(colors[i, 1]),
            np.float64(colors[i, 2]),
        )


@compiled_loop
def natural_light_pixels(colors, out, contrast):
    """Inverse of ``natural_shown`` of all colours."""
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
            brighter = cube_root(natural_curve_inverse(light, contrast) / light)
            lightness = lightness * brighter
            amount *= brighter * (brighter if light > SHOULDER else 1.0) / vividness(contrast)
            x, y, z = cone_roots(lightness, amount * green_red, amount * blue_yellow)
            out[i, 0], out[i, 1], out[i, 2] = rgb_of_cones(x * x * x, y * y * y, z * z * z)


def natural(rgb: ArrayLike, contrast: float = _NEUTRAL) -> NDArray[Any]:
    r"""Natural tone map of exposed light.

    In OKLab, with the light :math:`x = L^3` of the grey of equal lightness, :math:`s = 0.25`,
    and of the contrast c the ratio :math:`r = (1 + 0.443\,(c - 1))/(1 - 0.443\,(c - 1))`,

    .. math:: x_d &= x\left(\frac{q(x)}{q(s)}\right)^3 \text{ for } x \le s, \quad
              q(x) = \frac{(x + 0.07/r)(x + 0.006\,r)}{(x + 0.07\,r)(x + 0.006/r)}, \\
              x_d &= s + (1 - s)(1 - e^{-h}), \quad h = t\,\frac{t + 0.3\,m}{t + 0.3}, \quad
              t = \frac{x - s}{1 - s}

    where m is the slope at s. The slope of ln x\ :sub:`d` by ln x is at most c, at 0.1; shadows
    below 0.002 and highlights are about those without contrast. The chroma is that of the exposed
    light times :math:`v\,(x_d/x)^{1/3}`, :math:`v = (1 + c)/2`, and above s times
    :math:`v\,(x_d/x)^{2/3}`, so that bright colours desaturate to white. Colours outside are mapped
    into the gamut by ``in_gamut``.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure; channels may be negative. [1]
    contrast : float
        Contrast c, a value of ``STYLES``; 1 leaves dim colours within the gamut unchanged. [1]

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
    >>> natural([[0.18, 0.18, 0.18], [1.0, 1.0, 1.0]], contrast=1.0).round(4)
    array([[0.18  , 0.18  , 0.18  ],
           [0.7241, 0.7241, 0.7241]])
    """
    return each_pixel(natural_pixels, rgb, contrast)


def natural_inverse(rgb: ArrayLike, contrast: float = _NEUTRAL) -> NDArray[Any]:
    """Inverse of ``natural``, exact where it does not clip.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB of the display, 0 to 1. [1]
    contrast : float
        Contrast of the toe. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same floating type; white is the light whose curve is 1 within 1e-9. [1]
    """
    return each_pixel(natural_light_pixels, np.clip(physical(rgb), 0.0, 1.0), contrast)

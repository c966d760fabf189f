"""Gamut mapping of a display by reduction of chroma at constant hue and lightness.

In OKLab, along the line from a colour to the grey of equal lightness. Colours outside are
compressed into the outer fifth of the gamut, which preserves gradients.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.floating import BRIGHTEST, each_pixel
from airlight.image.oklab import RGB_TO_CONES, cone_roots_of, lightness_of, rgb_of_cones
from airlight.image.xyz import RGB_TO_XYZ
from airlight.kernel import compiled_loop, kernel

#: Primaries of displays by name, with their chromaticities of red, green and blue; white is D65.
#: [IEC 61966-2-1:1999; SMPTE EG 432-1:2010, with white D65]
PRIMARIES: Final[dict[str, tuple[tuple[float, float], ...]]] = {
    "srgb": ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06)),
    "display-p3": ((0.68, 0.32), (0.265, 0.69), (0.15, 0.06)),
}
#: Chromaticity of D65, their white. [IEC 61966-2-1:1999]
WHITE: Final = (0.3127, 0.3290)
#: Fraction of the distance from grey to the gamut boundary up to which chroma is unchanged. [1]
KNEE: Final = 0.8
#: Fraction to which infinite chroma is mapped: colours far beyond the gamut stay off its boundary,
#: so that no channel is 0 or 255 over a whole sunset. [1]
EDGE: Final = 0.96
#: Largest number of Newton steps to the chroma of a given fraction; usually three or four, at most
#: ten.
_STEPS: Final = 14
#: Relative change at which they end; the error left is of the order of its square.
_CLOSE: Final = 1e-6
#: Smallest distance of the grey from white and from black as a divisor: a hundred times the
#: rounding of single precision. [1]
_LEAST: Final = 1e-5
#: Smallest slope as a divisor in Newton's method. [1]
_FLAT: Final = 1e-6


def _rgb_to(name: str) -> NDArray[np.float64]:
    """Matrix from linear sRGB to linear light of these primaries, with the same white."""
    xyz = np.array([[x / y, 1.0, (1.0 - x - y) / y] for x, y in PRIMARIES[name]]).T
    white = RGB_TO_XYZ.sum(axis=1)
    to_xyz = xyz * np.linalg.solve(xyz, white)
    return np.asarray(np.linalg.solve(to_xyz, RGB_TO_XYZ), np.float64)


#: Linear sRGB to linear Display P3.
RGB_TO_P3: Final[NDArray[np.float64]] = _rgb_to("display-p3")
RGB_TO_P3.flags.writeable = False

# The same numbers as arguments of the kernels.
(_RR, _RG, _RB), (_GR, _GG, _GB), (_BR, _BG, _BB) = RGB_TO_P3.tolist()
_CONES_TO_P3: Final = np.linalg.solve(RGB_TO_CONES.T, RGB_TO_P3.T).T
(_RL, _RM, _RS), (_GL, _GM, _GS), (_BL, _BM, _BS) = _CONES_TO_P3.tolist()


def primaries_number(name: str) -> int:
    """Index of primaries in ``PRIMARIES``.

    Raises
    ------
    ParameterError
        If there are no such primaries.
    """
    if name not in PRIMARIES:
        raise ParameterError("primaries", name, ", ".join(PRIMARIES))
    return list(PRIMARIES).index(name)


@kernel
def signed_light(light):
    """Light of any sign clamped to ±``BRIGHTEST``; NaN is 0."""
    if light > 0.0:
        return light if light < BRIGHTEST else BRIGHTEST
    if light < 0.0:
        return light if light > -BRIGHTEST else -BRIGHTEST
    return 0.0


@kernel
def with_primaries(primaries, red, green, blue):
    """Linear light of the display's primaries, from linear sRGB."""
    if primaries == 0:
        return red, green, blue
    return (
        _RR * red + _RG * green + _RB * blue,
        _GR * red + _GG * green + _GB * blue,
        _BR * red + _BG * green + _BB * blue,
    )


@kernel
def light_of_cones(primaries, long, medium, short):
    """Linear light of the display's primaries, from the responses of the three cones."""
    if primaries == 0:
        return rgb_of_cones(long, medium, short)
    return (
        _RL * long + _RM * medium + _RS * short,
        _GL * long + _GM * medium + _GS * short,
        _BL * long + _BM * medium + _BS * short,
    )


@kernel
def softened(share):
    """Compressed relative chroma: the identity up to the knee, then asymptotic to the edge. [1]"""
    if share <= KNEE:
        return share
    return KNEE + (EDGE - KNEE) * (1.0 - math.exp((KNEE - share) / (EDGE - KNEE)))


@kernel
def to_white(grey, bounded):
    """Reciprocal of a grey's distance to white; 0 for unbounded light. [1]"""
    return 1.0 / max(1.0 - grey, _LEAST) if bounded else 0.0


@kernel
def gamut_share(grey, up, red, green, blue):
    """Chroma relative to the gamut boundary at the same lightness and hue. [1]

    Parameters
    ----------
    grey : float
        Light of the grey of equal lightness, above 0. [1]
    up : float
        Reciprocal of its distance to white, from ``to_white``. [1]
    red, green, blue : float
        Colour in linear light of the display's primaries. [1]

    Returns
    -------
    float
        Largest relative distance of the channels to 0 or 1; 1 on the boundary. [1]
    """
    above = max(red, max(green, blue)) - grey
    below = grey - min(red, min(green, blue))
    return max(above * up, below / max(grey, _LEAST))


@kernel
def share_at(primaries, lightness, up, by_long, by_medium, by_short, amount):
    """Relative chroma at a factor of the chroma, and its derivative by the factor.

    Parameters
    ----------
    primaries : int
        Index in ``PRIMARIES``.
    lightness : float
        Lightness in OKLab, above 0. [1]
    up : float
        Argument of ``gamut_share``.
    by_long, by_medium, by_short : float
        Cube roots of the cones' responses, less the lightness, at the factor 1. [1]
    amount : float
        Factor of the chroma. [1]

    Returns
    -------
    (float, float)
        Result of ``gamut_share``, and its derivative. [1]
    """
    x = lightness + amount * by_long
    y = lightness + amount * by_medium
    z = lightness + amount * by_short
    red, green, blue = light_of_cones(primaries, x * x * x, y * y * y, z * z * z)
    by_red, by_green, by_blue = light_of_cones(
        primaries, 3.0 * x * x * by_long, 3.0 * y * y * by_medium, 3.0 * z * z * by_short
    )
    grey = lightness * lightness * lightness
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
def amount_of_share(primaries, lightness, up, by_long, by_medium, by_short, wanted, start, most):
    """Factor of the chroma at which a colour reaches a relative chroma. [1]

    Parameters
    ----------
    primaries, lightness, up, by_long, by_medium, by_short :
        Arguments of ``share_at``.
    wanted : float
        Relative chroma. [1]
    start : float
        Start of Newton's method, above 0. [1]
    most : float
        Upper limit of the factor. [1]
    """
    least, amount = 0.0, start
    for _attempt in range(_STEPS):
        share, slope = share_at(primaries, lightness, up, by_long, by_medium, by_short, amount)
        if share > wanted:
            most = amount
        else:
            least = amount
        step = (wanted - share) / max(slope, _FLAT)
        amount = amount + step
        if abs(step) < _CLOSE * amount:
            break
        # A deep blue's share does not grow all the way: halved where Newton's method would leave,
        # by more than single precision rounds.
        if not 0.999 * least < amount < 1.001 * most:
            amount = 0.5 * (least + most)
    return amount


@kernel
def within_gamut(
    primaries, lightness, bounded, by_long, by_medium, by_short, red, green, blue, soft
):
    """Colour mapped into the gamut at constant hue and lightness.

    Parameters
    ----------
    primaries, lightness, by_long, by_medium, by_short :
        Arguments of ``share_at``.
    bounded : bool
        Whether channels are bounded by 1.
    red, green, blue : float
        The colour, in linear light of the display's primaries. [1]
    soft : bool
        Whether to compress colours near the boundary; otherwise colours outside are clipped to it.

    Returns
    -------
    red, green, blue : float
        Linear light of the primaries, not below 0. [1]
    """
    grey = lightness * lightness * lightness
    knee = KNEE if soft else 1.0
    # By multiplication: most colours need no division.
    far = grey - min(red, min(green, blue)) > knee * max(grey, _LEAST)
    if bounded:
        far = far or max(red, max(green, blue)) - grey > knee * max(1.0 - grey, _LEAST)
    if far:
        up = to_white(grey, bounded)
        share = gamut_share(grey, up, red, green, blue)
        wanted = softened(share) if soft else 1.0
        # The share grows about in proportion to the chroma.
        start = wanted / share
        amount = amount_of_share(
            primaries, lightness, up, by_long, by_medium, by_short, wanted, start, 1.0
        )
        x, y = lightness + amount * by_long, lightness + amount * by_medium
        z = lightness + amount * by_short
        red, green, blue = light_of_cones(primaries, x * x * x, y * y * y, z * z * z)
    most = 1.0 if bounded else BRIGHTEST
    return min(max(red, 0.0), most), min(max(green, 0.0), most), min(max(blue, 0.0), most)


@kernel
def into_gamut(primaries, bounded, soft, red, green, blue):
    """Scalar form of ``in_gamut``."""
    long, medium, short = cone_roots_of(signed_light(red), signed_light(green), signed_light(blue))
    lightness = lightness_of(long, medium, short)
    if not lightness > 0.0:
        return 0.0, 0.0, 0.0
    if bounded and 1.0 - lightness * lightness * lightness <= _LEAST:
        return 1.0, 1.0, 1.0
    r, g, b = with_primaries(primaries, signed_light(red), signed_light(green), signed_light(blue))
    return within_gamut(
        primaries,
        lightness,
        bounded,
        long - lightness,
        medium - lightness,
        short - lightness,
        r,
        g,
        b,
        soft,
    )


@compiled_loop
def gamut_pixels(colors, out, primaries, bounded, soft):
    """``into_gamut`` of all colours."""
    for i in range(colors.shape[0]):
        r, g, b = np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        out[i, 0], out[i, 1], out[i, 2] = into_gamut(primaries, bounded, soft, r, g, b)


def in_gamut(
    rgb: ArrayLike, primaries: str = "srgb", *, bounded: bool = True, soft: bool = True
) -> NDArray[Any]:
    r"""Colours mapped into a display's gamut by reduction of chroma.

    With the chroma :math:`s` relative to the gamut boundary, colours beyond :math:`k = 0.8` get the
    relative chroma :math:`k + (e - k)(1 - e^{-(s-k)/(e-k)})`, :math:`e = 0.96`.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB; channels may be negative. [1]
    primaries : str
        Name from ``PRIMARIES``.
    bounded : bool
        Whether channels are bounded by 1, as displayed values are.
    soft : bool
        Whether colours near the edge make room for those beyond, which else lie on the edge.

    Returns
    -------
    array, shape (..., 3)
        Linear light of those primaries, same floating type. [1]

    References
    ----------
    Ottosson (2021), "sRGB gamut clipping", on the projection to grey; the compression is
    airlight's.

    Examples
    --------
    >>> in_gamut([[0.2, 0.3, 0.4], [1.0, -0.2, 0.1]]).round(3)
    array([[0.2  , 0.3  , 0.4  ],
           [0.423, 0.005, 0.111]])
    """
    return each_pixel(gamut_pixels, rgb, primaries_number(primaries), bounded, soft)

"""Exposure: factor from radiance to display, explicit or metered."""

from __future__ import annotations

import math
from math import exp, log2
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.adaptation import KEY, NIGHT, adapted_key, shown_key
from airlight.image.cool_exposure import cool_limit, cool_shares
from airlight.image.lamp_exposure import brightest_light, lamps_shorter
from airlight.image.xyz import luminance, luminance_of
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.large_arrays import release
from airlight.physics.constants import LUMINOUS_EFFICACY

#: Default exposure for the sunlit Earth, if none is measured. [EV]
DEFAULT_EXPOSURE: Final = -4.0
#: Largest magnitude of an exposure. [EV]
MOST_EXPOSURE: Final = 100.0
#: Largest displayed level of the bright quarter at its lower end, and of the highlights. [1]
_BRIGHT: Final = 0.7
_HIGHLIGHT: Final = 1.8
#: Fractions of the lit part below the bright quarter and below the highlights, and between which it
#: determines the key: without shade, and without glint or the glow of a low sun.
_QUARTER: Final = 0.75
_BRIGHT_SHARE: Final = 0.96
_SHADE: Final = 0.25
_GLINT: Final = 0.8
#: Largest reduction of the exposure for the bright quarter and the highlights, and of a picture
#: without black space. [EV]
_PROTECTION: Final = 2.5
#: Least displayed level of a white surface that faces the star, for highlights. [1]
_WHITE: Final = 0.75
#: Pixels darker than this fraction of the bright end are ignored, such as black space.
_DARK: Final = 1e-4
#: Fraction of all pixels that may be brighter than the brightest one that counts as lit.
_DISCS: Final = 0.005
#: Light over that of the lit part from which on a pixel begins to be lit, and is. [1]
_UNLIT: Final = 1.0 / 500.0
_LIT: Final = 1.0 / 60.0
#: Light of a red pixel over its red channel, which saturates long before the luminance of a low sun
#: and its sky; of other colours the luminance counts. [1]
_RED: Final = 0.62
#: Luminance over that of white of a dark body, such as the Moon or a cloudless Earth, which black
#: space is assumed to hold on this fraction of the picture: five pixels of a metered frame. [1]
_BODY: Final = 0.12
_UNSEEN: Final = 5e-4
#: Factor of the key and of the highlights where most of the picture is black space, and exponent of
#: the fraction that is not: as photographers expose a planet, dark with bright parts. [1]
_LOW_KEY: Final = 0.5
_LIT_POWER: Final = 0.5
#: Largest reduction of the key of a picture that consists of dark things in full light, such as
#: blue sky, grass and the sea from above, how much darker than white they are then [EV], and the
#: powers up to there and beyond [1]: a camera exposes them nearer to "sunny 16".
_FULL_LIGHT: Final = 0.8
_DARKER: Final = 2.25
_RISE, _FALL = 7.0, 3.0
#: Approximate number of pixels sampled, every k-th row and column.
SAMPLE: Final = 32_768
#: Rows that are sampled before the memory of a large picture is released.
_ROWS: Final = 8


def exposure_factor(exposure: float) -> float:
    """Exposure factor of radiance: 2^EV.

    Parameters
    ----------
    exposure : float
        Exposure, -100 to 100. [EV]

    Returns
    -------
    float
        Factor. [1]

    Raises
    ------
    ParameterError
        If it is outside that range, or not a number.

    Examples
    --------
    >>> exposure_factor(-2.0)
    0.25
    """
    known = isinstance(exposure, (int, float, np.number))
    if not (known and -MOST_EXPOSURE <= exposure <= MOST_EXPOSURE):
        raise ParameterError("exposure", exposure, '-100 to 100 EV, or "auto"')
    return math.pow(2.0, float(exposure))


@kernel
def metered_light(red, green, blue):
    """Light of a pixel that is metered: its luminance, or 0.62 of its red. [W m⁻² sr⁻¹]

    Parameters
    ----------
    red, green, blue : float
        Linear sRGB. [W m⁻² sr⁻¹]
    """
    return max(luminance_of(red, green, blue), _RED * red)


@kernel
def full_light_factor(stops):
    r"""Factor of the key of a picture whose things are darker than white in the star's light. [1]

    .. math:: \log_2 f = -0.8\,u^p e^{p (1 - u^2) / 2}, \quad u = x / 2.25

    Where the key alone would show white as 2^x, x about 2.25, things are dark and not their light:
    they are shown darker. Near a low sun x is about 1, in haze 1.4, at dusk above 5. The exponent p
    is 7 below 2.25 and 3 above, where less light lengthens the exposure by half again at most.

    Parameters
    ----------
    stops : float
        Exposure by the key above that which shows white as white. [EV]

    Examples
    --------
    >>> full_light_factor(-1.0), round(full_light_factor(2.25), 2), round(full_light_factor(6.0), 2)
    (1.0, 0.57, 1.0)
    """
    x = max(stops, 0.0) / _DARKER
    power = _RISE if x < 1.0 else _FALL
    return 2.0 ** (-_FULL_LIGHT * x**power * exp(0.5 * power * (1.0 - x * x)))


@kernel
def lit_share(bright, end):
    """Weight of a pixel in the lit part of a picture, from 0 to 1 where it is lit. [1]

    Parameters
    ----------
    bright : float
        Light of the pixel. [W m⁻² sr⁻¹]
    end : float
        Light of the lit part; 0 if all pixels count. [W m⁻² sr⁻¹]
    """
    if end <= 0.0:
        return 1.0
    x = min(max(log2(bright / (_UNLIT * end)) / log2(_LIT / _UNLIT), 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


@inlined
def weighted_index(bright, weight, first, end, share):
    """Index at which the weight of the lit part from ``first`` on reaches a fraction of its total.

    Parameters
    ----------
    bright, weight : array, shape (n,)
        Arguments of ``exposure_of``.
    first : int
        First index.
    end : float
        Argument of ``lit_share``. [W m⁻² sr⁻¹]
    share : float
        Fraction. [1]
    """
    total = 0.0
    for i in range(first, weight.size):
        total += weight[i] * lit_share(bright[i], end)
    reached = 0.0
    for i in range(first, weight.size):
        reached += weight[i] * lit_share(bright[i], end)
        if reached >= share * total:
            return i
    return weight.size - 1


@inlined
def lit_end(bright, weight, first):
    """Light of the lit part: pixels at least that bright have half of the whole light.

    It hardly depends on how much dark there is around a crescent or an arc. The brightest half per
    cent, such as a sun, counts no more than the next. [W m⁻² sr⁻¹]

    Parameters
    ----------
    bright, weight, first :
        Arguments of ``weighted_index``.
    """
    most = bright[weighted_index(bright, weight, first, 0.0, 1.0 - _DISCS)]
    total = 0.0
    for i in range(first, weight.size):
        total += weight[i] * min(bright[i], most)
    reached = 0.0
    for i in range(first, weight.size):
        reached += weight[i] * min(bright[i], most)
        if reached >= 0.5 * total:
            return min(bright[i], most)
    return most


@kernel
def unlit_exposure(white):
    """Exposure of a picture without any light. [EV]

    That of a night without moon or stars, or of a dark body in black space.

    Parameters
    ----------
    white : float
        Argument of ``exposure_of``. [W m⁻² sr⁻¹]
    """
    if white > 0.0:
        return log2(_LOW_KEY * KEY / (_BODY * white))
    return log2(shown_key(NIGHT) * LUMINOUS_EFFICACY / NIGHT)


@compiled_loop
def exposure_of(bright, weight, cool, black, white):
    """Exposure of a picture, see ``automatic_exposure``. [EV]

    Parameters
    ----------
    bright : array, shape (n,)
        Light of the pixels, ``metered_light`` above 0, ascending, not empty. [W m⁻² sr⁻¹]
    weight : array, shape (n,)
        Weights of these pixels. [1]
    cool : array, shape (n,)
        Their ``cool_share``. [1]
    black : float
        Weight of black pixels. [1]
    white : float
        Luminance of a white surface that faces the star; 0 if unknown. [W m⁻² sr⁻¹]
    """
    first = 0
    dark = _DARK * bright[weighted_index(bright, weight, first, 0.0, 0.99)]
    while bright[first] < dark:
        first += 1
    end = lit_end(bright, weight, first)
    quarter = bright[weighted_index(bright, weight, first, end, _QUARTER)]
    high = bright[weighted_index(bright, weight, first, end, _BRIGHT_SHARE)]
    low = weighted_index(bright, weight, first, end, _SHADE)
    top = weighted_index(bright, weight, first, end, _GLINT)
    lit, whole, total, count = 0.0, black, 0.0, 0.0
    for i in range(bright.size):
        whole += weight[i]
        if i >= first:
            part = weight[i] * lit_share(bright[i], end)
            lit += part
            if low <= i <= top:
                total += part * log2(bright[i])
                count += part
    if white > 0.0:
        unseen = _UNSEEN * (whole - lit)
        total += unseen * log2(_BODY * white)
        count += unseen
    key = 2.0 ** (total / max(count, 1e-300))
    shown = shown_key(LUMINOUS_EFFICACY * key)
    # lamps may be as bright in a long exposure as they are above the rest of it
    longer = shown / adapted_key(LUMINOUS_EFFICACY * key)
    low_key = max((lit / max(whole, 1e-300)) ** _LIT_POWER, _LOW_KEY)
    dimmed = low_key
    exposure = log2(shown / max(key, NIGHT / LUMINOUS_EFFICACY))
    if white > 0.0:
        dimmed = min(dimmed, full_light_factor(exposure + log2(white)))
    exposure += log2(dimmed)
    if longer > 1.0:
        exposure -= lamps_shorter(brightest_light(bright, weight, black) / key, longer)
    limited = min(exposure, log2(longer * shown / KEY * _BRIGHT / quarter))
    if white > 0.0:
        exposure = max(exposure, -log2(white))
        limited = max(limited, -log2(white))
    limited = min(limited, log2(longer * shown / KEY * low_key * _HIGHLIGHT / high))
    limited = max(limited, exposure - _PROTECTION + log2(low_key))
    if white > 0.0:
        limited = max(limited, log2(_WHITE / white))
    bluer = cool_limit(bright, weight, cool, whole)
    limited = min(limited, max(bluer, exposure - _PROTECTION + log2(low_key)))
    return min(max(limited, -MOST_EXPOSURE), MOST_EXPOSURE)


def sampling_step(height: int, width: int) -> int:
    """Step between metered rows and columns of a picture. [pixel]"""
    return max(1, math.isqrt(height * width // SAMPLE))


def sampled(rgb: NDArray[np.floating], step: int) -> NDArray[np.float64]:
    """Subsampled picture.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Picture.
    step : int
        Step between rows and columns. [pixel]

    Returns
    -------
    array, shape (ceil(height / step), ceil(width / step), 3)
        Copy.
    """
    rows = rgb[::step, ::step]
    out = np.empty(rows.shape)
    for number, row in enumerate(rows):
        out[number] = row
        if number % _ROWS == 0:  # a row of a large picture brings its neighbours into memory
            release(rgb)
    return out


def metered_pixels(
    rgb: NDArray[np.floating], step: int, weights: NDArray[np.floating] | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """``metered_light`` and ``cool_share`` of a subsampled picture.

    Parameters
    ----------
    rgb, step :
        Arguments of ``sampled``.
    weights : array, shape (ceil(height / step), ceil(width / step)), optional
        Weights of its pixels, below 0 for those without part in its mean; default: equal.

    Returns
    -------
    bright, cool : array, shape (ceil(height / step), ceil(width / step))
        Light of the pixels [W m⁻² sr⁻¹], and shares [1].
    """
    chosen = sampled(rgb, step)
    red, blue = chosen[..., 0], chosen[..., 2]
    bright = np.maximum(luminance(chosen), _RED * red)
    own = np.ones(red.shape) if weights is None else np.maximum(weights, 0.0)
    return bright, cool_shares(red, blue, np.where(bright < np.inf, own, 0.0))


def automatic_exposure(
    rgb: NDArray[np.floating], weights: NDArray[np.floating] | None = None, white: float = 0.0
) -> float:
    r"""Automatic exposure of a picture, for a simulated state of adaptation.

    A pixel counts by its light :math:`L`, the larger of its luminance and 0.62 of its red. The lit
    part are the pixels brighter than about a hundredth of :math:`L_h`; those at least as bright as
    :math:`L_h` have half of the picture's light. Of the lit part :math:`\bar L` is the geometric
    mean between the 25 and 80 % quantiles, without shade and glint, and :math:`L_{75}` and
    :math:`L_{96}` are quantiles. With the luminance :math:`L_w` of a white surface that faces the
    star,

    .. math:: 2^\mathrm{EV} = \min\left(\max\left(
              \min\left(\frac{0.42\,d\,a}{\bar L}, \frac{0.7\,a}{L_{75}}\right),
              \frac{1}{L_w}\right), \frac{1.8\,b\,a}{L_{96}}\right),
              \quad a = \left(1 + \frac{34\ \mathrm{cd\,m^{-2}}}
              {\max(\bar L, 10^{-4}\ \mathrm{cd\,m^{-2}})}\right)^{-1/3}

    but at least :math:`0.75/L_w`. As far as the brightest fiftieth of the picture is bluer than the
    rest, it may have 1.1 (``cool_exposure``). Both are at most :math:`2.5 - \log_2 b` EV below the
    larger of the key's :math:`0.42\,d\,a/\bar L` and :math:`1/L_w`. Here :math:`\bar L` is at least
    1e-4 cd m⁻², and :math:`b = d` is the square root of the lit fraction of the picture, at least
    0.5: bright parts of a crescent keep their detail. By day a is 1, independent of the light
    level; in the dark the picture darkens with the cube root of luminance. A white surface is thus
    shown as white, and clouds and snow brighter than soil, whatever a picture consists of. With the
    star known, d is at most ``full_light_factor``: blue sky and dark ground in sunlight are not
    exposed as if they were grey.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB; of a large picture some 30 000 pixels on a regular grid are used.
        [W m⁻² sr⁻¹]
    weights : array, shape (height, width), optional
        Weights of the pixels, such as solid angles; default: equal.
    white : float, optional
        Luminance of a white surface that faces the star, irradiance over π; 0 if unknown.
        [W m⁻² sr⁻¹]

    Returns
    -------
    float
        Exposure, -100 to 100; of a black picture that of the night, or of a dark body in the light
        of the star. [EV]

    References
    ----------
    Reinhard et al. (2002), ACM Trans. Graph. 21, 267, on the key; Krawczyk, Myszkowski & Seidel
    (2005), SCCG, 195, on keys that depend on luminance; Stevens & Stevens (1963), J. Opt. Soc. Am.
    53, 375, on the cube root. The constants are airlight's.

    Examples
    --------
    >>> grey = np.full((2, 2, 3), 10.0)
    >>> f"{automatic_exposure(0.5 * grey) - automatic_exposure(grey):.2f}"  # half the light
    '1.00'
    """
    height, width = rgb.shape[:2]
    step = sampling_step(height, width)
    own = None if weights is None else weights[::step, ::step]
    bright, cool = (one.ravel() for one in metered_pixels(rgb, step, own))
    weight = np.ones(bright.size) if own is None else own.ravel()
    counted = np.isfinite(bright) & (bright > 0.0) & (weight > 0.0)
    black = float(weight[np.isfinite(bright) & ~counted].sum())
    bright, weight = bright[counted], np.asarray(weight[counted], dtype=np.float64)
    cool = cool[counted]
    if bright.size == 0:
        return float(unlit_exposure(white))
    order = np.argsort(bright)
    return float(exposure_of(bright[order], weight[order], cool[order], black, white))


@kernel
def eased(before, wanted, seconds, time_constant):
    """Exposure with exponential adaptation e^{-t/τ} towards another. [EV]

    Parameters
    ----------
    before, wanted : float
        Initial and final exposure. [EV]
    seconds : float
        Elapsed time. [s]
    time_constant : float
        Time constant τ; 0 for no delay. [s]
    """
    if time_constant <= 0.0:
        return wanted
    return wanted + (before - wanted) * math.exp(-seconds / time_constant)

"""Tone maps by name, with their inverses: exposed light to displayed light from 0 to 1.

They map linear sRGB, shape (..., 3), to linear sRGB of the same floating type. Negative light and
NaN count as black, infinite light as very bright.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.aces import aces, aces_color, aces_inverse
from airlight.image.agx import agx, agx_color, agx_inverse
from airlight.image.floating import each, each_pixel, physical, physical_light
from airlight.image.gamut import into_gamut, with_primaries
from airlight.image.natural import (
    STYLES,
    natural,
    natural_color,
    natural_inverse,
    natural_shown,
    style_contrast,
)
from airlight.image.xyz import luminance, luminance_of
from airlight.kernel import compiled_loop, kernel
from airlight.kernel.choice import chosen_kernel

# Hable's shoulder strength, linear strength, linear angle, toe strength, numerator, denominator.
_A: Final = 0.15
_B: Final = 0.50
_C: Final = 0.10
_D: Final = 0.20
_E: Final = 0.02
_F: Final = 0.30
_BIAS: Final = 2.0
_WHITE: Final = 11.2
#: Value of Hable's curve at the white point, by which it is divided.
_AT_WHITE: Final = (_WHITE * (_A * _WHITE + _C * _B) + _D * _E) / (
    _WHITE * (_A * _WHITE + _B) + _D * _F
) - _E / _F

#: Luminance that the extended Reinhard curve maps to white.
REINHARD_WHITE: Final = 4.0


@kernel
def exponential_curve(x):
    """Value 1 - e^{-x}. [1]"""
    return 1.0 - math.exp(-x)


@kernel
def exponential_curve_inverse(y):
    """Value -ln(1 - y). [1]"""
    return -math.log(1.0 - y)


@kernel
def hable_curve(light):
    """Hable's filmic curve of twice the linear value, over its value at white, at most 1. [1]"""
    x = _BIAS * light
    x = x if x < _WHITE else _WHITE
    curve = (x * (_A * x + _C * _B) + _D * _E) / (x * (_A * x + _B) + _D * _F) - _E / _F
    return curve / _AT_WHITE


@kernel
def hable_curve_inverse(y):
    """Root x ≥ 0 of A(1 - t) x² + B(C - t) x + D(E - tF) = 0, halved; t = y·white + E/F. [1]"""
    t = y * _AT_WHITE + _E / _F
    a = _A * (1.0 - t)
    b = _B * (_C - t)
    c = _D * (_E - t * _F)
    return (math.sqrt(b * b - 4.0 * a * c) - b) / (2.0 * a) / _BIAS


@kernel
def exponential_shown(light):
    """Scalar form of ``exponential``, for one channel. [1]"""
    return exponential_curve(physical_light(light))


@kernel
def hable_shown(light):
    """Scalar form of ``hable``, for one channel. [1]"""
    return max(hable_curve(physical_light(light)), 0.0)


@kernel
def exponential_color(red, green, blue):
    """Scalar form of ``exponential``."""
    return exponential_shown(red), exponential_shown(green), exponential_shown(blue)


@kernel
def hable_color(red, green, blue):
    """Scalar form of ``hable``."""
    return hable_shown(red), hable_shown(green), hable_shown(blue)


@kernel
def reinhard_color(red, green, blue):
    """Scalar form of ``reinhard``."""
    r, g, b = physical_light(red), physical_light(green), physical_light(blue)
    darkening = 1.0 / (1.0 + luminance_of(r, g, b))
    return r * darkening, g * darkening, b * darkening


@kernel
def reinhard_extended_color(red, green, blue, white):
    """Scalar form of ``reinhard_extended``."""
    r, g, b = physical_light(red), physical_light(green), physical_light(blue)
    bright = luminance_of(r, g, b)
    darkening = (1.0 + bright / (white * white)) / (1.0 + bright)
    return r * darkening, g * darkening, b * darkening


@kernel
def reinhard_extended_default_color(red, green, blue):
    """Scalar form of ``reinhard_extended`` with its default white."""
    return reinhard_extended_color(red, green, blue, REINHARD_WHITE)


@compiled_loop
def reinhard_pixels(colors, out):
    """Apply ``reinhard_color`` to every colour."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = reinhard_color(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )


@compiled_loop
def reinhard_extended_pixels(colors, out, white):
    """Apply ``reinhard_extended_color`` to every colour."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = reinhard_extended_color(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2]), white
        )


def exponential(rgb: ArrayLike) -> NDArray[Any]:
    """Exponential tone map: each channel by 1 - e^{-x}.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, 0 to 1, same floating type. [1]

    References
    ----------
    Costa et al., OpenSpace's atmospheres: its tone map; a film's response to light.

    Examples
    --------
    >>> exponential([0.0, 1.0, np.inf]).round(4)
    array([0.    , 0.6321, 1.    ])
    """
    return each(exponential_shown, rgb)


def exponential_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Inverse of ``exponential``; infinite for 1."""
    return each(exponential_curve_inverse, np.minimum(physical(rgb), 1.0))


def hable(rgb: ArrayLike) -> NDArray[Any]:
    """Hable's filmic tone map of each channel: toe, linear part, shoulder that ends at 5.6.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure; 5.6 and above is white. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, 0 to 1, same floating type. [1]

    References
    ----------
    Hable (2010), "Filmic Tonemapping Operators": A to F, exposure bias 2, white 11.2.

    Examples
    --------
    >>> hable([0.0, 1.0, 5.6]).round(4) + 0.0
    array([0.    , 0.4929, 1.    ])
    """
    return each(hable_shown, rgb)


def hable_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Inverse of ``hable``, from 0 to 5.6."""
    return each(hable_curve_inverse, np.minimum(physical(rgb), 1.0))


def reinhard(rgb: ArrayLike) -> NDArray[Any]:
    """Reinhard's tone map: luminance by L / (1 + L), at constant ratios of the channels.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure. [1]

    Returns
    -------
    array, shape (..., 3)
        Luminance below 1, single channels up to 14 (pure blue); same floating type. [1]

    References
    ----------
    Reinhard et al. (2002), ACM Trans. Graph. 21, 267, eq. 3. doi:10.1145/566654.566575

    Examples
    --------
    >>> reinhard([1.0, 1.0, 1.0]).round(4)
    array([0.5, 0.5, 0.5])
    """
    return each_pixel(reinhard_pixels, rgb)


def reinhard_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Inverse of ``reinhard``, for luminance below 1."""
    shown = physical(rgb)
    darkening = np.maximum(1.0 - luminance(shown)[..., None], np.finfo(shown.dtype).eps)
    return np.asarray(shown / darkening)


def reinhard_extended(rgb: ArrayLike, white: float = REINHARD_WHITE) -> NDArray[Any]:
    r"""Reinhard's tone map with a white point.

    .. math:: L_d = L (1 + L/L_w^2) / (1 + L)

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure. [1]
    white : float
        Smallest luminance that is mapped to 1; above 0. [1]

    Returns
    -------
    array, shape (..., 3)
        Luminance above 1 beyond the white point; same floating type. [1]

    Raises
    ------
    ParameterError
        If ``white`` is not a positive number.

    References
    ----------
    Reinhard et al. (2002), ACM Trans. Graph. 21, 267, eq. 4. doi:10.1145/566654.566575

    Examples
    --------
    >>> reinhard_extended([4.0, 4.0, 4.0]).round(4)
    array([1., 1., 1.])
    """
    _check_white(white)
    return each_pixel(reinhard_extended_pixels, rgb, white)


def reinhard_extended_inverse(rgb: ArrayLike, white: float = REINHARD_WHITE) -> NDArray[Any]:
    """Inverse of ``reinhard_extended``: root of L² / L_w² + (1 - L_d) L - L_d = 0."""
    _check_white(white)
    shown = physical(rgb)
    target = luminance(shown)[..., None].astype(np.float64)
    half = 0.5 * white * (1.0 - target)
    # The larger root, without cancellation when half > 0.
    root = np.sqrt(half * half + target)
    light = white * np.where(half > 0.0, target / (root + np.abs(half)), root - half)
    ratio = np.divide(light, target, out=np.ones_like(light), where=target > 0.0)
    return np.asarray((shown * ratio).astype(shown.dtype))


def _check_white(white: float) -> None:
    if not 0.0 < white < math.inf:
        raise ParameterError("white", white, "above 0, finite")


class ToneMap(NamedTuple):
    """Tone map, its inverse, and the kernel that maps one colour.

    Attributes
    ----------
    forward, inverse : callable
        Functions of linear sRGB, shape (..., 3).
    color : kernel
        Function of the red, green and blue of one colour; the same as ``forward``.
    """

    forward: Callable[[ArrayLike], NDArray[Any]]
    inverse: Callable[[ArrayLike], NDArray[Any]]
    color: Callable[[float, float, float], tuple[float, float, float]]


#: Tone maps by name. A new one needs a module in this package and a line here.
TONE_MAPS: Final[dict[str, ToneMap]] = {
    "natural": ToneMap(natural, natural_inverse, natural_color),
    "exponential": ToneMap(exponential, exponential_inverse, exponential_color),
    "hable": ToneMap(hable, hable_inverse, hable_color),
    "reinhard": ToneMap(reinhard, reinhard_inverse, reinhard_color),
    "reinhard-extended": ToneMap(
        reinhard_extended, reinhard_extended_inverse, reinhard_extended_default_color
    ),
    "aces": ToneMap(aces, aces_inverse, aces_color),
    "agx": ToneMap(agx, agx_inverse, agx_color),
}

#: ``_curved(which, red, green, blue)``: one colour by a tone map, indexed from 0, other than
#: ``natural``, the first, which includes the gamut mapping.
_curved = chosen_kernel("curved", [one.color for one in TONE_MAPS.values()][1:], __name__)


@kernel
def shown_light(which, primaries, style, red, green, blue):
    """Displayed light, 0 to 1, from exposed light: tone map and gamut mapping.

    Except for ``natural``, ``in_gamut`` removes negative channels before the tone map, and channels
    above white are mapped to the gamut boundary at constant hue.

    Parameters
    ----------
    which : int
        Index in ``TONE_MAPS``.
    primaries : int
        Index in ``PRIMARIES``.
    style : int
        Index in ``STYLES``, of ``natural`` alone.
    red, green, blue : float
        Linear sRGB after exposure; channels may be negative. [1]

    Returns
    -------
    red, green, blue : float
        Linear light of the display's primaries. [1]
    """
    if which == 0:
        return natural_shown(primaries, style_contrast(style), red, green, blue)
    red, green, blue = into_gamut(0, False, True, red, green, blue)
    red, green, blue = _curved(which - 1, red, green, blue)
    if max(red, max(green, blue)) > 1.0:
        red, green, blue = into_gamut(0, True, False, red, green, blue)
    return with_primaries(primaries, red, green, blue)


def style_number(name: str) -> int:
    """Index of a style in ``STYLES``.

    Raises
    ------
    ParameterError
        If there is no such style.
    """
    if name not in STYLES:
        raise ParameterError("style", name, ", ".join(STYLES))
    return list(STYLES).index(name)


def tone_map_named(name: str) -> ToneMap:
    """Tone map by name.

    Raises
    ------
    ParameterError
        If there is no such tone map.

    Examples
    --------
    >>> tone_map_named("hable").forward([1.0, 1.0, 1.0]).round(4)
    array([0.4929, 0.4929, 0.4929])
    """
    if name not in TONE_MAPS:
        raise ParameterError("tone_map", name, ", ".join(TONE_MAPS))
    return TONE_MAPS[name]

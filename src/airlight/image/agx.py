"""AgX, Sobotka's tone map: highlights desaturate to white without a hue shift."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.image.floating import each, each_pixel, physical, physical_light
from airlight.kernel import compiled_loop, kernel

#: Linear sRGB to the inset space in which the curve works; rows sum to 1 within 1.4e-4.
_INSET: Final = np.array(
    [
        [0.842479062253094, 0.0784335999999992, 0.0792237451477643],
        [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
        [0.0423756549057051, 0.0784336, 0.879142973793104],
    ]
)
#: Inset space to linear sRGB.
_OUTSET: Final = np.linalg.inv(_INSET)
# The same numbers as arguments of a kernel.
(_RR, _RG, _RB), (_GR, _GG, _GB), (_BR, _BG, _BB) = _INSET.tolist()
(_OUT_RR, _OUT_RG, _OUT_RB), (_OUT_GR, _OUT_GG, _OUT_GB), (_OUT_BR, _OUT_BG, _OUT_BB) = (
    _OUTSET.tolist()
)
#: Range of the curve below and above middle grey, 0.18: 10 and 6.5 stops.
_DARKEST: Final = -10.0
_STOPS: Final = 16.5
_GREY: Final = 0.18
#: Fixed point of the curve: middle grey goes to 0.5, with slope 2.
_PIVOT: Final = 10.0 / 16.5
_SLOPE: Final = 2.0
_TOE: Final = 3.0
_SHOULDER: Final = 3.25


def _scale(x: float, y: float, power: float) -> float:
    """Scale of the hyperbola through 0 or 1, x and y away from the fixed point."""
    return float(((_SLOPE * x) ** -power * ((_SLOPE * x / y) ** power - 1.0)) ** (-1.0 / power))


_TOE_SCALE: Final = _scale(_PIVOT, 0.5, _TOE)
_SHOULDER_SCALE: Final = _scale(1.0 - _PIVOT, 0.5, _SHOULDER)


@kernel
def agx_curve(light):
    """Display value of one insetted channel: log₂, then a hyperbolic sigmoid. [1]"""
    least = _GREY * 2.0**_DARKEST
    x = (math.log2((light if light > least else least) / _GREY) - _DARKEST) / _STOPS - _PIVOT
    x = x if x < 1.0 - _PIVOT else 1.0 - _PIVOT
    if x < 0.0:
        t = -_SLOPE * x / _TOE_SCALE
        y = 0.5 - _TOE_SCALE * t / (1.0 + t**_TOE) ** (1.0 / _TOE)
    else:
        t = _SLOPE * x / _SHOULDER_SCALE
        y = 0.5 + _SHOULDER_SCALE * t / (1.0 + t**_SHOULDER) ** (1.0 / _SHOULDER)
    return y if y > 0.0 else 0.0


@kernel
def agx_curve_inverse(value):
    """Inverse of ``agx_curve``, between the darkest and brightest value. [1]"""
    y = (value if value > 0.0 else 0.0) - 0.5
    y = y if y < 0.5 else 0.5
    if y < 0.0:
        t = -y / _TOE_SCALE
        x = -t / (1.0 - t**_TOE) ** (1.0 / _TOE) * _TOE_SCALE / _SLOPE
    else:
        t = y / _SHOULDER_SCALE
        x = t / (1.0 - t**_SHOULDER) ** (1.0 / _SHOULDER) * _SHOULDER_SCALE / _SLOPE
    return _GREY * 2.0 ** ((x + _PIVOT) * _STOPS + _DARKEST)


@kernel
def agx_color(red, green, blue):
    """Scalar form of ``agx``."""
    r, g, b = physical_light(red), physical_light(green), physical_light(blue)
    x = agx_curve(_RR * r + _RG * g + _RB * b)
    y = agx_curve(_GR * r + _GG * g + _GB * b)
    z = agx_curve(_BR * r + _BG * g + _BB * b)
    return (
        min(max(_OUT_RR * x + _OUT_RG * y + _OUT_RB * z, 0.0), 1.0) ** 2.2,
        min(max(_OUT_GR * x + _OUT_GG * y + _OUT_GB * z, 0.0), 1.0) ** 2.2,
        min(max(_OUT_BR * x + _OUT_BG * y + _OUT_BB * z, 0.0), 1.0) ** 2.2,
    )


@compiled_loop
def agx_pixels(colors, out):
    """``agx_color`` of all colours."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = agx_color(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )


def agx(rgb: ArrayLike) -> NDArray[Any]:
    """AgX tone map of exposed light.

    Inset, log₂ over 16.5 stops around middle grey, sigmoid, outset, conversion of display values
    (power 2.2) to linear light. The sigmoid is Sobotka's, not the polynomial fit (largest
    difference 0.006).

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB after exposure; negative values count as 0. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB of the display, 0 to 1, same floating type. [1]

    References
    ----------
    Sobotka, AgX (2022), github.com/sobotka/AgX: curve and its parameters; Wrensch, "Minimal AgX
    Implementation" (2023): the inset matrix for linear sRGB, whose inverse is the outset.

    Examples
    --------
    >>> (agx([0.18, 0.18, 0.18]) ** (1 / 2.2)).round(3)  # middle grey goes to 0.5
    array([0.5, 0.5, 0.5])
    """
    return each_pixel(agx_pixels, rgb)


def agx_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Inverse of ``agx``, exact where it does not clip.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB of the display, 0 to 1. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same floating type; negative where no light is mapped to the colour. [1]
    """
    shown = np.clip(physical(rgb), 0.0, 1.0)
    values = shown ** shown.dtype.type(1.0 / 2.2)
    light = each(agx_curve_inverse, values @ _INSET.T.astype(shown.dtype))
    return np.asarray(light @ _OUTSET.T.astype(shown.dtype))

"""ACES filmic tone map: Hill's fit of the reference rendering and output transforms."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.image.floating import each, each_pixel, physical, physical_light
from airlight.kernel import compiled_loop, kernel

#: Linear sRGB to the fit's input space (D65 to D60, AP1, desaturation of the RRT).
_INPUT: Final = np.array(
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]]
)
#: The fit's output space to linear sRGB.
_OUTPUT: Final = np.array(
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]]
)
# The same numbers as arguments of a kernel.
(_RR, _RG, _RB), (_GR, _GG, _GB), (_BR, _BG, _BB) = _INPUT.tolist()
(_OUT_RR, _OUT_RG, _OUT_RB), (_OUT_GR, _OUT_GG, _OUT_GB), (_OUT_BR, _OUT_BG, _OUT_BB) = (
    _OUTPUT.tolist()
)


@kernel
def aces_curve(x):
    """Hill's rational curve, y = (x (x + a) - b) / (x (c x + d) + e). [1]"""
    return (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081)


@kernel
def aces_curve_inverse(y):
    """Root x ≥ 0 of (1 - c y) x² + (a - d y) x - (b + e y) = 0, for y up to 1.016. [1]"""
    a = 1.0 - 0.983729 * y
    b = 0.0245786 - 0.4329510 * y
    c = -(0.000090537 + 0.238081 * y)
    root = b * b - 4.0 * a * c
    return (math.sqrt(root if root > 0.0 else 0.0) - b) / (2.0 * a)


@kernel
def aces_color(red, green, blue):
    """Scalar form of ``aces``."""
    r, g, b = physical_light(red), physical_light(green), physical_light(blue)
    x = aces_curve(_RR * r + _RG * g + _RB * b)
    y = aces_curve(_GR * r + _GG * g + _GB * b)
    z = aces_curve(_BR * r + _BG * g + _BB * b)
    return (
        min(max(_OUT_RR * x + _OUT_RG * y + _OUT_RB * z, 0.0), 1.0),
        min(max(_OUT_GR * x + _OUT_GG * y + _OUT_GB * z, 0.0), 1.0),
        min(max(_OUT_BR * x + _OUT_BG * y + _OUT_BB * z, 0.0), 1.0),
    )


@compiled_loop
def aces_pixels(colors, out):
    """``aces_color`` of all colours."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = aces_color(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )


def aces(rgb: ArrayLike) -> NDArray[Any]:
    """ACES tone map of exposed light.

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
    Hill's fit of the ACES 1.0 sRGB output transform, published in Pettineo's BakingLab,
    ``ACES.hlsl`` (2016).

    Examples
    --------
    >>> aces([0.18, 0.18, 0.18]).round(3)
    array([0.106, 0.106, 0.106])
    """
    return each_pixel(aces_pixels, rgb)


def aces_inverse(rgb: ArrayLike) -> NDArray[Any]:
    """Inverse of ``aces``, exact where it does not clip.

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
    shaped = shown @ np.linalg.inv(_OUTPUT).T.astype(shown.dtype)
    light = each(aces_curve_inverse, np.minimum(shaped, 1.0))
    return np.asarray(light @ np.linalg.inv(_INPUT).T.astype(shown.dtype))

"""Mesopic and scotopic vision: Purkinje shift below some cd m⁻²."""

from __future__ import annotations

from math import log2
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.image.adaptation import seen_share
from airlight.image.floating import each_pixel
from airlight.image.xyz import RGB_TO_XYZ, XYZ_TO_RGB, luminance_of
from airlight.kernel import compiled_loop, kernel
from airlight.physics.constants import LUMINOUS_EFFICACY

#: Luminances of the mesopic range: below the first rods alone see, above the second cones alone.
#: [cd m⁻²; Jensen et al. 2000, section 5: 10^-2 and 10^0.6]
SCOTOPIC: Final = 1e-2
PHOTOPIC: Final = 10.0**0.6
#: Linear sRGB of what rods see, of the luminance 1: x = y = 0.25. [Jensen et al. 2000, section 5]
_NIGHT_RED, _NIGHT_GREEN, _NIGHT_BLUE = (float(one) for one in XYZ_TO_RGB @ (1.0, 1.0, 2.0))
#: Scotopic over photopic luminance, Y (1.33 (1 + (Y + Z)/X) - 1.68) over Y; and of D65, by which it
#: is divided so that a grey stays as bright. [Larson, Rushmeier & Piatko 1997, eq. 18]
_RODS: Final = 1.33
_LESS: Final = 1.68
_OF_D65: Final = 1.33 * (1.0 + (1.0 + 1.08883) / 0.95047) - 1.68
#: Range of this ratio for real lights: rods are insensitive to deep red, and three times as
#: sensitive to violet.
_LEAST: Final = 0.0
_MOST: Final = 3.0

(_XR, _XG, _XB), _, (_ZR, _ZG, _ZB) = RGB_TO_XYZ.tolist()


@kernel
def rod_share(bright):
    """Weight of rod vision at a luminance [cd m⁻²], from 1 in the dark to 0. [1]

    References
    ----------
    Jensen, Premože, Shirley, Thompson, Ferwerda & Stark (2000), "Night rendering", University of
    Utah UUCS-00-016, section 5: a cubic in the logarithm of the luminance.
    """
    if bright >= PHOTOPIC:
        return 0.0
    if bright <= SCOTOPIC:
        return 1.0
    x = log2(PHOTOPIC / bright) / log2(PHOTOPIC / SCOTOPIC)
    return x * x * (3.0 - 2.0 * x)


@kernel
def cones_and_rods(red, green, blue, exposure):
    """Weight of cone vision [1], and scotopic luminance times that of rods [unit of the colour].

    Parameters
    ----------
    red, green, blue : float
        Linear sRGB. [W m⁻² sr⁻¹]
    exposure : float
        Factor of a picture's exposure, for ``seen_share``; 0 for the eye alone. [1]
    """
    bright = luminance_of(red, green, blue)
    share = rod_share(LUMINOUS_EFFICACY * bright)
    if share > 0.0 and exposure > 0.0:
        share *= seen_share(exposure)
    if share <= 0.0 or not bright > 0.0:
        return 1.0, 0.0
    x = _XR * red + _XG * green + _XB * blue
    z = _ZR * red + _ZG * green + _ZB * blue
    rods = (_RODS * (1.0 + (bright + z) / max(x, 1e-3 * bright)) - _LESS) / _OF_D65
    return 1.0 - share, bright * share * min(max(rods, _LEAST), _MOST)


@kernel
def with_rods(red, green, blue, cones, rods):
    """Colour that cones see, weighted, and the bluish grey that rods see."""
    return (
        cones * red + rods * _NIGHT_RED,
        cones * green + rods * _NIGHT_GREEN,
        cones * blue + rods * _NIGHT_BLUE,
    )


@kernel
def seen_by_eye(red, green, blue):
    """Scalar form of ``mesopic``."""
    cones, rods = cones_and_rods(red, green, blue, 0.0)
    return with_rods(red, green, blue, cones, rods)


@compiled_loop
def eye_pixels(colors, out):
    """``seen_by_eye`` of all colours."""
    for i in range(colors.shape[0]):
        out[i, 0], out[i, 1], out[i, 2] = seen_by_eye(
            np.float64(colors[i, 0]), np.float64(colors[i, 1]), np.float64(colors[i, 2])
        )


def mesopic(rgb: ArrayLike) -> NDArray[Any]:
    r"""Mesopic vision of colours: desaturation, darker reds, bluish greys.

    With the weight :math:`s` of the rods, 0 above 4 and 1 below 0.01 cd m⁻², and the colour
    :math:`c_{0.25}` of luminance 1 at x = y = 0.25,

    .. math:: c' = (1 - s)\,c + s\,\frac{V}{V_{65}}\,Y\,c_{0.25}, \quad
              V = 1.33\left(1 + \frac{Y + Z}{X}\right) - 1.68

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB. [W m⁻² sr⁻¹; 683 times its luminance is cd m⁻²]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same unit and floating type.

    References
    ----------
    Jensen et al. (2000), UUCS-00-016, for share and blue; Larson, Rushmeier & Piatko (1997),
    IEEE TVCG 3, 291, eq. 18, for the scotopic luminance V Y.

    Examples
    --------
    >>> day, night = mesopic([[1.0, 0.5, 0.2], [1e-6, 0.5e-6, 0.2e-6]])
    >>> day, (night / night.max()).round(2)
    (array([1. , 0.5, 0.2]), array([0.36, 0.5 , 1.  ]))
    """
    return each_pixel(eye_pixels, rgb)

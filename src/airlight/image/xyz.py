"""Conversion between CIE XYZ and linear sRGB.

Values are tristimulus values of a radiance or irradiance, in W m⁻² (sr⁻¹) weighted by the
colour-matching functions: 683 lm/W times Y is a luminance or illuminance.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.image.floating import floating
from airlight.kernel import kernel

#: XYZ to linear sRGB, white D65; the seven decimals of Lindbloom, "RGB/XYZ Matrices".
XYZ_TO_RGB: Final[NDArray[np.float64]] = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)
XYZ_TO_RGB.flags.writeable = False

#: Linear sRGB to XYZ: the exact inverse, so that a round trip is exact to rounding.
RGB_TO_XYZ: Final[NDArray[np.float64]] = np.asarray(np.linalg.inv(XYZ_TO_RGB), np.float64)
RGB_TO_XYZ.flags.writeable = False

_RED, _GREEN, _BLUE = (float(part) for part in RGB_TO_XYZ[1])


@kernel
def luminance_of(red, green, blue):
    """Y of one colour in linear sRGB: scalar form of ``luminance``."""
    return _RED * red + _GREEN * green + _BLUE * blue


def xyz_to_rgb(xyz: ArrayLike) -> NDArray[Any]:
    """Linear sRGB of tristimulus values.

    Parameters
    ----------
    xyz : array, shape (..., 3)

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB in the same unit and floating type; negative where outside the gamut of sRGB.

    References
    ----------
    IEC 61966-2-1:1999; Lindbloom, http://www.brucelindbloom.com/index.html?Eqn_RGB_XYZ_Matrix.html

    Examples
    --------
    >>> xyz_to_rgb([0.95047, 1.0, 1.08883]).round(5) + 0.0  # D65 is white
    array([1., 1., 1.])
    """
    values = floating(xyz)
    return np.asarray(values @ XYZ_TO_RGB.T.astype(values.dtype))


def rgb_to_xyz(rgb: ArrayLike) -> NDArray[Any]:
    """Tristimulus values of linear sRGB: the inverse of ``xyz_to_rgb``.

    Parameters
    ----------
    rgb : array, shape (..., 3)

    Returns
    -------
    array, shape (..., 3)
        Tristimulus values in the same unit and floating type.

    Examples
    --------
    >>> rgb_to_xyz([1.0, 1.0, 1.0]).round(4)
    array([0.9505, 1.    , 1.0888])
    """
    values = floating(rgb)
    return np.asarray(values @ RGB_TO_XYZ.T.astype(values.dtype))


def luminance(rgb: ArrayLike) -> NDArray[Any]:
    """Y of linear sRGB.

    Parameters
    ----------
    rgb : array, shape (..., 3)

    Returns
    -------
    array, shape (...)
        Luminance in the same unit and floating type; times 683 lm/W it is in cd m⁻² or lx.

    Examples
    --------
    >>> f"{float(luminance([0.0, 1.0, 0.0])):.4f}"
    '0.7152'
    """
    values = floating(rgb)
    return np.asarray(values @ RGB_TO_XYZ[1].astype(values.dtype))


def chromaticity(xyz: ArrayLike) -> NDArray[Any]:
    """Chromaticity coordinates x, y: the colour without its magnitude.

    Parameters
    ----------
    xyz : array, shape (..., 3)

    Returns
    -------
    array, shape (..., 2)
        Values X and Y divided by X + Y + Z; 0 where that sum is 0. [1]

    Examples
    --------
    >>> chromaticity([0.95047, 1.0, 1.08883]).round(4)  # D65
    array([0.3127, 0.329 ])
    """
    values = floating(xyz)
    total = values.sum(axis=-1, keepdims=True)
    black = np.zeros_like(values[..., :2])
    return np.asarray(np.divide(values[..., :2], total, out=black, where=total != 0))

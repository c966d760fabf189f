"""OKLab, a perceptual colour space with constant hue under desaturation.

Light k times as bright has cbrt(k) times the lightness and chroma, at the same hue. White of linear
sRGB has the lightness 1.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.image.floating import floating
from airlight.kernel import kernel
from airlight.kernel.cube_root import cube_root

#: Linear sRGB to responses of the cones, each row summing to 1.
RGB_TO_CONES: Final[NDArray[np.float64]] = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
RGB_TO_CONES.flags.writeable = False
#: L, a, b to cube roots of the responses; greys have equal roots.
LAB_TO_ROOTS: Final[NDArray[np.float64]] = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
LAB_TO_ROOTS.flags.writeable = False
CONES_TO_RGB: Final[NDArray[np.float64]] = np.asarray(np.linalg.inv(RGB_TO_CONES), np.float64)
ROOTS_TO_LAB: Final[NDArray[np.float64]] = np.asarray(np.linalg.inv(LAB_TO_ROOTS), np.float64)

# The same numbers as arguments of the kernels.
(_LR, _LG, _LB), (_MR, _MG, _MB), (_SR, _SG, _SB) = RGB_TO_CONES.tolist()
(_L0, _L1, _L2), (_A0, _A1, _A2), (_B0, _B1, _B2) = ROOTS_TO_LAB.tolist()
(_, _L_A, _L_B), (_, _M_A, _M_B), (_, _S_A, _S_B) = LAB_TO_ROOTS.tolist()
(_RL, _RM, _RS), (_GL, _GM, _GS), (_BL, _BM, _BS) = CONES_TO_RGB.tolist()


@kernel
def lab_of(red, green, blue):
    """L, a and b of one colour in linear sRGB, negative channels included."""
    long, medium, short = cone_roots_of(red, green, blue)
    return (
        lightness_of(long, medium, short),
        _A0 * long + _A1 * medium + _A2 * short,
        _B0 * long + _B1 * medium + _B2 * short,
    )


@kernel
def cone_roots_of(red, green, blue):
    """Cube roots of the responses of the three cones to linear sRGB; 0 for negative ones."""
    return (
        cube_root(_LR * red + _LG * green + _LB * blue),
        cube_root(_MR * red + _MG * green + _MB * blue),
        cube_root(_SR * red + _SG * green + _SB * blue),
    )


@kernel
def lightness_of(long, medium, short):
    """Lightness of the cube roots of the cones' responses."""
    return _L0 * long + _L1 * medium + _L2 * short


@kernel
def cone_roots(lightness, a, b):
    """Cube roots of the responses of the three cones to a colour."""
    return (
        lightness + _L_A * a + _L_B * b,
        lightness + _M_A * a + _M_B * b,
        lightness + _S_A * a + _S_B * b,
    )


@kernel
def rgb_of_cones(long, medium, short):
    """Linear sRGB from the responses of the three cones."""
    return (
        _RL * long + _RM * medium + _RS * short,
        _GL * long + _GM * medium + _GS * short,
        _BL * long + _BM * medium + _BS * short,
    )


@kernel
def rgb_of(lightness, a, b):
    """Linear sRGB of one colour; negative where outside the gamut."""
    long, medium, short = cone_roots(lightness, a, b)
    return rgb_of_cones(long * long * long, medium * medium * medium, short * short * short)


def rgb_to_oklab(rgb: ArrayLike) -> NDArray[Any]:
    """OKLab of linear sRGB.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB; channels may be negative; negative cone responses are clamped to 0. [1]

    Returns
    -------
    array, shape (..., 3)
        L, a, b, same floating type. [1]

    References
    ----------
    Ottosson (2020), "A perceptual color space for image processing".

    Examples
    --------
    >>> rgb_to_oklab([1.0, 1.0, 1.0]).round(4) + 0.0
    array([1., 0., 0.])
    >>> rgb_to_oklab([1.0, 0.0, 0.0]).round(3)
    array([0.628, 0.225, 0.126])
    """
    values = floating(rgb)
    cones = np.maximum(values @ RGB_TO_CONES.T.astype(values.dtype), 0.0)
    return np.asarray(np.cbrt(cones) @ ROOTS_TO_LAB.T.astype(values.dtype))


def oklab_to_rgb(lab: ArrayLike) -> NDArray[Any]:
    """Linear sRGB of OKLab: the inverse of ``rgb_to_oklab``.

    Parameters
    ----------
    lab : array, shape (..., 3)
        L, a, b. [1]

    Returns
    -------
    array, shape (..., 3)
        Linear sRGB, same floating type; negative where outside the gamut. [1]

    Examples
    --------
    >>> oklab_to_rgb([0.627955, 0.224863, 0.125846]).round(4) + 0.0
    array([1., 0., 0.])
    """
    values = floating(lab)
    roots = values @ LAB_TO_ROOTS.T.astype(values.dtype)
    return np.asarray(roots**3 @ CONES_TO_RGB.T.astype(values.dtype))

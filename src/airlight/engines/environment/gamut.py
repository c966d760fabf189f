"""Gamut mapping to non-negative linear sRGB, for renderers that require it.

Spectral colours can be outside the sRGB gamut: the disc of a setting sun has negative blue. Colours
are desaturated towards grey in linear light until the lowest channel is 0, which preserves
luminance and its sums. The display's gamut mapping (``image.gamut``) is perceptual instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.xyz import RGB_TO_XYZ

#: Texels of a block.
_BLOCK: Final = 1 << 18


@dataclass(frozen=True, kw_only=True)
class GamutChange:
    """Effect of gamut mapping.

    Attributes
    ----------
    share : float
        Fraction of the texels that had a negative channel. [1]
    largest : float
        Largest change of a channel over the luminance of its texel. [1]
    """

    share: float
    largest: float


def grey_of(rgb: NDArray[np.floating]) -> NDArray[np.float64]:
    """Luminance of linear sRGB as the value of a grey, shape (...,)."""
    return np.asarray(np.asarray(rgb, np.float64) @ RGB_TO_XYZ[1])


def without_negatives(
    rgb: NDArray[np.floating],
) -> tuple[NDArray[np.float64], GamutChange]:
    """Map colours into the sRGB gamut at constant luminance.

    Parameters
    ----------
    rgb : array, shape (..., 3)
        Linear sRGB.

    Returns
    -------
    (array, GamutChange)
        Colours of the same luminance without negative channels; black if it is not positive.

    Examples
    --------
    >>> colour, change = without_negatives(np.array([[1.0, 0.3, -0.1], [0.1, 0.2, 0.3]]))
    >>> colour.round(3)
    array([[0.888, 0.323, 0.   ],
           [0.1  , 0.2  , 0.3  ]])
    >>> change.share
    0.5
    """
    light = np.asarray(rgb, np.float64)
    grey = grey_of(light)[..., None]
    lowest = light.min(axis=-1, keepdims=True)
    outside = lowest < 0.0
    share = np.divide(grey, grey - lowest, out=np.ones_like(grey), where=outside & (grey > 0.0))
    moved = np.maximum(grey + share * (light - grey), 0.0)
    out = np.where(outside, np.where(grey > 0.0, moved, 0.0), light)
    relative = np.abs(out - light) / np.maximum(grey, 1e-300)
    largest = float(relative[(outside & (grey > 0.0))[..., 0]].max(initial=0.0))
    return out, GamutChange(share=float(np.mean(outside)), largest=largest)


def bring_into_gamut(rgb: NDArray[np.float32]) -> GamutChange:
    """In-place ``without_negatives`` of a frame.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB, modified in place.
    """
    share, largest = 0.0, 0.0
    step = max(1, _BLOCK // max(rgb.shape[1], 1))
    for first in range(0, rgb.shape[0], step):
        block = rgb[first : first + step]
        moved, change = without_negatives(block)
        block[...] = moved
        share += change.share * block.shape[0] / rgb.shape[0]
        largest = max(largest, change.largest)
    return GamutChange(share=share, largest=largest)

"""RGBA8 texels: sRGB-encoded colours, and a linear alpha.

The CPU decodes them by a table of the 256 values, a shader by the formula.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.image.encoding import srgb_curve_inverse
from airlight.kernel import inlined

#: Channels of a texel.
CHANNELS: Final = 4
_COLOR = [srgb_curve_inverse.py_func(value / 255.0) for value in range(256)]
#: Linear value of each of the 256 values of a channel, shape (4, 256). [1]
DECODED: Final = np.array([_COLOR, _COLOR, _COLOR, [v / 255.0 for v in range(256)]], np.float32)
#: Number of entries of the table for encoding linear values: a step is less than a sixth of the
#: smallest difference between two values of sRGB, 1/3295.
_STEPS: Final = 20_000
_LIMITS: Final = [srgb_curve_inverse.py_func((code + 0.5) / 255.0) for code in range(255)]
_CODES: Final = np.searchsorted(_LIMITS, np.arange(_STEPS + 1) / _STEPS).astype(np.uint8)


@inlined
def channel_of(texels, texel, channel):
    """Decode a channel of a texel. [1]

    Parameters
    ----------
    texels : array of uint8, flat
        Texels, four values each.
    channel : int
        0 to 2 for the colours, 3 for alpha.
    """
    return DECODED[channel, texels[CHANNELS * texel + channel]]


@inlined
def code_of(value, channel):
    """Nearest 8-bit code of a linear value, 0 to 1, of a channel. [1]"""
    if channel == CHANNELS - 1:
        return np.uint8(255.0 * value + 0.5)
    return _CODES[int(value * _STEPS + 0.5)]


def decoded_texels(texels: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Decode texels.

    Parameters
    ----------
    texels : array of uint8, shape (..., 4)
        Texels.

    Returns
    -------
    array, shape (..., 4)
        Linear values. [1]

    Examples
    --------
    >>> decoded_texels(np.array([0, 118, 255, 51], np.uint8)).round(4)
    array([0.    , 0.1812, 1.    , 0.2   ], dtype=float32)
    """
    out = np.empty(texels.shape, np.float32)
    for channel in range(CHANNELS):
        out[..., channel] = DECODED[channel][texels[..., channel]]
    return out

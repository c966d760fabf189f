"""Exposure for light that is bluer than the rest of a picture, such as the aureole of a low sun."""

from __future__ import annotations

from math import log2
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined, kernel

FloatArray = NDArray[np.float64]

#: Largest displayed level that a fiftieth of the picture may exceed if it is bluer than the
#: rest, such as the aureole of a sun on Mars, which loses its colour as it turns white; warm light
#: keeps it. Ratios of blue to red over the mean one from which on light is so, and is entirely. [1]
_COOL: Final = 1.1
_COOL_SHARE: Final = 0.02
_BLUER, _BLUEST = 1.1, 1.4
#: Growth of the limit with the share of the brightest light that is not bluer. [EV]
_WARMER: Final = 2.0


@kernel
def cool_share(red, blue, mean):
    """Share of a pixel's light that counts as bluer than the rest of the picture, 0 to 1. [1]

    Parameters
    ----------
    red, blue : float
        Linear sRGB. [W m⁻² sr⁻¹]
    mean : float
        Blue over red of the whole picture. [1]

    Examples
    --------
    >>> cool_share(1.0, 1.0, 1.0), cool_share(1.0, 1.0, 0.5)
    (0.0, 1.0)
    """
    ratio = blue / max(red * mean, 1e-30)
    return min(max((ratio - _BLUER) / (_BLUEST - _BLUER), 0.0), 1.0)


@inlined
def cool_limit(bright, weight, cool, whole):
    """Longest exposure if the brightest light is bluer than the rest of the picture. [EV]

    1000 EV if there is too little light.

    Parameters
    ----------
    bright, weight, cool : array, shape (n,)
        Arguments of ``exposure_of``.
    whole : float
        Weight of the picture. [1]
    """
    reached, bluer = 0.0, 0.0
    for back in range(weight.size):
        i = weight.size - 1 - back
        reached += weight[i]
        bluer += weight[i] * cool[i]
        if reached > _COOL_SHARE * whole:
            return log2(_COOL / bright[i]) + _WARMER * (1.0 - bluer / reached)
    return 1000.0


@compiled_loop
def _fill(red, blue, mean, out):
    for row in range(out.shape[0]):
        for column in range(out.shape[1]):
            out[row, column] = cool_share(red[row, column], blue[row, column], mean)


def cool_shares(red: FloatArray, blue: FloatArray, weights: FloatArray) -> FloatArray:
    """``cool_share`` of all pixels of a picture; 0 if it has no light.

    Parameters
    ----------
    red, blue : array, shape (height, width)
        Linear sRGB. [W m⁻² sr⁻¹]
    weights : array, shape (height, width)
        Weights of the pixels in the mean; 0 where radiance is not finite. [1]

    Returns
    -------
    array, shape (height, width)
        Shares. [1]
    """
    out = np.zeros(red.shape)
    counted = weights > 0.0
    light = float(weights[counted] @ red[counted])
    mean = float(weights[counted] @ blue[counted]) / light if light > 0.0 else 0.0
    if mean > 0.0:
        _fill(red, blue, mean, out)
    return out

"""Dither: noise of one quantisation step, against banding.

A rank-1 lattice: multiples of column and row, modulo 1, with the two ratios of a low-discrepancy
sequence. Its power is at high spatial frequencies: below a sixteenth of the sampling rate it is a
fortieth of that of white noise. Integer arithmetic makes it identical on all CPUs and GPUs.
"""

from __future__ import annotations

import math
from typing import Final

from airlight.kernel import kernel

#: Period of the lattice.
_COUNT: Final = 4096
#: Ratios of column and row: 1/ρ and 1/ρ² of the plastic number ρ = 1.3247, and a third of the
#: count between channels, whose noises so partly cancel in luminance.
_COLUMN: Final = 3092
_ROW: Final = 2334
_CHANNEL: Final = 1365


@kernel
def dither_noise(px, py, channel):
    """Noise of a pixel's channel, with a triangular density from -1 to 1. [1]

    Parameters
    ----------
    px, py : float
        Position from the picture's left and top edge, up to 65536. [pixel]
    channel : int
        0 to 2.

    Returns
    -------
    float
        Noise of mean 0 and variance 1/6, which makes mean and variance of the quantisation error
        independent of the picture.

    References
    ----------
    Lipshitz, Wannamaker & Vanderkooy (1992), J. Audio Eng. Soc. 40, 355, on the density; Roberts
    (2018), "The unreasonable effectiveness of quasirandom sequences", on the lattice.
    """
    place = (_COLUMN * math.floor(px) + _ROW * math.floor(py) + _CHANNEL * channel) % _COUNT
    twice = (2.0 * place + 1.0) / _COUNT
    if twice < 1.0:
        return math.sqrt(twice) - 1.0
    return 1.0 - math.sqrt(2.0 - twice)


@kernel
def dithered(value, px, py, channel, step):
    """Value of a channel with dither, except for black and white. [1]

    Parameters
    ----------
    value : float
        Encoded value, 0 to 1. [1]
    px, py, channel :
        Arguments of ``dither_noise``.
    step : float
        Quantisation step; 0 for no dither. [1]
    """
    amplitude = min(step, min(value, 1.0 - value))
    return value + amplitude * dither_noise(px, py, channel)

"""Dither: blue noise of one quantisation step, against banding.

Each 2 × 2 block of pixels has one value of each quarter of the range, the upper two on a diagonal,
each 4 × 4 block one of each sixteenth. Which is where is a hash of the larger block. So the power
is at high spatial frequencies, below a sixteenth of the sampling rate a thirtieth of white noise,
and unlike that of a lattice it has no peaks that beat when a picture is scaled. Integer arithmetic
makes it identical on all CPUs and GPUs.
"""

from __future__ import annotations

import math
from typing import Final

from airlight.kernel import kernel

#: Number of values.
_COUNT: Final = 4096
#: Modulus of the hash, a prime just above five octal digits, whose square is an integer of 31 bits,
#: and its factors: one of Wichmann & Hill (1982), Appl. Stat. 31, 188, and a prime.
_PRIME: Final = 32771
_ACROSS: Final = 171
_DOWN: Final = 7919
#: Steps of a lattice of 256 values, the last sixteenth of the range.
_REST_ACROSS: Final = 151
_REST_DOWN: Final = 77


@kernel
def hashed(column, row):
    """Pseudo-random integer of a place, 0 to 32770.

    Parameters
    ----------
    column, row : int
        Place, 0 to 65536.
    """
    h = (_ACROSS * column + _DOWN * row + 1) % _PRIME
    h = (h * h + row) % _PRIME
    return (h * h + column) % _PRIME


@kernel
def quarter(column, row, which):
    """Quarter of the range, 0 to 3, of one of the four parts of a block.

    Parameters
    ----------
    column, row : int
        Place of the part.
    which : int
        Arrangement of the block, 0 to 7.
    """
    upper = (column + row + which) % 2
    turned = which // 4 if upper == 1 else which // 2
    return 2 * upper + (column + turned) % 2


@kernel
def dither_place(px, py):
    """Place of a pixel in the range of the noise, 0 to 4095.

    Parameters
    ----------
    px, py : float
        Position from the picture's left and top edge, up to 65536. [pixel]
    """
    column, row = math.floor(px), math.floor(py)
    across, down = column // 2, row // 2
    # A digit for the block of four pixels, and one for each of its blocks of two.
    digits = hashed(across // 2, down // 2)
    own = digits // 8
    if down % 2 == 1:
        own = own // 64
    if across % 2 == 1:
        own = own // 8
    fine = 1024 * quarter(column, row, own % 8) + 256 * quarter(across, down, digits % 8)
    return fine + (_REST_ACROSS * column + _REST_DOWN * row) % 256


@kernel
def dither_noise(place):
    """Noise of a pixel's channels, with a triangular density from -1 to 1. [1]

    Parameters
    ----------
    place : int
        Result of ``dither_place``.

    Returns
    -------
    red, green, blue : float
        Noise of mean 0 and variance 1/6, which makes mean and variance of the quantisation error
        independent of the picture. The place in the range is moved by half of it for green and
        mirrored for blue, so that they partly cancel in luminance.

    References
    ----------
    Lipshitz, Wannamaker & Vanderkooy (1992), J. Audio Eng. Soc. 40, 355, on the density; Ulichney
    (1988), Proc. IEEE 76, 56, on blue noise; the stratified blocks are airlight's.
    """
    twice = (2.0 * place + 1.0) / _COUNT
    if twice < 1.0:
        outer = math.sqrt(twice) - 1.0
        return outer, 1.0 - math.sqrt(1.0 - twice), -outer
    outer = 1.0 - math.sqrt(2.0 - twice)
    return outer, math.sqrt(twice - 1.0) - 1.0, -outer


@kernel
def dithered(value, noise, step):
    """Value of a channel with dither, which leaves black and adds no white. [1]

    Parameters
    ----------
    value : float
        Encoded value, 0 to 1. [1]
    noise : float
        Result of ``dither_noise``. [1]
    step : float
        Quantisation step. [1]
    """
    # Half a step below white a value is rounded to it.
    amplitude = min(step, min(value, max(1.0 - value - 0.5 * step, 0.0)))
    return value + amplitude * noise

"""Procedural detail of clouds below the cells of their field; it is not data.

Octaves of gradient noise, each half of the previous scale, from a cell of the field to a 32nd.
Liquid water has a k^(-5/3) spectrum (Davis et al. 1997, JAS 54, 241): the contrast of an octave is
2^(-1/3) of that of the next coarser one. Scales below two widths of the pixel's footprint are
omitted, with a fade between two and four, so that a moving picture does not shimmer.
"""

from __future__ import annotations

from math import exp
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import GRADIENT_DEVIATION, gradient_noise
from airlight.kernel import kernel

#: Number of octaves.
OCTAVES: Final = 6
#: Standard deviation of the logarithm of the extinction in the coarsest octave. [1]
CONTRAST: Final = 0.35
#: Ratio of the contrasts of an octave and the next coarser one, 2^(-1/3). [1]
FALL: Final = 0.7937
#: Standard deviation of the displacement by the coarsest octave, over the width of a cell. [1]
DISPLACED: Final = 0.3
#: Ratio of the displacements of an octave and the next coarser one: edges are as
#: rough at all scales. [1]
DISPLACED_FALL: Final = 0.5


class CloudDetail(NamedTuple):
    """Detail at a point of a cloud field.

    Attributes
    ----------
    factor : float
        Factor of the extinction, of mean 1. [1]
    east, north, up : float
        Displacement of the place at which the field is read. [m]
    """

    factor: float
    east: float
    north: float
    up: float


@kernel
def cloud_detail(east, north, altitude, width, cell):
    """``CloudDetail`` of a point: 1 and 0 where its footprint is wider than half a cell.

    With the variance σ² of the octaves shown, the factor is exp(n - σ²/2), whose mean is 1 for
    normal noise n, and within 1 % for this noise.

    Parameters
    ----------
    east, north, altitude : float
        Place in the box, without wrapping to its period. [m]
    width : float
        Width of the pixel's footprint, more than 0. [m]
    cell : float
        Horizontal width of a cell of the field. [m]
    """
    total, variance, first, second, third = 0.0, 0.0, 0.0, 0.0, 0.0
    size, contrast, moved, sign = cell, CONTRAST, DISPLACED * cell, 1.0
    for _octave in range(OCTAVES):
        shown = min(0.5 * size / width - 1.0, 1.0)
        if shown > 0.0:
            noise = shown / GRADIENT_DEVIATION
            noise *= gradient_noise(east / size, north / size, altitude / size)
            total += contrast * noise
            variance += contrast * contrast * shown * shown
            first += moved * noise
            second += sign * moved * noise
            third = third - moved * noise
        size *= 0.5
        contrast *= FALL
        moved *= DISPLACED_FALL
        sign = -sign
    return CloudDetail(exp(total - 0.5 * variance), first, second, 0.5 * third)

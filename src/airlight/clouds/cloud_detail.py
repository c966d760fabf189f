"""Procedural detail of clouds below the cells of their field; it is not data.

Octaves of gradient noise, each half of the previous scale, from a cell of the field to a 32nd.
Liquid water has a k^(-5/3) spectrum (Davis et al. 1997, JAS 54, 241): the contrast of an octave is
2^(-1/3) of that of the next coarser one. Scales below two widths of the pixel's footprint are
omitted, with a fade between two and four, so that a moving picture does not shimmer.
"""

from __future__ import annotations

from math import exp
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.gradient_noise import GRADIENT_DEVIATION, gradient_noise
from airlight.kernel import in_shaders, kernel
from airlight.kernel.lanes import LANES, lane_sum, load, maximum, minimum

#: Number of octaves, at most that of lanes.
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

_OCTAVE: Final = np.arange(LANES)
_SEEN: Final = np.where(_OCTAVE < OCTAVES, 1.0, 0.0)
#: Of octaves in lanes: width of the coarsest over their own, contrast, and displacements to the
#: east and to the north over contrast and the width of a cell. [1]
_FINE: Final = (2.0**_OCTAVE).astype(np.float32)
_CONTRASTS: Final = (_SEEN * CONTRAST * FALL**_OCTAVE).astype(np.float32)
_MOVED: Final = (DISPLACED / CONTRAST * (DISPLACED_FALL / FALL) ** _OCTAVE).astype(np.float32)
_TURNED: Final = _MOVED * (-1.0) ** _OCTAVE.astype(np.float32)


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
    fine, contrast = load(_FINE, 0) * (1.0 / cell), load(_CONTRASTS, 0)
    moved, turned = load(_MOVED, 0), load(_TURNED, 0)
    shown = minimum(0.5 / width / fine - 1.0, 1.0)
    shown = maximum(shown, 0.0) * contrast
    variance = lane_sum(shown * shown)
    noise = gradient_noise(fine * east, fine * north, fine * altitude)
    noise = noise * shown * (1.0 / GRADIENT_DEVIATION)
    first = cell * lane_sum(moved * noise)
    second = cell * lane_sum(turned * noise)
    return CloudDetail(exp(lane_sum(noise) - 0.5 * variance), first, second, -0.5 * first)


@kernel
def detail_by_octaves(east, north, altitude, width, cell):
    """``cloud_detail`` octave by octave, in shaders.

    Parameters
    ----------
    east, north, altitude, width, cell :
        Arguments of ``cloud_detail``.
    """
    fine, contrast, moved, hand = 1.0 / cell, CONTRAST, cell * DISPLACED / CONTRAST, 1.0
    total, variance, first, second = 0.0, 0.0, 0.0, 0.0
    for _octave in range(OCTAVES):
        shown = max(min(0.5 / width / fine - 1.0, 1.0), 0.0) * contrast
        noise = gradient_noise(fine * east, fine * north, fine * altitude)
        noise *= shown * (1.0 / GRADIENT_DEVIATION)
        variance += shown * shown
        total += noise
        first += moved * noise
        second += hand * moved * noise
        fine, contrast, hand = 2.0 * fine, FALL * contrast, -hand
        moved *= DISPLACED_FALL / FALL
    return CloudDetail(exp(total - 0.5 * variance), first, second, -0.5 * first)


in_shaders(cloud_detail, detail_by_octaves)

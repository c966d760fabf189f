"""Scale of a map for half-precision floats."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.environment.gamut import grey_of
from airlight.image.exr import LARGEST_HALF

#: Luminance below which halves begin to lose precision, with a margin of four bits above the
#: smallest normal number, 2⁻¹⁴.
_DIM: Final = 2.0**-10
#: Largest fraction of the lit texels below that luminance.
_DIM_SHARE: Final = 0.05
#: Exponent of the largest scale: a night darker than starlight may lose precision.
_HIGHEST: Final = 24
#: Number of texels from which that fraction is estimated.
_SAMPLED: Final = 1 << 20


def half_scale(rgb: NDArray[np.floating]) -> float:
    """Power of two that scales a map into the range of half floats.

    Below 1 if a texel, such as one with the sun's disc, would overflow; above 1 if more than 5 % of
    the nonzero texels would be subnormal, as at night, and the brightest texel permits it.

    Parameters
    ----------
    rgb : array, shape (h, w, 3)
        Linear sRGB, not negative.

    Returns
    -------
    float
        Scale. [1]

    Examples
    --------
    >>> half_scale(np.full((1, 1, 3), 2.4e6)), half_scale(np.full((1, 1, 3), 10.0))
    (0.015625, 1.0)
    """
    peak = float(np.max(rgb, initial=0.0))
    if not peak > 0.0:
        return 1.0
    most = math.floor(math.log2(LARGEST_HALF / peak))
    step = max(1, round((rgb.shape[0] * rgb.shape[1] / _SAMPLED) ** 0.5))
    grey = grey_of(rgb[::step, ::step])
    dim = float(np.quantile(grey[grey > 0.0], _DIM_SHARE)) if np.any(grey > 0.0) else 1.0
    least = min(max(math.ceil(math.log2(_DIM / dim)), 0), _HIGHEST)
    return 2.0 ** min(most, least)

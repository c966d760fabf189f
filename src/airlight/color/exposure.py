"""Exposure: factor from radiance to display, given or measured on the picture."""

from __future__ import annotations

import math
from math import log2
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.color.tone_maps import tone_map_named
from airlight.color.xyz import luminance
from airlight.errors import ParameterError
from airlight.kernel import compiled_loop

#: Default exposure, suited to the sunlit Earth. [EV]
DEFAULT_EXPOSURE: Final = -2.5
#: Linear reflectance of a photographer's grey card.
MIDDLE_GREY: Final = 0.18
#: Pixels darker than this fraction of the picture's bright end do not count: the black of space.
_DARK: Final = 1e-4
#: Approximate number of pixels sampled, every k-th row and column.
_SAMPLE: Final = 1_000_000


def exposure_factor(exposure: float) -> float:
    """Factor of the light: 2^EV.

    Parameters
    ----------
    exposure : float
        Exposure, -100 to 100. [EV]

    Returns
    -------
    float
        Factor. [1]

    Raises
    ------
    ParameterError
        If it is outside that range, or not a number.

    Examples
    --------
    >>> exposure_factor(-2.0)
    0.25
    """
    if not isinstance(exposure, (int, float, np.number)) or not -100.0 <= exposure <= 100.0:
        raise ParameterError("exposure", exposure, '-100 to 100 EV, or "auto"')
    return math.pow(2.0, float(exposure))


@compiled_loop
def exposure_of(bright, grey):
    """The exposure that shows a picture's log-average luminance as middle grey. [EV]

    Parameters
    ----------
    bright : array, shape (n,)
        Luminances above 0, ascending, one at least.
    grey : float
        The luminance that is shown as middle grey.
    """
    rank = 0.99 * (bright.size - 1)
    low = int(rank)
    high = min(low + 1, bright.size - 1)
    dark = _DARK * (bright[low] + (rank - low) * (bright[high] - bright[low]))
    total, count = 0.0, 0
    for i in range(bright.size):
        if bright[i] >= dark:
            total += log2(bright[i])
            count += 1
    return min(max(log2(grey) - total / count, -100.0), 100.0)


def automatic_exposure(rgb: NDArray[np.floating], tone_map: str = "hable") -> float:
    r"""Exposure at which the picture's log-average luminance appears as middle grey.

    .. math:: \bar L = \exp\left(\frac1N \sum \ln L\right), \quad
              \mathrm{EV} = \log_2 (x_{0.18} / \bar L)

    where the tone map maps x₀.₁₈ to 0.18. Pixels below 1e-4 of the picture's 99th percentile are
    left out, so that black space does not overexpose the planet.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB; of a large picture about a million pixels on a regular grid are used.
    tone_map : str
        Tone map, one of ``TONE_MAPS``.

    Returns
    -------
    float
        Exposure, -100 to 100; 0 for a black picture. [EV]

    References
    ----------
    Reinhard et al. (2002), ACM Trans. Graph. 21, 267, eq. 1. doi:10.1145/566654.566575

    Examples
    --------
    >>> grey = np.full((2, 2, 3), 0.18)
    >>> f"{automatic_exposure(0.5 * grey) - automatic_exposure(grey):.6f}"  # half the light
    '1.000000'
    """
    height, width = rgb.shape[:2]
    step = max(1, math.isqrt(height * width // _SAMPLE))
    bright = luminance(np.asarray(rgb[::step, ::step], dtype=np.float64))
    bright = bright[np.isfinite(bright) & (bright > 0.0)]
    if bright.size == 0:
        return 0.0
    grey = np.full(3, MIDDLE_GREY)
    target = float(luminance(tone_map_named(tone_map).inverse(grey)))
    return float(exposure_of(np.sort(bright), target))

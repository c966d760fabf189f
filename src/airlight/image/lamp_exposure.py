"""Exposure of pictures of the night whose subject are lamps, such as towns seen from orbit."""

from __future__ import annotations

from math import log2
from typing import Final

from airlight.kernel import inlined, kernel

#: Fraction of the picture that lamps may have in a long exposure, light of it over that of the key
#: from which on they are the subject, its ratio until they are it alone, and the least exposure of
#: them below that by the key: towns are not drowned in white. [1, EV, EV, EV]
_LAMPS: Final = 0.01
_LAMPLIT: Final = 4.0
_LAMPS_ALONE: Final = 2.0
_SHORTER: Final = 2.0


@inlined
def brightest_light(bright, weight, black):
    """Mean light of the brightest hundredth of a picture, such as lamps. [W m⁻² sr⁻¹]

    Parameters
    ----------
    bright, weight, black :
        Arguments of ``exposure_of``.
    """
    whole = black
    for i in range(weight.size):
        whole += weight[i]
    light, counted = 0.0, 0.0
    i = weight.size - 1
    while i >= 0 and counted < _LAMPS * whole:
        light += weight[i] * bright[i]
        counted += weight[i]
        i -= 1
    return light / max(counted, 1e-300)


@kernel
def lamps_shorter(contrast, longer):
    """Reduction of a long exposure in which lamps are the subject. [EV]

    Parameters
    ----------
    contrast : float
        Light of the brightest hundredth over that of the key. [1]
    longer : float
        Displayed key over that of the adapted eye: 1 by day and at dusk, 1.3 by full moon. [1]

    Examples
    --------
    >>> lamps_shorter(64.0, 2.0), lamps_shorter(64.0, 1.0), lamps_shorter(8.0, 2.0)
    (2.0, 0.0, 0.0)
    """
    part = min(max((log2(contrast) - _LAMPLIT) / _LAMPS_ALONE, 0.0), 1.0)
    return _SHORTER * part * min(max(2.0 * longer - 3.0, 0.0), 1.0)

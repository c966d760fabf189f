"""Averages over unresolved ripples of a phase function."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

#: Angles per ripple that resolve it.
RESOLVED: Final = 12.0
#: Half width of the mean, in ripples.
_HALF_WIDTH: Final = 1.5


def ripple_means(angles: FloatArray, rows: FloatArray, ripple: float) -> FloatArray:
    """Functions of angle, averaged over ripples that the angles do not resolve.

    Logarithmic interpolation between two samples of a ripple is below its mean: spheres of 100 µm
    would lose 1 % of their scattering. The samples are closer than half a ripple, so that their
    mean, weighted by sin θ and a Hann window of three ripples, is exact.

    Parameters
    ----------
    angles : array, shape (na,)
        Ascending angles, at most half a ripple apart. [deg]
    rows : array, shape (nr, na)
        Functions sampled at the angles.
    ripple : float
        Width of the finest ripple. [deg]

    Returns
    -------
    array, shape (nr, na)
        Rows as given where the angles are less than a twelfth of a ripple apart, means elsewhere.

    Examples
    --------
    >>> angles = np.linspace(80.0, 100.0, 81)
    >>> means = ripple_means(angles, 1.0 + np.cos(2.0 * np.pi * angles / 0.6)[None], 0.6)
    >>> bool(np.ptp(means[0, 5:-5]) < 0.01)
    True
    """
    step = np.gradient(angles)
    rough = step > ripple / RESOLVED
    if not rough.any():
        return rows
    half = np.where(rough, _HALF_WIDTH * ripple, 1e-9 * ripple)
    area = step * np.sin(np.radians(angles)) + 1e-300  # both ends have none
    reach = min(math.ceil(_HALF_WIDTH * ripple / float(step[rough].min())), angles.size - 1)
    sums, total = np.zeros_like(rows), np.zeros_like(angles)
    for offset in range(-reach, reach + 1):
        here = slice(max(0, -offset), angles.size - max(0, offset))
        there = slice(max(0, offset), angles.size - max(0, -offset))
        distance = np.minimum(np.abs(angles[there] - angles[here]) / half[here], 1.0)
        weight = 0.5 * (1.0 + np.cos(np.pi * distance)) * area[there]
        sums[:, here] += weight * rows[:, there]
        total[here] += weight
    return sums / total

"""Organisation of cumuli: their number density over distances of many clouds.

Fields of shallow cumuli are gathered in clusters and in streets along the wind, between gaps of
10 km and more (Stevens et al. 2020, QJRMS 146, 141: "gravel"). The logarithm of their number
density is a limited Gaussian field whose spectrum is a power law up to several clouds' widths.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_grid import CloudGrid
from airlight.clouds.power_law_field import power_law_field

FloatArray = NDArray[np.float64]

#: Exponent of the spectrum along a line, and longest waves of clusters and distance of streets over
#: the width of the largest clouds; chosen by looking at pictures. [1]
SPECTRUM: Final = -2.0
_WIDE: Final = 8.0
_APART: Final = 2.5
#: Limit of the Gaussian field over its standard deviation: a single densest cluster would show
#: where a field repeats. [1]
_MOST: Final = 1.5
#: Shear that stretches streets to twice their width. [s⁻¹]
_STRETCHING: Final = 1.25e-4


def number_density(
    grid: CloudGrid, random: np.random.Generator, cell: float, shear: float, organisation: float
) -> FloatArray:
    """Number density of clouds over its mean, shape (columns, columns). [1]

    Parameters
    ----------
    grid, random, cell, shear
        See ``heaps.heap_extinction``; shear stretches streets along the wind.
    organisation : float
        Standard deviation of the logarithm. [1]
    """
    stretch = 1.0 + abs(shear) / _STRETCHING
    clusters = power_law_field(grid, random, slope=SPECTRUM, longest=_WIDE * cell)
    streets = power_law_field(grid, random, slope=SPECTRUM, longest=_APART * cell, stretch=stretch)
    both = clusters + streets
    limited = np.tanh(both / (_MOST * both.std()))
    density = np.exp(organisation * limited / limited.std())
    return np.asarray(density / density.mean())


def overlapping(cover: float, density: FloatArray) -> float:
    r"""Projected area of clouds at random places over that of the ground, of a cover. [1]

    It is the solution A of

    .. math:: 1 - \langle e^{-A d} \rangle = c,

    with the number density d over its mean and the cover c.

    Parameters
    ----------
    cover : float
        Cover, less than 1. [1]
    density : array
        Result of ``number_density``. [1]

    Examples
    --------
    >>> round(overlapping(0.5, np.ones(4)), 6)  # ln 2
    0.693147
    """
    low, high = 0.0, -np.log(1.0 - cover) / float(density.min())
    for _ in range(60):
        middle = 0.5 * (low + high)
        if 1.0 - np.exp(-middle * density).mean() < cover:
            low = middle
        else:
            high = middle
    return float(0.5 * (low + high))


def random_places(
    grid: CloudGrid, random: np.random.Generator, total: FloatArray | None, count: int
) -> FloatArray:
    """Places of a number density, even without one, shape (count, 2). [m]

    Parameters
    ----------
    grid, random
        See ``heaps.heap_extinction``.
    total : array, optional
        Cumulative sum of ``number_density``, flat. [1]
    count : int
        Number of places.
    """
    places = random.random((count, 2))
    if total is None:
        return np.asarray(places * grid.size)
    found = np.searchsorted(total, random.random(count) * total[-1])
    cells = np.stack(np.divmod(found, grid.columns), axis=1)
    return np.asarray((cells + places) * grid.spacing)

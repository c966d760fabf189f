"""Organisation of cumuli: their number density over distances of many clouds.

Fields of shallow cumuli are gathered in clusters and in streets along the wind, between gaps of
10 km and more (Stevens et al. 2020, QJRMS 146, 141: "gravel"). The logarithm of their number
density is a limited Gaussian field whose spectrum is a power law up to several clouds' widths. Wide
clouds gather more than narrow ones.
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
#: Exponent of the width in that of the number density, chosen such that drawn sizes have the
#: published slope (``heaps``), and number of classes of width. [1]
CENTRED: Final = 0.2
_CLASSES: Final = 8
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


def centred(density: FloatArray, ratio: float) -> FloatArray:
    """Number density of clouds of a width over that of the narrowest, over its mean. [1]"""
    found = density ** min(ratio**CENTRED, 2.0)
    return np.asarray(found / found.mean())


def gathered_places(
    grid: CloudGrid, random: np.random.Generator, widths: FloatArray, density: FloatArray
) -> FloatArray:
    """Places of clouds of a number density, shape (n, 2). [m]

    Wide clouds gather where there are most, and clouds that overlap become larger ones.

    Parameters
    ----------
    grid, random
        See ``heaps.heap_extinction``.
    widths : array, shape (n,)
        Widths, the largest first. [m]
    density : array
        Result of ``number_density``. [1]
    """
    places = random.random((widths.size, 3))
    cells = np.empty(widths.size, np.intp)
    for some in np.array_split(np.arange(widths.size), min(_CLASSES, widths.size)):
        total = np.cumsum(centred(density, float(np.median(widths[some])) / widths[-1]))
        cells[some] = np.searchsorted(total, places[some, 2] * total[-1])
    corners = np.stack(np.divmod(cells, grid.columns), axis=1)
    return np.asarray((corners + places[:, :2]) * grid.spacing)

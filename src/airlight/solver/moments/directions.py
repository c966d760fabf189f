"""Quadrature of zenith angles in a sweep, on either side of the horizon.

In optically thick media radiance varies slowly with direction: one Gauss-Legendre panel on each
side suffices. In thin ones most of the radiance of deep twilight comes from a narrow band on either
side of the horizon, the distant sunlit atmosphere; there each side has two panels, one of them next
to the horizon. From the top of the shell the band is the shell itself.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.solver.moments.grid import MomentsGrid

FloatArray = NDArray[np.float64]

#: Width of the panel next to the horizon, over the sine of the dip of the horizon at the top of the
#: shell; and its largest fraction of a side.
_BAND: Final = 0.7
_MOST_OF_SIDE: Final = 0.5


class Directions(NamedTuple):
    """Quadrature of zenith angles at each radius; the first half of a row is below the horizon.

    Attributes
    ----------
    mu, weight : array, shape (r, a)
        Zenith cosine and its weight in ∫ dmu. [1]
    flux : array, shape (r, a)
        Weight in ∫ mu dmu over the upper hemisphere, from the interpolating polynomial of each
        panel above the horizon. [1]
    """

    mu: FloatArray
    weight: FloatArray
    flux: FloatArray


def directions(grid: MomentsGrid, counts: tuple[int, ...]) -> Directions:
    """Gauss-Legendre directions on each side of the horizon of every radius.

    Parameters
    ----------
    grid : MomentsGrid
        Grid with the radii.
    counts : tuple of int
        Number of directions on each side; or those of the panel next to the horizon and of the rest
        of the side.

    Examples
    --------
    >>> ground = MomentsGrid(1.0, 1.02, np.ones(1), *[np.zeros(0)] * 4)
    >>> directions(ground, (1, 1)).mu.round(3).tolist()
    [[-0.069, -0.569, 0.069, 0.569]]
    """
    bottom, top = grid.bottom_radius, grid.top_radius
    band = _BAND * sqrt((top - bottom) * (top + bottom)) / top
    rows = [_at_radius(float(r), bottom, band, counts) for r in grid.radii]
    return Directions(*(np.array(values) for values in zip(*rows, strict=True)))


def _at_radius(
    r: float, bottom: float, band: float, counts: tuple[int, ...]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Cosines, weights and flux weights at one radius."""
    horizon = -sqrt(max((r - bottom) * (r + bottom), 0.0)) / r
    mu, weight, flux = [], [], []
    for pole in (-1.0, 1.0):
        side = pole - horizon
        ends = [horizon, pole]
        if len(counts) == 2:
            ends.insert(1, horizon + min(band, _MOST_OF_SIDE * abs(side)) * pole)
        for low, high, count in zip(ends[:-1], ends[1:], counts, strict=True):
            rule = gauss_legendre(count)
            mu.append(low + (high - low) * rule.nodes)
            weight.append(abs(high - low) * rule.weights)
            flux.append(_flux_weights(low, high, count))
    return np.concatenate(mu), np.concatenate(weight), np.concatenate(flux)


def _flux_weights(low: float, high: float, count: int) -> FloatArray:
    """Weights of ∫ mu L dmu over the part of a panel with mu > 0, for L at its points."""
    start = max(low, 0.0)
    if high <= start:
        return np.zeros(count)
    rule, fine = gauss_legendre(count), gauss_legendre(2 * count)
    analysis = (2 * np.arange(count)[:, None] + 1) * rule.weights
    analysis = analysis * legvander(2.0 * rule.nodes - 1.0, count - 1).T
    mu = start + (high - start) * fine.nodes
    cardinal = legvander(2.0 * (mu - low) / (high - low) - 1.0, count - 1) @ analysis
    return np.asarray((high - start) * (fine.weights * mu) @ cardinal)

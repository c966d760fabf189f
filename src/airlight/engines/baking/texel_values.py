"""Texel values for linear look-ups: impossible angles, and errors of zero mean.

For tables of Bruneton's layout, shape (radii, views, suns, angles, nl), or subsets of their views,
which are independent.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.threads import run_blocks

FloatArray = NDArray[np.float64]

#: Fraction of the second difference subtracted from a value: the mean error of linear interpolation
#: between texels, ∫ t (1 - t)/2 dt.
_SHARE: Final = 1.0 / 12.0
#: Smallest and largest factor by which a value is changed at a discontinuity of the radiance.
_LEAST, _MOST = 0.5, 1.2
#: Smallest and largest ratio of the angular shapes of two suns.
_NARROW, _WIDE = 0.5, 2.0
#: Axes along which values are balanced: radii and suns.
_BALANCED: Final = (0, 2)
#: Views in one block of work.
_VIEWS: Final = 4


def of_views(
    make: Callable[..., Sequence[FloatArray]],
    shape: tuple[int, ...],
    nu: FloatArray,
    *values: FloatArray,
) -> list[FloatArray]:
    """Values of ``make`` for all texels, in parallel over views.

    Parameters
    ----------
    make : callable
        Function of the angles' cosines, shape (radii, v, suns, angles), and of each of ``values``,
        shape (radii, v, suns, angles, nl); returns arrays of the latter shape.
    shape : tuple of int
        Texels along r, mu, mu_s, nu.
    nu : array, shape (n,)
        Cosines of the angle between view and sun at all texels. [1]
    values : array, shape (n, nl)
        Values of all texels.
    """
    angles = nu.reshape(shape)
    given = [one.reshape(*shape, -1) for one in values]
    made: dict[int, Sequence[FloatArray]] = {}

    def run(index: int) -> None:
        views = slice(index * _VIEWS, (index + 1) * _VIEWS)
        made[index] = make(angles[:, views], *(one[:, views] for one in given))

    run_blocks(run, -(-shape[1] // _VIEWS))
    parts = zip(*(made[index] for index in sorted(made)), strict=True)
    return [
        np.concatenate(part, axis=1, out=np.empty((*shape, part[0].shape[-1]))) for part in parts
    ]


def fill_angles(relative: FloatArray, nu: FloatArray) -> FloatArray:
    """Extrapolation of radiance to impossible angles, with the shape of the next lower sun.

    Near a sun at the zenith a view has nearly a single angle; look-ups between two suns then follow
    the shape at the lower one.

    Parameters
    ----------
    relative : array, shape (radii, views, suns, angles, nl)
        Radiance at the nearest possible angle, over an approximate shape. [1]
    nu : array, shape (radii, views, suns, angles)
        Cosine of that angle. [1]

    Returns
    -------
    array, shape (radii, views, suns, angles, nl)
        Radiance at the texel's angle, over the same shape. [1]
    """
    suns, angles = nu.shape[2:]
    own = np.linspace(-1.0, 1.0, angles)
    filled = relative.copy()
    place = 0.5 * (nu + 1.0) * (angles - 1)
    lower = np.minimum(place.astype(int), angles - 2)
    share = (place - lower)[..., None]
    for sun in range(1, suns):
        before = filled[:, :, sun - 1]
        index = lower[:, :, sun, :, None]
        there = (1.0 - share[:, :, sun]) * np.take_along_axis(before, index, axis=2)
        there += share[:, :, sun] * np.take_along_axis(before, index + 1, axis=2)
        ratio = np.divide(before, there, out=np.ones_like(before), where=there > 0.0)
        ratio = np.where(before > 0.0, np.clip(ratio, _NARROW, _WIDE), 1.0)
        impossible = np.abs(own - nu[:, :, sun]) > 1e-9
        filled[:, :, sun] *= np.where(impossible[..., None], ratio, 1.0)
    return filled


def balanced(values: FloatArray) -> FloatArray:
    """Values whose interpolation errors average to zero.

    Linear interpolation of convex radiance is too large, by an eighth of the second difference
    half-way. The mean of this error is subtracted, the least-squares choice for a parabola.

    Parameters
    ----------
    values : array, shape (radii, views, suns, angles, nl)
        Exact values, 0 or more.

    Returns
    -------
    array, shape (radii, views, suns, angles, nl)
        Values, 0 or more.

    Examples
    --------
    >>> falling = np.exp(-np.arange(6.0)).reshape(6, 1, 1, 1, 1)
    >>> made, half = balanced(falling).ravel(), np.exp(-1.5)
    >>> f"{falling[1:3].mean() / half - 1:.2f} {made[1:3].mean() / half - 1:.2f}"
    '0.13 0.03'
    """
    made = values
    for axis in _BALANCED:
        if values.shape[axis] < 3:
            continue
        first = np.moveaxis(made, axis, 0)
        bend = first[2:] - 2.0 * first[1:-1] + first[:-2]
        changed = first.copy()
        changed[1:-1] -= _SHARE * bend
        made = np.moveaxis(np.clip(changed, _LEAST * first, _MOST * first), 0, axis)
    return made

"""Mip levels of an equirectangular map, each half as large, with equal-area averaging.

Odd sizes are rounded up, with fractional texel weights, so that every level covers the sphere and
has the same mean.
"""

from __future__ import annotations

import itertools
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.image.texels import CHANNELS, channel_of, code_of
from airlight.kernel import compiled_loop, kernel

#: Largest number of texels averaged along an axis: two, or one and parts of two others.
_TAPS: Final = 3


class Levels(NamedTuple):
    """Mip levels of a map.

    Attributes
    ----------
    rows, columns : int
        Size of the full map.
    flat : array of uint8, shape (4·n,)
        Texels of ``airlight.image.texels``, one level after another.
    """

    rows: int
    columns: int
    flat: NDArray[np.uint8]


@kernel
def halved(size):
    """Number of rows or columns of the next level.

    Examples
    --------
    >>> halved(8), halved(7), halved(1)
    (4, 4, 1)
    """
    return (size + 1) // 2


@kernel
def level_place(rows, columns, level):
    """Offset of a level in the flat array of all levels.

    Parameters
    ----------
    rows, columns : int
        Size of the full map.
    level : int
        Level; 0 is the full map.

    Returns
    -------
    start, rows, columns : int
        Index of its first texel, and its size.

    Examples
    --------
    >>> level_place(5, 10, 2)  # after 5 x 10 and 3 x 5 texels
    (65, 2, 3)
    """
    start, height, width = 0, rows, columns
    for _step in range(level):
        start += height * width
        height, width = halved(height), halved(width)
    return start, height, width


def level_count(rows: int) -> int:
    """Number of levels of a map, down to a single row.

    Examples
    --------
    >>> level_count(1), level_count(4), level_count(5)
    (1, 3, 4)
    """
    return 1 + (rows - 1).bit_length()


def area_weights(size: int, parts: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Overlap weights that resample ``size`` texels to ``parts``.

    Returns
    -------
    first : array, shape (parts,)
        Index of the first texel that overlaps each part.
    weights : array, shape (parts, k)
        Weights of this and the following texels in the mean over the part. [1]

    Examples
    --------
    >>> first, weights = area_weights(3, 2)
    >>> first, weights.round(3)
    (array([0, 1]), array([[0.667, 0.333, 0.   ],
           [0.333, 0.667, 0.   ]]))
    """
    edges = np.arange(parts + 1) * size
    first = edges[:-1] // parts
    taps = max(_TAPS, -(-size // parts) + 1)
    texels = first[:, None] + np.arange(taps)
    low = np.maximum(texels * parts, edges[:-1, None])
    high = np.minimum((texels + 1) * parts, edges[1:, None])
    return first, np.maximum(high - low, 0) / size


@compiled_loop
def area_means(fine, first_row, row_weights, first_column, column_weights, out):
    """Area-average a map to a smaller size.

    Parameters
    ----------
    fine : array of uint8, shape (h, w, 4)
        Texels.
    first_row, row_weights, first_column, column_weights : array
        ``area_weights`` of both axes.
    out : array of uint8, shape (m, n, 4)
        Receives the texels.
    """
    height, width = fine.shape[:2]
    flat = fine.reshape(-1)
    total = np.empty(CHANNELS)
    for j in range(out.shape[0]):
        for i in range(out.shape[1]):
            total[:] = 0.0
            for y in range(row_weights.shape[1]):
                if row_weights[j, y] == 0.0:
                    continue
                row = min(first_row[j] + y, height - 1)
                for x in range(column_weights.shape[1]):
                    weight = row_weights[j, y] * column_weights[i, x]
                    if weight == 0.0:
                        continue
                    texel = row * width + min(first_column[i] + x, width - 1)
                    for c in range(CHANNELS):
                        total[c] += weight * channel_of(flat, texel, c)
            for c in range(CHANNELS):
                out[j, i, c] = code_of(min(total[c], 1.0), c)


def reduced(
    texels: NDArray[np.uint8], rows: int, columns: int, out: NDArray[np.uint8] | None = None
) -> NDArray[np.uint8]:
    """Map reduced by area averages in linear light.

    Parameters
    ----------
    texels : array of uint8, shape (h, w, 4)
        Texels of ``airlight.image.texels``.
    rows, columns : int
        New size, at most the old one.
    out : array of uint8, shape (rows, columns, 4), optional
        Receives the texels, and is returned.
    """
    if out is None:
        out = np.empty((rows, columns, CHANNELS), np.uint8)
    height, width = texels.shape[:2]
    area_means(
        np.ascontiguousarray(texels),
        *area_weights(height, rows),
        *area_weights(width, columns),
        out,
    )
    return out


def empty_levels(rows: int, columns: int) -> NDArray[np.uint8]:
    """Flat array for a map and all its mip levels, shape (4·n,)."""
    start, height, width = level_place(rows, columns, level_count(rows) - 1)
    return np.empty(CHANNELS * (start + height * width), np.uint8)


def level_views(flat: NDArray[np.uint8], rows: int, columns: int) -> tuple[NDArray[np.uint8], ...]:
    """Views of the levels in ``empty_levels``, each of shape (h, w, 4).

    Parameters
    ----------
    flat : array of uint8, shape (4·n,)
        Array of ``empty_levels``.
    """
    views = []
    for level in range(level_count(rows)):
        start, height, width = level_place(rows, columns, level)
        block = flat[CHANNELS * start : CHANNELS * (start + height * width)]
        views.append(block.reshape(height, width, CHANNELS))
    return tuple(views)


def fill_levels(levels: tuple[NDArray[np.uint8], ...]) -> None:
    """Compute all mip levels of a map.

    Parameters
    ----------
    levels : tuple of array of uint8, each shape (h, w, 4)
        Views of ``level_views``; the first holds the map, the others receive its halvings.
    """
    for fine, coarse in itertools.pairwise(levels):
        rows, columns = coarse.shape[:2]
        reduced(fine, rows, columns, coarse)

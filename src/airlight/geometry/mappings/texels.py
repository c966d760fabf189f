"""Texture coordinates, array indices and memory indices of texels.

Values of a table are at the centres of its texels. A coordinate in [0, 1] that runs from the first
to the last of n values is ``index / (n - 1)``; the texture coordinate of a GPU runs over
the texels' outer edges, so that the same point is ``0.5/n + x (1 - 1/n)``. Both are exact at both
ends. Sources: Atmosphere Plus notes, second print, section 3.1.7; E. Bruneton,
"Precomputed Atmospheric Scattering: a New Implementation" (2017).
"""

from __future__ import annotations

from airlight.kernel import kernel


@kernel
def texture_coordinate(x, n):
    """Convert a coordinate over the centres of n texels to a texture coordinate. [1]

    Examples
    --------
    >>> texture_coordinate(0.0, 4), texture_coordinate(1.0, 4)
    (0.125, 0.875)
    """
    return 0.5 / n + x * (1.0 - 1.0 / n)


@kernel
def unit_coordinate(u, n):
    """Inverse of ``texture_coordinate``; 0 if there is only one texel. [1]

    Examples
    --------
    >>> unit_coordinate(0.125, 4), unit_coordinate(0.875, 4)
    (0.0, 1.0)
    """
    if n < 2:
        return 0.0
    return (u - 0.5 / n) / (1.0 - 1.0 / n)


@kernel
def index_coordinate(i, n):
    """Convert a whole or fractional array index to [0, 1]; 0 if there is only one value. [1]

    Examples
    --------
    >>> index_coordinate(0, 32), index_coordinate(31, 32)
    (0.0, 1.0)
    """
    if n < 2:
        return 0.0
    return i / (n - 1.0)


@kernel
def coordinate_index(x, n):
    """Inverse of ``index_coordinate``: a fractional index between 0 and n - 1. [1]"""
    return x * (n - 1.0)


@kernel
def flat_index(x, y, z, width, height):
    """One-dimensional index of an element of a three-dimensional array, x running fastest. [1]

    Examples
    --------
    >>> flat_index(31, 255, 31, 32, 256) == 32 * 256 * 32 - 1
    True
    """
    return x + y * width + z * width * height


@kernel
def split_index(i, width, height):
    """Inverse of ``flat_index``: (x, y, z). [1]

    Examples
    --------
    >>> split_index(flat_index(3, 200, 17, 32, 256), 32, 256)
    (3, 200, 17)
    """
    return i % width, (i // width) % height, i // (width * height)


@kernel
def cell(index, first, last):
    """Neighbours of a fractional index, and weight of the upper.

    Parameters
    ----------
    index : float
        Fractional index, clamped to [first, last]. [1]
    first, last : int
        Ends of the range of values that may be used.

    Returns
    -------
    lower, upper : int
    fraction : float
        Weight of the upper neighbour, 0 to 1. [1]
    """
    held = min(max(index, float(first)), float(last))
    lower = min(int(held), max(last - 1, first))
    upper = min(lower + 1, last)
    return lower, upper, held - lower

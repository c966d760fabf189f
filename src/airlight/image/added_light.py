"""Sum of two pictures in linear light."""

from __future__ import annotations

from airlight.kernel import inlined


@inlined
def added_texel(first, second, row, column):
    """Sum of both pictures at a pixel.

    Parameters
    ----------
    first, second : array, shape (h, w)
        Pictures, of one channel; in a shader of four.
    row, column : int
        Position of the pixel.
    """
    return first[row, column] + second[row, column]

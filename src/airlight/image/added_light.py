"""Sum of two pictures in linear light: those of two lights."""

from __future__ import annotations

from airlight.kernel import inlined


@inlined
def added_texel(first, second, row, column):
    """Light of a pixel in both pictures.

    Parameters
    ----------
    first, second : array, shape (h, w)
        Pictures, of one channel; in a shader of four.
    row, column : int
        Place.
    """
    return first[row, column] + second[row, column]

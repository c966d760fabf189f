"""Sum of pictures in linear light, and of one behind another."""

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


@inlined
def layered_texel(behind, light, transmittance, row, column):
    """Light of a layer and of what is behind it at a pixel.

    Parameters
    ----------
    behind, light, transmittance : array, shape (h, w)
        Picture behind the layer, light of the layer and its transmittance, as in ``added_texel``.
    row, column : int
        Position of the pixel.
    """
    return light[row, column] + transmittance[row, column] * behind[row, column]


@inlined
def covering_texel(behind, light, coverage, row, column):
    """Light of a body and of what it leaves of the picture behind it, at a pixel.

    Parameters
    ----------
    behind, light, coverage : array, shape (h, w)
        Picture behind the body, its light and its coverage, as in ``added_texel``.
    row, column : int
        Position of the pixel.
    """
    covered = coverage[row, column] * behind[row, column]
    return light[row, column] + behind[row, column] - covered

"""Contrast of the land of a map at its smallest scales, which noise continues below them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.image.texels import decoded_texels
from airlight.scene.ground_detail import PLAIN_CONTRAST, PLAIN_FALL

#: Fewest squares of land from which statistics are taken.
_FEWEST: Final = 100
#: Largest number of squares along an axis.
_MOST: Final = 400
#: Share of the contrast of the first octave that noise adds: its cells are those of the texels,
#: whose interpolation keeps the rest. [1]
_ADDED: Final = 0.5
#: Limits of the contrast, and of its ratio between successive octaves: a map whose fine scales are
#: as strong as its coarse ones has noise of its own, which is not continued to the nearest stones.
#: [1]
_CONTRAST: Final = (0.0, 0.15)
_FALL: Final = (0.4, 0.7)


class Grain(NamedTuple):
    """Contrast of the land.

    Attributes
    ----------
    contrast : tuple of float, length 3
        Standard deviation of the linear sRGB reflectance over its mean in the coarsest octave of
        noise. [1]
    fall : float
        Its ratio from one octave, a quarter of the scale, to the next. [1]
    """

    contrast: tuple[float, float, float]
    fall: float


#: Contrast where there is no land.
EVEN: Final = Grain((PLAIN_CONTRAST,) * 3, PLAIN_FALL)


def grain_of(levels: Sequence[NDArray[np.uint8]]) -> Grain:
    """Contrast of a map by the variances in squares of four texels of its first and third level.

    An octave spans scales of a factor of four, as do these squares: the contrast is continued by
    the ratio between them. In each square all of which is land, deviations are from its mean.

    Parameters
    ----------
    levels : sequence of array of uint8, shape (h, w, 4)
        Mip levels.
    """
    if len(levels) < 5:
        return EVEN
    fine, coarse = _contrast(levels[0]), _contrast(levels[2])
    if fine is None or coarse is None:
        return EVEN
    fall = float(np.clip(fine.mean() / max(coarse.mean(), 1e-6), *_FALL))
    red, green, blue = (float(x) for x in np.clip(_ADDED * fine, *_CONTRAST))
    return Grain((red, green, blue), fall)


def _contrast(texels: NDArray[np.uint8]) -> NDArray[np.float64] | None:
    """Root mean square of the deviation over the mean in squares of land, shape (3,). [1]"""
    rows, columns = (size // 4 for size in texels.shape[:2])
    # the poles' rows are stretched
    first, last = rows // 6, rows - rows // 6
    down = np.unique(np.linspace(first, last - 1, min(_MOST, last - first)).astype(np.intp))
    right = np.unique(np.linspace(0, columns - 1, min(_MOST, columns)).astype(np.intp))
    step = np.arange(4)
    squares = texels[
        (4 * down[:, None] + step)[:, None, :, None], (4 * right[:, None] + step)[None, :, None, :]
    ].reshape(-1, 16, 4)
    squares = squares[~squares[..., 3].any(axis=1)]
    values = decoded_texels(squares)[..., :3].astype(np.float64)
    values = values[values.mean(axis=1).min(axis=1) > 0.0]
    if len(values) < _FEWEST:
        return None
    relative = values.var(axis=1) / values.mean(axis=1) ** 2
    # the median: few squares hold most of the variance, edges of snow and of salt lakes
    return np.asarray(np.sqrt(np.median(relative, axis=0)))

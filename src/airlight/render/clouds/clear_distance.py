"""Distances from the cells of a field within which there are no clouds."""

from __future__ import annotations

from math import sqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_detail import DISPLACED, DISPLACED_FALL
from airlight.clouds.cloud_field import CloudField
from airlight.kernel import compiled_loop

Float32Array = NDArray[np.float32]

#: Extinction below which a cell is clear. [m⁻¹]
_NOTHING: Final = 1e-9
#: Cells from one with extinction that are not clear: one for interpolation, and one as distances
#: are those between faces.
_FILLED: Final = 2
#: Longest distance. [m]
_LONGEST: Final = 1e5
#: Share of the distance that is kept, for the curvature of the box. [1]
_KEPT: Final = 0.95
#: Displacement by detail over the width of a cell beyond the half cell that interpolation leaves:
#: three standard deviations. [1]
_DISPLACED: Final = 3.0 * DISPLACED / sqrt(1.0 - DISPLACED_FALL**2) - 0.5


def clear_distances(field: CloudField) -> Float32Array:
    """Distance from any point of a cell within which there are no clouds, shape (nz, ny, nx). [m]

    Clouds end a cell beyond the middles of those with extinction, by linear interpolation.
    """
    cells = field.extinction.transpose(2, 1, 0) > _NOTHING
    square = np.where(cells, np.float32(0.0), np.float32(_LONGEST**2))
    periodic = field.beyond == "periodic"
    steps = field.spacing[2], field.spacing[1], field.spacing[0]
    for axis, step in enumerate(steps):
        lines = np.ascontiguousarray(np.moveaxis(square, axis, -1))
        out = np.empty_like(lines)
        rows = (-1, lines.shape[-1])
        _nearest(lines.reshape(rows), step, periodic and axis > 0, out.reshape(rows))
        square = np.moveaxis(out, -1, axis)
    distance = np.sqrt(square) - np.float32(_DISPLACED * min(steps[1:]))
    return np.ascontiguousarray(np.float32(_KEPT) * np.maximum(distance, np.float32(0.0)))


@compiled_loop
def _nearest(given, step, periodic, out):
    """Least square of distances, from that across rows and the places along them. [m²]"""
    count = given.shape[1]
    for row in range(given.shape[0]):
        for i in range(count):
            least = given[row, i]
            for away in range(1, count):
                square = (max(away - _FILLED, 0) * step) ** 2
                if square >= least:
                    break
                before, after = i - away, i + away
                if periodic:
                    before += count if before < 0 else 0
                    after -= count if after >= count else 0
                if before >= 0:
                    least = min(least, square + given[row, before])
                if after < count:
                    least = min(least, square + given[row, after])
            out[row, i] = least

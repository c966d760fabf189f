"""Distances from the cells of a field within which there are no clouds."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField

Float32Array = NDArray[np.float32]

#: Extinction below which a cell is clear. [m⁻¹]
_NOTHING: Final = 1e-9
#: Cells beyond the sides of a periodic box that are looked at.
_AROUND: Final = 48
#: Share of the distance that is kept, for the curvature of the box. [1]
_KEPT: Final = 0.95
#: Displacement by detail over the width of a cell beyond the half cell that interpolation leaves:
#: three standard deviations. [1]
_DISPLACED: Final = 0.3


def clear_distances(field: CloudField) -> Float32Array:
    """Distance from any point of a cell within which there are no clouds, shape (nz, ny, nx). [m]

    Clouds end a cell beyond the middles of those with extinction, by linear interpolation.
    """
    from scipy.ndimage import distance_transform_edt, maximum_filter

    cells = np.ascontiguousarray(field.extinction.transpose(2, 1, 0))
    sides = "wrap" if field.beyond == "periodic" else "nearest"
    # a cell around for interpolation, and one as distances are those between faces
    filled = maximum_filter(cells > _NOTHING, size=5, mode=("nearest", sides, sides))
    steps = field.spacing[2], field.spacing[1], field.spacing[0]
    if not filled.any():
        return np.full(cells.shape, 1e5, np.float32)
    pad = [0, 0, 0]
    if sides == "wrap":
        pad = [0, min(_AROUND, cells.shape[1]), min(_AROUND, cells.shape[2])]
    wide = np.pad(filled, [(n, n) for n in pad], mode="wrap")
    distance = distance_transform_edt(~wide, sampling=steps)
    for axis in (1, 2):
        if pad[axis]:
            distance = np.minimum(distance, pad[axis] * steps[axis])
    distance = distance[:, pad[1] : pad[1] + cells.shape[1], pad[2] : pad[2] + cells.shape[2]]
    displaced = _DISPLACED * min(steps[1:])
    return np.asarray(_KEPT * np.maximum(distance - displaced, 0.0), np.float32)

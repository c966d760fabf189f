"""Cells of the finer box inside the box of a field."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from airlight.clouds.cloud_field import CloudField

#: Width [m], cells of a cell of the larger box along x and y, and largest number of levels.
WIDTH: Final = 6400.0
PARTS: Final = 2
LEVELS: Final = 16


def inner_field(
    field: CloudField, coarse: CloudField, place: tuple[float, float]
) -> CloudField | None:
    """Cells of the finer box; None if it would not be smaller.

    Parameters
    ----------
    field, coarse : CloudField
        Clouds, and those of the larger box.
    place : tuple of two float
        Place about which it is, if the field is not displaced: east and north. [m]
    """
    corner, steps, counts = [], [], []
    for axis in range(2):
        step, whole = coarse.spacing[axis], coarse.extinction.shape[axis]
        count = round(WIDTH / step)
        if count >= whole:
            return None
        first = round((place[axis] - 0.5 * WIDTH) / step + 0.5 * whole)
        first = min(max(first, 0), whole - count)
        corner.append((field.west, field.south)[axis] + first * step)
        steps.append(step / PARTS)
        counts.append(count * PARTS)
    x, y = (
        low + (np.arange(count) + 0.5) * step
        for low, step, count in zip(corner, steps, counts, strict=True)
    )
    layers = field.extinction.shape[2]
    heights = field.base + (np.arange(layers) + 0.5) * field.spacing[2]
    levels = next(count for count in range(min(LEVELS, layers), 0, -1) if layers % count == 0)
    cells = [
        sum(field.at(x[:, None], y, np.full((1, 1), height)) for height in some) / len(some)
        for some in heights.reshape(levels, -1)
    ]
    middle = [low + 0.5 * n * step for low, n, step in zip(corner, counts, steps, strict=True)]
    return replace(
        field,
        extinction=np.stack(cells, axis=-1).astype(np.float32),
        spacing=(steps[0], steps[1], (field.top - field.base) / levels),
        drift=(middle[0], middle[1]),
        beyond="clear",
        interpolated=False,
    )

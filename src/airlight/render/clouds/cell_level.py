"""Place of a level of detail in the stacked arrays of a cloud field, and in its cells."""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

from airlight.kernel import inlined

#: Width of a footprint over that of a cell above which cells are joined. [1]
SHARP: Final = 1.0


class CellLevel(NamedTuple):
    """Cells of a level of detail in stacked arrays.

    Attributes
    ----------
    columns, rows : int
        Number of cells to the east and to the north.
    first : int
        Row at which they start.
    """

    columns: int
    rows: int
    first: int


@inlined
def level_number(width, climb, layer):
    """Number of the level of detail for a pixel's footprint.

    Parameters
    ----------
    width : float
        Width across the line of sight; along it, that of a footprint wider than the clouds are
        high is longer by the slant. [m]
    climb : float
        Cosine of the angle between line of sight and vertical. [1]
    layer : LayerTables
        Clouds.
    """
    number, last = 0, layer.levels.shape[0] - 1
    width *= sqrt(min(max(width / (layer.top - layer.base), 1.0), 1.0 / climb))
    widest = SHARP * max(layer.step_x, layer.step_y)
    while number < last and width > widest:
        number += 1
        widest *= 2.0
    return number


@inlined
def cell_level(number, levels):
    """``CellLevel`` of a number in an array of ``stacked``."""
    return CellLevel(int(levels[number, 0]), int(levels[number, 1]), int(levels[number, 2]))


@inlined
def place_in_level(place, count, level_count):
    """Coordinate in cells of a level, of that in cells of the field. [cells]"""
    return (place + 0.5) * level_count / count - 0.5

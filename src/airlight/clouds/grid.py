"""``Grid``: the periodic box in which clouds are generated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Grid:
    """Square periodic box of cells.

    Parameters
    ----------
    columns, levels : int
        Number of cells along a side and upwards.
    spacing : float
        Horizontal width of a cell. [m]
    depth : float
        Height of the box. [m]
    """

    columns: int
    levels: int
    spacing: float
    depth: float

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of cells to the east, to the north and upwards."""
        return self.columns, self.columns, self.levels

    @property
    def size(self) -> float:
        """Side of the box. [m]"""
        return self.columns * self.spacing

    @property
    def level(self) -> float:
        """Height of a cell. [m]"""
        return self.depth / self.levels

    @property
    def heights(self) -> FloatArray:
        """Heights of the centres above the base, shape (levels,). [m]"""
        return np.asarray((np.arange(self.levels) + 0.5) * self.level)

"""``CloudField``: extinction of a cloud's particles on a box of cells above a place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError

Float32Array = NDArray[np.float32]

#: What is beyond the four sides of a box.
BEYOND: Final = ("clear", "periodic")
#: Largest extinction, 1000 times that of a dense cumulus. [m⁻¹]
MOST_EXTINCTION: Final = 1e3
#: Largest number of cells.
MOST_CELLS: Final = 1 << 28


@dataclass(frozen=True, eq=False, kw_only=True)
class CloudField:
    """Extinction at 550 nm, mean of each cell, on a regular box east, north and up of a place.

    A point of a spherical planet of radius R is in the box by its altitude and by its gnomonic
    coordinates about the place: R tan of its angular distance, to the east and to the north.

    Parameters
    ----------
    extinction : array of float32, shape (nx, ny, nz)
        Extinction coefficient at 550 nm; axes towards east, north and up. [m⁻¹]
    spacing : tuple of three float
        Width of a cell to the east, to the north and upwards. [m]
    base : float
        Altitude of the lowest faces. [m]
    latitude, longitude : float
        The place, in the middle of the box. [deg]
    drift : (float, float)
        Displacement of the box to the east and to the north of the place. [m]
    beyond : "clear" or "periodic"
        Content beyond the four sides. There is nothing above and below.
    interpolated : bool
        Whether extinction is linear between the centres of cells, rather than constant in a cell.
    trail : float
        Trails of falling crystals (``fibres``): their displacement to the west over the square of
        the depth below the top; detail of pictures below the cells follows them. [m⁻¹]

    Raises
    ------
    ParameterError
        If an extinction is negative or not finite, or the box is not one.
    """

    extinction: Float32Array
    spacing: tuple[float, float, float]
    base: float
    latitude: float = 0.0
    longitude: float = 0.0
    drift: tuple[float, float] = (0.0, 0.0)
    beyond: str = "clear"
    interpolated: bool = True
    trail: float = 0.0

    def __post_init__(self) -> None:
        cells = np.ascontiguousarray(self.extinction, np.float32)
        if cells.ndim != 3 or not 0 < cells.size <= MOST_CELLS:
            allowed = f"an array (nx, ny, nz) of 1 to {MOST_CELLS} cells"
            raise ParameterError("extinction", f"shape {cells.shape}", allowed)
        low, high = float(cells.min()), float(cells.max())
        if not (low >= 0.0 and high <= MOST_EXTINCTION):  # not true of NaN
            value = low if low < 0.0 else high
            raise ParameterError("extinction", value, f"0 to {MOST_EXTINCTION:g} /m")
        if not all(0.0 < step < np.inf for step in self.spacing):
            raise ParameterError("spacing", self.spacing, "three numbers more than 0 m")
        if not np.isfinite(self.drift).all():
            raise ParameterError("drift", self.drift, "two finite numbers of m")
        if not np.isfinite(self.base):
            raise ParameterError("base", self.base, "a finite number of m")
        if not np.isfinite(self.trail):
            raise ParameterError("trail", self.trail, "a finite number /m")
        if self.beyond not in BEYOND:
            raise ParameterError("beyond", self.beyond, ", ".join(BEYOND))
        object.__setattr__(self, "extinction", cells)

    @property
    def sides(self) -> tuple[float, float]:
        """Widths to the east and to the north. [m]"""
        east, north, _ = self.extinction.shape
        return float(east) * self.spacing[0], float(north) * self.spacing[1]

    @property
    def west(self) -> float:
        """Coordinate of the western faces. [m]"""
        return self.drift[0] - 0.5 * self.sides[0]

    @property
    def south(self) -> float:
        """Coordinate of the southern faces. [m]"""
        return self.drift[1] - 0.5 * self.sides[1]

    @property
    def top(self) -> float:
        """Altitude of the highest faces. [m]"""
        return self.base + float(self.extinction.shape[2]) * self.spacing[2]

    @property
    def column_optical_depth(self) -> Float32Array:
        """Vertical optical depth at 550 nm of each column, shape (nx, ny). [1]"""
        return np.asarray(
            self.spacing[2] * self.extinction.sum(axis=2, dtype=np.float64), np.float32
        )

    def at(
        self, east: NDArray[np.float64], north: NDArray[np.float64], altitude: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Extinction at points of any common shape. [m⁻¹]

        Parameters
        ----------
        east, north, altitude : array
            Coordinates in the box. [m]
        """
        places = np.broadcast_arrays(
            (np.asarray(east, np.float64) - self.west) / self.spacing[0],
            (np.asarray(north, np.float64) - self.south) / self.spacing[1],
            (np.asarray(altitude, np.float64) - self.base) / self.spacing[2],
        )
        shape = self.extinction.shape
        inside = (places[2] >= 0.0) & (places[2] < shape[2])
        if self.beyond == "clear":
            for place, count in zip(places[:2], shape[:2], strict=True):
                inside &= (place >= 0.0) & (place < count)
        corners: list[list[tuple[NDArray[np.int64], NDArray[np.float64]]]] = []
        for place in places:
            if not self.interpolated:
                corners.append([(np.floor(place).astype(np.int64), np.ones_like(place))])
                continue
            lower = np.floor(place - 0.5).astype(np.int64)
            part = place - 0.5 - lower
            corners.append([(lower, 1.0 - part), (lower + 1, part)])
        total = np.zeros(places[0].shape)
        for i, a in corners[0]:
            for j, b in corners[1]:
                for k, c in corners[2]:
                    total += (
                        a
                        * b
                        * c
                        * self.extinction[self._cell(0, i), self._cell(1, j), self._cell(2, k)]
                    )
        return np.where(inside, total, 0.0)

    def _cell(self, axis: int, index: NDArray[np.int64]) -> NDArray[np.int64]:
        """Index of a cell: periodic, or the nearest one of the box."""
        count = self.extinction.shape[axis]
        if axis < 2 and self.beyond == "periodic":
            return np.mod(index, count)
        return np.clip(index, 0, count - 1)

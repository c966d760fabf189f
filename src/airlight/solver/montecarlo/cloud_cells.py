"""Cloud fields as arrays for histories: cells, and maxima of blocks of cells."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

#: Largest number of cells of a block along each axis.
BLOCK_CELLS: Final = 8
#: Width over the planet's radius of the only cell of a periodic axis. [1]
_ENDLESS: Final = 100.0


class CloudCells(NamedTuple):
    """Cells of m cloud fields at one wavelength, in the frame of histories.

    Attributes
    ----------
    radius : float
        Radius of the ground. [m]
    axes : array, shape (m, 3, 3)
        East, north and up at the place of each field, by rows. [1]
    corner : array, shape (m, 3)
        Western and southern faces, and radius of the lowest ones. [m]
    spacing : array, shape (m, 3)
        Width of a cell. [m]
    number, block : array, shape (m, 3)
        Numbers of cells, and of cells of a block.
    kind : array, shape (m, 2)
        1 for a field that is periodic, and for one that is interpolated; otherwise 0.
    first : array, shape (m, 2)
        Index of the first cell and of the first block of each field.
    cells : array of float32, shape (n,)
        Extinction at 550 nm; the last axis of a field varies fastest. [m⁻¹]
    majorants : array of float32, shape (nb,)
        Largest extinction at 550 nm of blocks. [m⁻¹]
    extinction, albedo : array, shape (m,)
        Extinction over that at 550 nm, and single-scattering albedo. [1]
    """

    radius: float
    axes: FloatArray
    corner: FloatArray
    spacing: FloatArray
    number: IntArray
    block: IntArray
    kind: IntArray
    first: IntArray
    cells: NDArray[np.float32]
    majorants: NDArray[np.float32]
    extinction: FloatArray
    albedo: FloatArray

    def in_frame(self, frame: FloatArray) -> CloudCells:
        """Cells in a frame, whose axes are the rows of ``frame``."""
        return self._replace(axes=np.ascontiguousarray(self.axes @ frame.T))

    def with_optics(self, extinction: FloatArray, albedo: FloatArray) -> CloudCells:
        """Cells at another wavelength, from ``extinction`` and ``albedo``, shape (m,). [1]"""
        return self._replace(extinction=extinction, albedo=albedo)


@dataclass(frozen=True)
class CloudyStarts:
    """Starts of histories in clouds.

    Attributes
    ----------
    cells : sequence of CloudCells
        Clouds at each wavelength, in the planet's frame.
    frames : array, shape (n, 3, 3)
        Axes of ``vectors.start_vectors`` in the planet's frame, by rows. [1]
    areas : array, shape (n, 2, 3)
        Sides of the areas from which histories start, in the axes of ``frames``. [m]
    """

    cells: Sequence[CloudCells]
    frames: FloatArray
    areas: FloatArray

    def cells_at(self, line: int, wavelength: int) -> CloudCells:
        """Clouds in the frame of one line of sight."""
        return self.cells[wavelength].in_frame(self.frames[line])


def cloud_cells(fields: Sequence[CloudField], axes: FloatArray, radius: float) -> CloudCells:
    """Cells of fields at 550 nm, albedo 1.

    Parameters
    ----------
    axes : array, shape (m, 3, 3)
        East, north and up at the places, by rows. [1]
    radius : float
        Radius of the ground. [m]
    """
    sizes = [[_block_size(field, axis) for axis in range(3)] for field in fields]
    maxima = [_block_maxima(field, size) for field, size in zip(fields, sizes, strict=True)]
    cells = [field.extinction.ravel() for field in fields]
    spacing = np.array([f.spacing for f in fields], float)
    corner = np.array([[f.west, f.south, radius + f.base] for f in fields], float)
    for k, field in enumerate(fields):
        for axis in range(2):
            if field.beyond == "periodic" and field.extinction.shape[axis] == 1:
                # It does not depend on this coordinate: no ray meets a face.
                spacing[k, axis], corner[k, axis] = _ENDLESS * radius, -0.5 * _ENDLESS * radius
    starts = [np.cumsum([0, *(one.size for one in arrays[:-1])]) for arrays in (cells, maxima)]
    return CloudCells(
        radius=float(radius),
        axes=np.ascontiguousarray(axes),
        corner=corner,
        spacing=spacing,
        number=np.array([f.extinction.shape for f in fields], np.int64),
        block=np.array(sizes, np.int64),
        kind=np.array([[f.beyond == "periodic", f.interpolated] for f in fields], np.int64),
        first=np.stack(starts, axis=1).astype(np.int64),
        cells=cells[0] if len(cells) == 1 else np.concatenate(cells),
        majorants=np.concatenate(maxima),
        extinction=np.ones(len(fields)),
        albedo=np.ones(len(fields)),
    )


def _block_size(field: CloudField, axis: int) -> int:
    """Number of cells of a block; a whole number of blocks is a period."""
    count = int(field.extinction.shape[axis])
    if axis == 2 or field.beyond != "periodic":
        return min(count, BLOCK_CELLS)
    return max(size for size in range(1, BLOCK_CELLS + 1) if count % size == 0)


def _block_maxima(field: CloudField, size: Sequence[int]) -> NDArray[np.float32]:
    """Largest extinction in each block, flat; with its neighbours, if interpolated. [m⁻¹]"""
    found = field.extinction
    for axis, cells in enumerate(size):
        if field.interpolated:
            periodic = axis < 2 and field.beyond == "periodic"
            width = [(1, 1) if k == axis else (0, 0) for k in range(3)]
            padded = np.pad(found, width, mode="wrap" if periodic else "edge")
            count = found.shape[axis]
            shifted = [padded.take(range(k, k + count), axis) for k in range(3)]
            found = np.maximum(np.maximum(*shifted[:2]), shifted[2])
        found = np.maximum.reduceat(found, np.arange(0, found.shape[axis], cells), axis=axis)
    return np.ascontiguousarray(found).ravel()

"""Cells of the solver of boxes: those of a field, refined, above levels of clear air."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.errors import ParameterError
from airlight.solver.boxes.settings import BoxSettings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Most levels between ground and cloud, and their least depth over that of a cell.
_LEVELS_BELOW: Final = 6
_DEPTH_BELOW: Final = 4.0
#: Largest scaled optical depth of a level in all but a tenth of its columns. [1]
_LEVEL_DEPTH: Final = 4.0
_GAPS: Final = 0.1
#: Depth of a clear level above a field that has cloud in its highest cells, over theirs. [1]
_LID: Final = 0.02


@dataclass(frozen=True, eq=False)
class BoxGrid:
    """Cells of the solver.

    Attributes
    ----------
    extinction : array of float32, shape (levels, ny, nx)
        Mean extinction of the cloud at 550 nm in a cell. [m⁻¹]
    edges : array, shape (levels + 1,)
        Altitudes of the edges of the levels, from the ground. [m]
    widths : tuple of two float
        Widths of a cell to the east and to the north. [m]
    periodic : bool
        Whether the field repeats itself sideways.
    refinement : tuple of three int
        Cells along each axis of a cell of the field.
    below, above : int
        Levels below and above the field.
    """

    extinction: Float32Array
    edges: FloatArray
    widths: tuple[float, float]
    periodic: bool
    refinement: tuple[int, int, int]
    below: int
    above: int

    @property
    def flat(self) -> tuple[bool, bool]:
        """Whether light does not vary along x, and along y."""
        _, ny, nx = self.extinction.shape
        return self.periodic and nx == 1, self.periodic and ny == 1

    def coarse(self, values: Float32Array) -> Float32Array:
        """Means over the cells of the field of an array (levels, ny, nx, ...)."""
        x, y, z = self.refinement
        if self.refinement == (1, 1, 1):
            return values[: len(values) - self.above]
        below, above = values[: self.below], values[self.below : len(values) - self.above]
        shape = above.shape
        parts = above.reshape(shape[0] // z, z, *shape[1:]).mean(axis=1, dtype=np.float32)
        joined = np.concatenate([below, parts]) if self.below else parts
        return self.coarse_columns(joined) if x * y > 1 else joined

    def coarse_columns(self, values: Float32Array) -> Float32Array:
        """Means over the columns of the field of an array (n, ny, nx, ...)."""
        x, y, _ = self.refinement
        count, ny, nx, *rest = values.shape
        split = values.reshape(count, ny // y, y, nx // x, x, *rest)
        return np.asarray(split.mean(axis=(2, 4), dtype=np.float32))

    @property
    def coarse_edges(self) -> FloatArray:
        """Altitudes of the edges of the levels of the field and below. [m]"""
        z = self.refinement[2]
        return np.append(
            self.edges[: self.below], self.edges[self.below : self.edges.size - self.above : z]
        )


def box_grid(
    field: CloudField, ground: float | None, thickest: float, settings: BoxSettings
) -> BoxGrid:
    """Cells of a field, refined where they are optically thick and few; overcast levels always.

    Parameters
    ----------
    ground : float or None
        Altitude of the ground; None for the base of the field. [m]
    thickest : float
        Largest scaled extinction of the cloud per extinction at 550 nm. [1]

    Raises
    ------
    ParameterError
        If the ground is above the base of the field.
    """
    floor = field.base if ground is None else ground
    if floor > field.base:
        raise ParameterError("ground", floor, f"at most the base of the field, {field.base:g} m")
    shape, spacing = field.extinction.shape, field.spacing
    periodic = field.beyond == "periodic"
    refinement = _refinement(field, thickest, settings)
    cells = _means(field) if refinement == (1, 1, 1) else _sampled(field, refinement)
    step = spacing[2] / refinement[2]
    above = field.base + step * np.arange(shape[2] * refinement[2] + 1)
    gap = field.base - floor
    below = min(int(np.ceil(gap / (_DEPTH_BELOW * spacing[2]))), _LEVELS_BELOW) if gap > 0.0 else 0
    lower = floor + gap * np.arange(below) / max(below, 1)
    clear = np.zeros((below, *cells.shape[1::-1]), np.float32)
    # Where the beam enters a cloud, some of its light is given to the level before.
    lid = int(cells[..., -1].any())
    above = np.append(above, [above[-1] + _LID * step] * lid)
    return BoxGrid(
        np.ascontiguousarray(
            np.concatenate(
                [clear, cells.transpose(2, 1, 0), np.zeros((lid, *clear.shape[1:]), np.float32)]
            )
        ),
        np.concatenate([lower, above]),
        (spacing[0] / refinement[0], spacing[1] / refinement[1]),
        periodic,
        refinement,
        below,
        lid,
    )


def _refinement(field: CloudField, thickest: float, settings: BoxSettings) -> tuple[int, int, int]:
    """Number of cells along each axis of a cell of the field."""
    shape = field.extinction.shape
    flat = [field.beyond == "periodic" and count == 1 for count in shape[:2]] + [False]
    depths = [thickest * float(np.quantile(field.extinction, 0.98)) * one for one in field.spacing]
    found = [1, 1, _level_parts(field, thickest)]
    for _ in range(3 * settings.refinement):
        left = [
            0.0 if flat[axis] or found[axis] >= settings.refinement else depths[axis] / found[axis]
            for axis in range(3)
        ]
        axis = int(np.argmax(left))
        finer = [count + (k == axis) for k, count in enumerate(found)]
        if (
            left[axis] <= settings.largest_depth
            or field.extinction.size * np.prod(finer) > settings.most_cells
        ):
            break
        found = finer
    return found[0], found[1], found[2]


def _level_parts(field: CloudField, thickest: float) -> int:
    """Parts of a level, such that light does not leak through overcast.

    Beside gaps light passes anyway, and parts that are much wider than deep converge badly.
    """
    columns = field.extinction.reshape(-1, field.extinction.shape[2])
    most = float(np.quantile(columns, _GAPS, axis=0).max())
    return max(int(np.ceil(thickest * most * field.spacing[2] / _LEVEL_DEPTH)), 1)


def _means(field: CloudField) -> Float32Array:
    """Mean extinction of each cell: of linear interpolation, 1/8, 6/8 and 1/8 of neighbours."""
    cells = field.extinction
    if not field.interpolated:
        return cells
    for axis in range(3):
        wrap = axis < 2 and field.beyond == "periodic"
        pad = [(1, 1) if k == axis else (0, 0) for k in range(3)]
        wide = np.pad(cells, pad, mode="wrap" if wrap else "edge")
        count = cells.shape[axis]
        low, high = (wide.take(range(k, k + count), axis=axis) for k in (0, 2))
        cells = (0.75 * cells + 0.125 * (low + high)).astype(np.float32)
    return cells


def _sampled(field: CloudField, refinement: tuple[int, int, int]) -> Float32Array:
    """Extinction in the middle of parts of cells."""
    if not field.interpolated:
        cells = field.extinction
        for axis, count in enumerate(refinement):
            cells = np.repeat(cells, count, axis=axis)
        return cells
    start = (field.west, field.south, field.base)
    points = [
        start[axis] + (np.arange(count * parts) + 0.5) * (field.spacing[axis] / parts)
        for axis, (count, parts) in enumerate(zip(field.extinction.shape, refinement, strict=True))
    ]
    return field.at(*np.meshgrid(*points, indexing="ij", sparse=True)).astype(np.float32)

"""Problem of a box at four wavelengths, and its arrays in registers of eight lanes."""

from __future__ import annotations

from math import isqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import HALF_LANES, LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solver.boxes.beam import BeamCells, beam_row
from airlight.solver.boxes.directions import BoxDirections, harmonics, parities
from airlight.solver.boxes.grid import BoxGrid
from airlight.solver.boxes.scaled_optics import BoxOptics
from airlight.solver.boxes.sweep import SweepDirections

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Limits of the factor that conserves the energy of the beam; and cosine of the sun's zenith angle
#: below which the factor fades, as horizontal planes get beam from beyond the box. [1]
_LOST: Final = (0.9, 1.1)
_LOW: Final = 0.1


class BoxProblem(NamedTuple):
    """Problem of at most four wavelengths.

    Attributes
    ----------
    grid : BoxGrid
        Cells.
    optics : BoxOptics
        Coefficients of these wavelengths.
    towards : tuple of three float
        Unit vector to the sun.
    ground : array, shape (w,)
        Albedo of the ground. [1]
    sky : array, shape (4, n, w)
        Radiance that enters at the top, by octant and direction. [sr⁻¹]
    direct : array, shape (levels + 1, w)
        Irradiance of the beam at the edges of levels without cloud, normal to it. [1]
    curvature : float
        Reciprocal of the planet's radius. [m⁻¹]
    beam_depth : array, shape (ny, points, nx, levels + 1)
        Unscaled optical depth of the cloud along the beam, see ``beam_row``. [1]
    """

    grid: BoxGrid
    optics: BoxOptics
    towards: tuple[float, float, float]
    ground: FloatArray
    sky: FloatArray
    direct: FloatArray
    curvature: float
    beam_depth: Float32Array


def beam_depths(
    grid: BoxGrid,
    towards: tuple[float, float, float],
    points: int,
    cells: BeamCells,
    corner: tuple[float, float],
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Float32Array:
    """Unscaled optical depths of the cloud along the beam, see ``BoxProblem``.

    Parameters
    ----------
    cells : BeamCells
        Cells that the beam crosses.
    corner : tuple of two float
        Coordinates of the western and southern sides of the box. [m]
    """
    levels, ny, nx = grid.extinction.shape
    across = across_column(grid, points)
    found = np.zeros((ny, across[0] * across[1], nx, levels + 1), np.float32)
    columns = grid.edges, corner, grid.widths
    run_blocks(
        lambda y: beam_row(y, towards, across, columns, cells, found[y]),
        ny,
        progress=progress,
        cancel=cancel,
        message="shadows of clouds",
    )
    return found


def across_column(grid: BoxGrid, points: int) -> tuple[int, int]:
    """Points across a column along x and y from which the beam is followed."""
    flat_x, flat_y = grid.flat
    return 1 if flat_x else points, 1 if flat_y else points


def beam_cells(grid: BoxGrid, curvature: float) -> BeamCells:
    """Cells that the beam crosses."""
    _, ny, nx = grid.extinction.shape
    corner = -0.5 * nx * grid.widths[0], -0.5 * ny * grid.widths[1]
    return BeamCells(
        grid.extinction,
        grid.edges,
        corner,
        grid.widths,
        grid.periodic,
        grid.below,
        False,
        curvature,
    )


def four_wide(values: FloatArray) -> Float32Array:
    """Values with the last axis, of wavelengths, filled up to four by the first one."""
    missing = HALF_LANES - values.shape[-1]
    filled = np.concatenate([values, np.repeat(values[..., :1], missing, axis=-1)], axis=-1)
    return np.ascontiguousarray(filled, np.float32)


def _pairs(values: FloatArray) -> Float32Array:
    """Values (..., n, m) by direction as registers (..., n / 2, m, 8)."""
    *shape, count, kept = values.shape
    split = values.reshape(*shape, count // 2, 2, kept).swapaxes(-1, -2)
    return np.ascontiguousarray(np.repeat(split, HALF_LANES, axis=-1), np.float32)


def in_pairs(values: Float32Array) -> Float32Array:
    """Values (..., n, 4) by direction and wavelength as registers (..., n / 2, 8)."""
    shape = values.shape
    return np.ascontiguousarray(values, np.float32).reshape(*shape[:-2], shape[-2] // 2, LANES)


def sweep_directions(
    ways: BoxDirections, grid: BoxGrid, degree: int, towards: tuple[float, float, float]
) -> SweepDirections:
    """Directions of the sweeps of a grid."""
    vectors, weights = ways
    functions = harmonics(vectors, degree)
    widths = np.array([*grid.widths, 1.0])
    slopes = 2.0 * np.abs(vectors) / widths
    for axis, flat in enumerate(grid.flat):
        if flat:
            slopes[..., axis] = 0.0
    sun = harmonics(-np.array(towards), degree)
    kinds = parities(degree)
    order = np.argsort(kinds, kind="stable")
    first = functions[:, 0, :, order].transpose(1, 2, 0)  # (2, n, terms)
    return SweepDirections(
        _pairs(slopes[0, 0]),
        _pairs(first),
        np.ascontiguousarray(_pairs(first * weights[:, 0, :, None]).swapaxes(1, 2)),
        _pairs(vectors * weights[..., None]),
        np.asarray(sun, np.float32),
        order,
        np.searchsorted(kinds[order], np.arange(5)),
    )


def half_range(ways: BoxDirections, degree: int) -> Float32Array:
    """Moments of hemispheres of light of degrees 0 and 1, see ``rebalance.correct``."""
    vectors, weights = ways
    basis = np.concatenate([np.ones_like(vectors[..., :1]), 3.0 * vectors], axis=-1)
    functions = harmonics(vectors, degree) * weights[..., None] / (4.0 * np.pi)
    return np.asarray(np.einsum("hodt,hodi->hti", functions, basis), np.float32)


def begin(
    moments: Float32Array,
    ways: BoxDirections,
    degree: int,
    halves: tuple[Float32Array, Float32Array],
) -> Float32Array:
    """Fill moments of both hemispheres with given light; diffuse irradiance of the ground. [1]

    Parameters
    ----------
    moments : array, shape (levels, ny, nx, terms, 4)
        Moments of all directions, of any degree. [1]
    ways : BoxDirections
    degree : int
        Degree of the moments that are filled.
    halves : tuple of two arrays
        See ``SweepLight.moments``.
    """
    vectors, weights = ways
    known = harmonics(vectors, isqrt(moments.shape[3]) - 1)
    weighted = harmonics(vectors, degree) * weights[..., None]
    for half, kept in enumerate(halves):
        share = np.einsum("odt,odi->ti", weighted[half], known[half]).astype(np.float32)
        for level, row in enumerate(moments):
            kept[level] = share @ row
    falling = np.einsum("od,odi->i", weights[0] * -vectors[0, ..., 2], known[0])
    return np.asarray(np.maximum(falling.astype(np.float32) @ moments[0], 0.0))


def lost_light(
    problem: BoxProblem, thickness: Float32Array, beam: Float32Array, direct: Float32Array
) -> Float32Array:
    """Light that a periodic box takes from the beam, over that of its cells' means. [1]

    Parameters
    ----------
    problem : BoxProblem
    thickness : array, shape (levels,)
        Depth of the levels. [m]
    beam, direct : array
        See ``BoxLevels``.
    """
    grid, optics, cosine = problem.grid, problem.optics, max(problem.towards[2], 0.0)
    depths = np.asarray(thickness, np.float64)
    cloud = np.einsum("kyx,kyxw->kw", grid.extinction, beam) * four_wide(optics.cloud)
    clear = beam.sum(axis=(1, 2)) * four_wide(optics.air)
    given = depths @ (cloud + clear) / grid.extinction[0].size
    top = cosine * four_wide(problem.direct)[-1]
    lost = top - direct.mean(axis=(0, 1), dtype=np.float64)
    factor = np.divide(lost, given, out=np.ones_like(given), where=given > 1e-9)
    factor = np.clip(factor, *_LOST)
    if problem.curvature > 0.0:
        factor = 1.0 + min(cosine / _LOW, 1.0) * (factor - 1.0)
    return np.asarray(factor, np.float32)

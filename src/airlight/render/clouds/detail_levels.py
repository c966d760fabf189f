r"""Levels of detail of a cloud field: cells joined until they are as wide as a pixel's footprint.

A joined cell transmits what its columns transmit on average, rather than the mean extinction's
share, so that gaps between clouds stay transparent:

.. math:: e^{-\tau_{k+1}(z)} = \left\langle e^{-\tau_k(z)} \right\rangle,

with the delta-M scaled optical depth τ from the observer's side. Its light and its transmittance to
the sun are means over what is seen, weighted by the decrease of that transmittance.

Levels are stacked: each array of a layer holds them one after another along its rows.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.render.clouds.cell_level import SHARP
from airlight.render.clouds.clear_distance import clear_distances
from airlight.render.clouds.cloud_light import CloudLight

Float32Array = NDArray[np.float32]
FloatArray = NDArray[np.float64]

#: Weight of what is not seen. [1]
_UNSEEN: Final = 1e-6
#: Least transmittance. [1]
_DARK: Final = 1e-30


class Cells(NamedTuple):
    """Arrays of ``LayerTables`` at one level of detail.

    Attributes
    ----------
    extinction, clear, depth : array, shape (nz, ny, nx)
    base_depth : array, shape (ny, nx)
    source : array, shape (mz, my, mx, pairs, 8)
    down : array, shape (my, mx, 8)
    """

    extinction: Float32Array
    clear: Float32Array
    depth: Float32Array
    base_depth: Float32Array
    source: Float32Array
    down: Float32Array


def stacked(levels: list[Cells]) -> dict[str, Any]:
    """Arrays of ``LayerTables`` of levels of detail, with ``levels`` and ``source_levels``.

    Levels that share an array share its rows.
    """
    found: dict[str, Any] = {}
    for name, kind in (("levels", "extinction"), ("source_levels", "source")):
        first, rows, last = 0, [], None
        for one in levels:
            array = getattr(one, kind)
            if last is not None and array is not last:
                first += last.shape[1]
            rows.append((array.shape[2], array.shape[1], first))
            last = array
        found[name] = np.array(rows, np.int64)
    for name in Cells._fields:
        starts = found["source_levels" if name in ("source", "down") else "levels"]
        before = (slice(None),) * (0 if name in ("base_depth", "down") else 1)
        arrays = [getattr(one, name) for one in levels]
        shape = list(arrays[0].shape)
        shape[len(before)] = int(starts[-1, 1:].sum())
        found[name] = np.zeros(shape, np.float32) if starts[-1, 2] else arrays[0]
        for one, (columns, rows, first) in zip(arrays, starts, strict=True):
            if starts[-1, 2]:
                found[name][(*before, slice(first, first + rows), slice(columns))] = one
    return found


def joins(field: CloudField, width: float) -> int:
    """Number of levels of joined cells up to a footprint's width.

    Parameters
    ----------
    field : CloudField
        Clouds.
    width : float
        Largest width of a footprint. [m]
    """
    sides, counts, found = field.sides, field.extinction.shape[:2], 0
    while max(counts) > 1:
        if max(side / count for side, count in zip(sides, counts, strict=True)) * SHARP >= width:
            break
        counts, found = ((counts[0] + 1) // 2, (counts[1] + 1) // 2), found + 1
    return found


def detail_levels(light: CloudLight, finest: Cells, count: int, above: bool) -> list[Cells]:
    """Levels of detail.

    Parameters
    ----------
    light : CloudLight
        Light of the clouds.
    finest : Cells
        Cells of the field.
    count : int
        Number of levels of joined cells, see ``joins``.
    above : bool
        Whether the observer is above the clouds.
    """
    field, scaled, found = light.field, float(light.scaled.mean()), [finest]
    for _ in range(count):
        field, cells = _joined(field, found[-1], scaled, above)
        found.append(cells)
    return found


def _joined(
    field: CloudField, cells: Cells, scaled: float, above: bool
) -> tuple[CloudField, Cells]:
    """Field and cells of the next level."""
    nz, ny, nx = cells.extinction.shape
    rows, columns = (ny + 1) // 2, (nx + 1) // 2
    depth = scaled * field.spacing[2] * cells.extinction.astype(np.float64)
    seen = _transmittance(depth, above)
    kept = _coarse(seen, (rows, columns))
    lost = np.abs(np.diff(np.log(np.maximum(kept, _DARK)), axis=0))
    extinction = (lost / (scaled * field.spacing[2])).astype(np.float32)
    weight = np.abs(np.diff(seen, axis=0)) + _UNSEEN

    def mean_depth(values: Float32Array, weights: FloatArray) -> Float32Array:
        passed = _coarse(weights * np.exp(-scaled * values.astype(np.float64)), (rows, columns))
        ratio = passed / _coarse(weights, (rows, columns))
        return np.asarray(-np.log(np.maximum(ratio, _DARK)) / scaled, np.float32)

    source, down = cells.source, cells.down
    levels, lines, across = source.shape[:3]
    shape = min(lines, rows), min(across, columns)
    if shape != (lines, across):
        visible = _coarse(weight, (lines, across))
        shares = (_overlap(nz, levels) @ visible.reshape(nz, -1)).reshape(levels, lines, across)
        shares = shares.astype(np.float32)
        source = _coarse(source * shares[..., None, None], shape)
        source /= _coarse(shares, shape)[..., None, None]
        source = np.ascontiguousarray(source, np.float32)
        down = np.ascontiguousarray(_coarse(down[None], shape)[0], np.float32)
    east, north, up = field.spacing
    joined = replace(
        field,
        extinction=extinction.transpose(2, 1, 0),
        spacing=(east * nx / columns, north * ny / rows, up),
    )
    return joined, Cells(
        extinction=extinction,
        clear=clear_distances(joined),
        depth=mean_depth(cells.depth, weight),
        base_depth=mean_depth(cells.base_depth, np.ones((ny, nx))),
        source=source,
        down=down,
    )


def _transmittance(depth: FloatArray, above: bool) -> FloatArray:
    """Transmittance from the faces of cells of an optical depth to the top or to the base."""
    kept = np.ones((depth.shape[0] + 1, *depth.shape[1:]))
    if above:
        kept[:-1] = np.exp(-np.cumsum(depth[::-1], axis=0)[::-1])
    else:
        kept[1:] = np.exp(-np.cumsum(depth, axis=0))
    return kept


def _coarse(values: NDArray[Any], shape: tuple[int, int]) -> NDArray[Any]:
    """Means over the rows and columns of fewer cells; (…, ny, nx) or (nz, ny, nx, …)."""
    start = 0 if values.ndim == 2 else 1
    for axis, count in enumerate(shape, start=start):
        if values.shape[axis] == 2 * count:
            before = (slice(None),) * axis
            values = values[(*before, slice(0, None, 2))] + values[(*before, slice(1, None, 2))]
            values *= values.dtype.type(0.5)
        elif values.shape[axis] != count:
            mean = _overlap(values.shape[axis], count).astype(values.dtype)
            values = np.moveaxis(np.tensordot(mean, values, axes=(1, axis)), 0, axis)
    return values


def _overlap(many: int, few: int) -> FloatArray:
    """Shares of many equal parts of a length in each of few, shape (few, many). [1]"""
    edges, wide = np.arange(many + 1) / many, np.arange(few + 1) / few
    low = np.maximum(edges[None, :-1], wide[:-1, None])
    high = np.minimum(edges[None, 1:], wide[1:, None])
    return np.asarray(np.maximum(high - low, 0.0) * few)

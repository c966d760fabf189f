"""Table of the air in front of clouds, by direction and distance."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.render.clouds.mean_layer import MeanLayer
from airlight.render.clouds.sight_extent import node_distance, sight_extent
from airlight.render.pixels.sky_view_lut import (
    Observer,
    line_of_sight,
    line_of_texel,
    unseparated_phases,
)
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.solver.moments.march import march
from airlight.solver.moments.march_tables import MarchTables, MarchTerms, Segment, new_workspace
from airlight.solver.refracted_geometry import RefractedGeometry

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Azimuths from 0 to π, and rows of each half; and distances.
DIRECTIONS: Final = (41, 41)
DISTANCES: Final = 24
#: Layers: first order, two constituents without phase functions, higher orders, transmittance, and
#: higher orders of clear sky less those.
LAYERS: Final = 6
#: Longest length without light. [m]
_NOTHING: Final = 1e-3


def air_table(
    geometry: RefractedGeometry,
    tables: MarchTables,
    observer: Observer,
    window: SkyViewWindow,
    shell: tuple[float, float, float, float],
    layer: MeanLayer | None,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> tuple[Float32Array, Float32Array]:
    """Tables ``CloudTables.air`` and ``CloudTables.beyond``.

    Parameters
    ----------
    geometry, tables, observer : RefractedGeometry, MarchTables, Observer
        Of the solution, and of the frame.
    window : SkyViewWindow
        Directions.
    shell : tuple of four float
        Radii of observer, ground, bases and tops of clouds. [m]
    layer : MeanLayer, optional
        Mean layer of the clouds, whose light the air scatters.
    """
    lines = np.empty((window.texels, 7))
    true = np.empty((window.texels, DISTANCES))
    _lines(window, observer, tables, shell, lines, true)
    x, mu, longest = lines[:, 0], lines[:, 1], lines[:, 5]
    every = [np.repeat(one, DISTANCES) for one in (x, mu, longest)]
    length = geometry.optical_length(
        every[0], every[1], np.maximum(true.ravel(), 0.0), every[2], quick=True
    )
    length = np.minimum(length, every[2]).reshape(true.shape)
    # the last node is the end of the line, on the ground or in space
    length = np.concatenate([length, longest[:, None]], axis=1)
    out = np.zeros((window.texels, DISTANCES + 1, LAYERS, tables.lanes), np.float32)
    count = 0 if layer is None else layer.weights.shape[1]
    share = 16

    def fill(k: int) -> None:
        some = slice(k * share, (k + 1) * share)
        here = lines[some], length[some]
        _fill(*here, observer, tables, new_workspace(tables), out[some])
        if layer is None or observer.orders == 1:
            return
        found = [_higher(*here, one)[..., : len(layer.weights)] for one in layer.air]
        mean = layer.ratio(found) * out[some, :, 3, :count]
        out[some, :, 5, :count] = out[some, :, 3, :count] - mean
        out[some, :, 3, :count] = mean

    run_blocks(
        fill,
        -(-window.texels // share),
        progress=progress,
        cancel=cancel,
        message="air before clouds",
    )
    return np.ascontiguousarray(out[:, :-1]), out[:, -1, 5] - out[:, -2, 5]


def _higher(lines: FloatArray, length: FloatArray, tables: MarchTables) -> Float32Array:
    """Path radiance of higher orders of tables, shape (lines, nodes, w). [sr⁻¹]"""
    out = np.zeros((*length.shape, tables.lanes), np.float32)
    _fill_higher(lines, length, tables, new_workspace(tables), out)
    return out


@compiled_loop
def _lines(window, observer, tables, shell, lines, true):
    """Start, angles, length, way to the shell and half sine of each direction; true distances."""
    number = 0
    for row in range(2 * window.rows):
        sky = row < window.rows
        first = window.first_sky if sky else window.rows + window.first_ground
        count = window.sky_count if sky else window.ground_count
        if row < first or row >= first + count:
            continue
        for column in range(window.first_column, window.first_column + window.column_count):
            line = line_of_texel(column, row, window, observer, tables)
            r, mu, mu_s, nu, length = line_of_sight(line, observer, tables)
            way = 0.0
            if observer.outside:
                way = -observer.r * line.mu + r * mu
            lines[number, 0], lines[number, 1], lines[number, 2] = r, mu, mu_s
            lines[number, 3], lines[number, 4], lines[number, 5] = nu, line.half_sine, length
            extent = sight_extent(
                line.mu, line.sine, line.to_ground, shell[0], shell[1], shell[2], shell[3]
            )
            for node in range(true.shape[1]):
                true[number, node] = node_distance(node, true.shape[1], extent) - way
            number += 1


@compiled_loop
def _fill(lines, length, observer, tables, work, out):
    tables, work = without_refcount((tables, work))
    for k in range(lines.shape[0]):
        r, mu, mu_s, nu = lines[k, 0], lines[k, 1], lines[k, 2], lines[k, 3]
        half_sine = lines[k, 4]
        unseparated_phases(half_sine, tables.phase, tables, work.phase)
        for node in range(length.shape[1]):
            if length[k, node] <= _NOTHING:
                out[k, node, 4] = 1.0
                continue
            segment = Segment(r, mu, mu_s, nu, half_sine, length[k, node])
            if observer.orders != 0:
                march(segment, 1, MarchTerms(True, True, False), tables, work, work.radiance)
                for at in range(0, tables.lanes, LANES):
                    found, kept = lane_view(work.radiance, at), lane_view(out[k, node], at)
                    kept[0], kept[1], kept[2] = found[0], found[2], found[3]
                    kept[4] = found[1]
            if observer.orders != 1:
                march(segment, 0, MarchTerms(True, False, False), tables, work, work.radiance)
                for at in range(0, tables.lanes, LANES):
                    found, kept = lane_view(work.radiance, at), lane_view(out[k, node], at)
                    kept[3], kept[4] = found[0], found[1]


@compiled_loop
def _fill_higher(lines, length, tables, work, out):
    tables, work = without_refcount((tables, work))
    for k in range(lines.shape[0]):
        r, mu, mu_s, nu, half_sine = lines[k, 0], lines[k, 1], lines[k, 2], lines[k, 3], lines[k, 4]
        for node in range(length.shape[1]):
            if length[k, node] <= _NOTHING:
                continue
            segment = Segment(r, mu, mu_s, nu, half_sine, length[k, node])
            march(segment, 0, MarchTerms(True, False, False), tables, work, work.radiance)
            for at in range(0, tables.lanes, LANES):
                lane_view(out[k], at)[node] = lane_view(work.radiance, at)[0]

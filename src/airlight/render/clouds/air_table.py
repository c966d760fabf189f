"""Table of the air in front of clouds, by direction and distance."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.render.clouds.cloud_tables import (
    FIRST,
    FIRST_P,
    HIGHER,
    HIGHER_Q,
    HIGHER_U,
    LAYERS,
    LOST,
    LOST_Q,
    LOST_U,
    PEAKS,
    POLARISED_LAYERS,
    THROUGH,
)
from airlight.render.clouds.mean_layer import MeanLayer
from airlight.render.clouds.sight_extent import node_distance, sight_extent
from airlight.render.pixels.sky_view_lut import (
    Observer,
    line_of_sight,
    line_of_texel,
    unseparated_phases,
    upright,
)
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.solver.moments.march import march
from airlight.solver.moments.march_tables import MarchTables, MarchTerms, Segment, new_workspace
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.stokes_frame import star_plane
from airlight.solver.tables.ring_shadow import no_rings

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Azimuths from 0 to π, and rows of each half; and distances.
DIRECTIONS: Final = (41, 41)
DISTANCES: Final = 24
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
    polarised: bool = False,
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
    polarised : bool
        Whether the table has the layers of polarised light.
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
    layers = POLARISED_LAYERS if polarised else LAYERS
    out = np.zeros((window.texels, DISTANCES + 1, layers, tables.lanes), np.float32)
    count, air = (0, ()) if layer is None else (layer.weights.shape[1], layer.air)
    share = 16

    def fill(k: int) -> None:
        some = slice(k * share, (k + 1) * share)
        here = lines[some], length[some]
        _fill(*here, observer, tables, new_workspace(tables), out[some])
        if layer is None or observer.orders == 1:
            return
        found = [_higher(*here, observer, one, layers)[..., : len(layer.weights)] for one in air]
        clear = out[some, :, HIGHER, :count].copy()
        for at in (HIGHER, HIGHER_Q, HIGHER_U) if polarised else (HIGHER,):
            change = layer.change([one[:, :, at] for one in found], found[0][:, :, HIGHER])
            out[some, :, at, :count] += change * clear
            out[some, :, at + 1, :count] = -change * clear

    run_blocks(
        fill,
        -(-window.texels // share),
        progress=progress,
        cancel=cancel,
        message="air before clouds",
    )
    beyond = np.zeros((window.texels, 3, tables.lanes), np.float32)
    for stokes, at in enumerate((LOST, LOST_Q, LOST_U) if polarised else (LOST,)):
        beyond[:, stokes] = out[:, -1, at] - out[:, -2, at]
    return np.ascontiguousarray(out[:, :-1]), beyond


def _higher(
    lines: FloatArray, length: FloatArray, observer: Observer, tables: MarchTables, layers: int
) -> Float32Array:
    """Layers with the higher orders of other tables only, shape (lines, nodes, layers, w)."""
    out = np.zeros((*length.shape, layers, tables.lanes), np.float32)
    higher = observer._replace(orders=0)
    _fill(lines, length, higher, tables, new_workspace(tables), out)
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
            line = upright(line_of_texel(column, row, window, observer, tables))
            _, r, mu, mu_s, nu, length = line_of_sight(line, observer, tables)
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
    """Fill rows of ``CloudTables.air`` and beyond.

    Parameters
    ----------
    lines, length : array, shapes (n, 7) and (n, nodes)
        Results of ``_lines``, and optical lengths to the nodes. [m]
    observer, tables, work : Observer, MarchTables, MarchWorkspace
        Of the frame, and workspace.
    out : array, shape (n, nodes, layers, w)
        Receives the layers.
    """
    tables, work = without_refcount((tables, work))
    polarised = out.shape[2] > LAYERS
    for k in range(lines.shape[0]):
        r, mu, mu_s, nu = lines[k, 0], lines[k, 1], lines[k, 2], lines[k, 3]
        half_sine = lines[k, 4]
        cosine, sine = star_plane(mu, mu_s, nu)
        turn_cosine, turn_sine = np.float32(cosine), np.float32(sine)
        unseparated_phases(half_sine, tables.phase, tables, work.phase)
        if polarised:
            unseparated_phases(half_sine, tables.phase_f12, tables, work.phase_f12)
        for node in range(length.shape[1]):
            if length[k, node] <= _NOTHING:
                out[k, node, THROUGH] = 1.0
                continue
            segment = Segment(r, mu, mu_s, nu, half_sine, length[k, node], no_rings())
            if observer.orders != 0:
                terms = MarchTerms(True, True, polarised)
                march(segment, 1, terms, tables, work, work.radiance)
                for at in range(0, tables.lanes, LANES):
                    found, kept = lane_view(work.radiance, at), lane_view(out[k, node], at)
                    kept[FIRST], kept[PEAKS], kept[PEAKS + 1] = found[0], found[2], found[3]
                    kept[THROUGH] = found[1]
                    if polarised:
                        kept[FIRST_P] = found[4] * turn_cosine + found[5] * turn_sine
            if observer.orders != 1:
                terms = MarchTerms(True, False, polarised)
                march(segment, 0, terms, tables, work, work.radiance)
                for at in range(0, tables.lanes, LANES):
                    found, kept = lane_view(work.radiance, at), lane_view(out[k, node], at)
                    kept[HIGHER], kept[THROUGH] = found[0], found[1]
                    if polarised:
                        kept[HIGHER_Q], kept[HIGHER_U] = found[4], found[5]

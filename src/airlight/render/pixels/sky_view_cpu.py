"""Sky-view LUT computed on the CPU, complete or in the window of a camera.

It also serves software GPUs, on which the march is about fifteen times slower.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.lanes import LANES, lane_view
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.render.pixels.sea_sky import sea_sky_size
from airlight.render.pixels.sky_view_lut import Observer, mirrored_texel, sky_view_texel
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.solver.moments.march_tables import MarchTables, new_workspace

Float32Array = NDArray[np.float32]

#: Texels per task.
_BLOCK: Final = 256


class SkyViewLayers(NamedTuple):
    """Sky-view LUT, all wavelengths: fourth roots, each shape (texels, w).

    Rows of the sky come first, then of the ground; in ``air``, over water, the table of
    ``sea_sky`` follows. Unused layers have one texel.

    Attributes
    ----------
    air, ground : array
        Path radiance, and radiance of a white Lambert ground behind it. [sr^-¼]
    first, second : array
        Single scattering by separated constituents, without phase function. [1]
    stokes_q, stokes_u : array
        I + Q and I + U of the other path radiance; one texel if not requested. [sr^-¼]
    mirrored : array
        Mean sky that the sea mirrors at the end of each line to the ground, and following the
        ground, mean light there of the facets of resolved waves. [sr^-¼]
    """

    air: Float32Array
    ground: Float32Array
    first: Float32Array
    second: Float32Array
    stokes_q: Float32Array
    stokes_u: Float32Array
    mirrored: Float32Array

    @classmethod
    def none(cls) -> SkyViewLayers:
        """Empty layers."""
        empty = np.zeros((1, LANES), np.float32)
        return cls(*[empty] * 7)


@inlined
def _indices(texel, window):
    """Column and row of a texel in the whole LUT."""
    stride = window.column_count
    line, beyond = texel // stride, texel - stride * (window.sky_count + window.ground_count)
    column, row = window.first_column + texel - stride * line, window.first_sky + line
    if line >= window.sky_count:
        row = window.rows + window.first_ground + line - window.sky_count
    if beyond >= 0:
        down = beyond // window.columns
        column, row = beyond - window.columns * down, 2 * window.rows + down
    return column, row


@kernel
def _keep(found, row, layer, texel):
    """Copy a row of ``found`` to a texel."""
    for at in range(0, found.shape[1], LANES):
        lane_view(layer, at)[texel] = lane_view(found, at)[row]


@compiled_loop
def fill_texels(begin, end, window, observer, tables, work, layers):
    """Fill texels ``begin`` to ``end`` - 1 of all layers."""
    tables, work, layers = without_refcount((tables, work, layers))
    peaks, polarised = tables.separated_1 >= 0, layers.stokes_q.shape[0] > 1
    for texel in range(begin, end):
        column, row = _indices(texel, window)
        sky_view_texel(column, row, window, True, peaks, polarised, observer, tables, work)
        _keep(work.radiance, 0, layers.air, texel)
        _keep(work.radiance, 1, layers.ground, texel)
        if tables.separated_1 >= 0:
            _keep(work.radiance, 2, layers.first, texel)
        if tables.separated_2 >= 0:
            _keep(work.radiance, 3, layers.second, texel)
        if polarised:
            _keep(work.radiance, 4, layers.stokes_q, texel)
            _keep(work.radiance, 5, layers.stokes_u, texel)


@compiled_loop
def fill_mirrored(begin, end, window, observer, tables, work, layers):
    """Fill texels ``begin`` to ``end`` - 1 of the mirrored sky, once the table is filled."""
    tables, work, layers = without_refcount((tables, work, layers))
    ground = window.ground_count * window.column_count
    for texel in range(begin, end):
        third = (texel - window.sky_count * window.column_count) // ground
        column, row = _indices(texel - third * ground, window)
        row += third * window.rows
        mirrored_texel(column, row, window, layers.air, observer, tables, work)
        _keep(work.radiance, 0, layers.mirrored, texel)


def fill_sky_view(
    tables: MarchTables,
    observer: Observer,
    window: SkyViewWindow,
    *,
    polarised: bool = False,
    cancel: Cancel | None = None,
    progress: Progress | None = None,
) -> SkyViewLayers:
    """Fill the sky-view LUT.

    Parameters
    ----------
    tables : MarchTables
        Tables of the solution, with the resolution of the march.
    observer : Observer
        Position of observer and star.
    polarised : bool
        Whether Q and U are filled.

    Returns
    -------
    SkyViewLayers
        Layers with the lanes of ``tables``.
    """
    seen, ground = window.texels, window.ground_count * window.column_count
    wet = tables.ground.wet and observer.orders != 1
    texels = seen + (sea_sky_size(observer, window) if wet else 0)

    def layer(count: int = texels, *, kept: bool = True) -> Float32Array:
        return np.zeros((count if kept else 1, tables.lanes), np.float32)

    layers = SkyViewLayers(
        air=layer(),
        ground=layer(),
        first=layer(kept=tables.separated_1 >= 0),
        second=layer(kept=tables.separated_2 >= 0),
        stokes_q=layer(kept=polarised),
        stokes_u=layer(kept=polarised),
        mirrored=layer(max(seen + ground, 1), kept=wet),
    )

    def filled(loop: Any, first: int, count: int, progress: Progress | None) -> None:
        def run(index: int) -> None:
            begin = first + index * _BLOCK
            end = min(begin + _BLOCK, first + count)
            loop(begin, end, window, observer, tables, new_workspace(tables), layers)

        run_blocks(run, -(-count // _BLOCK), cancel=cancel, progress=progress, message="rendering")

    filled(fill_texels, 0, texels, progress)
    if wet:
        filled(fill_mirrored, seen - ground, 2 * ground, None)
    return layers

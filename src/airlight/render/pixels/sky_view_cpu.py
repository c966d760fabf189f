"""Sky-view LUT computed on the CPU, complete or in the window of a camera.

It also serves software GPUs, on which the march is about fifteen times slower.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.render.pixels.sky_view_lut import Observer, sky_view_texel
from airlight.render.pixels.sky_view_window import SkyViewWindow
from airlight.solver.moments.march_tables import MarchTables, new_workspace

Float32Array = NDArray[np.float32]

#: Texels per task.
_BLOCK: Final = 256


class SkyViewLayers(NamedTuple):
    """Sky-view LUT, all wavelengths: fourth roots, each shape (texels, w).

    Rows of the sky come first, then of the ground, then of the sky mirrored by water. Unused layers
    of absent peaked constituents have one texel.

    Attributes
    ----------
    air, ground : array
        Path radiance, and radiance of a white Lambert ground behind it. [sr^-¼]
    first, second : array
        Single scattering by separated constituents, without phase function. [1]
    stokes_q, stokes_u : array
        I + Q and I + U of the other path radiance; one texel if not requested. [sr^-¼]
    """

    air: Float32Array
    ground: Float32Array
    first: Float32Array
    second: Float32Array
    stokes_q: Float32Array
    stokes_u: Float32Array

    @classmethod
    def none(cls) -> SkyViewLayers:
        """Empty layers."""
        empty = np.zeros((1, LANES), np.float32)
        return cls(*[empty] * 6)


@compiled_loop
def fill_texels(begin, end, window, observer, tables, work, layers):
    """Fill texels ``begin`` to ``end`` - 1 of all layers."""
    tables, work, layers = without_refcount((tables, work, layers))
    peaks, polarised = tables.separated_1 >= 0, layers.stokes_q.shape[0] > 1
    stride = window.column_count
    sky_texels = stride * window.sky_count
    for texel in range(begin, end):
        column = window.first_column + texel % stride
        row = window.first_sky + texel // stride
        if texel >= sky_texels:
            line = (texel - sky_texels) // stride
            row = window.rows + window.first_ground + line
            if line >= window.ground_count:
                row += window.rows - window.ground_count
        sky_view_texel(column, row, window, True, peaks, polarised, observer, tables, work)
        layers.air[texel], layers.ground[texel] = work.radiance[0], work.radiance[1]
        if tables.separated_1 >= 0:
            layers.first[texel] = work.radiance[2]
        if tables.separated_2 >= 0:
            layers.second[texel] = work.radiance[3]
        if polarised:
            layers.stokes_q[texel], layers.stokes_u[texel] = work.radiance[4], work.radiance[5]


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
    texels = window.texels
    if tables.ground.wet:
        texels += window.ground_count * window.column_count

    def layer(*, kept: bool = True) -> Float32Array:
        return np.zeros((texels if kept else 1, tables.lanes), np.float32)

    layers = SkyViewLayers(
        air=layer(),
        ground=layer(),
        first=layer(kept=tables.separated_1 >= 0),
        second=layer(kept=tables.separated_2 >= 0),
        stokes_q=layer(kept=polarised),
        stokes_u=layer(kept=polarised),
    )

    def run(index: int) -> None:
        fill_texels(
            index * _BLOCK,
            min((index + 1) * _BLOCK, texels),
            window,
            observer,
            tables,
            new_workspace(tables),
            layers,
        )

    run_blocks(run, -(-texels // _BLOCK), cancel=cancel, progress=progress, message="rendering")
    return layers

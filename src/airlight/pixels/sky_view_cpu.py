"""Sky-view LUT computed on the CPU, complete or in the window of a camera.

It also serves software GPUs, on which the march is about fifteen times slower.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, load, store
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.kernel.without_refcount import without_refcount
from airlight.pixels.sky_view_lut import Observer, sky_view_texel
from airlight.pixels.sky_view_window import SkyViewWindow
from airlight.solvers.moments.march_tables import MarchTables, new_workspace

Float32Array = NDArray[np.float32]

#: Texels per task.
_BLOCK: Final = 256


class SkyViewLayers(NamedTuple):
    """Layers of the sky-view LUT as fourth roots, each shape (texels·w,).

    Rows of the sky come first, then of the ground, then of the sky mirrored by water. Unused layers
    have one value.

    Attributes
    ----------
    air, ground : array
        Radiance of the air, and of a white Lambert ground behind it. [sr^-¼]
    first, second : array
        Single scattering by separated constituents, without phase function. [1]
    stokes_q, stokes_u : array
        I + Q and I + U of the air, without separated constituents. [sr^-¼]
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
        empty = np.zeros(1, np.float32)
        return cls(*[empty] * 6)


@compiled_loop
def fill_texels(begin, end, window, observer, tables, work, layers):
    """Fill texels ``begin`` to ``end`` - 1 of all layers."""
    tables, work, layers = without_refcount((tables, work, layers))
    found, lanes = work.radiance, tables.lanes
    peaks, polarised = tables.separated_1 >= 0, layers.stokes_q.size > 1
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
        sky_view_texel(
            column, row, window.columns, window.rows, True, peaks, polarised, observer, tables,
            work, found,
        )  # fmt: skip
        for at in range(0, lanes, LANES):
            store(layers.air, lanes * texel + at, load(found, at))
            store(layers.ground, lanes * texel + at, load(found, lanes + at))
            if tables.separated_1 >= 0:
                store(layers.first, lanes * texel + at, load(found, 2 * lanes + at))
            if tables.separated_2 >= 0:
                store(layers.second, lanes * texel + at, load(found, 3 * lanes + at))
            if polarised:
                store(layers.stokes_q, lanes * texel + at, load(found, 4 * lanes + at))
                store(layers.stokes_u, lanes * texel + at, load(found, 5 * lanes + at))


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
    window : SkyViewWindow
        Window to fill.
    polarised : bool
        Whether Q and U are filled.
    cancel, progress : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    SkyViewLayers
        Layers with the lanes of ``tables``.
    """
    texels = window.texels
    if tables.ground.wet:
        texels += window.ground_count * window.column_count
    size = texels * tables.lanes
    layers = SkyViewLayers(
        air=np.empty(size, np.float32),
        ground=np.empty(size, np.float32),
        first=np.zeros(size if tables.separated_1 >= 0 else 1, np.float32),
        second=np.zeros(size if tables.separated_2 >= 0 else 1, np.float32),
        stokes_q=np.empty(size if polarised else 1, np.float32),
        stokes_u=np.empty(size if polarised else 1, np.float32),
    )

    def run(index: int) -> None:
        fill_texels(
            index * _BLOCK, min((index + 1) * _BLOCK, texels), window, observer, tables,
            new_workspace(tables), layers,
        )  # fmt: skip

    run_blocks(run, -(-texels // _BLOCK), cancel=cancel, progress=progress, message="rendering")
    return layers

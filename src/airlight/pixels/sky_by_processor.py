"""Table of the sky filled on the CPU: complete, or the part that a picture sees.

It serves pictures drawn on the CPU, and software devices, which run the shader's march about
fifteen times slower than the compiled one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop
from airlight.kernel.borrowing import borrowed
from airlight.kernel.lanes import LANES, fourth_root, load, splat, store
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.pixels.lines_by_processor import aim, ground_behind
from airlight.pixels.march_points import MarchPoints
from airlight.pixels.shown import Shown
from airlight.pixels.sky_table import Observer, direction_of_texel, phases_towards
from airlight.pixels.sky_window import SkyWindow
from airlight.solvers.moments.march import PACKET, march, new_packet
from airlight.solvers.moments.solution import MomentsSolution

Float32Array = NDArray[np.float32]

#: Number of texels that one call of a thread fills.
_BLOCK = 16 * PACKET


class SkyLayers(NamedTuple):
    """Table of the sky, all wavelengths: fourth roots, each shape (texels·w,).

    The sky's rows come first. Layers of absent peaked constituents have one value.

    Attributes
    ----------
    air, ground : array
        Radiance of the air, and of a ground of albedo 1 behind it. [sr^-¼]
    first, second : array
        Single scattering by the peaked constituents, without their phase functions. [1]
    """

    air: Float32Array
    ground: Float32Array
    first: Float32Array
    second: Float32Array

    @classmethod
    def none(cls) -> SkyLayers:
        """Empty table."""
        empty = np.zeros(1, np.float32)
        return cls(empty, empty, empty, empty)


@compiled_loop
def _fill(begin, end, window, observer, shown, light, panels, rules, packet, work, layers):
    """Fill texels ``begin`` to ``end`` - 1 of all layers."""
    shown, light, packet, work, layers = borrowed((shown, light, packet, work, layers))
    air, ground, first, second = layers
    radiance = work.radiance
    peaks = (shown.first_peak, shown.second_peak)
    lanes = light.air.ground.albedo.size
    stride = window.last_column - window.first_column + 1
    sky_texels = stride * (window.last_sky - window.first_sky + 1)
    behind = np.empty(lanes, np.float32)
    sines, cos_azimuths = np.empty(PACKET), np.empty(PACKET)
    for start in range(begin, end, PACKET):
        rays = min(PACKET, end - start)
        for p in range(rays):
            texel = start + p
            column = window.first_column + texel % stride
            row = window.first_sky + texel // stride
            if texel >= sky_texels:
                row = window.rows + window.first_ground + (texel - sky_texels) // stride
            mu, sine, cos_azimuth, half_sine = direction_of_texel(
                column, row, window.columns, window.rows, observer, shown
            )
            sines[p], cos_azimuths[p] = sine, cos_azimuth
            aim(p, mu, sine, cos_azimuth, texel >= sky_texels, observer, shown, packet)
            phases_towards(half_sine, False, shown, lanes, packet.phase[p])
        march(packet, rays, observer.orders, peaks, panels, rules, light, work)
        for p in range(rays):
            texel = start + p
            for at in range(0, lanes, LANES):
                store(air, lanes * texel + at, fourth_root(load(radiance[p], at)))
                store(behind, at, splat(0.0))
            if texel >= sky_texels:
                ground_behind(
                    p, sines[p], cos_azimuths[p], observer, shown, light, packet, work, behind
                )
            for at in range(0, lanes, LANES):
                store(ground, lanes * texel + at, fourth_root(load(behind, at)))
            for at in range(0, lanes, LANES):
                if peaks[0] >= 0:
                    store(first, lanes * texel + at, fourth_root(load(work.first[p], at)))
                if peaks[1] >= 0:
                    store(second, lanes * texel + at, fourth_root(load(work.second[p], at)))


def filled_sky(
    solution: MomentsSolution,
    shown: Shown,
    observer: Observer,
    window: SkyWindow,
    points: MarchPoints,
    *,
    cancel: Cancel | None = None,
    progress: Progress | None = None,
) -> SkyLayers:
    """Fill the table of the sky.

    Parameters
    ----------
    solution, shown : MomentsSolution, Shown
        Solution and its tables.
    observer : Observer
        Position of observer and star.
    window : SkyWindow
        Part of the table to fill.
    points : MarchPoints
        Resolution of the march.
    cancel, progress : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    SkyLayers
        Layers with the lanes of ``solution.light``.
    """
    light, texels = solution.light, window.texels
    size = texels * light.air.ground.albedo.size
    layers = SkyLayers(
        air=np.empty(size, np.float32),
        ground=np.empty(size, np.float32),
        first=np.zeros(size if shown.first_peak >= 0 else 1, np.float32),
        second=np.zeros(size if shown.second_peak >= 0 else 1, np.float32),
    )
    rules = tuple(gauss_legendre(count).as_tuple() for count in points.points)

    def run(index: int) -> None:
        _fill(
            index * _BLOCK, min((index + 1) * _BLOCK, texels), window, observer, shown, light,
            points.panels, rules, new_packet(light.scattering.size),
            solution.workspace(max(points.points), points.panels), layers,
        )  # fmt: skip

    run_blocks(run, -(-texels // _BLOCK), cancel=cancel, progress=progress, message="rendering")
    return layers

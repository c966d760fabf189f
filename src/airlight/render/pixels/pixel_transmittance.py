"""Transmittance of a planet's air along the line of sight of a pixel."""

from __future__ import annotations

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, splat, store
from airlight.render.pixels.star_disc import leaving_air
from airlight.solver.moments.source import transmittance_columns


@inlined
def pixel_transmittance(px, py, ray, beyond, exact, frame, work, color, result):
    """Spectral transmittance of a line of sight to space; 0 where it ends on the ground. [1]

    Parameters
    ----------
    px, py, ray, beyond, exact, frame, work, color :
        Arguments of ``pixel_light``.
    result : array, shape (w,)
        Receives the transmittance. [1]
    """
    tables = frame.tables
    _, free = leaving_air(ray, frame.observer, tables, work.columns_total)
    for at in range(0, tables.lanes, LANES):
        through = splat(0.0)
        if free:
            through = transmittance_columns(
                work.columns_total, lane_view(tables.extinction, at), tables.constituents
            )
        store(result, at, through)

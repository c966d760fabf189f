"""Light of a line of sight whose columns are longer than those that were marched."""

from __future__ import annotations

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, maximum, splat
from airlight.solver.moments.source import transmittance_columns

#: Opacity below which radiance grows as the columns. [1]
THIN = 1e-6


@inlined
def lengthen(ratio, extinction, frame, work):
    """Carry light of a line of sight on to columns that are longer by a ratio.

    The air is even along it: its radiance is (1 - T^b)/(1 - T) as large, what is behind it T^(b-1),
    for the transmittance T of the line and the ratio b.

    Parameters
    ----------
    ratio : float
        Ratio b. [1]
    extinction : array, shape (nc, w)
        Extinction coefficients. [m⁻¹]
    frame, work : FrameTables, MarchWorkspace
        What the pixels read; the workspace has the columns of the line, and its light, which is
        changed.
    """
    tables = frame.tables
    for at in range(0, tables.lanes, LANES):
        radiance, lanes = lane_view(work.radiance, at), lane_view(extinction, at)
        once = transmittance_columns(work.columns_total, lanes, tables.constituents)
        for c in range(tables.constituents):
            work.columns_total[c] *= ratio
        more = transmittance_columns(work.columns_total, lanes, tables.constituents)
        for c in range(tables.constituents):
            work.columns_total[c] /= ratio
        thin = np.float32(THIN)
        growth = (1.0 - more + thin * np.float32(ratio)) / (1.0 - once + thin)
        radiance[0] = radiance[0] * growth
        radiance[1] = radiance[1] * (more / maximum(once, splat(1e-30)))
        if frame.camera.filter > 0:
            radiance[4] = radiance[4] * growth
            radiance[5] = radiance[5] * growth

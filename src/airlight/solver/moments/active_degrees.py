"""Truncation of the spherical harmonics at each radius of an optically thick medium.

Under thick cloud radiance is nearly isotropic: its moments of high degree are a millionth of the
mean radiance, and the source function is computed without them.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.solver.moments.convergence import DARK
from airlight.solver.moments.setup import WavelengthBatch

Float32Array = NDArray[np.float32]

#: Largest neglected moments, over the mean radiance and the tolerance. [1]
_PART: Final = 0.005


def active_degrees(batch: WavelengthBatch, field: Float32Array) -> NDArray[np.int64]:
    """Highest active degree at each radius of the grid, shape (r,).

    A degree is active unless its contribution to the source function, relative to that of degree 0,
    is negligible at all nodes that are not dark.

    Parameters
    ----------
    batch : WavelengthBatch
        Set-up of the sweeps.
    field : array, shape (r, s, k, 8)
        Moments of an approximate solution, at the radii of the sweep.
    """
    setup, used = batch.setup, batch.used
    degree = setup.degree
    kept = batch.air.moments[..., :used]
    kept = (np.abs(kept) / np.maximum(kept[:, :1], 1e-30)).max(axis=0)
    mean = field[:, :, 0, :used]
    lit = mean > DARK * mean.max(axis=(0, 1))
    least = _PART * setup.settings.tolerance
    gathered = np.full(field.shape[0], min(2, degree))  # Q and U have degree 2
    for l in range(3, degree + 1):
        first = l * (l + 1) // 2
        size = np.sqrt(np.square(field[:, :, first : first + l + 1, :used]).sum(axis=2))
        counts = (size * kept[l] > least * mean) & lit
        gathered[counts.any(axis=(1, 2))] = l
    degrees = np.repeat(gathered, setup.refinement)[: setup.grid.radii.size]
    between = np.repeat(np.maximum(gathered[:-1], gathered[1:]), setup.refinement)
    degrees[:-1] = np.where(np.arange(between.size) % setup.refinement, between, degrees[:-1])
    return np.asarray(degrees, np.int64)

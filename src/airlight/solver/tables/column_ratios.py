"""Column table with rational interpolation: columns to the top, accurate to 1e-3."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.transmittance import direction_coordinate
from airlight.geometry.shell import distance_to_top
from airlight.kernel import inlined
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.density_profile import DensitySegments
from airlight.solver.tables.columns import ColumnTable, table_rays

FloatArray = NDArray[np.float64]

#: Mean relative density that is treated as 0, so that 1/sqrt of it is finite in single precision.
#: [1]
_LEAST: Final = 1e-30


def rational_mean_density(table: ColumnTable) -> FloatArray:
    """Column table for rational interpolation: (s, m·s), m the mean density on the ray.

    With m = column/distance and s = 1/sqrt(m), lerp(m·s)/lerp(s) is exact at the nodes, half-way
    between them for exponential m (in altitude, or away from the horizon), and everywhere in
    plane-parallel geometry, where m does not depend on direction. The column is this ratio times
    the distance to the top. Below 1e-6 of its largest value m is interpolated linearly.

    Returns
    -------
    array, shape (radii, directions, nc, 2)
        Pairs (s, m·s). [1]
    """
    r, mu, length = (np.empty(table.values.shape[:2]) for _ in range(3))
    table_rays(table.radii, table.bottom_radius, table.top_radius, r, mu, length)
    mean = table.values / np.maximum(length, 1e-9)[..., None]
    mean[-1, 0] = mean[-1, 1]  # at the top looking straight up, the distance is 0
    largest = mean.max(axis=(0, 1))
    scale = 1.0 / np.sqrt(np.maximum(mean + 1e-6 * largest, _LEAST))
    return np.stack([scale, mean * scale], axis=-1)


def column_rows(table: ColumnTable, density: DensitySegments) -> FloatArray:
    """Fractional row of a column table at each altitude node of the profiles, shape (n,). [1]

    Between rows it is linear in the distance to the horizon.
    """
    bottom = table.bottom_radius
    altitude = np.clip(table.radii - bottom, 0.0, None)
    x = np.sqrt(altitude * (altitude + 2.0 * bottom))
    node = density.node_altitudes
    horizon = np.sqrt(node * (node + 2.0 * bottom))
    return np.asarray(np.interp(horizon, x, np.arange(x.size, dtype=float)))


@inlined
def columns_to_top(r, mu, bottom, top, first_nodes, rows, ratios, out):
    """Columns from a point to the top of the shell, for a ray that misses the ground.

    Parameters
    ----------
    r, mu : float
        Radius of the point [m] and zenith cosine of the ray there [1].
    bottom, top : float
        Radii of ground and top. [m]
    first_nodes, rows : array
        First altitude node of each cell, and rows from ``column_rows``. [1]
    ratios : array, shape (radii, directions, nc, 2)
        Table from ``rational_mean_density``. [1]
    out : array, shape (nc,)
        Receives the columns. [m]
    """
    x = node_value(r, bottom, top, first_nodes, rows)
    row = min(int(x), ratios.shape[0] - 2)
    f = x - row
    x = direction_coordinate(r, mu, bottom, top) * (ratios.shape[1] - 1)
    cell_index = min(int(x), ratios.shape[1] - 2)
    e = x - cell_index
    w00, w01 = (1.0 - f) * (1.0 - e), (1.0 - f) * e
    w10, w11 = f * (1.0 - e), f * e
    distance = distance_to_top(r, mu, top)
    for c in range(ratios.shape[2]):
        scale = (
            w00 * ratios[row, cell_index, c, 0]
            + w01 * ratios[row, cell_index + 1, c, 0]
            + w10 * ratios[row + 1, cell_index, c, 0]
            + w11 * ratios[row + 1, cell_index + 1, c, 0]
        )
        scaled = (
            w00 * ratios[row, cell_index, c, 1]
            + w01 * ratios[row, cell_index + 1, c, 1]
            + w10 * ratios[row + 1, cell_index, c, 1]
            + w11 * ratios[row + 1, cell_index + 1, c, 1]
        )
        out[c] = distance * scaled / scale

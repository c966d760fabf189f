"""Interpolation in two-dimensional tables of several channels."""

from __future__ import annotations

from airlight.geometry.mappings.texels import cell
from airlight.kernel import compiled_loop


@compiled_loop
def bilinear(values, first, second, out):
    """Interpolate between the texels of a two-dimensional table.

    Parameters
    ----------
    values : array, shape (n1, n2, channels)
    first, second : array, shape (n,)
        Coordinates in [0, 1] along each axis. [1]
    out : array, shape (n, channels)
        Receives the values.
    """
    n1, n2, channels = values.shape
    for p in range(first.size):
        i0, i1, f = cell(first[p] * (n1 - 1), 0, n1 - 1)
        j0, j1, e = cell(second[p] * (n2 - 1), 0, n2 - 1)
        for c in range(channels):
            low = (1.0 - e) * values[i0, j0, c] + e * values[i0, j1, c]
            high = (1.0 - e) * values[i1, j0, c] + e * values[i1, j1, c]
            out[p, c] = (1.0 - f) * low + f * high

"""Boundaries of thin layers, and radii of a column table that resolve them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.transmittance import altitude_coordinate, radius_from_coordinate
from airlight.kernel import vectorized
from airlight.physics.optics.layer_edges import layer_edges
from airlight.solver.tables.columns import density_table, even_radii

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Largest optical depth between rows of the column table in layers aloft, largest change of a
#: profile between rows over its maximum, and largest number of rows over that of clear air.
_ROW_DEPTH: Final = 0.15
_ROW_CHANGE: Final = 0.15
#: Largest change between rows of the logarithm of the column above within a thin layer, down to a
#: small fraction of the layer's column, and of the logarithm of the distance to the top below it.
_ROW_FALL: Final = 0.15
_LEAST_ABOVE: Final = 0.01
_MOST_ROWS: Final = 8
#: Smallest scattering optical depth of a wide layer aloft that is resolved: a fainter one changes
#: sky radiance by less than 0.4 %, and panel ends would cost 10 % of a solve.
FAINT_AND_WIDE: Final = 0.01


def layer_ends(medium: Medium) -> FloatArray:
    """Altitudes inside the shell at which a thin layer begins or ends, ascending, (n,). [m]"""
    ends = [end for layer in medium.thin_layers for end in layer if 0.0 < end < medium.thickness]
    return np.unique(np.array(ends, float))


def column_radii(medium: Medium, rows: int) -> FloatArray:
    """Radii of the table of columns to the star, denser in thin and in optically thick layers. [m]

    Interpolation between rows is exact for an exponential profile. For a cloud with a sharp top the
    error is quadratic in the optical depth between rows: 5 % of the cloud's radiance for 1.

    Parameters
    ----------
    rows : int
        Number of rows for clear air.
    """
    bottom = medium.bottom_radius
    density, altitude = density_table(medium.density), medium.density.node_altitudes
    clear = vectorized(altitude_coordinate)(bottom + altitude, bottom, medium.top_radius)
    steps = (rows - 1) * np.diff(clear)
    largest = np.maximum(density.max(axis=0), 1e-300)
    needed = (np.abs(np.diff(density, axis=0)) / (_ROW_CHANGE * largest)).max(axis=1)
    strongest = medium.extinction.max(axis=1)
    step = 0.5 * (density[1:] + density[:-1]) * np.diff(altitude)[:, None]
    for layer in medium.thin_layers:
        inside = (altitude[:-1] >= layer.bottom) & (altitude[1:] <= layer.top)
        above = np.cumsum((step * inside[:, None])[::-1], axis=0)[::-1]
        above = np.log(above + _LEAST_ABOVE * above[0] + 1e-300)
        fall = np.abs(np.diff(above, axis=0, append=above[-1:])).max(axis=1)
        needed = np.maximum(needed, fall / _ROW_FALL)
        # Below a layer its column is constant, but the distance to the top is not.
        farther = np.log(medium.thickness - np.minimum(altitude, layer.bottom))
        needed = np.maximum(needed, np.abs(np.diff(farther)) / _ROW_FALL)
    brightest = medium.scattering.max(axis=1)
    if layer_edges(medium.density, brightest, faint_and_wide=FAINT_AND_WIDE).size:
        needed = np.maximum(needed, step @ strongest / _ROW_DEPTH)
    more = np.maximum(needed - steps, 0.0)
    more *= min(1.0, (_MOST_ROWS - 1) * rows / max(float(more.sum()), 1e-300))
    row = np.concatenate([[0.0], np.cumsum(steps + more)])
    count = round(row[-1]) + 1
    if count == rows:
        return even_radii(bottom, medium.top_radius, rows)
    x = np.interp(np.linspace(0.0, row[-1], count), row, clear)
    radii = vectorized(radius_from_coordinate)(x, bottom, medium.top_radius)
    return np.asarray(np.clip(radii, bottom, medium.top_radius))

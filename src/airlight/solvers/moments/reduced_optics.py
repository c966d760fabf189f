"""Optics of a medium, packed for kernels that run eight wavelengths at once.

Where light is scattered many times by particles with a sharp forward peak, the part
f = g_{N+1} of each scattering counts as unscattered (δ-M: Wiscombe 1977, JAS 34, 1408), and the
first order is computed with the exact phase function in the air so thinned (TMS: Nakajima &
Tanaka 1988, JQSRT 40, 51). Where the particles are thin the peak's light is scattered once, δ-M
gains nothing and spoils the narrow bright band along the horizon; f is therefore faded in with the
particles' vertical optical depth. Measurements: docs/decisions/0001-moments-in-the-twilight.md.
"""

from __future__ import annotations

from math import exp
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import kernel, vectorized
from airlight.mappings.transmittance import radius_from_coordinate
from airlight.optics.layer_edges import layer_edges
from airlight.planets.medium import Medium
from airlight.solvers.moments.grid import Grid
from airlight.solvers.moments.levels import Depths, panel_cuts
from airlight.solvers.moments.packing import pack
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.sweep import Air
from airlight.tables.columns import density_table

FloatArray = NDArray[np.float64]

#: Vertical scattering optical depth about which forward peaks begin to be cut off. [1]
THIN: Final = 0.1
#: Largest optical depth between rows of the table of columns in layers aloft, and largest number
#: of rows over that of clear air.
_ROW_DEPTH: Final = 0.15
_MORE_ROWS: Final = 8
#: Legendre moments below this count as zero.
NEGLIGIBLE: Final = 1e-6
#: Largest part of a scattering that counts as unscattered. [1]
MOST_PEAK: Final = 0.98


@kernel
def is_peaked(beyond):
    """Whether a phase function has a forward peak, by its first moment above the degree. [1]"""
    return abs(beyond) > NEGLIGIBLE


@kernel
def cut_weight(depth):
    """Weight of the removal of forward peaks, by the scattering depth of what is peaked. [1]"""
    return 1.0 - exp(-((depth / THIN) ** 2))


@kernel
def cut_part(beyond, weight):
    """Part of a scattering that counts as unscattered. [1]

    Parameters
    ----------
    beyond : float
        The phase function's first moment above the degree. [1]
    weight : float
        Weight from ``cut_weight``. [1]
    """
    if is_peaked(beyond):
        return min(max(beyond, 0.0), MOST_PEAK) * weight
    return 0.0


def peak_weight(medium: Medium, degree: int) -> FloatArray:
    """Weight of the removal of forward peaks, from 0 (thin) to 1 (thick), shape (nl,).

    Parameters
    ----------
    medium : Medium
        Medium; its scattering counts if the phase function has moments above the degree.
    degree : int
        Degree of the harmonics.
    """
    peaked = vectorized(is_peaked)(medium.phase_moments(degree + 1)[..., degree + 1])
    depth = (medium.scattering * medium.columns[:, None] * peaked).sum(axis=0)
    return np.asarray(vectorized(cut_weight)(depth))


def choose_degree(medium: Medium, settings: Settings) -> int:
    """Degree of the harmonics: no more than the phase functions need, higher for thick dust."""
    highest = settings.thick_degree
    moments = medium.phase_moments(highest)
    strong = np.abs(moments).max(axis=(0, 1)) > NEGLIGIBLE
    needed = int(np.flatnonzero(strong).max()) if strong.any() else 0
    thick = bool((peak_weight(medium, settings.degree) > 0.9).any())
    return max(2, min(needed, highest if thick else settings.degree))


def forward_peaks(medium: Medium, degree: int) -> FloatArray:
    """Part of each constituent's scattering that counts as unscattered, shape (nc, nl). [1]

    Parameters
    ----------
    medium : Medium
    degree : int
        Degree of the harmonics.
    """
    beyond = medium.phase_moments(degree + 1)[..., degree + 1]
    return np.asarray(vectorized(cut_part)(beyond, peak_weight(medium, degree)))


def scattering_depth(medium: Medium, degree: int) -> FloatArray:
    """Vertical scattering optical depth without forward peaks, shape (nl,). [1]

    Parameters
    ----------
    medium : Medium
    degree : int
        Degree of the harmonics.
    """
    smooth = medium.scattering * (1.0 - forward_peaks(medium, degree))
    return medium.columns @ smooth


def transport_depth(medium: Medium) -> FloatArray:
    """Vertical depth in which each scattering counts by 1 - g, shape (nl,). [1]"""
    forward = medium.scattering * medium.phase_moments(1)[..., 1]
    return medium.columns @ (medium.extinction - forward)


def optical_depths(medium: Medium, degree: int) -> Depths:
    """Depths that the radii follow.

    Parameters
    ----------
    medium : Medium
    degree : int
        Degree of the harmonics.
    """
    table = density_table(medium.density, medium.thickness)
    altitude = medium.thickness * np.linspace(0.0, 1.0, table.shape[0]) ** 2
    step = 0.5 * (table[1:] + table[:-1]) * np.diff(altitude)[:, None]
    column = np.concatenate([np.zeros((1, table.shape[1])), np.cumsum(step, axis=0)])
    smooth = medium.scattering * (1.0 - forward_peaks(medium, degree))
    return Depths(altitude, column @ smooth.max(axis=1))


def make_air(medium: Medium, degree: int, block: slice) -> Air:
    """Pack the optics of some of a medium's wavelengths in whole groups of eight lanes.

    Parameters
    ----------
    medium : Medium
        Medium with all wavelengths.
    degree : int
        Degree of the harmonics.
    block : slice
        Indices of the wavelengths.
    """
    moments = medium.phase_moments(degree + 1)[:, block]
    scattering = medium.scattering[:, block]
    extinction = medium.extinction[:, block]
    peak = forward_peaks(medium, degree)[:, block]
    scatters = (scattering > 0.0)[..., None]
    smooth = scattering[..., None] * (moments[..., : degree + 1] - peak[..., None]) * scatters
    return Air(
        extinction=pack(extinction - peak * scattering),
        moments=pack(np.moveaxis(smooth, 2, 1)),
        ground=medium.ground._replace(albedo=pack(medium.ground.albedo[block])),
        star_radius=float(medium.lights[0].angular_radius),
    )


def panel_ends(medium: Medium, grid: Grid, parts: int) -> FloatArray:
    """Altitudes at which the panels of rays end, ascending, inside the shell. [m]

    Parameters
    ----------
    medium : Medium
    grid : Grid
        Grid of the medium.
    parts : int
        More than 1 in thick air, whose levels are then the ends; otherwise those of layers aloft.
    """
    if parts > 1:
        return panel_cuts(grid.radii - grid.bottom_radius, parts)
    return layer_edges(medium.density, medium.scattering.max(axis=1))


def column_rows(medium: Medium, settings: Settings) -> int:
    """Number of radii of the table of columns towards the star: more where a layer aloft is thick.

    Between rows the table is exact for air that thins exponentially; for a cloud with an upper end
    it errs by the square of the optical depth from row to row: 5 % of a cloud's light for 1.

    Parameters
    ----------
    medium : Medium
    settings : Settings
        Settings with the number of rows of clear air.
    """
    rows = settings.column_radii
    if not layer_edges(medium.density, medium.scattering.max(axis=1)).size:
        return rows
    bottom = medium.bottom_radius
    coordinate = np.linspace(0.0, 1.0, rows)
    radii = vectorized(radius_from_coordinate)(coordinate, bottom, medium.top_radius)
    density = medium.density.at(radii - bottom)
    steps = 0.5 * (density[:, 1:] + density[:, :-1]) * np.diff(radii)
    most = float((medium.extinction.max(axis=1) @ steps).max())
    return rows * int(np.clip(np.ceil(most / _ROW_DEPTH), 1, _MORE_ROWS))

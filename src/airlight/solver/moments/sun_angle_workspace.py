"""Workspace of the ray march for many sun angles."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import MAX_EDGES
from airlight.solver.moments.harmonics import moment_count
from airlight.solver.moments.march_tables import MarchTables

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Largest number of sun angles of one line.
MOST_SUN_ANGLES: Final = 512


class SunAngleWorkspace(NamedTuple):
    """Workspace of one thread in addition to that of the march; n sun angles, w lanes.

    Attributes
    ----------
    edges : array, shape (n, MAX_EDGES)
        Ends of the panels for each sun angle. [m]
    columns_so_far : array, shape (n, nc)
        Columns up to the next panel. [m]
    next, counts, rules : array, shape (n,)
        Index of the next panel, number of edges, and start of the quadrature.
    faint : array, shape (n,)
        Multiple scattering is omitted at points that scatter less. [1]
    together : array, shape (n,)
        Indices of the sun angles that share a panel.
    transmittance, transmittance_once : array, shape (w,)
        Transmittance to a point times its weight, with and without delta-M scaling. [m]
    scattering : array, shape (nc, w)
        Scattering coefficients at a point. [m⁻¹]
    factors : array, shape (k, w)
        Harmonics of the line at a point times the moments' strengths. [m⁻¹]
    orders : array, shape (sun_angles, N + 2, w)
        Sums of the field's harmonics at a point over the degrees, by azimuthal order, and the
        field's scale, for each sun angle of the field.
    made : array, shape (sun_angles,)
        Whether these are computed for the point.
    sums : array, shape (n, 4 + nc, w)
        Sums over the line for each sun angle: path radiance, three of ``add_peaks``, single
        scattering by each constituent.
    """

    edges: FloatArray
    columns_so_far: FloatArray
    next: NDArray[np.int64]
    counts: NDArray[np.int64]
    rules: NDArray[np.int64]
    faint: FloatArray
    together: NDArray[np.int64]
    transmittance: Float32Array
    transmittance_once: Float32Array
    scattering: Float32Array
    factors: Float32Array
    orders: Float32Array
    made: NDArray[np.bool_]
    sums: Float32Array


def new_sun_angle_workspace(tables: MarchTables) -> SunAngleWorkspace:
    """Workspace for the tables of a solution."""
    lanes, count = tables.lanes, tables.constituents
    return SunAngleWorkspace(
        edges=np.empty((MOST_SUN_ANGLES, MAX_EDGES)),
        columns_so_far=np.empty((MOST_SUN_ANGLES, count)),
        next=np.empty(MOST_SUN_ANGLES, np.int64),
        counts=np.empty(MOST_SUN_ANGLES, np.int64),
        rules=np.empty(MOST_SUN_ANGLES, np.int64),
        faint=np.empty(MOST_SUN_ANGLES),
        together=np.empty(MOST_SUN_ANGLES, np.int64),
        transmittance=np.empty(lanes, np.float32),
        transmittance_once=np.empty(lanes, np.float32),
        scattering=np.empty((count, lanes), np.float32),
        factors=np.empty((moment_count(tables.degree), lanes), np.float32),
        orders=np.empty((tables.sun_angles, tables.degree + 2, lanes), np.float32),
        made=np.empty(tables.sun_angles, np.bool_),
        sums=np.empty((MOST_SUN_ANGLES, 4 + count, lanes), np.float32),
    )

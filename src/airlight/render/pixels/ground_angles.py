"""Angles at the ground intersection of a line of sight."""

from __future__ import annotations

from math import sqrt

from airlight.geometry.refraction import refraction_angle, turned
from airlight.geometry.shell import first_intersection
from airlight.kernel import inlined, kernel
from airlight.solver.tables.column_ratios import columns_to_top


@kernel
def star_from(across, up, radius, cos_azimuth, sun_x, sun_z):
    """Star-zenith cosine at a point of a line of sight. [1]

    Parameters
    ----------
    across, up, radius : float
        Coordinates from ``first_intersection``. [m]
    cos_azimuth : float
        Cosine of the line's azimuth from the star's vertical plane. [1]
    sun_x, sun_z : float
        Components as in ``Observer``. [1]
    """
    return min(max((across * cos_azimuth * sun_x + up * sun_z) / radius, -1.0), 1.0)


@inlined
def ground_cosine(z, sine, observer, tables):
    """Cosine of the reflection angle at the ground, towards the observer. [1]

    R - (R + h) sin θ is computed as R cos²θ/(1 + sin θ) - h sin θ, as single precision would have
    the difference to half a metre only.

    Parameters
    ----------
    z, sine : float
        Cosine and sine of the line's zenith angle at the observer. [1]
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.
    """
    within = max(tables.bottom * z * z / (1.0 + sine) - observer.optical_altitude * sine, 0.0)
    return sqrt(within * (2.0 * tables.bottom - within)) / tables.bottom


@inlined
def refraction_to_ground(z, sine, observer, tables, columns):
    """Angle of refraction of a line of sight that ends on the ground. [rad]

    Parameters
    ----------
    z, sine : float
        Cosine and sine of its zenith angle. [1]
    columns : array, shape (nc,)
        Workspace. [m]
    """
    bottom, top = tables.bottom, tables.top
    slant = ground_cosine(z, sine, observer, tables)
    columns_to_top(
        bottom, slant, bottom, top, tables.first_nodes, tables.column_rows, tables.columns, columns
    )
    column = columns[tables.constituents - 1]
    if not observer.outside:
        columns_to_top(
            observer.r,
            -z,
            bottom,
            top,
            tables.first_nodes,
            tables.column_rows,
            tables.columns,
            columns,
        )
        column = max(column - columns[tables.constituents - 1], 0.0)
    return refraction_angle(bottom, slant, tables.refraction_strength, column)


@inlined
def columns_to_ground(z, sine, observer, tables, columns, beyond):
    """Columns of all constituents between the observer and the ground, into ``columns``. [m]

    Parameters
    ----------
    z, sine, observer, tables :
        Arguments of ``refraction_to_ground``.
    columns : array, shape (nc,)
        Receives the columns. [m]
    beyond : array, shape (nc,)
        Workspace: columns of the line extended behind the observer. [m]
    """
    bottom, top = tables.bottom, tables.top
    slant = ground_cosine(z, sine, observer, tables)
    columns_to_top(
        bottom, slant, bottom, top, tables.first_nodes, tables.column_rows, tables.columns, columns
    )
    if not observer.outside:
        columns_to_top(
            observer.r,
            -z,
            bottom,
            top,
            tables.first_nodes,
            tables.column_rows,
            tables.columns,
            beyond,
        )
        for c in range(tables.constituents):
            columns[c] = max(columns[c] - beyond[c], 0.0)


@inlined
def ground_angles(x, z, sine, angle, observer, tables):
    """Angles at the ground intersection of a line of sight.

    Parameters
    ----------
    x, z, sine : float
        Components along x and z in the observer's frame, and sine of the zenith angle. [1]
    angle : float
        Angle of refraction. [rad]

    Returns
    -------
    mu_s, mu_r, nu : float
        Cosines of the star-zenith angle, of the reflection angle, and of the angle between line of
        sight and star. [1]
    """
    mu_r = ground_cosine(z, sine, observer, tables)
    across, up = first_intersection(min(observer.r * sine, tables.bottom), sine, tables.bottom)
    cos_azimuth = x / sine if sine > 0.0 else 1.0
    mu_s = star_from(across, up, tables.bottom, cos_azimuth, observer.sun_x, observer.sun_z)
    nu = min(max(x * observer.sun_x + z * observer.sun_z, -1.0), 1.0)
    if tables.refraction_strength > 0.0:
        mu_s, nu = turned(-mu_r, mu_s, nu, angle)
        mu_s = min(max(mu_s, -1.0), 1.0)
    return mu_s, mu_r, nu

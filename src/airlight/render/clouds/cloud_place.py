"""Places in the box of clouds, and what is there: clear distances, and the beam's optical depth."""

from __future__ import annotations

from math import exp, sqrt

from airlight.geometry.vectors import dot, plus, scaled
from airlight.kernel import inlined
from airlight.render.clouds.beam_depth import cell_before, cell_value, plane_value
from airlight.render.clouds.patches import displaced_patch


@inlined
def box_place(point, clouds):
    """Place of a point in the field, which is periodic or ends at the sides. [cells]

    Parameters
    ----------
    point : Vec3
        From the centre, in the observer's frame. [m]
    clouds : CloudTables
        Clouds.

    Returns
    -------
    x, y, z : float
        Columns, rows and levels from the middle of the first cell.
    """
    x, y, z, _, _ = patch_place(point, clouds)
    return x, y, z


@inlined
def patch_place(point, clouds):
    """``box_place`` and how far the same patch of the field goes; parameters as there.

    Returns
    -------
    x, y, z : float
        Result of ``box_place``. [cells]
    free, scale : float
        Distance from the point within which the patch is the same [m]; least length over that in
        the plane of the box [1].
    """
    height = dot(point, clouds.up)
    radius = sqrt(dot(point, point))
    factor = clouds.radius / max(height, 1e-3 * clouds.radius)
    east, north = factor * dot(point, clouds.east), factor * dot(point, clouds.north)
    ny, nx = clouds.base_depth.shape
    scale = min(max(height / radius, 1e-3), 1.0)
    scale *= scale
    free = 1e9
    if clouds.periodic:
        right, up, free = displaced_patch(
            east, north, nx * clouds.step_x, ny * clouds.step_y, clouds.edges
        )
        east += right
        north += up
    return (
        (east - clouds.corner_x) / clouds.step_x - 0.5,
        (north - clouds.corner_y) / clouds.step_y - 0.5,
        (radius - clouds.base) / clouds.step_z - 0.5,
        free * scale,
        scale,
    )


@inlined
def clear_distance(x, y, z, clouds):
    """Distance in the box from a place in which there are no clouds; 0 if unknown. [m]"""
    nz, ny, nx = clouds.clear.shape
    if not clouds.periodic:
        beyond_x = max(-0.5 - x, x - nx + 0.5) * clouds.step_x
        beyond_y = max(-0.5 - y, y - ny + 0.5) * clouds.step_y
        beyond = max(beyond_x, beyond_y)
        if beyond > 0.0:
            return 0.9 * beyond + 0.1 * clouds.step_x
    i, _ = cell_before(x + 0.5, nx, clouds.periodic)
    j, _ = cell_before(y + 0.5, ny, clouds.periodic)
    k = min(max(int(z + 0.5), 0), nz - 1)
    return clouds.clear[k, j, i]


@inlined
def beam_depth_at(point, clouds):
    """Optical depth of clouds at 550 nm between a point and the sun. [1]

    Parameters
    ----------
    point : Vec3
        From the centre, in the observer's frame. [m]
    clouds : CloudTables
        Clouds.
    """
    nz, ny, nx = clouds.extinction.shape
    radius = sqrt(dot(point, point))
    depth = 0.0
    if radius < clouds.base:
        rising = dot(point, clouds.sun)
        gap = (clouds.base - radius) * (clouds.base + radius)
        way = gap / (sqrt(rising * rising + gap) + max(rising, 0.0))
        x, y, _ = box_place(plus(point, scaled(clouds.sun, way)), clouds)
        if clouds.periodic or (-0.5 <= x < nx - 0.5 and -0.5 <= y < ny - 0.5):
            depth = plane_value(clouds.base_depth, x, y, clouds.periodic)
    elif radius < clouds.top:
        x, y, z = box_place(point, clouds)
        depth = cell_value(clouds.depth, x, y, z, clouds.periodic)
        # half a cell below the highest face the depth falls to that of the face
        depth *= min(2.0 * (nz - 0.5 - z), 1.0)
    return depth


@inlined
def visibility(point, footprint, clouds):
    """Transmittance of the beam by clouds, its mean where a footprint is as wide as the box. [1]"""
    depth, seen = beam_depth_at(point, clouds), 1.0
    if depth > 0.0:
        seen = exp(-depth * clouds.scaled[0, 0])
    wide = min(2.0 * footprint / (clouds.step_x * clouds.extinction.shape[2]), 1.0)
    return seen + wide * (clouds.mean_visibility - seen)

"""Places in the box of clouds, and what is there: clear distances, and the beam's optical depth."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from airlight.geometry.vectors import dot, plus, scaled
from airlight.kernel import inlined
from airlight.render.clouds.beam_depth import cell_before, cell_value, plane_value
from airlight.render.clouds.cell_level import cell_level, place_in_level
from airlight.render.clouds.local_sun import local_slant
from airlight.render.clouds.patches import MIXED, Patch, patch_at


class BoxPlace(NamedTuple):
    """Place of a point in the field, and in that of the neighbouring patch.

    Attributes
    ----------
    x, y, z : float
        Columns, rows and levels from the middle of the first cell. [cells]
    free : float
        Distance from the point within which there is no other patch; 0 if there is. [m]
    scale : float
        Least length over that in the plane of the box. [1]
    share : float
        Share of the neighbour. [1]
    other_x, other_y : float
        Place in the neighbour. [cells]
    """

    x: float
    y: float
    z: float
    free: float
    scale: float
    share: float
    other_x: float
    other_y: float


@inlined
def box_place(point, layer):
    """``BoxPlace`` of a point in the field, which is periodic or ends at the sides.

    Parameters
    ----------
    point : Vec3
        From the centre, in the observer's frame. [m]
    layer : LayerTables
        Clouds.
    """
    height = dot(point, layer.up)
    radius = sqrt(dot(point, point))
    factor = layer.radius / max(height, 1e-3 * layer.radius)
    east, north = factor * dot(point, layer.east), factor * dot(point, layer.north)
    cells = cell_level(0, layer.levels)
    scale = min(max(height / radius, 1e-3), 1.0)
    scale *= scale
    patch = Patch(0.0, 0.0, 1e9, 0.0, 0.0, 0.0)
    if layer.periodic:
        patch = patch_at(
            east, north, cells.columns * layer.step_x, cells.rows * layer.step_y, layer.edges
        )
    east, north = east - layer.corner_x, north - layer.corner_y
    return BoxPlace(
        (east + patch.right) / layer.step_x - 0.5,
        (north + patch.up) / layer.step_y - 0.5,
        (radius - layer.base) / layer.step_z - 0.5,
        patch.free * scale,
        scale,
        patch.share,
        (east + patch.other_right) / layer.step_x - 0.5,
        (north + patch.other_up) / layer.step_y - 0.5,
    )


@inlined
def clear_way(place, number, layer):
    """Distance from a place within which there are no clouds, in its patch and the other; or 0. [m]

    Parameters
    ----------
    place : BoxPlace
        Place.
    number : int
        Number of the level of detail.
    layer : LayerTables
        Clouds.
    """
    clear = place.scale * clear_distance(place.x, place.y, place.z, number, layer)
    if place.free > 0.0:
        return min(clear, place.free)
    other = place.scale * clear_distance(place.other_x, place.other_y, place.z, number, layer)
    # not beyond the band, where there may be a third patch
    width = layer.step_x * layer.levels[0, 0]
    return min(min(clear, other), place.scale * MIXED * width)


@inlined
def clear_distance(x, y, z, number, layer):
    """Distance in the box from a place in which there are no clouds; 0 if unknown. [m]"""
    nx, ny, _ = cell_level(0, layer.levels)
    if not layer.periodic:
        beyond_x = max(-0.5 - x, x - nx + 0.5) * layer.step_x
        beyond_y = max(-0.5 - y, y - ny + 0.5) * layer.step_y
        beyond = max(beyond_x, beyond_y)
        if beyond > 0.0:
            return 0.9 * beyond + 0.1 * layer.step_x
    level = cell_level(number, layer.levels)
    x, y = place_in_level(x, nx, level.columns), place_in_level(y, ny, level.rows)
    i, _ = cell_before(x + 0.5, level.columns, layer.periodic)
    j, _ = cell_before(y + 0.5, level.rows, layer.periodic)
    k = min(max(int(z + 0.5), 0), layer.clear.shape[0] - 1)
    return layer.clear[k, level.first + j, i]


@inlined
def beam_depth_at(point, number, layer):
    """Optical depth of clouds at 550 nm between a point and the sun, mean of its patches. [1]"""
    return box_depth_at(point, number, layer) * local_slant(point, layer)


@inlined
def box_depth_at(point, number, layer):
    """The same in the direction of the sun of the box. [1]

    Parameters
    ----------
    point : Vec3
        From the centre, in the observer's frame. [m]
    number : int
        Number of the level of detail.
    layer : LayerTables
        Clouds.
    """
    nx, ny, _ = cell_level(0, layer.levels)
    level = cell_level(number, layer.levels)
    radius = sqrt(dot(point, point))
    depth = 0.0
    if radius < layer.base:
        rising = dot(point, layer.sun)
        gap = (layer.base - radius) * (layer.base + radius)
        way = gap / (sqrt(rising * rising + gap) + max(rising, 0.0))
        point = plus(point, scaled(layer.sun, way))
    if radius < layer.top:
        place = box_place(point, layer)
        share, x, y = 1.0 - place.share, place.x, place.y
        for _turn in range(2):
            inside = layer.periodic or (-0.5 <= x < nx - 0.5 and -0.5 <= y < ny - 0.5)
            x, y = place_in_level(x, nx, level.columns), place_in_level(y, ny, level.rows)
            if share > 0.0 and radius >= layer.base:
                # half a cell below the highest face the depth falls to that of the face
                lower = min(2.0 * (layer.depth.shape[0] - 0.5 - place.z), 1.0)
                value = cell_value(layer.depth, level, x, y, place.z, layer.periodic)
                depth += share * lower * value
            elif share > 0.0 and inside:
                depth += share * plane_value(layer.base_depth, level, x, y, layer.periodic)
            share, x, y = place.share, place.other_x, place.other_y
    return depth

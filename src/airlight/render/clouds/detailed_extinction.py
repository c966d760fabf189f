"""Extinction of a field with the detail below its cells, as lines of sight meet it."""

from __future__ import annotations

from airlight.clouds.cloud_detail import cloud_detail
from airlight.clouds.fibres import TURN
from airlight.kernel import inlined
from airlight.render.clouds.beam_depth import cell_value
from airlight.render.clouds.cell_level import cell_level, place_in_level
from airlight.render.clouds.cloud_place import clear_distance

#: Change of detail along trails of crystals over that across them. [1]
ALONG_TRAIL = 0.1


@inlined
def extinction_at(place, width, number, layer):
    """Extinction at 550 nm with detail, of the patches at a place by their shares. [m⁻¹]

    Parameters
    ----------
    place : BoxPlace
        Place.
    width, number, layer : float, int, LayerTables
        Arguments of ``detailed_extinction``.
    """
    total, share, x, y = 0.0, 1.0 - place.share, place.x, place.y
    for _turn in range(2):
        if share > 0.0:
            total += share * detailed_extinction(x, y, place.z, width, number, layer)
        share, x, y = place.share, place.other_x, place.other_y
    return total


@inlined
def detailed_extinction(x, y, z, width, number, layer):
    """Extinction at 550 nm with detail below the cells. [m⁻¹]

    Parameters
    ----------
    x, y, z : float
        Place of ``BoxPlace``. [cells]
    width : float
        Width of the pixel's footprint. [m]
    number : int
        Number of the level of detail.
    layer : LayerTables
        Clouds.
    """
    nz, cells = layer.extinction.shape[0], cell_level(0, layer.levels)
    nx, ny = cells.columns, cells.rows
    found = 0.0
    if clear_distance(x, y, z, number, layer) > 0.0:
        return found
    if layer.periodic or (-0.5 <= x < nx - 0.5 and -0.5 <= y < ny - 0.5):
        factor = 1.0
        cell = min(layer.step_x, layer.step_y)
        if layer.detailed and width < 0.5 * cell:
            east, north, along = x * layer.step_x, y * layer.step_y, 1.0
            if layer.trail != 0.0:
                fallen = (nz - 0.5 - z) * layer.step_z
                along = ALONG_TRAIL
                east = along * (east + layer.trail * fallen * fallen)
                north += TURN * layer.trail * nz * layer.step_z * fallen
            detail = cloud_detail(east, north, z * layer.step_z * along, width, cell)
            factor = detail.factor
            x += detail.east / layer.step_x
            y += detail.north / layer.step_y
            z += along * detail.up / layer.step_z
        if -0.5 <= z < nz - 0.5:
            level = cell_level(number, layer.levels)
            x, y = place_in_level(x, nx, level.columns), place_in_level(y, ny, level.rows)
            found = factor * cell_value(layer.extinction, level, x, y, z, layer.periodic)
    return found

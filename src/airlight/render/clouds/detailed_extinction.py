"""Extinction of a field with the detail below its cells, as lines of sight meet it."""

from __future__ import annotations

from airlight.clouds.cloud_detail import cloud_detail
from airlight.clouds.fibres import TURN
from airlight.kernel import inlined
from airlight.render.clouds.beam_depth import cell_value
from airlight.render.clouds.cloud_place import clear_distance

#: Change of detail along trails of crystals over that across them. [1]
ALONG_TRAIL = 0.1


@inlined
def detailed_extinction(x, y, z, width, clouds):
    """Extinction at 550 nm with detail below the cells. [m⁻¹]

    Parameters
    ----------
    x, y, z : float
        Place from ``box_place``. [cells]
    width : float
        Width of the pixel's footprint. [m]
    clouds : CloudTables
        Clouds.
    """
    nz, ny, nx = clouds.extinction.shape
    found = 0.0
    if clear_distance(x, y, z, clouds) > 0.0:
        return found
    if clouds.periodic or (-0.5 <= x < nx - 0.5 and -0.5 <= y < ny - 0.5):
        factor = 1.0
        cell = min(clouds.step_x, clouds.step_y)
        if clouds.detailed and width < 0.5 * cell:
            east, north, along = x * clouds.step_x, y * clouds.step_y, 1.0
            if clouds.trail != 0.0:
                fallen = (nz - 0.5 - z) * clouds.step_z
                along = ALONG_TRAIL
                east = along * (east + clouds.trail * fallen * fallen)
                north += TURN * clouds.trail * nz * clouds.step_z * fallen
            detail = cloud_detail(east, north, z * clouds.step_z * along, width, cell)
            factor = detail.factor
            x += detail.east / clouds.step_x
            y += detail.north / clouds.step_y
            z += along * detail.up / clouds.step_z
        if -0.5 <= z < nz - 0.5:
            found = factor * cell_value(clouds.extinction, x, y, z, clouds.periodic)
    return found

"""Any projection's view vector by its number, for a processor that has no table of functions."""

from __future__ import annotations

from airlight.kernel import kernel
from airlight.scene.projections.cubemap import cube_ray
from airlight.scene.projections.equirectangular import panorama_ray
from airlight.scene.projections.fisheye import fisheye_ray
from airlight.scene.projections.perspective import perspective_ray


@kernel
def projected_ray(projection, x, y, width, height, field_of_view):
    """View vector of a point of a picture in the camera's frame.

    Parameters
    ----------
    projection : int
        Its place in ``PROJECTIONS``, counted from 0.
    x, y : float
        From the left and the top edge. [pixel]
    width, height : float
        Of the picture. [pixel]
    field_of_view : float
        As the projection's ``rays`` takes it. [rad]

    Returns
    -------
    right, up, forward : float
        Of unit length, or 0 where the picture shows nothing. [1]

    Examples
    --------
    >>> projected_ray(1, 2.0, 2.0, 4.0, 4.0, 3.0)  # the middle of a fisheye
    (0.0, 0.0, 1.0)
    """
    if projection == 0:
        return perspective_ray(x, y, width, height, field_of_view)
    if projection == 1:
        return fisheye_ray(x, y, width, height, field_of_view)
    if projection == 2:
        return panorama_ray(x, y, width, height, field_of_view)
    return cube_ray(x, y, width, height, field_of_view)

"""View vector of any projection by its number, for processors without a table of functions."""

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
        Index in ``PROJECTIONS``, counted from 0.
    x, y : float
        Distances from the left and the top edge. [pixel]
    width, height : float
        Size of the picture. [pixel]
    field_of_view : float
        Field of view, as the projection's ``rays`` takes it. [rad]

    Returns
    -------
    right, up, forward : float
        Components of a unit vector, or 0 where the picture shows nothing. [1]

    Examples
    --------
    >>> projected_ray(1, 2.0, 2.0, 4.0, 4.0, 3.0)  # the centre of a fisheye
    (0.0, 0.0, 1.0)
    """
    if projection == 0:
        return perspective_ray(x, y, width, height, field_of_view)
    if projection == 1:
        return fisheye_ray(x, y, width, height, field_of_view)
    if projection == 2:
        return panorama_ray(x, y, width, height, field_of_view)
    return cube_ray(x, y, width, height, field_of_view)

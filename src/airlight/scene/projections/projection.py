"""Interface of a projection."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Projection:
    """Mapping between image positions and directions.

    Parameters
    ----------
    name : str
        Name for the camera and the command line.
    ray : kernel
        Scalar function ``ray(x, y, width, height, field_of_view)`` that returns the view vector of
        an image point in the camera's frame (right, up, forward): of unit length, or zero outside
        the projection. ``x``, ``y``: distances from the left and the top edge in
        pixels, so that pixel i has its centre at i + 0.5. ``field_of_view``: radians.
    pixel_angle : callable
        Function ``pixel_angle(width, height, field_of_view)`` that returns the angle of a pixel on
        the optical axis. [rad]
    aspect : int or None
        Required aspect ratio, width over height; None for any. [1]
    shape : str
        Description of the aspect ratio, for error messages.
    size : (int, int)
        Default width and height. [pixel]
    sized : callable
        Function ``sized(number)`` that returns width and height for a size of one number. [pixel]
    field_of_view : float
        Default field of view. [deg]
    field_of_view_limits : (float, float)
        Smallest and largest allowed field of view. [deg]
    look_zenith : float
        Default zenith angle of the view. [deg]
    connected : bool
        Whether neighbouring pixels are neighbours in the sky, so that glare is defined.
    circular : bool
        Whether the image is limited to the largest circle that fits.
    parallel : bool
        Whether lines of sight are parallel.
    periodic : bool
        Whether the right edge continues at the left.
    """

    name: str
    ray: Callable[[float, float, float, float, float], tuple[float, float, float]]
    pixel_angle: Callable[[int, int, float], float]
    field_of_view: float
    field_of_view_limits: tuple[float, float]
    look_zenith: float
    aspect: int | None = None
    connected: bool = True
    circular: bool = False
    parallel: bool = False
    periodic: bool = False
    shape: str = "any shape"
    size: tuple[int, int] = (1280, 720)
    sized: Callable[[int], tuple[int, int]] = lambda number: (number, number)

    def fits(self, width: int, height: int) -> bool:
        """Whether the projection supports a frame size. [pixel]"""
        return self.aspect is None or width == self.aspect * height

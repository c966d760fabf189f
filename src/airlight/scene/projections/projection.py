"""Interface that every projection's file fills in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Projection:
    """A way to lay directions out on a picture.

    Parameters
    ----------
    name : str
        As the camera and the command line call it.
    rays : callable
        ``rays(x, y, width, height, field_of_view)`` gives the view vectors of the pixels in the
        camera's frame (right, up, forward), shape (len(y), len(x), 3): of unit length, or zero
        where the picture shows nothing. ``x``, ``y``: distances from the left and the top edge
        in pixels, so that pixel i has its centre at i + 0.5. ``field_of_view``: radians.
    pixel_angle : callable
        ``pixel_angle(width, height, field_of_view)``: the angle that one pixel spans where the
        picture looks straight ahead. [rad]
    fits : callable
        ``fits(width, height)``: whether a picture may have this shape.
    shape : str
        The allowed shapes in words, for the error.
    field_of_view : float
        Default field of view. [deg]
    field_of_view_limits : (float, float)
        Smallest and largest allowed. [deg]
    look_zenith : float
        Default zenith angle of the view. [deg]
    """

    name: str
    rays: Callable[[FloatArray, FloatArray, int, int, float], FloatArray]
    pixel_angle: Callable[[int, int, float], float]
    fits: Callable[[int, int], bool]
    shape: str
    field_of_view: float
    field_of_view_limits: tuple[float, float]
    look_zenith: float

"""Interface that every projection's file implements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Projection:
    """Projection of directions onto a picture.

    Parameters
    ----------
    name : str
        Name for the camera and the command line.
    rays : callable
        Function ``rays(x, y, width, height, field_of_view)`` that gives the view vectors of the
        pixels in the camera's frame (right, up, forward), shape (len(y), len(x), 3): of unit
        length, or zero where the picture shows nothing. ``x``, ``y``: distances from the left and
        the top edge in pixels, so that pixel i has its centre at i + 0.5. ``field_of_view``:
        radians.
    pixel_angle : callable
        Function ``pixel_angle(width, height, field_of_view)`` that gives the angle of one pixel
        where the picture looks straight ahead. [rad]
    fits : callable
        Function ``fits(width, height)``: whether a picture may have this size.
    shape : str
        Description of the allowed sizes, for the error.
    field_of_view : float
        Default field of view. [deg]
    field_of_view_limits : (float, float)
        Smallest and largest allowed field of view. [deg]
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

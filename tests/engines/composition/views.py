"""Cameras, and depths of simple bodies, for the tests of composition."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from airlight.engines.composition import Pinhole

FloatArray = NDArray[np.float64]


def looking(
    altitude: float, pitch: float, bearing: float = 0.0, *, size: tuple[int, int] = (96, 54),
    field_of_view: float = 60.0,
) -> Pinhole:  # fmt: skip
    """Camera above the origin of a scene whose +Y is north, Z up. [m], [deg]"""
    turn, rise = math.radians(bearing), math.radians(pitch)
    right = np.array([math.cos(turn), -math.sin(turn), 0.0])
    ahead = np.array([math.sin(turn) * math.cos(rise), math.cos(turn) * math.cos(rise),
                      math.sin(rise)])  # fmt: skip
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(right, ahead), -ahead], axis=-1)
    matrix[2, 3] = altitude
    focal = 0.5 * size[0] / math.tan(0.5 * math.radians(field_of_view))
    return Pinhole(width=size[0], height=size[1], focal_x=focal, focal_y=focal, to_world=matrix)


def directions(camera: Pinhole) -> FloatArray:
    """Unit vectors of all pixels in the scene's axes, shape (h, w, 3)."""
    rays = camera.rays(slice(0, camera.height))
    return np.asarray(rays / np.linalg.norm(rays, axis=-1, keepdims=True) @ camera.axes)


def distance_to_sphere(camera: Pinhole, centre: FloatArray, radius: float) -> FloatArray:
    """Distance to a sphere along each pixel's line, infinite where it is missed. [m]"""
    away = camera.position - centre
    along = directions(camera) @ away
    inside = along**2 - (away @ away - radius**2)
    near = -along - np.sqrt(np.maximum(inside, 0.0))
    return np.where((inside > 0.0) & (near > 0.0), near, np.inf)

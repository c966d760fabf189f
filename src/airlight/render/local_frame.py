"""Local frame of the observer in a scene of several bodies, and camera angles in it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from airlight.scene import Camera, Scene
from airlight.scene.directions import camera_axes
from airlight.scene.light_position import LightPosition

FloatArray = NDArray[np.float64]


def level_axes(up: FloatArray, towards: FloatArray | None = None) -> FloatArray:
    """Axes of the local frame as rows: x horizontally towards a light, z to the zenith. [1]"""
    flat = np.zeros(3)
    if towards is not None:
        flat = towards - (towards @ up) * up
    if np.linalg.norm(flat) < 1e-12:
        flat = np.cross(up, [0.0, 0.0, 1.0] if abs(up[2]) < 0.9 else [1.0, 0.0, 0.0])
    x = flat / np.linalg.norm(flat)
    return np.stack([x, np.cross(up, x), up])


def zenith_azimuth(towards: FloatArray) -> tuple[float, float]:
    """Zenith angle and azimuth of a direction in the local frame. [deg]"""
    x, y, z = (float(one) for one in towards)
    return math.degrees(math.atan2(math.hypot(x, y), z)), math.degrees(math.atan2(-y, x))


def camera_angles(axes: FloatArray) -> tuple[float, float, float]:
    """Zenith angle, azimuth and roll of a camera; inverse of ``camera_axes``. [deg]

    Parameters
    ----------
    axes : array, shape (3, 3)
        Right, up and forward in the local frame, as rows. [1]
    """
    right, _, forward = axes
    zenith, azimuth = zenith_azimuth(forward)
    level, upright, _ = camera_axes(zenith, azimuth, 0.0)
    return zenith, azimuth, math.degrees(math.atan2(-right @ upright, right @ level))


def metered_scene(camera: Camera, axes: FloatArray, stars: Sequence[FloatArray]) -> Scene:
    """Scene with a camera and stars only, for ``scene_exposure``.

    Parameters
    ----------
    camera : Camera
        Projection and size of the frame.
    axes : array, shape (3, 3)
        Right, up and forward of the camera in any frame, as rows. [1]
    stars : sequence of array, shape (3,)
        Directions of at least one star in that frame. [1]
    """
    local = level_axes(np.array([0.0, 0.0, 1.0]), stars[0])
    zenith, azimuth, roll = camera_angles(axes @ local.T)
    first, *others = (zenith_azimuth(local @ one) for one in stars)
    return Scene(
        camera=replace(camera, look_zenith=zenith, look_azimuth=azimuth, roll=roll),
        sun_zenith=first[0],
        secondary_lights=tuple(LightPosition(zenith=z, azimuth=a) for z, a in others),
    )

"""Cloud cover at a probe, on the line of sight and on the path from the star to the ground."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.image.texels import CHANNELS
from airlight.physics.optics.clouds import layer_distance
from airlight.scene import Scene
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.ground_place import latitude_longitude, map_color, map_level
from airlight.scene.light_position import LightPosition
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


def probed_clouds(
    solution: MomentsSolution,
    scene: Scene,
    direction: FloatArray,
    distance: float,
    position: LightPosition,
) -> tuple[float, float] | None:
    """Cloud cover on a line of sight to the ground, as in ``render.pixels.ground``.

    Parameters
    ----------
    solution : MomentsSolution
        Displayed solution.
    scene : Scene
        Observer and camera.
    direction : array, shape (3,)
        Direction in the observer's frame. [1]
    distance : float
        Distance to the ground; infinite if there is none. [m]

    Returns
    -------
    seen, shaded : float
        Cover on the line of sight, and on the path to the light. None without clouds. [1]
    """
    medium, bottom = solution.medium, solution.medium.bottom_radius
    if medium.surface.clouds is None or not np.isfinite(distance):
        return None
    overlay = ground_overlay(medium.surface.lights, medium.surface.clouds)
    assert overlay is not None
    place = distance * direction + np.array([0.0, 0.0, bottom + scene.altitude])
    cosine = -float(direction @ place) / bottom
    level = map_level(scene.camera.pixel_angle, distance, cosine, bottom, overlay.rows)
    covers = []
    for towards in (-direction, position.direction):
        mu = float(towards @ place) / bottom
        away = layer_distance(mu, bottom, medium.surface.cloud_altitude)
        spot = scene.ground_frame @ (place + away * towards)
        texel = np.empty(CHANNELS)
        map_color(
            overlay.flat, overlay.rows, overlay.columns, len(overlay.levels),
            *latitude_longitude(*spot), level, texel, 0,
        )  # fmt: skip
        covers.append(float(texel[CHANNELS - 1]))
    above = scene.altitude > medium.surface.cloud_altitude
    return covers[0] if above else 0.0, covers[1]

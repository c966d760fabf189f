"""Decomposition of a scene into single-light scenes, whose radiances add up."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from airlight.planets.light_source import LightSource
from airlight.render.pixels.light_visibility import light_visibility
from airlight.render.pixels.occulted_light import occulted_light
from airlight.scene import Scene
from airlight.scene.light_position import LightPosition
from airlight.solver.moments.solution import MomentsSolution


class SceneForLight(NamedTuple):
    """Scene and solution of a single light.

    Attributes
    ----------
    scene : Scene
        Scene in the frame of the light, as its sun.
    solution : MomentsSolution
        Solution with this light.
    air : bool
        Whether atmosphere and ground are illuminated; otherwise only the disc is rendered.
    light : LightPosition
        Light in the original scene.
    """

    scene: Scene
    solution: MomentsSolution
    air: bool
    light: LightPosition


def scenes_by_light(scene: Scene, solution: MomentsSolution) -> list[SceneForLight]:
    """Single-light scenes of all visible lights.

    All share one solution, scaled by the irradiance and spectrum of each light. City lights belong
    to the first. Eclipses follow ``occulted_light``, visibility ``light_visibility``.

    Parameters
    ----------
    scene : Scene
        Observer, lights and camera.

    Returns
    -------
    list of SceneForLight
        Single-light scenes, in the order of ``scene.lights``.
    """
    sources = solution.lights
    pictures: list[SceneForLight] = []
    for number, light in enumerate(scene.lights):
        source = occulted_light(light.source(sources), light, scene.lights)
        first = pictures[0].solution.lights[0] if pictures else source
        visibility = 2.0 if number == 0 else _visibility(scene, solution, light, source, first)
        if visibility == 0.0:
            continue
        plain = number == 0 and source is sources[0]
        lit = solution if plain else solution.with_light(source, secondary=number > 0)
        pictures.append(SceneForLight(scene.with_light(light), lit, visibility > 1.0, light))
    return pictures


def _visibility(
    scene: Scene,
    solution: MomentsSolution,
    light: LightPosition,
    source: LightSource,
    first: LightSource,
) -> float:
    """Visibility of a secondary light, see ``light_visibility``."""
    medium = solution.medium
    share = float(np.max(source.irradiance / np.maximum(first.irradiance, 1e-300)))
    return light_visibility(
        light.zenith, scene.lights[0].zenith, math.degrees(source.angular_radius), share,
        scene.altitude, medium.bottom_radius, medium.thickness,
    )  # fmt: skip

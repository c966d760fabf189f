"""Pictures that sum to a scene's: one for each of its lights."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from airlight.pixels.light_visibility import light_visibility
from airlight.pixels.occulted_light import occulted_light
from airlight.planets.light_source import LightSource
from airlight.scene import Scene
from airlight.scene.light_position import LightPosition
from airlight.solvers.moments.solution import MomentsSolution


class SceneForLight(NamedTuple):
    """Picture by one light.

    Attributes
    ----------
    scene : Scene
        Scene with the light at the sun's place.
    solution : MomentsSolution
        Solution under this light.
    air : bool
        Whether its light on air and ground is rendered; otherwise its disc alone.
    light : LightPosition
        The light in the scene of all.
    """

    scene: Scene
    solution: MomentsSolution
    air: bool
    light: LightPosition


def scenes_by_light(scene: Scene, solution: MomentsSolution) -> list[SceneForLight]:
    """Scene and solution of each light alone.

    Light adds up, so a picture is the sum of those of its lights: each has the light at the sun's
    place, with its own irradiance, spectrum and disc. No light costs another solve. The lamps of
    towns shine in the first.

    A moon in front of a star hides its disc and dims its light, see ``occulted_light``.

    Lights beside the first that cannot be seen are left out, see ``light_visibility``.

    Parameters
    ----------
    scene : Scene
        Observer, lights and camera.
    solution : MomentsSolution
        Solution of the planet.

    Returns
    -------
    list of SceneForLight
        Pictures, in the order of ``scene.lights``.
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
        lit = solution if plain else solution.lit_by(source, beside=number > 0)
        pictures.append(SceneForLight(scene.lit_by(light), lit, visibility > 1.0, light))
    return pictures


def _visibility(
    scene: Scene,
    solution: MomentsSolution,
    light: LightPosition,
    source: LightSource,
    first: LightSource,
) -> float:
    """Result of ``light_visibility`` for a light beside the first."""
    medium = solution.medium
    share = float(np.max(source.irradiance / np.maximum(first.irradiance, 1e-300)))
    return light_visibility(
        light.zenith, scene.lights[0].zenith, math.degrees(source.angular_radius), share,
        scene.altitude, medium.bottom_radius, medium.thickness,
    )  # fmt: skip

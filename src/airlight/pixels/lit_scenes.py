"""Pictures that sum to a scene's: one for each of its lights."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from airlight.pixels.light_shown import light_shown
from airlight.pixels.occulted_light import occulted_light
from airlight.planets.light_source import LightSource
from airlight.scene import Scene
from airlight.scene.light_position import LightPosition
from airlight.solvers.moments.solution import MomentsSolution


class LitScene(NamedTuple):
    """Picture by one light.

    Attributes
    ----------
    scene : Scene
        Scene with the light at the sun's place.
    solution : MomentsSolution
        Solution under this light.
    air : bool
        Whether its light on air and ground is drawn; otherwise its disc alone.
    light : LightPosition
        The light in the scene of all.
    """

    scene: Scene
    solution: MomentsSolution
    air: bool
    light: LightPosition


def lit_scenes(scene: Scene, solution: MomentsSolution) -> list[LitScene]:
    """Scene and solution of each light alone.

    Light adds up, so a picture is the sum of those of its lights: each has the light at the sun's
    place, with its own irradiance, spectrum and disc. No light costs another solve. The lamps of
    towns shine in the first.

    A moon in front of a star hides its disc and dims its light, see ``occulted_light``.

    Lights beside the first that cannot be seen are left out, see ``light_shown``.

    Parameters
    ----------
    scene : Scene
        Observer, lights and camera.
    solution : MomentsSolution
        Solution of the planet.

    Returns
    -------
    list of LitScene
        Pictures, in the order of ``scene.lights``.
    """
    sources = solution.lights
    pictures: list[LitScene] = []
    for number, light in enumerate(scene.lights):
        source = occulted_light(light.source(sources), light, scene.lights)
        first = pictures[0].solution.lights[0] if pictures else source
        shown = 2.0 if number == 0 else _shown(scene, solution, light, source, first)
        if shown == 0.0:
            continue
        plain = number == 0 and source is sources[0]
        lit = solution if plain else solution.with_light(source, secondary=number > 0)
        pictures.append(LitScene(scene.with_light(light), lit, shown > 1.0, light))
    return pictures


def _shown(
    scene: Scene,
    solution: MomentsSolution,
    light: LightPosition,
    source: LightSource,
    first: LightSource,
) -> float:
    """Result of ``light_shown`` for a light beside the first."""
    medium = solution.medium
    share = float(np.max(source.irradiance / np.maximum(first.irradiance, 1e-300)))
    return light_shown(
        light.zenith, scene.lights[0].zenith, math.degrees(source.angular_radius), share,
        scene.altitude, medium.bottom_radius, medium.thickness,
    )  # fmt: skip

"""Decomposition of a scene into single-light scenes, whose radiances add up."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from airlight.planets.light_source import LightSource
from airlight.render.pixels.occulted_light import occulted_light
from airlight.scene.light_position import LightPosition

if TYPE_CHECKING:
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

#: Irradiance over that of the first light below which a light is invisible by day. [1]
MIN_RELATIVE_IRRADIANCE: Final = 1e-5
#: Margin for refraction at the horizon and for twilight. [deg]
_LIFTED: Final = 1.0
_DEGREE: Final = 180.0 / math.pi


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
        light.zenith,
        scene.lights[0].zenith,
        math.degrees(source.angular_radius),
        share,
        scene.altitude,
        medium.bottom_radius,
        medium.thickness,
    )


def light_visibility(
    zenith: float,
    first_zenith: float,
    radius: float,
    share: float,
    altitude: float,
    bottom: float,
    thickness: float,
) -> float:
    """Visibility of a light: 2 for disc and illumination, 1 for the disc only, 0 for none.

    Also emitted as JavaScript.

    A light is invisible without irradiance or too far below the horizon to illuminate visible air.
    By day, illumination below ``MIN_RELATIVE_IRRADIANCE`` is ignored.

    Parameters
    ----------
    zenith, first_zenith : float
        Zenith angles of the light and of the first one. [deg]
    radius : float
        Angular radius of the light. [deg]
    share : float
        Irradiance over that of the first light. [1]
    altitude, bottom, thickness : float
        Altitude of the observer, radius of the ground, height of the shell. [m]

    Examples
    --------
    >>> [light_visibility(z, 40.0, 0.26, 2e-6, 0.0, 6360e3, 1e5) for z in (60.0, 95.0, 130.0)]
    [1.0, 0.0, 0.0]
    """
    if share <= 0.0:
        return 0.0
    dip = math.atan2(math.sqrt(altitude * (2.0 * bottom + altitude)), bottom) * _DEGREE
    below = zenith - 90.0 - dip - radius - _LIFTED
    # visible air extends as far beyond the horizon as sunlit air beyond the terminator
    lit = math.atan2(math.sqrt(thickness * (2.0 * bottom + thickness)), bottom) * _DEGREE
    if below > 2.0 * lit:
        return 0.0
    if altitude < thickness and first_zenith < 90.0 and share < MIN_RELATIVE_IRRADIANCE:
        return 1.0 if below < 0.0 else 0.0
    return 2.0
